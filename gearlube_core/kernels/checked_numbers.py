"""Checks of numbers from a file, before a kernel counts with them."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel


@kernel
def is_whole(value: float, low: float, high: float) -> bool:
    """Whether a number among the constants is a whole one within limits."""
    return low <= value <= high and value == float(int(value))


@kernel
def all_finite(values: Array, start: int, end: int) -> bool:
    """Whether the constants from one place up to another can be computed with."""
    finite = True
    for i in range(start, end):
        finite = finite and abs(values[i]) < 1e300
    return finite
