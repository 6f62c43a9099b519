"""A part of an array inside a kernel, without the count of references that a slice costs."""

from __future__ import annotations

from typing import Any

from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload
from numba.np import arrayobj

from gearlube_core.arrays import Array


def part(array: Array, at: int, size: int) -> Array:
    """Return `array[at : at + size]` of a contiguous array, shape (size,), over the same memory.

    Nothing is checked: 0 <= at and at + size <= array.size. The part lives as long as the array,
    so a kernel must not return it or keep it.

    Examples
    --------
    >>> import numpy as np
    >>> part(np.array([1.0, 2.0, 3.0, 4.0]), 1, 2)
    array([2., 3.])
    """
    return array[at : at + size]


def _part(typingctx: Any, array: Any, at: Any, size: Any) -> Any:
    """Return the code that makes a part; see `part`."""
    if not isinstance(array, types.Array) or array.ndim != 1 or array.layout != "C":
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        whole = arrayobj.make_array(array)(context, builder, arguments[0])
        first = context.cast(builder, arguments[1], signature.args[1], types.intp)
        count = context.cast(builder, arguments[2], signature.args[2], types.intp)
        made = arrayobj.make_array(array)(context, builder)
        arrayobj.populate_array(
            made,
            data=cgutils.gep_inbounds(builder, whole.data, first),
            shape=cgutils.pack_array(builder, [count]),
            strides=cgutils.pack_array(builder, [whole.itemsize]),
            itemsize=whole.itemsize,
            meminfo=None,
        )
        return made._getvalue()

    return array(array, at, size), generate


_part_of: Any = intrinsic(_part)


@overload(part)
def _overloaded(array: Any, at: Any, size: Any) -> Any:
    def found(array: Any, at: Any, size: Any) -> Any:
        return _part_of(array, at, size)

    return found
