"""A grid of speeds and preloads: compute what is missing, keep every finished point."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from pathlib import Path

import xarray as xr

from gearlube.studies.sweep.bookkeeping import Book, Observer, Place
from gearlube.studies.sweep.executors import Crew, PointFunction, crew_for, default_jobs
from gearlube.studies.sweep.gear_pair import mesh_table_of
from gearlube.studies.sweep.interrupts import deferred_interrupts
from gearlube.studies.sweep.merge import merge, save
from gearlube.studies.sweep.natural_frequencies import natural_frequencies
from gearlube.studies.sweep.point import failed_point, run_point
from gearlube.studies.sweep.provenance import code_version
from gearlube.studies.sweep.quantities import described
from gearlube.studies.sweep.settings import SweepSettings
from gearlube.studies.sweep.store import PointStore
from gearlube.studies.sweep.unpack import fmu_guid, unpacked
from gearlube.studies.sweep.warm_up import warm_up
from gearlube_core.checks import check_within
from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.mesh_table.table import MeshTable

logger = logging.getLogger(__name__)

_MOST_JOBS = 1024
_POLL = 0.25  # s, time after which Ctrl-C is noticed
_ATTEMPTS = 3  # local pools, should processes die
_PRELOAD_CURE = "A preload cannot pull; the paper has 2500 and 6000 N."


class SweepInterruptedError(GearLubeError):
    """The sweep was stopped from the keyboard; its finished points are on disk."""


PrepareFunction = Callable[[Path, SweepSettings], None]
ModesFunction = Callable[[Sequence[float], float, SweepSettings, MeshTable], xr.DataArray]


def run_sweep(
    fmu: Path | str,
    *,
    speeds_kmh: Sequence[float],
    preloads: Sequence[float],
    settings: SweepSettings | None = None,
    out: Path | str = "gearlube_sweep",
    jobs: int | None = None,
    scheduler: str | None = None,
    observer: Observer | None = None,
    command_line: str = "",
    point: PointFunction = run_point,
    prepare: PrepareFunction | None = warm_up,
    modes: ModesFunction | None = natural_frequencies,
) -> xr.Dataset:
    """Run the axle FMU over a grid of vehicle speeds and bearing preloads.

    Parameters
    ----------
    fmu : path
        The axle FMU.
    speeds_kmh, preloads : sequence of float
        Grid [km/h], [N].
    settings : SweepSettings
        Shared by all points.
    out : path
        Folder of results: points/ holds every finished point; sweep.nc and summary.csv all.
        Points that are already there are not computed again; failed ones are.
    jobs : int
        Local processes [-]; all processors if None. Without effect on a cluster.
    scheduler : str
        Address of a running Dask scheduler, "tcp://host:port".
    observer : callable
        Called with a `Progress` after every point.
    command_line : str
        Noted in the file.
    point : callable
        Computes one point; importable by the workers.
    prepare : callable
        Compiles the axle before local processes start, so that they do not all do it.
    modes : callable
        Gives the natural frequencies that the figures mark, at the middle speed; None for none.

    Returns
    -------
    xarray.Dataset
        Over (preload, speed); also written to out/sweep.nc.

    Raises
    ------
    SweepInterruptedError
        After Ctrl-C, when the finished points have been saved.
    """
    fmu, out = Path(fmu), Path(out)
    settings = settings or SweepSettings()
    speeds = sorted({check_within("speed", v, 1.0, 400.0, "km/h") for v in speeds_kmh})
    loads = sorted({check_within("preload", p, 1.0, 1e5, "N", _PRELOAD_CURE) for p in preloads})
    if not speeds or not loads:
        raise ParameterError("A sweep needs at least one speed and one preload, got none.")
    if jobs is not None:
        check_within("jobs", jobs, 1, _MOST_JOBS, "", "Leave it out to use all processors.")
    with unpacked(fmu) as directory:
        guid, mesh = fmu_guid(directory), mesh_table_of(directory)
    keys = {
        (v, p): settings.key(speed_kmh=v, preload=p, fmu_guid=guid, version=code_version())
        for p in loads
        for v in speeds
    }
    store = PointStore(out / "points")
    began = time.monotonic()
    book = Book(keys, store, observer)
    book.reuse()
    try:
        if prepare is not None and scheduler is None and book.due:
            prepare(fmu, settings)
        _compute(book, fmu, settings, jobs=jobs, scheduler=scheduler, point=point)
    except KeyboardInterrupt:
        raise SweepInterruptedError(
            f"Stopped: {len(book.finished)} of {len(keys)} points are finished and kept in "
            f"{store.directory}. Run the same command again to compute the rest."
        ) from None
    sweep = merge(loads, speeds, book.points).assign_attrs(
        {
            "title": "Speed sweep of a lubricated hypoid axle",
            "gearlube_version": code_version(),
            "fmu_guid": guid,
            "mesh_table": mesh.name,
            "mesh_table_source": mesh.source,
            "command_line": command_line,
            "scheduler": scheduler or "local processes",
            "computed_points": len(keys) - book.reused,
            "wall_time": time.monotonic() - began,
            **{f"setting_{name}": value for name, value in settings.as_dict().items()},
        }
    )
    if modes is not None:
        sweep["mode_frequency"] = modes(loads, speeds[len(speeds) // 2], settings, mesh)
    described(sweep)
    save(sweep, out)
    return sweep


def _compute(
    book: Book,
    fmu: Path,
    settings: SweepSettings,
    *,
    jobs: int | None,
    scheduler: str | None,
    point: PointFunction,
) -> None:
    """Compute all due points; a point whose process died is tried again in a new pool."""
    last = ""
    for _ in range(_ATTEMPTS):
        if not book.due:
            return
        workers = min(jobs or default_jobs(), len(book.due))
        try:
            with crew_for(fmu, jobs=workers, scheduler=scheduler, point=point) as crew:
                _collect(book, crew, settings)
        except BrokenExecutor as error:
            last = str(error)
            logger.warning("A worker process died; trying its points again: %s", error)
    for speed_kmh, preload in book.due:
        message = f"The process of this point died {_ATTEMPTS} times: {last}"
        book.add((speed_kmh, preload), failed_point(speed_kmh, preload, message))


def _collect(book: Book, crew: Crew, settings: SweepSettings) -> None:
    """Submit what is due and enter results as they come; the same loop for every executor."""
    with deferred_interrupts() as interrupt:
        waiting: dict[Future[xr.Dataset], Place] = {
            crew.executor.submit(crew.run, *crew.leading, *at, settings): at for at in book.due
        }
        stopping = False
        while waiting:
            if interrupt.requested and not stopping:
                stopping = True
                logger.info("Stopping; points under way will be kept (Ctrl-C again drops them).")
                waiting = {f: at for f, at in waiting.items() if not f.cancel()}
            done, _ = wait(waiting, timeout=_POLL, return_when=FIRST_COMPLETED)
            for future in done:
                at = waiting.pop(future)
                book.add(at, _result(future, at))
        if stopping:
            raise KeyboardInterrupt


def _result(future: Future[xr.Dataset], at: Place) -> xr.Dataset:
    try:
        return future.result()
    except BrokenExecutor:
        raise
    except Exception as error:
        # The boundary of the sweep: whatever went wrong in one point becomes a row.
        logger.debug("%g km/h, %g N", *at, exc_info=error)
        return failed_point(*at, f"{type(error).__name__}: {error}")
