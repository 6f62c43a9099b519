"""Where the points run: processes on this machine, or the workers of a Dask cluster."""

from __future__ import annotations

import logging
import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.studies.sweep.settings import SweepSettings
from gearlube.studies.sweep.unpack import unpacked

PointFunction = Callable[[Path, float, float, SweepSettings], xr.Dataset]


@dataclass(frozen=True, slots=True)
class Crew:
    """An executor and the function that runs one point on it.

    `run` takes (speed_kmh, preload, settings); where the FMU lies is the crew's business.
    """

    executor: Executor
    run: Callable[..., xr.Dataset]
    leading: tuple[Any, ...]


def default_jobs() -> int:
    """Return the number of processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _be_quiet_worker() -> None:
    """Leave Ctrl-C to the parent, and messages too: they come back with the failed points."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    logging.getLogger("fmu_src").addHandler(logging.NullHandler())


@contextmanager
def local_crew(fmu: Path, jobs: int | None, point: PointFunction) -> Iterator[Crew]:
    """Run points in `jobs` spawned processes; the FMU is unzipped once for all of them."""
    workers = default_jobs() if jobs is None else jobs
    with unpacked(fmu) as directory:
        executor = ProcessPoolExecutor(
            max_workers=workers,
            mp_context=multiprocessing.get_context("spawn"),
            initializer=_be_quiet_worker,
        )
        try:
            yield Crew(executor, point, (directory,))
        finally:
            executor.shutdown(wait=True, cancel_futures=True)


@contextmanager
def crew_for(
    fmu: Path, *, jobs: int | None, scheduler: str | None, point: PointFunction
) -> Iterator[Crew]:
    """Open the cluster at `scheduler` if one is named, else local processes."""
    if scheduler is None:
        with local_crew(fmu, jobs, point) as crew:
            yield crew
        return
    from gearlube.studies.sweep.cluster import cluster_crew

    with cluster_crew(fmu, scheduler, point) as crew:
        yield crew
