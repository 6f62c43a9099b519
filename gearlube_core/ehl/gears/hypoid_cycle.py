"""Steady films along a flank's engagement, and the film marched through it, resumable."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.ehl.gears.film_columns import film_row
from gearlube_core.ehl.gears.hypoid_film import HypoidFilm
from gearlube_core.ehl.gears.hypoid_traction import flank_traction
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.transient.curves import FilmCurves, NumberedSteps, Progress, march_curves
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.ehl.transient.steady import solve_steady_film

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
        Stencil and tolerances.
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
