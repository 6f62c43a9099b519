"""Curves of films over steps or times, and the march that gathers them, resumable."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.transient.history import MarchRecord
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.ehl.transient.solution import FilmSolution, unpack_solutions
from gearlube_core.errors import ConvergenceError, ParameterError

Progress = Callable[[int, int, FilmSolution], None]
Row = Callable[[int, FilmSolution], list[float]]


def central_film(solution: FilmSolution) -> float:
    """Return the film in the centre of the dry contact, by linear interpolation [m]."""
    column = np.array([np.interp(0.0, solution.y, row) for row in solution.film])
    return float(np.interp(0.0, solution.x, column))


def _thinnest(solution: FilmSolution) -> tuple[float, float]:
    # place of the smallest film [m]
    i, j = np.unravel_index(int(solution.film.argmin()), solution.film.shape)
    return float(solution.x[i]), float(solution.y[j])


def _most_pressed(solution: FilmSolution) -> tuple[float, float]:
    # place of the largest pressure [m]
    i, j = np.unravel_index(int(solution.pressure.argmax()), solution.pressure.shape)
    return float(solution.x[i]), float(solution.y[j])


_COLUMNS: dict[str, Callable[[FilmSolution], float]] = {
    "time": lambda film: film.time,
    "load": lambda film: film.load,
    "pressure_max": lambda film: film.maximum_pressure,
    "pressure_max_y": lambda film: _most_pressed(film)[1],
    "central_film": central_film,
    "minimum_film": lambda film: film.minimum_film,
    "minimum_film_x": lambda film: _thinnest(film)[0],
    "minimum_film_y": lambda film: _thinnest(film)[1],
    "loaded_length": lambda film: film.loaded_length,
    "load_error": lambda film: film.load_error,
    "residual": lambda film: film.residual,
    "converged": lambda film: float(film.converged),
    "newton_steps": lambda film: float(film.newton_steps),
    "krylov_steps": lambda film: float(film.krylov_steps),
    "seconds": lambda film: film.seconds,
    "solid_share": lambda film: film.touch.share,
    "touching_area": lambda film: film.touch.area,
    "solid_pressure": lambda film: film.touch.largest,
    "grid_error": lambda film: film.error.film,
    "time_error": lambda film: film.time_error,
    # of a march that is repeated, see `with_time_errors`
    "time_error_pressure": lambda _: math.nan,
}


def film_row(columns: tuple[str, ...], solution: FilmSolution, **more: float) -> list[float]:
    """Return the numbers of a film in named columns, SI.

    Parameters
    ----------
    columns
        Names of the columns.
    solution
        Solved film of one step.
    more
        Columns that do not follow from the film alone.
    """
    return [more[name] if name in more else _COLUMNS[name](solution) for name in columns]


@dataclass(frozen=True, slots=True)
class FilmCurves:
    """One row a film, SI; `curves[column]` is a column by its name."""

    columns: tuple[str, ...]
    table: Array  # (films, columns)
    kept: dict[int, FilmSolution]  # whole films of the rows or steps that were asked for

    def __getitem__(self, column: str) -> Array:
        """Return a column by its name, shape (films,)."""
        if column not in self.columns:
            raise ParameterError(f"column must be one of {', '.join(self.columns)}, got {column}.")
        return self.table[:, self.columns.index(column)]

    @property
    def failures(self) -> int:
        """Return the number of films that did not converge."""
        return int((self["converged"] == 0.0).sum())


@dataclass(frozen=True, slots=True)
class NumberedSteps:
    """Equal steps of a film in time.

    Parameters
    ----------
    first, last
        Numbers of first and last step.
    start_time
        Of the first step [s].
    step_time
        From one step to the next [s].
    substeps
        Time steps for one step.
    """

    first: int
    last: int
    start_time: float
    step_time: float
    substeps: int = 1

    def longer(self) -> NumberedSteps:
        """Return steps of twice the time step: every step, or every other one."""
        if self.substeps % 2 == 0:
            return replace(self, substeps=self.substeps // 2)
        # numbered from the first on: the n-th is the first + 2 n of these
        last = self.first + (self.last - self.first) // 2
        return replace(self, last=last, step_time=2.0 * self.step_time)


def with_time_errors(curves: FilmCurves, longer: FilmCurves, every: int) -> FilmCurves:
    """Return curves with the errors of their time steps, from a march with steps twice as long.

    E = |f_dt - f_2dt|/f_dt, as of a film that converges at first order: smooth films do so at
    second order, kinks that move with the gap do not.

    Parameters
    ----------
    curves
        Of the shorter steps, with the columns `time_error` and `time_error_pressure`.
    longer
        Of steps twice as long, of the same columns.
    every
        Rows of `curves` from one row of `longer` to the next. Rows between take the larger of
        both errors beside them.
    """
    table = curves.table.copy()
    count = len(longer.table)
    shared = np.arange(count) * every
    places = np.arange(len(table)) / every
    before = np.minimum(np.floor(places).astype(int), count - 1)
    after = np.minimum(np.ceil(places).astype(int), count - 1)
    for error, of in (("time_error", "minimum_film"), ("time_error_pressure", "pressure_max")):
        k = curves.columns.index(error)
        off = np.abs(longer[of] / curves[of][shared] - 1.0)
        table[:, k] = np.maximum(off[before], off[after])
    return replace(curves, table=table)


def march_curves(
    film: MovingFilm,
    columns: tuple[str, ...],
    row: Row,
    steps: NumberedSteps,
    *,
    scheme: str = "bdf2",
    settings: PointSolverSettings | None = None,
    keep: tuple[int, ...] = (),
    checkpoint: Path | str | None = None,
    checkpoint_every: int,
    progress: Progress | None = None,
    repeat: bool = False,
    throw: bool = True,
) -> FilmCurves:
    """Return the curves of a film over numbered steps, from the steady film at the first.

    Parameters
    ----------
    film
        Contact whose load and motion change.
    columns, row
        Names of the columns, and the numbers in them of a step and its film.
    steps
        Their numbers and times.
    scheme, settings
        As in `FilmMarch`.
    keep
        Steps whose whole film is returned; a checkpoint holds those already reached.
    checkpoint
        File to write every `checkpoint_every` steps, and to go on from if it is there.
    progress
        Called with the step, the last step and its film, from the first step on.
    repeat
        March a second time with time steps twice as long, half as much time again; the columns
        `time_error` and `time_error_pressure` come from the difference instead of from `TimeError`.
    throw
        Raise at the first step that does not converge; else go on and say so in the table.

    Raises
    ------
    ConvergenceError
        A step did not converge.
    ParameterError
        The checkpoint belongs to another march.
    """
    check_within("checkpoint_every", checkpoint_every, 1, 1_000_000)
    first, last = steps.first, steps.last
    path = None if checkpoint is None else Path(checkpoint)
    record = MarchRecord.read(path) if path is not None and path.exists() else None
    march = FilmMarch(
        film,
        steps.step_time / steps.substeps,
        start_time=steps.start_time,
        scheme=scheme,
        settings=settings,
        record=record,
        throw=throw,
    )
    if record is None:
        rows = [row(first, march.solution)]
        kept = {first: march.solution} if first in keep else {}
        if progress is not None:
            progress(first, last, march.solution)
    else:
        rows = record.curves.tolist()
        kept = unpack_solutions(
            film, march.settings, record.kept_steps, record.kept_fields, record.kept_values
        )
    for n in range(first + len(rows), last + 1):
        while march.steps < (n - first) * steps.substeps:
            solution = march.step(throw=False)
        if throw and not solution.converged:
            raise ConvergenceError(f"Step {n}: {solution.outcome}")
        rows.append(row(n, solution))
        if n in keep:
            kept[n] = solution
        if path is not None and (n % checkpoint_every == 0 or n == last):
            march.save(path, np.array(rows), kept)
        if progress is not None:
            progress(n, last, solution)
    curves = FilmCurves(columns, np.array(rows), kept)
    if not repeat or last == first:
        return curves
    longer = march_curves(
        film,
        columns,
        row,
        steps.longer(),
        scheme=scheme,
        settings=settings,
        checkpoint=None if path is None else path.with_name(f"{path.stem}_longer{path.suffix}"),
        checkpoint_every=checkpoint_every,
        throw=throw,
    )
    return with_time_errors(curves, longer, 1 if steps.substeps % 2 == 0 else 2)
