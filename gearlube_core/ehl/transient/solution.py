"""Film at one time in SI units, with its convergence status."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import interpn

from gearlube_core.arrays import Array
from gearlube_core.ehl.grid_error import SECOND_ORDER, FilmError, FilmNumbers, formal_order
from gearlube_core.ehl.point.equations.stencil import cell_faces
from gearlube_core.ehl.point.far_field import border_pressure
from gearlube_core.ehl.point.newton.newton import flow_residual
from gearlube_core.ehl.point.settings import PointSolverSettings, Sides
from gearlube_core.ehl.point.solid_contact import NO_CONTACT, SolidLoad
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.thin_film import thin_film_sentence
from gearlube_core.ehl.time_error import time_error_sentence
from gearlube_core.ehl.transient.level import MovingLevel
from gearlube_core.ehl.transient.problem import MovingFilm

_CURE = "Take smaller time steps, or more nodes where the film is thin."
_STEADY_CURE = "Take more nodes where the film is thin, or a crown where a line ends sharply."


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
    touch: SolidLoad = NO_CONTACT  # how far the solids touch
    time_error: float = (
        math.nan
    )  # estimated, of the smallest film by the time steps [-]; at rest: nan
    formal_order: float = SECOND_ORDER  # of its grid
    coarser: tuple[FilmSolution, ...] = ()  # a film at rest on coarser grids, finest first
    wider: FilmSolution | None = None  # the last of them on twice the domain
    sides: str = "ambient"  # along y

    @property
    def nodes(self) -> tuple[int, ...]:
        """Return the number of nodes along x and y."""
        return self.x.size, self.y.size

    @property
    def axes(self) -> tuple[Array, ...]:
        """Return the places of the nodes along x and y [m]."""
        return self.x, self.y

    @property
    def numbers(self) -> FilmNumbers:
        """Return films and largest pressure; no film at the origin where it is not loaded.

        With closed sides: of x = 0 and half way along y.
        """
        closed = Sides(self.sides).closed
        origin = np.array([0.0, 0.5 * (self.y[0] + self.y[-1]) if closed else 0.0])
        central = math.nan
        if float(interpn(self.axes, self.pressure, origin)[0]) > 0.0:
            central = float(interpn(self.axes, self.film, origin)[0])
        return FilmNumbers(central, self.minimum_film, self.maximum_pressure, math.nan)

    @property
    def error(self) -> FilmError:
        """Return the estimated errors of grid and domain; not known in motion."""
        return FilmError.of(self)

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
        closed = Sides(self.sides).closed
        return border_pressure(self.pressure, self.film, closed=closed).share

    @property
    def loaded_length(self) -> float:
        """Return the extent along y over which pressure passes 1 MPa, from row to row [m]."""
        rows = self.y[(self.pressure > 1.0e6).any(axis=0)]
        return float(rows[-1] - rows[0]) if rows.size else 0.0


def _failures(
    pressure: Array, film: Array, residual: float, load_error: float, settings: PointSolverSettings
) -> list[str]:
    checks = (
        (bool(np.isfinite(pressure).all()), "the pressure is not finite"),
        (residual <= settings.tolerance, f"the flow residual is {residual:.1e}"),
        (abs(load_error) <= settings.load_tolerance, f"the load is {100.0 * load_error:.1e} % off"),
        (float(film.min()) > 0.0, "the film vanishes"),
    )
    return [text for good, text in checks if not good]


def _outcome(failed: list[str], newton_steps: int, touch: SolidLoad, cure: str = _CURE) -> str:
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
    time_error: float = math.nan,
) -> FilmSolution:
    """Return a state in SI with the judgement on it."""
    scales = level.scales
    residual = flow_residual(level, state)
    failed = _failures(state.pressure, state.film, residual, state.load_error, settings)
    sides = level.grid.sides
    pressure = scales.outward(sides.inner(state.pressure)) * scales.pressure
    height = scales.outward(sides.inner(state.film)) * scales.film
    load = level.grid.integral(state.pressure) * scales.pressure * scales.length**2
    cells = level.grid.cells[:, None] * scales.length**2
    touch = SolidLoad.of(film.solids, height, cells, load)
    cut = border_pressure(pressure, height, closed=sides.closed).sentence
    cut += thin_film_sentence(pressure, height, (film.x, film.y), film.reference().radii)
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
        outcome=_outcome(failed, newton_steps, touch, _STEADY_CURE if steady else _CURE)
        + cut
        + time_error_sentence(time_error),
        newton_steps=newton_steps,
        krylov_steps=krylov_steps,
        seconds=seconds,
        touch=touch,
        time_error=time_error,
        formal_order=formal_order(settings.wedge),
        sides=sides.name,
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
    "time_error",
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
        touch = SolidLoad.of(film.solids, height, cells, numbers["load"])
        solutions[int(step)] = FilmSolution(
            **numbers,
            x=film.x,
            y=film.y,
            pressure=pressure,
            film=height,
            converged=not failed,
            outcome=_outcome(failed, newton_steps, touch)
            + border_pressure(pressure, height, closed=Sides(film.sides).closed).sentence
            + thin_film_sentence(pressure, height, (film.x, film.y), film.reference().radii)
            + time_error_sentence(numbers["time_error"]),
            newton_steps=newton_steps,
            krylov_steps=int(krylov_steps),
            touch=touch,
            formal_order=formal_order(settings.wedge),
            sides=film.sides,
        )
    return solutions
