"""Open border of a grid: pressure on it, and the load of the oil outside."""

from __future__ import annotations

import copy
from collections.abc import Callable

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.border_pressure import BorderPressure, border_pressure
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.terms.boundary import AmbientBorder
from gearlube_core.ehl.point.terms.linearisation import Linearisation


class OpenBorder(AmbientBorder):
    """Pressure that the oil beyond a domain sets on the border of a grid, in its units.

    Parameters
    ----------
    problem
        Contact and domain.
    scales, shape
        Of the grid.
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
        self._inside = np.zeros(shape, dtype=np.bool_)
        self._inside[1:-1, 1:-1] = True
        self._viscosity = 1.0

    def with_viscosity(self, factor: float) -> OpenBorder:
        """Return the border of an oil of `factor` times the viscosity."""
        border = copy.copy(self)
        border._viscosity = factor
        return border

    def load(self, approach: float) -> tuple[float, float]:
        """Return the load beyond the border and its slope by the approach [-]."""
        scales = self._scales
        load, slope = self._far.load(approach * scales.film, self._viscosity)
        unit = scales.pressure * scales.length**2
        return load / unit, slope * scales.film / unit

    def impose(self, pressure: Array, approach: float) -> Array:
        """Return a pressure, (ny, nx), with that of the oil beyond on the border."""
        pressure = np.where(self._inside, pressure, 0.0)
        pressure[~self._inside], _ = self._pressure(~self._inside, approach)
        return pressure

    def within(self, nodes: Flags) -> Flags:
        """Return the nodes inside the border."""
        return nodes & self._inside

    def slope(self, approach: float) -> Array:
        """Return the derivative of the pressure on the border by the approach, (ny, nx) [-]."""
        slope = np.zeros(self._inside.shape)
        _, slope[~self._inside] = self._pressure(~self._inside, approach)
        return slope

    def add_derivatives(
        self, linear: Linearisation, approach: float, grid: PointGrid, load: float
    ) -> None:
        """Add what the approach changes by way of the pressure on and beyond the border."""
        rise = self.slope(approach)
        beyond = self.load(approach)[1]
        linear.load_by_approach = (grid.integral(rise) + beyond) / load
        linear.by_approach = linear.by_approach + linear.apply(rise, 0.0, grid.deflection)

    def sentence(self, share: float) -> str:
        """Return a sentence on the share of the load that is carried beyond the border."""
        return f" Oil beyond the domain carries {100.0 * share:.2g} % of the load."

    def border_pressure(
        self, pressure: Array, film: Array, approach: float, outward: Callable[[Array], Array]
    ) -> BorderPressure:
        """Return how far the pressure beside the border is off that of the oil beyond."""
        return border_pressure(outward(pressure), outward(film), outward(self.beside(approach)))

    def beside(self, approach: float) -> Array:
        """Return the pressure beyond, continued to the nodes beside the border; (ny, nx) [-]."""
        ring = self._inside.copy()
        ring[2:-2, 2:-2] = False
        pressure = np.zeros(ring.shape)
        pressure[ring], _ = self._pressure(ring, approach)
        pressure[[0, -1]] = pressure[[1, -2]]
        pressure[:, [0, -1]] = pressure[:, [1, -2]]
        return pressure

    def _pressure(self, where: Flags, approach: float) -> tuple[Array, Array]:
        scales = self._scales
        pressure, slope = self._far.pressure(
            self._x[where], self._y[where], approach * scales.film, self._viscosity
        )
        return pressure / scales.pressure, slope * (scales.film / scales.pressure)
