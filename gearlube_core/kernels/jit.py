"""The one decorator of every compiled kernel.

Kernels are pure and allocation-free: floats, NamedTuples of floats and float64 arrays in,
numbers (and an integer status where they can fail) out. They never raise, so that the complete
time step can be lowered to an object file that needs nothing but libm.
`error_model="numpy"` makes a division by zero give inf or NaN instead of an exception.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from gearlube_core.kernels.dispatcher import KernelDispatcher, compiled

_Function = TypeVar("_Function", bound=Callable[..., Any])


def kernel(function: _Function) -> _Function:
    """Compile `function` with numba on first call and keep the machine code on disk.

    Examples
    --------
    >>> @kernel
    ... def squared(x):
    ...     return x * x
    >>> squared(3.0)  # doctest: +SKIP
    9.0
    """
    return compiled(function, error_model="numpy")


def announced(function: _Function, words: str) -> _Function:
    """Return a kernel that logs these words before it is compiled, as that takes long."""
    if isinstance(function, KernelDispatcher):
        function.announce(words)
    return function


def row_kernel(function: _Function) -> _Function:
    """As `kernel`, for work on arrays that several threads do at once, see `RowWorkers`."""
    return compiled(function, error_model="numpy", nogil=True)
