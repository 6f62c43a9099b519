"""Steady films along a flank's engagement, and the film marched through it, resumable."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.solid import Solid
from gearlube_core.ehl.gears.hypoid_film import HypoidFilm
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.thermal.solver import solve_thermal_point
from gearlube_core.ehl.point.traction import point_traction
from gearlube_core.ehl.transient.curves import (
    FilmCurves,
    NumberedSteps,
    Progress,
    film_row,
    march_curves,
)
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.ehl.transient.steady import solve_steady_film
from gearlube_core.friction.johnson_greenwood_1980 import thermal_eyring_film
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_oil import FilmOil, heat_under, stress_ratio
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY

THERMAL_COLUMNS = (
    "time",
    "central_film",
    "minimum_film",
    "cold_central_film",
    "cold_minimum_film",
    "pressure_max",
    "traction",
    "rise_max",
    "rise_surface",
    "heat_balance",
    "turns",
    "converged",
    "seconds",
)
COLUMNS = (
    "time",
    "load",
    "central_film",
    "minimum_film",
    "minimum_film_x",
    "minimum_film_y",
    "pressure_max",
    "traction_newtonian",
    "traction_eyring",
    "traction_heated",
    "load_error",
    "residual",
    "converged",
    "newton_steps",
    "seconds",
    "grid_error",
    "time_error",
    "time_error_pressure",
)


class FlankTraction(NamedTuple):
    """Coefficients of friction along sliding [-]."""

    newtonian: float
    eyring: float  # at the oil's temperature throughout
    heated: float  # Eyring, heated across the film, surfaces at the oil's temperature


@kernel
def heated_stress(
    p: np.ndarray, h: np.ndarray, eta: np.ndarray, slip: float, oil: FilmOil, beta: float
) -> np.ndarray:
    """Return the shear stress of a heated Eyring film where there is pressure, (n,) [Pa].

    beta(p) = beta (ln eta + 9.67)/(ln eta0 + 9.67)

    Parameters
    ----------
    p, h, eta
        Pressure [Pa], film [m], viscosity at the oil's temperature [Pa s], (n,).
    slip
        Sliding speed [m/s].
    oil
        With an Eyring stress.
    beta
        -d ln eta/dT of the oil at ambient pressure [1/K].

    Notes
    -----
    Source: [johnson_greenwood_1980]; [houpert_1985] for beta(p).
    """
    tau = np.zeros(p.size)
    reduced = math.log(oil.eta0) + ROELANDS_LOG_VISCOSITY
    for i in range(p.size):
        if p[i] > 0.0:
            tau0 = oil.shear.tau0 * stress_ratio(oil, p[i], 1.0)[0]
            log_eta = math.log(eta[i])
            beta_p = beta * (log_eta + ROELANDS_LOG_VISCOSITY) / reduced
            k = heat_under(oil, p[i], oil.rho0)[0]
            film = thermal_eyring_film(log_eta, beta_p, k, tau0, h[i], slip)
            tau[i] = film.stress_ratio * tau0
    return tau


def flank_traction(
    solution: FilmSolution, oil: FilmOil, sliding: tuple[float, float], beta: float
) -> FlankTraction:
    """Return the traction of a film along its sliding.

    mu = int tau dA/W,  tau = eta |dU|/h,  tau0 asinh(a s/sinh s) or that of a heated film

    Parameters
    ----------
    solution
        Film of the contact.
    oil
        With its Eyring stress.
    sliding
        Along x and y [m/s].
    beta
        -d ln eta/dT at ambient pressure [1/K].

    Notes
    -----
    Where there is no pressure the gap is left out: it shears oil at ambient pressure in films
    that are thicker. Surfaces that heat up, not contained here, take some per cent more.
    Source: `point_traction`, `heated_stress`.
    """
    slip = math.hypot(*sliding)
    if not slip > 0.0:
        return FlankTraction(0.0, 0.0, 0.0)
    x, y, p = solution.x, solution.y, solution.pressure
    shear = point_traction(x, y, p, solution.film, sliding, oil)
    loaded = p > 0.0
    eta, film = shear.viscosity[loaded], solution.film[loaded]
    share = (x[1] - x[0]) * (y[1] - y[0]) / solution.load
    return FlankTraction(
        share * float((eta * slip / film).sum()),
        share * float(shear.mean_stress[loaded].sum()),
        share * float(heated_stress(p[loaded], film, eta, slip, oil, beta).sum()),
    )


def thermal_films(
    film: HypoidFilm,
    times: Array,
    solids: tuple[Solid, Solid],
    temperature_exponent: float,
    *,
    settings: PointSolverSettings = MARCH_SETTINGS,
    progress: Callable[[int, int, float], None] | None = None,
    throw: bool = True,
) -> FilmCurves:
    """Return the steady films of a flank with their heat, columns as in `THERMAL_COLUMNS`.

    Parameters
    ----------
    film
        Contact through the engagement.
    times : ndarray, shape (N,)
        [s].
    solids
        Of both members: bulk at the oil's temperature.
    temperature_exponent
        S0 of Houpert's law; the viscosity at the oil's temperature stays that of the film.
    settings
        Stencil and tolerances of the flow.
    progress
        Called with the row, the last row and the smallest film [m].
    throw
        Raise where a film does not converge; else say so in the table.

    Raises
    ------
    ConvergenceError

    Notes
    -----
    Each on its own domain, beside the cold film of the same grid. Friction is integrated where
    there is pressure, as in `flank_traction`.
    """
    rows = []
    for n, time in enumerate(times):
        problem = film.problem(film.cycle.at(float(time)))
        cold_law = problem.lubricant.viscosity
        oil = problem.lubricant._replace(viscosity=cold_law._replace(S0=temperature_exponent))
        cold = solve_point_contact(problem, settings, throw=throw)
        warm = solve_thermal_point(replace(problem, lubricant=oil), *solids, settings, throw=throw)
        inlet = oil.temperature
        loaded = warm.film.pressure > 0.0
        cell = (problem.x[1] - problem.x[0]) * (problem.y[1] - problem.y[0])
        surfaces = max(float(one.max()) for one in warm.surface_temperature)
        rows.append(
            [
                float(time),
                warm.film.central_film,
                warm.film.minimum_film,
                cold.central_film,
                cold.minimum_film,
                warm.film.maximum_pressure,
                float(warm.mean_stress[loaded].sum()) * cell / problem.load,
                warm.max_temperature - inlet,
                surfaces - inlet,
                warm.balances[-1] if warm.balances else np.inf,
                float(max(len(warm.balances) - 1, 0)),
                float(warm.converged and cold.outcome.converged),
                cold.seconds + warm.seconds,
            ]
        )
        if progress is not None:
            progress(n, len(times) - 1, warm.film.minimum_film)
    return FilmCurves(THERMAL_COLUMNS, np.array(rows), {})


def steady_films(
    film: HypoidFilm,
    times: Array,
    beta: float,
    *,
    settings: PointSolverSettings = MARCH_SETTINGS,
    keep: tuple[int, ...] = (),
    progress: Progress | None = None,
    throw: bool = True,
) -> FilmCurves:
    """Return the steady films for the conditions of each time.

    All on the grid of the march, so that what differs from it is the film's history.

    Parameters
    ----------
    film
        Contact through the engagement.
    times : ndarray, shape (N,)
        [s].
    beta
        -d ln eta/dT of the oil at ambient pressure [1/K].
    settings
        Stencil and tolerances of the solver.
    keep
        Rows whose whole film is returned.
    progress
        Called with the row, the last row and the film.
    throw
        Raise where a film does not converge; else say so in the table.

    Raises
    ------
    ConvergenceError
    """
    moving = film.moving_film()
    rows, kept = [], {}
    for n, time in enumerate(times):
        solution = solve_steady_film(moving, float(time), settings, throw=throw)
        rows.append(_row(film, solution, beta))
        if n in keep:
            kept[n] = solution
        if progress is not None:
            progress(n, len(times) - 1, solution)
    return FilmCurves(COLUMNS, np.array(rows), kept)


def march_flank(
    film: HypoidFilm,
    steps: int,
    beta: float,
    *,
    settings: PointSolverSettings = MARCH_SETTINGS,
    scheme: str = "bdf2",
    checkpoint: Path | str | None = None,
    checkpoint_every: int = 10,
    progress: Progress | None = None,
    repeat: bool = False,
    throw: bool = True,
) -> FilmCurves:
    """Return the film through the engagement, with squeeze, from the steady one at its start.

    Parameters
    ----------
    film
        Contact through the engagement.
    steps
        Equal time steps from the first to the last time of its cycle, 2 to 1e5.
    beta
        -d ln eta/dT of the oil at ambient pressure [1/K].
    settings, scheme, checkpoint, checkpoint_every, progress, repeat, throw
        As in `march_curves`.

    Raises
    ------
    ConvergenceError
    ParameterError
        Steps out of range, or the checkpoint belongs to another march.
    """
    check_within("steps", steps, 2, 100_000)
    first, last = (float(t) for t in film.cycle.time[[0, -1]])
    return march_curves(
        film.moving_film(),
        COLUMNS,
        lambda _, solution: _row(film, solution, beta),
        NumberedSteps(0, steps, start_time=first, step_time=(last - first) / steps),
        scheme=scheme,
        settings=settings,
        checkpoint=checkpoint,
        checkpoint_every=checkpoint_every,
        progress=progress,
        repeat=repeat,
        throw=throw,
    )


def _row(film: HypoidFilm, solution: FilmSolution, beta: float) -> list[float]:
    now = film.cycle.at(solution.time)
    traction = flank_traction(solution, film.lubricant, now.sliding, beta)
    return film_row(
        COLUMNS,
        solution,
        **{f"traction_{law}": value for law, value in traction._asdict().items()},
    )
