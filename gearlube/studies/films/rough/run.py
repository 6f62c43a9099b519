"""The film between rough surfaces in motion: march, records, kept films, statistics."""

from __future__ import annotations

import errno
import logging
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.studies.films.results import begin
from gearlube.studies.films.rough.files import (
    Gathered,
    new_statistics,
    read_frames,
    write_frame,
    write_rough_results,
)
from gearlube_core.checks import check_within
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.ehl.statistics.rough_film import statistics_of_run
from gearlube_core.ehl.transient.history import MarchRecord
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import ConvergenceError, FileError, InterruptedRunError, ParameterError
from gearlube_core.kernels.row_workers import MOST_THREADS
from gearlube_core.progress import Progress, no_progress

_FIELDS_KEPT = 2  # film and pressure, in single precision
_FIELDS_RECORDED = 9  # pressure, rh h at three times, its error, inflow, rise and copies
_RECORDS = 2  # an older one stays until the new one is whole
_FIGURES = 4_000_000  # B, figures and statistics
_PICTURE = 300_000  # B, of a kept film
_STEP = 400  # B, of the statistics of a step
_MEGABYTE = 1e6


class _DiskNeed(NamedTuple):
    """Bytes of the files of a march."""

    frames: int
    records: int
    others: int
    free: int

    @property
    def total(self) -> int:
        """All files [B]."""
        return self.frames + self.records + self.others

    @property
    def sentence(self) -> str:
        """Return the need in words."""
        parts = (
            (self.frames, "of kept films"),
            (self.records, "of records to go on from"),
            (self.others, "of statistics and figures"),
        )
        listed = ", ".join(f"{one / _MEGABYTE:.1f} MB {words}" for one, words in parts)
        return f"It will take {self.total / _MEGABYTE:.0f} MB on the disk: {listed}."


logger = logging.getLogger("gearlube")

_LOST = 10  # steps in turn that do not converge, after which a march stops


def run_rough(
    case: RoughCase,
    *,
    steps: int | None = None,
    folder: Path | None = None,
    threads: int = 1,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return the statistics of a contact that becomes rough, step by step in time.

    Parameters
    ----------
    case
        Contact, surfaces, time steps, grid.
    steps
        Number of steps to compute now; None: all steps of the case. A later call with the same
        folder continues.
    folder
        Folder for rough.nc, summary.csv, figures, kept films and the record of the march. A march
        continues from its record there, with the same results to the bit as without a stop. None:
        nothing is written.
    threads
        Number of threads that share the work on rows, 1 to 64; results do not depend on it, to the
        bit.
    progress
        Called with the share done and a sentence on what runs.

    Returns
    -------
    xr.Dataset
        Results of `RoughFilmStatistics`, and the work of every step; `converged` is 0 if any step
        did not converge.

    Raises
    ------
    ParameterError
        `steps` or `threads` is out of range, there is too little disk space, or the record is
        damaged or of another case.
    ConvergenceError
        Ten steps in turn did not converge, or a film is not finite; the last record is kept.
    FileError
        A file could not be written; the last record is kept.
    InterruptedRunError
        Ctrl-C while steps were written to a folder; the last record is kept.

    Examples
    --------
    >>> coarse = {"surface_1.cutoff_um": 42.0, "surface_2.cutoff_um": 42.0,
    ...           "solver.nodes_x": 257, "solver.rows": 40, "frames.steps": []}
    >>> case = RoughCase.named("jamali_2015_a").varied(coarse)
    >>> case.schedule().steps
    2244
    >>> run_rough(case, steps=100).sizes["time"]  # doctest: +SKIP
    101
    """
    schedule = case.schedule()
    last = schedule.steps if steps is None else steps
    check_within("steps", last, 1, schedule.steps, "", "The case ends there.")
    check_within("threads", threads, 1, MOST_THREADS, "")
    key = case.key()
    if folder is not None:
        need = disk_need(case, folder)
        logger.info("%s %.0f MB are free.", need.sentence, 1e-6 * need.free)
    begin(folder, progress, "smooth film")
    record = None if folder is None else _record(folder, key)
    gathered = Gathered(case)
    if record is not None:
        gathered.unpack(record.curves)
    march = FilmMarch(
        case.film(),
        schedule.time_step,
        scheme=case.solver.scheme,
        settings=case.settings(),
        record=record,
        throw=True,
        threads=threads,
    )
    if record is None:
        gathered.add(march.solution)
        _keep(case, folder, 0, march.solution, key)
    else:
        logger.info("Continuing from step %d.", march.steps)
    recorded = march.steps
    try:
        for step in _steps(march, last, gathered, progress):
            _keep(case, folder, step, march.solution, key)
            if folder is not None and (step % case.frames.record_every == 0 or step == last):
                with _reported(folder, step):
                    march.save(_record_file(folder, key), gathered.packed())
                recorded = step
    except KeyboardInterrupt:
        if folder is None:
            raise
        where = f"from step {recorded}" if recorded else "from the beginning"
        raise InterruptedRunError(
            f"Stopped in step {march.steps} of {last}. Run the same command again: it "
            f"continues {where} in {folder}."
        ) from None
    dataset = _with_attributes(gathered.dataset(), case, key)
    if folder is not None:
        progress(last / (last + 1), "writing files and figures")
        with _reported(folder, march.steps):
            write_rough_results(dataset, folder)
    progress(1.0, "done")
    return dataset


def _steps(march: FilmMarch, last: int, gathered: Gathered, progress: Progress) -> Iterator[int]:
    """March to a step and gather; yield the number of every step. Raise where a film is lost."""
    lost = 0
    while march.steps < last:
        solution = march.step(throw=False)
        step = march.steps
        _check_finite(step, solution)
        gathered.add(solution)
        lost = 0 if solution.converged else lost + 1
        if lost == _LOST:
            raise ConvergenceError(
                f"Steps {step - _LOST + 1} to {step} did not converge. {solution.outcome}"
            )
        yield step
        progress(
            step / (last + 1),
            f"step {step}: {1e-9 * solution.maximum_pressure:.2f} GPa, smallest film "
            f"{1e9 * solution.minimum_film:.0f} nm",
        )


def statistics_again(case: RoughCase, folder: Path) -> xr.Dataset:
    """Return the statistics of the kept films in a folder; nothing is marched.

    Of the kept films alone, also where rough.nc holds those of every step; they are written to
    frames.nc.

    Raises
    ------
    ParameterError
        There is no kept film, or one is damaged or of another case.
    """
    from gearlube_core.storage.atomic_file import write_dataset

    key = case.key()
    found = statistics_of_run(read_frames(folder, key), new_statistics(case))
    dataset = _with_attributes(found, case, key)
    write_dataset(dataset, folder / "frames.nc")
    return dataset


def _record_file(folder: Path, key: str) -> Path:
    return folder / f"march_{key}.npz"


def _record(folder: Path, key: str) -> MarchRecord | None:
    """Return the record of the march in a folder; None: there is none."""
    path = _record_file(folder, key)
    others = sorted(one.name for one in folder.glob("march_*.npz") if one != path)
    if others:
        raise ParameterError(
            f"{folder} must hold only results of this case, got {others[0]} from another case. "
            "Give another --out, or remove that file and the folder frames."
        )
    return MarchRecord.read(path) if path.exists() else None


def _keep(
    case: RoughCase, folder: Path | None, step: int, solution: FilmSolution, key: str
) -> None:
    if folder is not None and step in case.kept_steps():
        with _reported(folder, step):
            write_frame(folder, step, solution, key)


@contextmanager
def _reported(folder: Path, step: int) -> Iterator[None]:
    """Turn a full disk into an error that says what is kept."""
    try:
        yield
    except OSError as reason:
        why = "the disk is full" if reason.errno == errno.ENOSPC else (reason.strerror or reason)
        raise FileError(
            f"Step {step} could not be written to {folder}: {why}. The previous record is "
            "complete. Free some disk space and run the same command again: it continues from "
            "there."
        ) from reason


def _check_finite(step: int, solution: FilmSolution) -> None:
    if not (np.isfinite(solution.film).all() and np.isfinite(solution.pressure).all()):
        raise ConvergenceError(
            f"Step {step}: the film is not finite. Take more nodes or shorter time steps. The last "
            "record is kept."
        )


def _with_attributes(dataset: xr.Dataset, case: RoughCase, key: str) -> xr.Dataset:
    schedule, section = case.schedule(), case.section()
    half_width, _, hertz = section.hertz_contact
    failed = int((dataset["converged"] == 0.0).sum()) if "converged" in dataset else 0
    count = dataset.sizes["time"]
    outcome = f"All {count} films converged."
    if failed:
        outcome = (
            f"{failed} of {count} films did not converge. Take more nodes or shorter time steps."
        )
    dataset.attrs |= {
        "contact": "rough",
        "name": case.name,
        "source": case.source,
        "march": key,
        "side_conditions": case.side_conditions,
        "half_width": half_width,
        "hertz_pressure": hertz,
        "length": float(np.diff(section.y_limits)[0]),
        "time_step": schedule.time_step,
        "rough_time": schedule.time(schedule.until_rough),
        "nodes_x": case.solver.nodes_x,
        "rows": case.solver.rows,
        "converged": int(not failed),
        "outcome": outcome,
    }
    return dataset


def disk_need(case: RoughCase, folder: Path) -> _DiskNeed:
    """Return the disk space of the files of a march.

    Raises
    ------
    ParameterError
        The disk has less.
    """
    nodes, kept = case.solver.nodes_x * (case.solver.rows + 2), len(case.kept_steps())
    steps = case.schedule().steps + 1
    near = next(one for one in (folder, *folder.absolute().parents) if one.exists())
    need = _DiskNeed(
        frames=kept * (4 * _FIELDS_KEPT * nodes + _PICTURE),
        records=_RECORDS * (8 * _FIELDS_RECORDED * nodes + _STEP * steps),
        others=_FIGURES + 3 * _STEP * steps,
        free=shutil.disk_usage(near).free,
    )
    if need.total > need.free:
        raise ParameterError(
            f"{folder} must have {need.total / _MEGABYTE:.0f} MB free space, got "
            f"{need.free / _MEGABYTE:.0f} MB. Keep fewer films ([frames]), or give --out on "
            "another disk."
        )
    return need
