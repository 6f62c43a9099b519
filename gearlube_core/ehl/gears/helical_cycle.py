"""The film of a helical pair through its meshing cycle: curves over the steps, resumable."""

from __future__ import annotations

from pathlib import Path

from gearlube_core.checks import check_within
from gearlube_core.ehl.gears.helical_film import HelicalFilm
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.transient.curves import (
    FilmCurves,
    NumberedSteps,
    Progress,
    film_row,
    march_curves,
)
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.ehl.transient.steady import solve_steady_film

COLUMNS = (
    "step",
    "load",
    "pressure_max",
    "pressure_max_y",
    "minimum_film",
    "minimum_film_x",
    "minimum_film_y",
    "loaded_length",
    "load_error",
    "converged",
    "newton_steps",
    "krylov_steps",
    "seconds",
    "solid_share",
    "touching_area",
    "solid_pressure",
    "time_error",
    "time_error_pressure",
)


def solve_helical_line(
    film: HelicalFilm,
    step: float,
    settings: PointSolverSettings | None = None,
    *,
    film_error: float | None = None,
    most_nodes: int = 1025,
    throw: bool = True,
) -> FilmSolution:
    """Return the steady film of the line at one step of its cycle.

    Parameters
    ----------
    film
        Pair, operation, oil and grid.
    step
        Number of the step, need not be whole.
    settings, film_error, most_nodes, throw
        As in `solve_steady_film`.
    """
    return solve_steady_film(
        film.moving_film(),
        step * film.time_step,
        settings,
        film_error=film_error,
        most_nodes=most_nodes,
        throw=throw,
    )


def march_helical_cycle(
    film: HelicalFilm,
    *,
    first: int = 0,
    last: int | None = None,
    substeps: int = 1,
    scheme: str = "bdf2",
    settings: PointSolverSettings | None = None,
    keep: tuple[int, ...] = (),
    checkpoint: Path | str | None = None,
    checkpoint_every: int = 25,
    progress: Progress | None = None,
    repeat: bool = False,
    throw: bool = True,
) -> FilmCurves:
    """Return the film over the steps of a meshing cycle.

    Parameters
    ----------
    film
        Pair, operation, oil and grid.
    first, last
        Steps; the film is steady at the first. All of them by default.
    substeps
        Time steps for one step of the cycle.
    scheme, settings, keep, checkpoint, checkpoint_every, progress, repeat, throw
        As in `march_curves`.

    Raises
    ------
    ConvergenceError
        A step did not converge.
    ParameterError
        Steps out of range, or the checkpoint belongs to another march.
    """
    last = film.steps.count if last is None else last
    check_within("first", first, 0, film.steps.count)
    check_within("last", last, first, film.steps.count)
    check_within("substeps", substeps, 1, 1000)
    steps = NumberedSteps(first, last, first * film.time_step, film.time_step, substeps)
    return march_curves(
        film.moving_film(),
        COLUMNS,
        lambda step, solution: film_row(COLUMNS, solution, step=float(step)),
        steps,
        scheme=scheme,
        settings=settings,
        keep=keep,
        checkpoint=checkpoint,
        checkpoint_every=checkpoint_every,
        progress=progress,
        repeat=repeat,
        throw=throw,
    )
