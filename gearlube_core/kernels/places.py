"""Whole numbers of floats as places in arrays, for any float at all.

Compiled code may turn a float that is not finite, or beyond 2^63, into any whole number: a place
that follows from a float is made here.
"""

from __future__ import annotations

from gearlube_core.kernels.jit import kernel


@kernel
def place_below(position: float, count: int) -> int:
    """Return the whole part of `position` as a place from 0 to `count - 1`.

    Outside it is the nearest of them, and 0 for NaN.
    """
    if not position >= 1.0:
        return 0
    if position >= count:
        return count - 1
    return int(position)
