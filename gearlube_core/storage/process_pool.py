"""Pools of workers: processes of this machine, or anything else that gives an Executor."""

from __future__ import annotations

import ctypes
import mmap
import multiprocessing
import os
import signal
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass, field
from functools import lru_cache, wraps
from threading import Thread
from typing import Any, Protocol, TypeVar, cast

from threadpoolctl import ThreadpoolController

_Function = TypeVar("_Function", bound=Callable[..., Any])
_END_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
_ROOM = 1 << 28  # [byte], less than any worker needs
_THREADS = "OPENBLAS_NUM_THREADS"


class Pool(Protocol):
    """Interface of workers; they can be opened more than once."""

    def open(self, tasks: int) -> AbstractContextManager[Executor | None]:
        """Give an executor for `tasks` tasks; None: run them one by one in this process."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcessPool:
    """Processes of this machine; the linear algebra of each runs on one thread.

    Parameters
    ----------
    jobs : int, optional
        Processes, never more than tasks. Default: all processors that this process may use.
    prepare : callable, optional
        Called with `arguments` once in each process before its first task.
    arguments : tuple
    always_spawn : bool
        Start a process even for one job. By default a single job runs in this process.
    before : callable, optional
        Called once in this process before the others start.
    """

    jobs: int | None = None
    prepare: Callable[..., None] | None = None
    arguments: tuple[Any, ...] = ()
    always_spawn: bool = False
    before: Callable[[], None] | None = None

    @contextmanager
    def open(self, tasks: int) -> Iterator[Executor | None]:
        """Give an executor for `tasks` tasks, or None to run them in this process."""
        if self.before is not None:
            self.before()
        count = min(self.jobs or processors(), tasks)
        if count <= 1 and not self.always_spawn:
            if self.prepare is not None:
                self.prepare(*self.arguments)
            yield None
            return
        executor = ProcessPoolExecutor(
            max(count, 1),
            mp_context=multiprocessing.get_context("spawn"),
            initializer=_start_worker,
            initargs=(self.prepare, self.arguments),
        )
        own = os.environ.get(_THREADS)
        os.environ.setdefault(_THREADS, "1")  # each thread takes memory before it is limited
        try:
            yield executor
        except KeyboardInterrupt:
            _end_workers(executor)
            raise
        finally:
            if own is None:
                os.environ.pop(_THREADS, None)
            dead = _is_dead(executor)
            if dead:
                _end_workers(executor)
            executor.shutdown(wait=not dead, cancel_futures=True)


@dataclass
class KeptPool:
    """Workers of a pool that stay for the next tasks; starting them takes seconds.

    Parameters
    ----------
    pool : Pool
    stack : ExitStack
        Ends the workers.
    """

    pool: Pool
    stack: ExitStack
    _opened: list[Executor | None] = field(default_factory=list)

    @contextmanager
    def open(self, tasks: int) -> Iterator[Executor | None]:
        """Give the executor that is there, or a new one where its processes have died."""
        if not self._opened or getattr(self._opened[-1], "_broken", False):
            self._opened.append(self.stack.enter_context(self.pool.open(tasks)))
        executor = self._opened[-1]
        try:
            yield executor
        except KeyboardInterrupt:
            if isinstance(executor, ProcessPoolExecutor):
                _end_workers(executor)
            raise


def _end_workers(executor: ProcessPoolExecutor) -> None:
    """End the processes at once: nobody waits for what they still compute."""
    for process in list((getattr(executor, "_processes", None) or {}).values()):
        process.terminate()


def check_alive(executor: Executor) -> None:
    """Raise MemoryError where nobody would ever hand the tasks to the workers of a pool."""
    if _is_dead(executor):
        raise MemoryError("the pool of processes can start no thread")


def _is_dead(executor: Executor) -> bool:
    """Return whether the pool's own thread has ended: it says nothing where it starts no other."""
    thread = getattr(executor, "_executor_manager_thread", None)
    return isinstance(thread, Thread) and not thread.is_alive()


def processors() -> int:
    """Return the number of processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def single_threaded() -> AbstractContextManager[Any]:
    """Limit the linear algebra of this process to one thread; in a context or permanently.

    Small matrix products lose more time to threads that wait for each other than they gain.
    """
    limiter: AbstractContextManager[Any] = _libraries(len(sys.modules)).limit(limits=1)
    return limiter


@lru_cache(maxsize=1)
def _libraries(_imported: int) -> ThreadpoolController:
    """Return the libraries with threads, which only an import adds to: a search of milliseconds."""
    return ThreadpoolController()


def on_one_thread(function: _Function) -> _Function:
    """Return a function that runs its linear algebra on one thread, see `single_threaded`.

    >>> on_one_thread(abs)(-2.0)
    2.0
    """

    @wraps(function)
    def run(*arguments: Any, **named: Any) -> Any:
        with single_threaded():
            return function(*arguments, **named)

    return cast(_Function, run)


def stop_on_interrupt() -> None:
    """Let Ctrl-C end this process at once: for a worker whose result nobody then waits for."""
    _end_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    single_threaded()


def _start_worker(prepare: Callable[..., None] | None, arguments: tuple[Any, ...]) -> None:
    try:
        _end_with_parent()
        mmap.mmap(-1, _ROOM).close()
    except (OSError, RuntimeError):  # OpenBLAS would wait for memory without end
        os._exit(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to the parent, which stops us
    single_threaded()
    if prepare is not None:
        prepare(*arguments)


def _end_with_parent() -> None:
    """Let this process end when its parent does, also when that is killed."""
    parent = multiprocessing.parent_process()
    if parent is None:
        return

    def watch() -> None:
        parent.join()
        os._exit(1)

    Thread(target=watch, daemon=True).start()
    if sys.platform == "linux":  # also while a kernel runs, when no other thread gets a turn
        ctypes.CDLL(None).prctl(_END_WITH_PARENT, signal.SIGKILL)
