"""Many independent contact solutions, in parallel and resumable from a folder."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from gearlube_core.storage.atomic_file import whole_file
from gearlube_core.storage.worker_pool import single_threaded, worker_pool

Record = dict[str, NDArray[np.float64]]
Task = TypeVar("Task")


@dataclass(frozen=True, slots=True)
class RecordStore:
    """Folder of finished records; without one nothing is kept.

    Parameters
    ----------
    folder : Path or None
    key : str
        Hash of everything that the records of a run share.
    """

    folder: Path | None
    key: str

    def read(self, name: str) -> Record | None:
        """Return a finished record; None when it is absent or damaged."""
        if self.folder is None:
            return None
        try:
            with np.load(self._path(self.folder, name), allow_pickle=False) as stored:
                return {key: stored[key] for key in stored.files}
        except (OSError, ValueError, EOFError, zipfile.BadZipFile):
            return None

    def keep(self, name: str, record: Record) -> None:
        """Write a neighbouring file and rename it, so that no reader sees half a record."""
        if self.folder is None:
            return
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self._path(self.folder, name)
        with whole_file(path) as partial, partial.open("wb") as file:
            np.savez(file, **record)  # type: ignore[arg-type]

    def _path(self, folder: Path, name: str) -> Path:
        return folder / f"{self.key}_{name}.npz"


def resumable_records(
    tasks: Sequence[Task],
    name: Callable[[Task], str],
    compute: Callable[[Task], Record],
    store: RecordStore,
    *,
    prepare: Callable[..., None] | None = None,
    arguments: tuple[Any, ...] = (),
    jobs: int | None = None,
    new: Callable[[Task, int], object] = lambda task, done: None,
) -> Iterator[tuple[Task, Record]]:
    """Yield every task with its record: stored ones first, the others as they are finished.

    Parameters
    ----------
    tasks
        Their inputs.
    name
        File name of a task's record in the store, unique among them.
    compute
        Called in the worker processes, so it and its tasks can be pickled.
    store
        Where finished records are found and kept.
    prepare, arguments
        Called once in each process that computes, before the first task.
    jobs
        Processes; one runs in this process. Default: all processors.
    new
        Told of each new record once it is kept, with the number of all finished ones.
    """
    missing, done = [], 0
    for task in tasks:
        record = store.read(name(task))
        if record is None:
            missing.append(task)
        else:
            done += 1
            yield task, record
    for task, record in _computed(compute, missing, prepare, arguments, jobs):
        store.keep(name(task), record)
        done += 1
        new(task, done)
        yield task, record


def _computed(
    compute: Callable[[Task], Record],
    tasks: list[Task],
    prepare: Callable[..., None] | None,
    arguments: tuple[Any, ...],
    jobs: int | None,
) -> Iterator[tuple[Task, Record]]:
    jobs = min(jobs or os.cpu_count() or 1, len(tasks)) if tasks else 0
    if jobs <= 1:
        if prepare is not None and tasks:
            prepare(*arguments)
        for task in tasks:
            with single_threaded():
                record = compute(task)
            yield task, record
        return
    with worker_pool(jobs, prepare, arguments) as pool:
        waiting: dict[Future[Record], Task] = {pool.submit(compute, task): task for task in tasks}
        try:
            while waiting:
                finished, _ = wait(waiting, return_when=FIRST_COMPLETED)
                for future in finished:
                    yield waiting.pop(future), future.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
