"""Kernels over lines of large arrays."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from gearlube_core.kernels.dispatcher import compiled

_Function = TypeVar("_Function", bound=Callable[..., Any])


def line_kernel(function: _Function) -> _Function:
    """As `row_kernel`, without numba's count of the users of an array.

    numba counts whoever holds an array or a part of it, with an instruction that locks the count
    against other threads. Where a kernel takes a line of an array for every line that it writes,
    that costs as much as the work on the line, and threads wait for each other's counts. A kernel
    that allocates nothing needs no count, as its caller holds the arrays. One that does allocate
    is refused when it is compiled: a line that is set to another array by `a[i] = b` is one.
    """
    return compiled(function, error_model="numpy", nogil=True, _nrt=False)
