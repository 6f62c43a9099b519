"""The film of a helical pair through its meshing cycle: curves over the steps, resumable."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.checks import check_within
from gearlube_core.ehl.helical_film import HelicalFilm
from gearlube_core.ehl.settings import PointSolverSettings
from gearlube_core.ehl.transient_film import FilmSolution, unpack_solutions
from gearlube_core.ehl.transient_march import FilmMarch
from gearlube_core.ehl.transient_record import MarchRecord
from gearlube_core.ehl.transient_steady import solve_steady_film
from gearlube_core.errors import ConvergenceError, ParameterError

Array = np.ndarray[Any, np.dtype[np.float64]]

COLUMNS = (
    "step",
    "load",
    "max_pressure",
    "max_pressure_y",
    "min_film",
    "min_film_x",
    "min_film_y",
    "loaded_length",
    "load_error",
    "converged",
    "newton_steps",
    "krylov_steps",
    "seconds",
    "solid_share",
    "touching_area",
    "solid_pressure",
)

Progress = Callable[[int, int, FilmSolution], None]


@dataclass(frozen=True, slots=True)
class HelicalCycle:
    """Curves over a meshing cycle; one row a step, SI, columns as in `COLUMNS`."""

    table: Array  # (steps, columns)
    kept: dict[int, FilmSolution]  # whole solutions of the steps that were asked for

    def __getitem__(self, column: str) -> Array:
        """Return a column by its name."""
        if column not in COLUMNS:
            raise ParameterError(f"column must be one of {', '.join(COLUMNS)}, got {column}.")
        return self.table[:, COLUMNS.index(column)]

    @property
    def failures(self) -> int:
        """Return the number of steps that did not converge."""
        return int((self["converged"] == 0.0).sum())


def _row(step: float, solution: FilmSolution) -> list[float]:
    i = np.unravel_index(int(solution.pressure.argmax()), solution.pressure.shape)
    j = np.unravel_index(int(solution.film.argmin()), solution.film.shape)
    return [
        step,
        solution.load,
        solution.maximum_pressure,
        float(solution.y[i[1]]),
        solution.minimum_film,
        float(solution.x[j[0]]),
        float(solution.y[j[1]]),
        solution.loaded_length,
        solution.load_error,
        float(solution.converged),
        float(solution.newton_steps),
        float(solution.krylov_steps),
        solution.seconds,
        solution.touch.share,
        solution.touch.area,
        solution.touch.largest,
    ]


def solve_helical_line(
    film: HelicalFilm,
    step: float,
    settings: PointSolverSettings | None = None,
    *,
    throw: bool = True,
) -> FilmSolution:
    """Return the steady film with the line at rest at a step of its cycle.

    Parameters
    ----------
    film
        Pair, operation, oil and grid.
    step
        Number of the step, need not be whole.
    settings, throw
        As in `solve_steady_film`.
    """
    return solve_steady_film(film.moving_film(), step * film.time_step, settings, throw=throw)


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
    throw: bool = True,
) -> HelicalCycle:
    """Return the film over the steps of a meshing cycle.

    Parameters
    ----------
    film
        Pair, operation, oil and grid.
    first, last
        Steps; the film is steady at the first. All of them by default.
    substeps
        Time steps for one step of the cycle.
    scheme, settings
        As in `FilmMarch`.
    keep
        Steps whose whole solution is returned; a checkpoint holds those already reached.
    checkpoint
        File to write every `checkpoint_every` steps, and to go on from if it is there.
    progress
        Called with the step, the last step and its solution, from the first step on.
    throw
        Raise at the first step that does not converge; else go on and say so in the table.

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
    check_within("checkpoint_every", checkpoint_every, 1, 1_000_000)
    rows: list[list[float]] = []
    record, path = None, None
    if checkpoint is not None:
        path = Path(checkpoint)
        if path.exists():
            record = MarchRecord.read(path)
            # records of before know no touching solids
            lacking = [0.0] * (len(COLUMNS) - record.curves.shape[1])
            rows = [[*row, *lacking] for row in record.curves.tolist()]
    march = FilmMarch(
        film.moving_film(),
        film.time_step / substeps,
        start_time=first * film.time_step,
        scheme=scheme,
        settings=settings,
        record=record,
        throw=throw,
    )
    kept: dict[int, FilmSolution] = {}
    if record is not None:
        kept = unpack_solutions(
            march.film,
            march.settings,
            record.kept_steps,
            record.kept_fields,
            record.kept_values,
        )
    if not rows:
        rows.append(_row(float(first), march.solution))
        if progress is not None:
            progress(first, last, march.solution)
    if first in keep and record is None:
        kept[first] = march.solution
    for n in range(first + len(rows), last + 1):
        while march.steps < (n - first) * substeps:
            solution = march.step(throw=False)
        if throw and not solution.converged:
            raise ConvergenceError(f"Step {n}: {solution.outcome}")
        rows.append(_row(float(n), solution))
        if n in keep:
            kept[n] = solution
        if path is not None and (n % checkpoint_every == 0 or n == last):
            march.save(path, np.array(rows), kept)
        if progress is not None:
            progress(n, last, solution)
    return HelicalCycle(np.array(rows), kept)
