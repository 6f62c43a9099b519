"""Run a variation: check every point, compute what is missing, keep each finished block."""

from __future__ import annotations

import hashlib
import json
import logging
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np

import drivetrain
import fmu_src
import gearlube
import gearlube_core
from gearlube.variation.design import Design
from gearlube.variation.point_study import FAILED, MISSING, Block, PointStudy, computed_block
from gearlube.variation.store import BlockStore
from gearlube_core import __version__
from gearlube_core.checks import check_within
from gearlube_core.errors import GearLubeError, InterruptedRunError, ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.folders import locked_folder
from gearlube_core.storage.process_pool import Pool, ProcessPool
from gearlube_core.storage.resumable import resumable_results

logger = logging.getLogger(__name__)

MOST_JOBS = 1024
MOST_BLOCK = 1_000_000
LEAST_BLOCKS = 16  # so that all processors have work and little is lost by a stop
_LISTED = 3  # wrong points whose reasons are listed
_CHECKED_TOGETHER = 50  # between two reports


@dataclass(frozen=True, slots=True)
class VariationRun:
    """Outcome of a run.

    Parameters
    ----------
    store : BlockStore
    computed, failed : int
        Points computed now; points of them that failed.
    lost : int
        Points whose process died several times, or that had no memory, disk or program for them;
        another run computes them again.
    """

    store: BlockStore
    computed: int
    failed: int
    lost: int


def run_variation(
    study: PointStudy,
    design: Design,
    *,
    out: Path | str,
    jobs: int | None = None,
    scheduler: str | None = None,
    block: int | None = None,
    overwrite: bool = False,
    progress: Progress = no_progress,
) -> VariationRun:
    """Compute a study at every point of a design; `open_variation` opens the results.

    Parameters
    ----------
    study : PointStudy
    design : Design
    out : path
        Folder of results; blocks of the same variation that are already there are not computed
        again.
    jobs : int, optional
        Number of local processes; default: all processors. Not used on a cluster.
    scheduler : str, optional
        Address of a running Dask scheduler, "tcp://host:port".
    block : int, optional
        Number of points that a worker computes and keeps together. Default: as the study sets
        it, but small enough for at least 16 blocks.
    overwrite : bool
        True: start again if the folder holds another variation.
    progress : callable
        Called with the share done [-] and a sentence.

    Raises
    ------
    ParameterError
        A point of the design is wrong, or another run writes to the folder; nothing has been
        computed then.
    InterruptedRunError
        After Ctrl-C, when the blocks that were being computed have been saved.

    Notes
    -----
    The memory of this process does not grow with the results: it holds only the blocks that have
    just arrived. Call this in a script under `if __name__ == "__main__":`, because each process
    reads the script.

    Examples
    --------
    >>> from gearlube.variation.design import Axis
    >>> from gearlube.variation.point_study import point_study
    >>> design = Design(axes=(Axis("bearing.preload", (2500.0, 6000.0)),))
    >>> run_variation(point_study("map"), design, out="my_variation").computed  # doctest: +SKIP
    2
    """
    if jobs is not None:
        check_within("jobs", jobs, 1, MOST_JOBS, "", "Leave it out to use all processors.")
    usual = max(1, min(study.block, -(-design.size // LEAST_BLOCKS)))
    points = int(check_within("--block", usual if block is None else block, 1, MOST_BLOCK))
    key = key_of(study, design)
    folder = Path(out)
    if BlockStore.found(folder, design, key=key, overwrite=overwrite) is None:
        check_all(study, design, progress)
    folder.mkdir(parents=True, exist_ok=True)
    with locked_folder(folder):  # only now is it sure what the folder holds
        store = BlockStore.found(folder, design, key=key, overwrite=overwrite)
        store = store or BlockStore.made(folder, study, design, key=key, block=points)
        tally = _run(store, study, design, key, jobs, scheduler, progress)
    return VariationRun(store, tally.computed, tally.failed, tally.lost)


def _run(
    store: BlockStore,
    study: PointStudy,
    design: Design,
    key: str,
    jobs: int | None,
    scheduler: str | None,
    progress: Progress,
) -> _Tally:
    """Compute the blocks that the store has not."""
    kept = store.finished()
    due = [number for number in range(store.blocks) if number not in kept]
    if kept and due:
        logger.info("%d of %d blocks are kept in %s.", len(kept), store.blocks, store.path)
    tally = _Tally(store, len(due), progress)
    if due:
        compute, pool = _workers(study, design, store.block, key, jobs, scheduler)
        try:
            for number, result, _ in resumable_results(
                due,
                str,
                compute,
                _Keeper(store),
                pool,
                failed=_lost,
                worth_keeping=lambda found: found.status.size > 0,
            ):
                tally.add(number, result)
        except KeyboardInterrupt:
            there = sum(len(store.points(number)) for number in store.finished())
            raise InterruptedRunError(
                f"Stopped: {there} of {design.size} points are kept in {store.path}. Run the same "
                "command again to compute the rest."
            ) from None
    return tally


def key_of(study: PointStudy, design: Design) -> str:
    """Return a hash of everything that decides the results of a variation."""
    everything = [study.name, study.identity, asdict(design), code_hash()]
    return hashlib.sha256(json.dumps(everything, sort_keys=True).encode()).hexdigest()[:24]


@cache
def code_hash() -> str:
    """Return a hash of version and all code that computes points."""
    found = hashlib.sha256(__version__.encode())
    for package in (gearlube_core, drivetrain, fmu_src, gearlube):
        for path in sorted(Path(str(package.__file__)).parent.rglob("*")):
            if path.suffix in (".py", ".toml", ".nc"):
                found.update(path.name.encode())
                found.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return found.hexdigest()


def check_all(study: PointStudy, design: Design, progress: Progress = no_progress) -> None:
    """Check every point of a design.

    Raises
    ------
    ParameterError
        Some points are wrong; the message says how many, and why the first of each kind is.
    """
    wrong, reasons = 0, dict[str, str]()
    for number in range(design.size):
        if number % _CHECKED_TOGETHER == 0:
            progress(0.0, f"checking point {number + 1} of {design.size}")
        point = design.point(number)
        try:
            study.check(point)
        except GearLubeError as error:
            wrong += 1
            values = ", ".join(f"{name} = {one}" for name, one in point.items())
            if len(reasons) < _LISTED:
                reasons.setdefault(str(error).split(", got")[0], f"{error} At {values}.")
    if wrong:
        raise ParameterError(
            f"{wrong} of {design.size} points are out of range; nothing was computed. "
            + " ".join(reasons.values())
        )


@dataclass(slots=True)
class _Tally:
    """Counts what arrives and reports the progress."""

    store: BlockStore
    due: int
    progress: Progress
    blocks: int = 0
    computed: int = 0
    failed: int = 0
    lost: int = 0

    def add(self, number: int, result: Block) -> None:
        self.blocks += 1
        computed = int((result.status != MISSING).sum())
        self.computed += computed
        self.failed += int((result.status == FAILED).sum())
        self.lost += len(self.store.points(number)) - computed
        for row in np.flatnonzero(result.status == MISSING):
            logger.warning("A point is lost: %s", result.messages[row].rstrip(": "))
        done = 1.0 - (self.due - self.blocks) / self.store.blocks
        self.progress(done, f"{self.failed} failed" if self.failed else "points")


@dataclass(frozen=True, slots=True)
class _Keeper:
    """The store as `resumable_results` wants it; what is there has been left out before."""

    store: BlockStore

    def read(self, key: str) -> Block | None:
        return None

    def keep(self, key: str, result: Block) -> None:
        self.store.write(int(key), result)


def _lost(number: int, error: Exception) -> Block:
    """Return the empty block of one whose process died several times, or that no worker had."""
    return Block(np.empty((0, 0)), np.empty(0, dtype=np.int8), [])


def _compile(study: PointStudy, design: Design) -> None:
    computed_block(study, design, 1, 0)


def _workers(
    study: PointStudy, design: Design, block: int, key: str, jobs: int | None, scheduler: str | None
) -> tuple[Callable[[int], Block], Pool]:
    if scheduler is not None:
        from gearlube.variation.cluster import StudyOnWorker, block_on_worker
        from gearlube_core.storage.dask_pool import DaskPool

        plugin = StudyOnWorker(study, design, key)
        return partial(block_on_worker, plugin.name, block), DaskPool(scheduler, plugin)
    # one point here, so that the processes find compiled kernels and do not all compile them
    before = None if jobs == 1 else partial(_compile, study, design)
    pool = ProcessPool(jobs=jobs, before=before)
    return partial(computed_block, study, design, block), pool
