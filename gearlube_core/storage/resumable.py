"""Long calculations that can be resumed: finished results on disk, under a key of all inputs."""

from __future__ import annotations

import logging
import signal
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, Protocol, TypeVar

from gearlube_core.arrays import Array
from gearlube_core.errors import FileError, is_of_machine
from gearlube_core.storage.atomic_file import (
    read_arrays,
    read_dataset,
    write_arrays,
    write_compressed_dataset,
)
from gearlube_core.storage.process_pool import Pool, check_alive, single_threaded

if TYPE_CHECKING:
    import xarray as xr

Record = dict[str, Array]  # a result that consists of arrays
Result = TypeVar("Result")

logger = logging.getLogger(__name__)
Task = TypeVar("Task")


_POLL = 0.25  # s, time after which Ctrl-C is noticed
_ATTEMPTS = 3  # pools, should processes die
_SUBMITTED = 1000  # tasks that wait for a worker; more would only cost time and memory


class FileFormat(Protocol[Result]):
    """Interface of a file format for one kind of result and its key."""

    suffix: str

    def write(self, path: Path, key: str, result: Result) -> None:
        """Write a result and its key, atomically."""
        ...

    def read(self, path: Path) -> tuple[str, Result]:
        """Return key and result; raise FileError when the file cannot be read."""
        ...


class _Arrays:
    suffix = ".npz"
    _KEY = "gearlube_key"

    def write(self, path: Path, key: str, result: Record) -> None:
        write_arrays(path, {**result, self._KEY: key})

    def read(self, path: Path) -> tuple[str, Record]:
        arrays = read_arrays(path, sealed=True)
        return str(arrays.pop(self._KEY, "")), arrays


class _Datasets:
    suffix = ".nc"
    _KEY = "gearlube_point_key"

    def write(self, path: Path, key: str, result: xr.Dataset) -> None:
        write_compressed_dataset(result.assign_attrs({self._KEY: key}), path)

    def read(self, path: Path) -> tuple[str, xr.Dataset]:
        dataset = read_dataset(path, sealed=True)
        return str(dataset.attrs.get(self._KEY, "")), dataset


ARRAYS: FileFormat[Record] = _Arrays()
DATASETS: FileFormat[Any] = _Datasets()


@dataclass(frozen=True, slots=True)
class ResultStore(Generic[Result]):
    """Results in a folder.

    Parameters
    ----------
    folder : Path or None
        Made when the first result is kept. None: nothing is kept.
    format : FileFormat
        `ARRAYS` (dict of ndarrays) or `DATASETS` (xarray.Dataset).
    """

    folder: Path | None
    format: FileFormat[Result]

    def read(self, key: str) -> Result | None:
        """Return a result; None when it is absent, damaged or stored under another key."""
        if self.folder is None or not (path := self._path(self.folder, key)).is_file():
            return None
        try:
            stored, result = self.format.read(path)
        except FileError as error:
            logger.warning("%s It will be computed again.", error)
            return None
        if stored != key:
            logger.warning(
                "%s has another result than its name says. It will be computed again.", path
            )
            return None
        return result

    def keep(self, key: str, result: Result) -> None:
        """Write a result in one atomic step."""
        if self.folder is not None:
            self.folder.mkdir(parents=True, exist_ok=True)
            self.format.write(self._path(self.folder, key), key, result)

    def drop(self, keys: Iterable[str]) -> None:
        """Remove results, and the folder if nothing else is in it."""
        if self.folder is not None and self.folder.is_dir():
            for key in keys:
                self._path(self.folder, key).unlink(missing_ok=True)
            if not any(self.folder.iterdir()):
                self.folder.rmdir()

    def _path(self, folder: Path, key: str) -> Path:
        return folder / f"{key}{self.format.suffix}"


@dataclass(slots=True)
class Interrupt:
    """Whether someone has pressed Ctrl-C."""

    requested: bool = False


@contextmanager
def deferred_interrupts() -> Iterator[Interrupt]:
    """Turn the first Ctrl-C into a flag; a second one raises KeyboardInterrupt.

    An exception at an arbitrary place could leave a lock of the NetCDF library held, and the next
    write would wait for ever. Outside the main thread, where signals do not arrive, the flag
    stays down.
    """
    interrupt = Interrupt()
    if threading.current_thread() is not threading.main_thread():
        yield interrupt
        return
    previous = signal.getsignal(signal.SIGINT) or signal.default_int_handler

    def request(_number: int, _frame: FrameType | None) -> None:
        if interrupt.requested:
            raise KeyboardInterrupt
        interrupt.requested = True

    signal.signal(signal.SIGINT, request)
    try:
        yield interrupt
    finally:
        signal.signal(signal.SIGINT, previous)


class Store(Protocol[Result]):
    """Interface of where results are kept, such as `ResultStore`."""

    def read(self, key: str) -> Result | None:
        """Return a result; None when it is absent."""
        ...

    def keep(self, key: str, result: Result) -> None:
        """Write a result in one atomic step."""
        ...


class Finished(NamedTuple, Generic[Task, Result]):
    """A task with its result."""

    task: Task
    result: Result
    stored: bool  # read from the store, not computed now


def resumable_results(
    tasks: Sequence[Task],
    key: Callable[[Task], str],
    compute: Callable[[Task], Result],
    store: Store[Result],
    pool: Pool,
    *,
    failed: Callable[[Task, Exception], Result] | None = None,
    worth_keeping: Callable[[Result], bool] = lambda result: True,
) -> Iterator[Finished[Task, Result]]:
    """Yield every task with its result: stored ones first, the others as they are finished.

    Parameters
    ----------
    tasks
        Inputs that can be hashed and, for a pool of processes, pickled.
    key
        Key of a task's result in the store: a hash of everything that decides it.
    compute
        Called in the workers, so it must be possible to pickle it.
    store
        Where finished results are found and kept.
    pool
        Where the tasks run.
    failed
        Result of a task that raised an error or whose process died several times; kept only where
        the error is of physics, see `is_of_machine`. Without it such an error ends the run.
    worth_keeping
        Whether the store keeps a result.

    Raises
    ------
    KeyboardInterrupt
        After Ctrl-C, when the tasks under way are finished and kept. A second Ctrl-C does not
        wait for them.
    BrokenExecutor
        A process died several times and `failed` is not given.
    MemoryError
        There is too little memory for the threads of a pool.
    """
    due = []
    for task in tasks:
        result = store.read(key(task))
        if result is None:
            due.append(task)
        else:
            yield Finished(task, result, True)
    for task, result, is_final in _computed(due, compute, pool, failed):
        if is_final and worth_keeping(result):
            store.keep(key(task), result)
        yield Finished(task, result, False)


def _computed(
    tasks: list[Task],
    compute: Callable[[Task], Result],
    pool: Pool,
    failed: Callable[[Task, Exception], Result] | None,
) -> Iterator[tuple[Task, Result, bool]]:
    """Compute all tasks; those whose process died are tried again in a new pool.

    The third value is False where another run may find another result.
    """
    due, attempt = dict.fromkeys(tasks), 0
    while due:
        attempt += 1
        try:
            with pool.open(len(due)) as executor:
                for task, result, is_final in _in_pool(executor, list(due), compute, failed):
                    del due[task]
                    yield task, result, is_final
        except BrokenExecutor as error:
            if attempt < _ATTEMPTS:
                logger.warning(
                    "A worker process died, perhaps for want of memory. Its tasks are tried again."
                )
                continue
            if failed is None:
                raise
            for task in due:
                yield task, *_failure(task, error, failed)
            return


def _in_pool(
    executor: Executor | None,
    tasks: list[Task],
    compute: Callable[[Task], Result],
    failed: Callable[[Task, Exception], Result] | None,
) -> Iterator[tuple[Task, Result, bool]]:
    if executor is None:
        for task in tasks:
            with single_threaded():
                result = _result(task, lambda task=task: compute(task), failed)  # type: ignore[misc]
            yield task, *result
        return
    with deferred_interrupts() as interrupt:
        left = iter(tasks)
        waiting: dict[Future[Result], Task] = {}
        stopping = False
        while True:
            if not stopping:
                more = islice(left, _SUBMITTED - len(waiting))
                waiting.update((executor.submit(compute, task), task) for task in more)
            if not waiting:
                break
            if interrupt.requested and not stopping:
                stopping = True
                logger.info(
                    "Stopping. Tasks that are running will be finished and kept; press "
                    "Ctrl-C again to drop them."
                )
                waiting = {f: task for f, task in waiting.items() if not f.cancel()}
            done, _ = wait(waiting, timeout=_POLL, return_when=FIRST_COMPLETED)
            if not done:
                check_alive(executor)
            for future in done:
                task = waiting.pop(future)
                yield task, *_result(task, future.result, failed)
        if stopping:
            raise KeyboardInterrupt


def _result(
    task: Task, get: Callable[[], Result], failed: Callable[[Task, Exception], Result] | None
) -> tuple[Result, bool]:
    try:
        return get(), True
    except (BrokenExecutor, CancelledError):  # the second where a cluster is gone
        raise
    except Exception as error:
        if failed is None:
            raise
        return _failure(task, error, failed)


def _failure(
    task: Task, error: Exception, failed: Callable[[Task, Exception], Result]
) -> tuple[Result, bool]:
    logger.debug("%s failed", task, exc_info=error)
    again = is_of_machine(error)
    if again:
        logger.warning(
            "%s. This says nothing of the physics: it is not kept, and the next run of the same "
            "command computes it again.",
            f"{type(error).__name__}: {error}".rstrip(".: "),
        )
    return failed(task, error), not again
