"""A part of an array as a matrix inside a kernel, as `array_part` does for a row."""

from __future__ import annotations

from typing import Any

from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload
from numba.np import arrayobj

from gearlube_core.arrays import Array


def rows(array: Array, at: int, count: int, size: int) -> Array:
    """Return `count` rows of `size` numbers behind place `at`, shape (count, size), as `part`.

    Examples
    --------
    >>> import numpy as np
    >>> rows(np.arange(7.0), 1, 2, 3)
    array([[1., 2., 3.],
           [4., 5., 6.]])
    """
    return array[at : at + count * size].reshape(count, size)


def _rows(typingctx: Any, array: Any, at: Any, count: Any, size: Any) -> Any:
    """Return the code that makes rows; see `rows`."""
    if not isinstance(array, types.Array) or array.ndim != 1 or array.layout != "C":
        return None
    matrix = array.copy(ndim=2)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        whole = arrayobj.make_array(array)(context, builder, arguments[0])
        first, n, m = (
            context.cast(builder, value, kind, types.intp)
            for value, kind in zip(arguments[1:], signature.args[1:], strict=True)
        )
        made = arrayobj.make_array(matrix)(context, builder)
        arrayobj.populate_array(
            made,
            data=cgutils.gep_inbounds(builder, whole.data, first),
            shape=cgutils.pack_array(builder, [n, m]),
            strides=cgutils.pack_array(builder, [builder.mul(m, whole.itemsize), whole.itemsize]),
            itemsize=whole.itemsize,
            meminfo=None,
        )
        return made._getvalue()

    return matrix(array, at, count, size), generate


_rows_of: Any = intrinsic(_rows)


@overload(rows)
def _overloaded(array: Any, at: Any, count: Any, size: Any) -> Any:
    def found(array: Any, at: Any, count: Any, size: Any) -> Any:
        return _rows_of(array, at, count, size)

    return found
