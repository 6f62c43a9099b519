"""Terms of one level, built from a problem."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.film_shear import FilmShear, NewtonianShear
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.far_field import BorderPressure, border_pressure
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.solid_contact import SolidLayer
from gearlube_core.ehl.point.terms.boundary import AmbientBorder
from gearlube_core.ehl.point.terms.cavitation import (
    Cavitation,
    MassConservingCavitation,
    ReynoldsCavitation,
)
from gearlube_core.ehl.point.terms.differences import NoStorage, Storage
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.ehl.point.terms.solids import NoSolids, Solids, TouchingSolids
from gearlube_core.oil.film_oil import FilmOil, film_properties

Properties = tuple[Array, Array, Array, Array]
Shear = FilmShear | NewtonianShear


@dataclass(frozen=True, slots=True)
class OilTerm:
    """Oil in the units of a grid, at its own temperature or at those of a film."""

    oil: FilmOil
    # `cooling_factor` of the temperature and the density's factor by heat, (ny, nx) [-]
    warm: tuple[Array, Array] | None = None

    def properties(self, pressure: Array) -> Properties:
        """Return eta, d eta/dp, rho and d rho/dp at a pressure, of its shape [-]."""
        return film_properties(self.oil, pressure, self.warm)

    def heated(self, viscosity: Array, density: Array) -> OilTerm:
        """Return the oil at temperatures with these factors, (ny, nx) [-]."""
        return OilTerm(self.oil, (viscosity, density))


@dataclass(frozen=True, slots=True)
class UniformEntrainment:
    """All rows have the entrainment of the problem."""

    rows: Array  # entrainment over that of the problem, (ny,) [-]; all 1

    @classmethod
    def of(cls, count: int) -> UniformEntrainment:
        """Return that of a number of rows."""
        return cls(np.ones(count))

    def carried(self, values: Array) -> Array:
        """Return nodal values times the entrainment of their row, shape (ny, nx)."""
        return values


@dataclass(frozen=True, slots=True)
class RowEntrainment:
    """Every row has an entrainment of its own."""

    rows: Array  # entrainment over that of the problem, (ny,) [-]

    def carried(self, values: Array) -> Array:
        """Return nodal values times the entrainment of their row, shape (ny, nx)."""
        return self.rows[:, None] * values


Entrainment = UniformEntrainment | RowEntrainment


class OpenBorder(AmbientBorder):
    """Pressure that the oil beyond a domain sets on the border of a grid, in its units.

    Parameters
    ----------
    problem
        Contact and its domain.
    scales, shape
        Scales and shape of the grid.
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


@dataclass(frozen=True, slots=True)
class FilmTerms:
    """Terms that act in the film of one grid; `replace` gives another set.

    Every term has a null object that does no work: `UniformEntrainment`, `NoStorage`,
    `NewtonianShear`, `NoSolids`, `AmbientBorder`, `ReynoldsCavitation`.
    """

    oil: OilTerm
    shear: Shear  # flow factors
    entrainment: Entrainment
    storage: NoStorage | Storage
    solids: Solids
    boundary: AmbientBorder
    cavitation: Cavitation

    @classmethod
    def of(
        cls,
        problem: PointContactProblem,
        scales: PointScales,
        grid: PointGrid,
        sliding: tuple[float, float] | None,
        cavitation: str,
    ) -> FilmTerms:
        """Return the terms of a steady, isothermal problem.

        Parameters
        ----------
        problem, scales
            Contact and its units.
        grid
            Grid of this contact level.
        sliding
            Of an Eyring oil along the axes of the grid [m/s]; None: not given.
        cavitation
            Cavitation model: "reynolds" or "mass_conserving".
        """
        full = np.zeros(grid.shape, dtype=np.bool_)
        breaks: Cavitation = ReynoldsCavitation(full)
        if cavitation == "mass_conserving":
            layer = math.inf if problem.inlet_layer is None else problem.inlet_layer
            breaks = MassConservingCavitation.of(full, grid.metric, grid.dx, layer / scales.film)
        return cls(
            oil=OilTerm(scales.oil(problem.lubricant)),
            shear=film_shear(problem, scales, grid, sliding),
            entrainment=UniformEntrainment.of(grid.shape[0]),
            storage=NoStorage(np.zeros(grid.shape)),
            solids=_solids(problem, scales),
            boundary=(
                OpenBorder(problem, scales, grid.shape)
                if problem.oil_beyond
                else AmbientBorder(grid.sides)
            ),
            cavitation=breaks,
        )


def film_shear(
    problem: PointContactProblem,
    scales: PointScales,
    grid: PointGrid,
    sliding: tuple[float, float] | None,
) -> Shear:
    """Return the shear of a film that slides along the axes of the grid [m/s]."""
    if sliding is None or not problem.lubricant.shear.tau0 > 0.0:
        return NewtonianShear.of(grid.shape)
    return FilmShear.of(
        problem.lubricant,
        sliding,
        (grid.dx * scales.length, grid.dy * scales.length),
        grid.shape[0],
        film=scales.film,
        pressure=scales.pressure,
        viscosity=problem.lubricant.eta0,
        central=grid.central_spacing(),
        sides=grid.sides,
    )


def _solids(problem: PointContactProblem, scales: PointScales) -> Solids:
    if problem.solids is None:
        return NoSolids()
    thickness, pressure = problem.solids.thickness, problem.solids.pressure
    return TouchingSolids(SolidLayer(thickness / scales.film, pressure / scales.pressure))
