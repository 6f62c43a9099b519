"""Rows of a grid shared among threads."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Any

from gearlube_core.checks import check_within

MOST_THREADS = 64
_FEW = 12_000  # nodes; sharing takes about as long as the work on fewer


class RowWorkers:
    """Calls work on parts of the rows of a grid, at the same time where that pays.

    Parameters
    ----------
    threads
        At most so many parts; 1: the caller does all.

    Raises
    ------
    ParameterError
        The number is out of range.

    Notes
    -----
    What is done must not depend on which rows are done together, so that results are the same to
    the bit for any number of threads. Work is done at the same time only where its kernels
    are made with `row_kernel` or `line_kernel`. A process that was forked starts threads of its
    own.
    """

    def __init__(self, threads: int = 1) -> None:
        check_within("threads", threads, 1, MOST_THREADS, "")
        self.threads = threads
        self._pool: ThreadPoolExecutor | None = None
        self._owner = 0

    def __reduce__(self) -> Any:
        """Return how a copy is made: with threads of its own."""
        return RowWorkers, (self.threads,)

    def parts(self, rows: int, columns: int, together: int = 1) -> list[tuple[int, int]]:
        """Return the first row of every part and the one behind its last.

        Parts begin at multiples of `together`.
        """
        bundles = -(-rows // together)
        count = min(self.threads, bundles, max(1, rows * columns // _FEW))
        edges = [min(together * (bundles * k // count), rows) for k in range(count + 1)]
        return list(pairwise(edges))

    def share(
        self,
        work: Callable[[tuple[int, int]], object],
        rows: int,
        columns: int = 1 << 20,
        together: int = 1,
    ) -> None:
        """Call `work` with the rows of every part.

        Parameters
        ----------
        work
            Of the first row and the one behind the last.
        rows, columns
            Of the grid: few nodes are one part.
        together
            Parts begin at multiples of so many rows.
        """
        first, *others = self.parts(rows, columns, together)
        if not others:
            work(first)
            return
        if self._pool is None or self._owner != os.getpid():
            self._pool, self._owner = ThreadPoolExecutor(self.threads - 1), os.getpid()
        tasks = [self._pool.submit(work, part) for part in others]
        work(first)
        for task in tasks:
            task.result()


ALONE = RowWorkers()
