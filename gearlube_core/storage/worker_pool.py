"""Processes that share the processors: each runs its linear algebra on one thread."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any

from threadpoolctl import threadpool_limits


def single_threaded() -> threadpool_limits:
    """Limit the linear algebra of this process to one thread; use as a context or for good.

    Small matrix products lose more to the threads' waiting for each other than they gain.
    """
    return threadpool_limits(1)


def worker_pool(
    count: int, prepare: Callable[..., None] | None = None, arguments: tuple[Any, ...] = ()
) -> ProcessPoolExecutor:
    """Return a pool of `count` fresh processes, in each of which `prepare` has run."""
    return ProcessPoolExecutor(
        count,
        mp_context=get_context("spawn"),
        initializer=_begin,
        initargs=(prepare, arguments),
    )


def _begin(prepare: Callable[..., None] | None, arguments: tuple[Any, ...]) -> None:
    single_threaded()
    if prepare is not None:
        prepare(*arguments)
