"""Border of a grid where the oil goes on: its pressure and the load beyond."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales


class OpenBorder:
    """Pressure that the oil beyond a domain sets on the border of a grid, in its units.

    Parameters
    ----------
    problem
        Contact and domain.
    scales, shape
        Of the grid.

    Attributes
    ----------
    inside : ndarray of bool, shape (ny, nx)
        All nodes but those of the border.
    thickening : float
        Multiple of the viscosity [-].
    """

    def __init__(
        self, problem: PointContactProblem, scales: PointScales, shape: tuple[int, int]
    ) -> None:
        nodes = shape if scales.swap else shape[::-1]
        x = np.linspace(*problem.x_limits, nodes[0])
        y = np.linspace(*problem.y_limits, nodes[1])
        # the cells of the nodes on the border end half a cell beyond it
        self._far = problem.far_field((0.5 * float(x[1] - x[0]), 0.5 * float(y[1] - y[0])))
        self._scales = scales
        self._x, self._y = (scales.inward(a) for a in np.meshgrid(x, y, indexing="ij"))
        self.inside = np.zeros(shape, dtype=np.bool_)
        self.inside[1:-1, 1:-1] = True
        self.thickening = 1.0

    def load(self, approach: float) -> tuple[float, float]:
        """Return the load beyond the border and its slope by the approach."""
        scales = self._scales
        load, slope = self._far.load(approach * scales.film, self.thickening)
        unit = scales.pressure * scales.length**2
        return load / unit, slope * scales.film / unit

    def impose(self, pressure: Array, approach: float) -> Array:
        """Return a pressure, (ny, nx), with that of the oil beyond on the border."""
        pressure = pressure.copy()
        pressure[~self.inside], _ = self._pressure(~self.inside, approach)
        return pressure

    def slope(self, approach: float) -> Array:
        """Return how pressure on the border answers to the approach, (ny, nx)."""
        slope = np.zeros(self.inside.shape)
        _, slope[~self.inside] = self._pressure(~self.inside, approach)
        return slope

    def beside(self, approach: float) -> Array:
        """Return the pressure beyond, continued to the nodes beside the border; (ny, nx)."""
        ring = self.inside.copy()
        ring[2:-2, 2:-2] = False
        pressure = np.zeros(ring.shape)
        pressure[ring], _ = self._pressure(ring, approach)
        pressure[[0, -1]] = pressure[[1, -2]]
        pressure[:, [0, -1]] = pressure[:, [1, -2]]
        return pressure

    def _pressure(self, where: Flags, approach: float) -> tuple[Array, Array]:
        scales = self._scales
        pressure, slope = self._far.pressure(
            self._x[where], self._y[where], approach * scales.film, self.thickening
        )
        return pressure / scales.pressure, slope * (scales.film / scales.pressure)
