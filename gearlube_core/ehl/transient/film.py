"""A film that changes in time: what is given, its grids and what is found at one time."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.border_pressure import border_pressure
from gearlube_core.ehl.point.equations.mesh import Grading, cell_faces, x_nodes
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.newton import flow_residual
from gearlube_core.ehl.point.newton.preconditioner import Hierarchy
from gearlube_core.ehl.point.newton.transfer import Transfer
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solid_contact import NO_TOUCH, SolidContact, Touch
from gearlube_core.ehl.point.solver import grid_shapes
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.transient.level import Conditions, MovingLevel
from gearlube_core.ehl.transient.rows import row_shapes
from gearlube_core.oil.film_oil import EhlLubricant

_LONG = 3.0  # spacing across the motion over that along it, from which rows are solved whole
_CURE = "Take smaller time steps, or more nodes where the film is thin."
_STEADY_CURE = "Take more nodes where the film is thin, or a crown where a line ends sharply."


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

    Raises
    ------
    ParameterError
        An input is out of range.
    """

    conditions: Conditions
    lubricant: EhlLubricant
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
        )

    @property
    def x(self) -> Array:
        """Return the nodes along x [m], shape (nx,)."""
        return x_nodes(self.x_limits, self.nodes[0], self.grading)

    @property
    def y(self) -> Array:
        """Return the nodes along y [m], shape (ny,)."""
        return np.linspace(*self.y_limits, self.nodes[1])

    def with_nodes(self, nx: int, ny: int) -> MovingFilm:
        """Return the same film on another grid."""
        return replace(self, nodes=(nx, ny))

    @property
    def long(self) -> bool:
        """Tell whether rows along x are so far apart that they are best solved whole."""
        (nx, ny), (x0, x1), (y0, y1) = self.nodes, self.x_limits, self.y_limits
        return (y1 - y0) * (nx - 1) > _LONG * (x1 - x0) * (ny - 1)

    def grids(self, wedge: str) -> Hierarchy:
        """Return the nested grids with the conditions of no time yet."""
        (nx, ny), (x0, x1), (y0, y1) = self.nodes, self.x_limits, self.y_limits
        return self._hierarchy(
            grid_shapes((ny, nx), ((y1 - y0) / (ny - 1), (x1 - x0) / (nx - 1))), wedge
        )

    def row_grids(self, wedge: str) -> Hierarchy:
        """Return grids that differ in the number of their rows alone."""
        nx, ny = self.nodes
        return self._hierarchy(row_shapes((ny, nx)), wedge)

    def with_rows_below(self, grids: Hierarchy, wedge: str) -> Hierarchy:
        """Return `row_grids` with the finest of `grids`, whose conditions and load hold."""
        finest = grids.levels[-1]
        rows = self._hierarchy(row_shapes(finest.shape), wedge, finest)
        for level in rows.levels:
            level.set_load(finest.load)
        return rows

    def _hierarchy(
        self, shapes: list[tuple[int, int]], wedge: str, finest: PointLevel | None = None
    ) -> Hierarchy:
        problem = self.reference()
        scales = PointScales.of(problem)
        new = shapes if finest is None else shapes[:-1]
        levels: list[PointLevel] = [
            MovingLevel(problem, scales, shape, wedge, self.grading) for shape in new
        ]
        if finest is not None:
            levels.append(finest)
        transfers = [Transfer(fine, coarse) for coarse, fine in pairwise(shapes)]
        return Hierarchy(levels, transfers)


def impose(film: MovingFilm, grids: Hierarchy, time: float, finest_only: bool = False) -> None:
    """Set the conditions of a time [s] on all grids, or their load alone on all but the finest."""
    finest = grids.levels[-1]
    for level in grids.levels:
        assert isinstance(level, MovingLevel)
        if level is finest or not finest_only:
            level.set_conditions(film.conditions(level.grid.x, level.grid.y, time))
    for level in grids.levels:
        level.set_load(finest.load)


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmSolution:
    """Film at one time; arrays of shape (nx, ny) over `x` and `y`."""

    time: float  # [s]
    x: Array  # [m]
    y: Array  # [m]
    pressure: Array  # of oil and solids [Pa]
    film: Array  # [m]
    approach: float  # h_0 [m]
    load: float  # that the pressure carries [N]
    load_error: float  # missing share of the load [-]
    residual: float  # unbalanced flow over the flow through the dry width [-]
    converged: bool
    outcome: str  # what happened and what to do, also where the domain cuts the contact
    newton_steps: int
    krylov_steps: int
    seconds: float
    touch: Touch = NO_TOUCH  # how far the solids touch

    @property
    def maximum_pressure(self) -> float:
        """Return the largest pressure [Pa]."""
        return float(self.pressure.max())

    @property
    def minimum_film(self) -> float:
        """Return the smallest film [m]."""
        return float(self.film.min())

    @property
    def maximum_pressure_place(self) -> tuple[float, float]:
        """Return x and y of the largest pressure [m]."""
        i, j = np.unravel_index(int(self.pressure.argmax()), self.pressure.shape)
        return float(self.x[i]), float(self.y[j])

    @property
    def minimum_film_place(self) -> tuple[float, float]:
        """Return x and y of the smallest film [m]."""
        i, j = np.unravel_index(int(self.film.argmin()), self.film.shape)
        return float(self.x[i]), float(self.y[j])

    @property
    def border_pressure(self) -> float:
        """Return the largest pressure one node from the border over the largest of all [-]."""
        return border_pressure(self.pressure, self.film).share

    @property
    def loaded_length(self) -> float:
        """Return the extent along y over which pressure passes 1 MPa [m]."""
        rows = self.y[(self.pressure > 1.0e6).any(axis=0)]
        return float(rows[-1] - rows[0]) if rows.size else 0.0


def _failures(
    pressure: Array, film: Array, residual: float, load_error: float, settings: PointSolverSettings
) -> list[str]:
    checks = (
        (bool(np.isfinite(pressure).all()), "the pressure is not finite"),
        (residual <= settings.tolerance, f"the flow residual is {residual:.1e}"),
        (
            abs(load_error) <= settings.load_tolerance,
            f"the load is {100.0 * load_error:.1e} % off",
        ),
        (float(film.min()) > 0.0, "the film vanishes"),
    )
    return [text for good, text in checks if not good]


def _outcome(failed: list[str], newton_steps: int, touch: Touch, cure: str = _CURE) -> str:
    if not failed:
        return f"Converged in {newton_steps} steps.{touch.sentence}"
    return f"Not converged after {newton_steps} steps: {' and '.join(failed)}. {cure}"


def film_solution(
    film: MovingFilm,
    level: MovingLevel,
    state: FilmState,
    settings: PointSolverSettings,
    *,
    time: float,
    newton_steps: int,
    krylov_steps: int,
    seconds: float,
    steady: bool = False,
) -> FilmSolution:
    """Return a state in SI with the judgement on it."""
    scales = level.scales
    residual = flow_residual(level, state)
    failed = _failures(state.pressure, state.film, residual, state.load_error, settings)
    pressure = scales.outward(state.pressure) * scales.pressure
    height = scales.outward(state.film) * scales.film
    load = level.grid.integral(state.pressure) * scales.pressure * scales.length**2
    cells = level.grid.cells[:, None] * scales.length**2
    touch = Touch.of(film.solids, height, cells, load)
    cut = border_pressure(pressure, height).sentence
    return FilmSolution(
        time=time,
        x=film.x,
        y=film.y,
        pressure=pressure,
        film=height,
        approach=state.approach * scales.film,
        load=load,
        load_error=state.load_error,
        residual=residual,
        converged=not failed,
        outcome=_outcome(failed, newton_steps, touch, _STEADY_CURE if steady else _CURE) + cut,
        newton_steps=newton_steps,
        krylov_steps=krylov_steps,
        seconds=seconds,
        touch=touch,
    )


_NUMBERS = (
    "time",
    "approach",
    "load",
    "load_error",
    "residual",
    "newton_steps",
    "krylov_steps",
    "seconds",
)


def pack_solutions(solutions: dict[int, FilmSolution]) -> tuple[Array, Array, Array]:
    """Return the numbers, fields and values of solutions as a `MarchRecord` holds them."""
    steps = np.array(list(solutions), dtype=np.float64)
    if not solutions:
        return steps, np.zeros(0), np.zeros((0, len(_NUMBERS)))
    fields = np.array([(s.pressure, s.film) for s in solutions.values()])
    return steps, fields, np.array([[getattr(s, n) for n in _NUMBERS] for s in solutions.values()])


def unpack_solutions(
    film: MovingFilm, settings: PointSolverSettings, steps: Array, fields: Array, values: Array
) -> dict[int, FilmSolution]:
    """Return the solutions that `pack_solutions` has packed."""
    solutions = {}
    cells = np.diff(cell_faces(film.x))[:, None] * (film.y[1] - film.y[0])
    for step, (pressure, height), row in zip(steps, fields, values, strict=True):
        numbers = dict(zip(_NUMBERS, row.tolist(), strict=True))
        newton_steps, krylov_steps = int(numbers.pop("newton_steps")), numbers.pop("krylov_steps")
        failed = _failures(pressure, height, numbers["residual"], numbers["load_error"], settings)
        touch = Touch.of(film.solids, height, cells, numbers["load"])
        solutions[int(step)] = FilmSolution(
            **numbers,
            x=film.x,
            y=film.y,
            pressure=pressure,
            film=height,
            converged=not failed,
            outcome=_outcome(failed, newton_steps, touch)
            + border_pressure(pressure, height).sentence,
            newton_steps=newton_steps,
            krylov_steps=int(krylov_steps),
            touch=touch,
        )
    return solutions
