"""A transient film problem, its grids, and a section of a line contact as one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.grid_error import twice_as_wide
from gearlube_core.ehl.point.equations.stencil import Grading, x_nodes
from gearlube_core.ehl.point.level import DISCRETE, PointLevel
from gearlube_core.ehl.point.newton.transfer import Hierarchy, Transfer, grid_shapes
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import PointSolverSettings, Sides
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.transient.level import Conditions, FilmConditions, MovingLevel
from gearlube_core.ehl.transient.rows import row_shapes
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil import FilmOil

_LONG = 3.0  # spacing across the motion over that along it, from which rows are solved whole
# (x, y, time) to heights of both solids above their smooth shape together [m], shape (nx, ny)
Heights = Callable[[Array, Array, float], Array]


@dataclass(frozen=True, slots=True, kw_only=True)
class MovingFilm:
    """A film over a rectangle whose gap, load and speeds follow from time.

    d/dx(F_x dp/dx) + d/dy(F_y dp/dy) = d(u rho h)/dx + d(v rho h)/dy + d(rho h)/dt,
    u = u(y, t),  v = s(t) u,  p = 0 on the border,
    h = h_0(t) + h_u(x, y, t) + 1/(pi E*) int p/r,  int p = W(t),  p >= 0

    F is rho h^3/(12 eta), times the flow factors of an Eyring oil.

    Parameters
    ----------
    conditions
        Of nodes and time.
    lubricant
        Oil; Newtonian where its Eyring stress is zero.
    contact_modulus
        E* [Pa]; half of E' = 2 E*.
    x_limits, y_limits
        Domain [m]; oil flows towards larger x.
    nodes
        Along x and along y, border included: 17 to 2049.
    hertz, load, speed
        Relative radii, W [N] and entrainment [m/s] that set scales; any typical ones.
    open_film
        Where the film is thicker [m] the oil is held at ambient pressure.
    solids
        What carries load where the film vanishes; None: the oil alone.
    grading
        Of the spacing along x; None: uniform.
    sides : {"ambient", "cyclic", "no_flow"}
        What the film meets at both limits of y, see `Sides`. Closed sides take `hertz.R_x` for the
        scales and a uniform spacing; conditions get the rows in the middle of their cells.

    Raises
    ------
    ParameterError
        An input is out of range.
    """

    conditions: Conditions
    lubricant: FilmOil
    contact_modulus: float
    x_limits: tuple[float, float]
    y_limits: tuple[float, float]
    nodes: tuple[int, int]
    hertz: EllipticParaboloid
    load: float
    speed: float
    open_film: float = math.inf
    solids: SolidContact | None = None
    grading: Grading | None = None
    sides: str = "ambient"

    def __post_init__(self) -> None:
        self.reference()

    def reference(self) -> PointContactProblem:
        """Return the steady contact of smooth solids that sets the scales."""
        return PointContactProblem(
            gap=self.hertz,
            entrainment=(self.speed, 0.0),
            load=self.load,
            contact_modulus=self.contact_modulus,
            lubricant=self.lubricant,
            x_limits=self.x_limits,
            y_limits=self.y_limits,
            nodes=self.nodes,
            hertz=self.hertz,
            solids=self.solids,
            sides=self.sides,
        )

    @property
    def x(self) -> Array:
        """Return the nodes along x [m], shape (nx,)."""
        return x_nodes(self.x_limits, self.nodes[0], self.grading)

    @property
    def y(self) -> Array:
        """Return the nodes along y [m], shape (ny,)."""
        return Sides(self.sides).rows(self.y_limits, self.nodes[1])

    def with_nodes(self, nx: int, ny: int) -> MovingFilm:
        """Return the same film on another grid."""
        return replace(self, nodes=(nx, ny))

    def widened(self) -> MovingFilm | None:
        """Return the film on twice the domain, nodes kept; None: it may not go on.

        Along y no farther where the solids end, at films that are held open.
        """
        x, y = self.x_limits, self.y_limits
        if self.grading is not None or Sides(self.sides).closed or not x[0] < 0.0 < x[1]:
            return None
        x, nx = twice_as_wide(x, self.nodes[0])
        wide = replace(self, x_limits=x, nodes=(nx, self.nodes[1]))
        if math.isfinite(self.open_film) or not y[0] < 0.0 < y[1]:
            return wide
        y, ny = twice_as_wide(y, self.nodes[1])
        return replace(wide, y_limits=y, nodes=(nx, ny))

    @property
    def long(self) -> bool:
        """Tell whether rows along x are so far apart that they are best solved whole."""
        dx, dy = self.reference().spacing
        return dy > _LONG * dx and not Sides(self.sides).closed

    def grids(self, settings: PointSolverSettings) -> Hierarchy:
        """Return the nested grids with the conditions of no time yet."""
        (nx, ny), (dx, dy) = self.nodes, self.reference().spacing
        return self._hierarchy(grid_shapes((ny, nx), (dy, dx), Sides(self.sides)), settings)

    def row_grids(self, settings: PointSolverSettings) -> Hierarchy:
        """Return grids that differ in the number of their rows alone."""
        nx, ny = self.nodes
        return self._hierarchy(row_shapes((ny, nx)), settings)

    def with_rows_below(self, grids: Hierarchy, settings: PointSolverSettings) -> Hierarchy:
        """Return `row_grids` with the finest of `grids`, whose conditions and load hold."""
        finest = grids.levels[-1]
        rows = self._hierarchy(row_shapes(finest.shape), settings, finest)
        for level in rows.levels:
            level.set_load(finest.load)
        return rows

    def _hierarchy(
        self,
        shapes: list[tuple[int, int]],
        settings: PointSolverSettings,
        finest: PointLevel | None = None,
    ) -> Hierarchy:
        if settings.discretisation == "elements" and (self.long or self.grading is not None):
            raise ParameterError(
                "elements in a film that changes in time need a uniform grid whose rows are at "
                f"most {_LONG:g} times as far apart as its columns, got rows "
                f"{self.reference().spacing[1] / self.reference().spacing[0]:.3g} times as far "
                "apart. Take differences, or more rows and no grading."
            )
        problem = self.reference()
        scales = PointScales.of(problem)
        new = shapes if finest is None else shapes[:-1]
        levels: list[PointLevel] = [
            MovingLevel(
                problem,
                scales,
                shape,
                settings.wedge,
                self.grading,
                scheme=DISCRETE[settings.discretisation],
            )
            for shape in new
        ]
        if finest is not None:
            levels.append(finest)
        sides = Sides(self.sides)
        transfers = [Transfer(fine, coarse, sides) for coarse, fine in pairwise(shapes)]
        return Hierarchy(levels, transfers)


def set_conditions(
    film: MovingFilm, grids: Hierarchy, time: float, finest_only: bool = False
) -> None:
    """Set the conditions of a time [s] on all grids, or their load alone on all but the finest."""
    finest = grids.levels[-1]
    for level in grids.levels:
        assert isinstance(level, MovingLevel)
        if level is finest or not finest_only:
            level.set_conditions(film.conditions(level.grid.x, level.grid.y, time))
    for level in grids.levels:
        level.set_load(finest.load)


def moving_section(
    section: PointContactProblem, heights: Heights, solids: SolidContact | None = None
) -> MovingFilm:
    """Return the film of a part of a line contact whose heights change in time.

    Parameters
    ----------
    section
        The smooth contact with its sliding, of `line_section`.
    heights
        Of nodes x (nx,) and y (ny,) [m] and a time [s]: what both solids together stand above
        their smooth shape [m], shape (nx, ny). It narrows the gap.
    solids
        What carries load where the film vanishes; None: the oil alone.

    Raises
    ------
    ParameterError
        The section does not say how it slides.
    """
    if section.sliding is None:
        raise ParameterError("section must have sliding, got none. Give (u_2 - u_1, 0) m/s.")
    mean, half = section.entrainment[0], 0.5 * section.sliding[0]

    def conditions(x: Array, y: Array, time: float) -> FilmConditions:
        gap = section.gap(x[:, None], y[None, :]) - heights(x, y, time)
        rows = np.ones(y.size)
        return FilmConditions(gap, section.load, (mean - half) * rows, (mean + half) * rows)

    return MovingFilm(
        conditions=conditions,
        lubricant=section.lubricant,
        contact_modulus=section.contact_modulus,
        x_limits=section.x_limits,
        y_limits=section.y_limits,
        nodes=section.nodes,
        hertz=section.hertz,
        load=section.load,
        speed=mean,
        solids=solids,
        sides=section.sides,
    )
