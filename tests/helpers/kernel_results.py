"""Results of kernels as arrays, to compare compiled ones with their source."""

from __future__ import annotations

import numpy as np


def numbers(value):
    """All numbers in a result: a number, an array, or tuples of these."""
    if isinstance(value, tuple):
        return np.concatenate([numbers(part) for part in value]) if value else np.zeros(0)
    return np.ravel(np.asarray(value, dtype=float))


def own_arrays(value):
    """The value with its arrays copied, also those in a tuple."""
    if isinstance(value, tuple):
        parts = [own_arrays(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    if not isinstance(value, np.ndarray):
        return value
    own = value.copy()
    own.flags.writeable = value.flags.writeable  # a kernel is compiled for either
    return own


def arrays_in(values):
    """All arrays in nested tuples."""
    for value in values:
        if isinstance(value, tuple):
            yield from arrays_in(value)
        elif isinstance(value, np.ndarray):
            yield value


def everything(function, args):
    """What a function returns or writes, as arrays."""
    own = tuple(own_arrays(a) for a in args)
    returned = function(*own)
    written = list(arrays_in(own))
    return written if returned is None else [*written, numbers(returned)]
