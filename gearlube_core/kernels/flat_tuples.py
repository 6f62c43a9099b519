"""Nested NamedTuples of floats as flat arrays, and back inside a kernel.

A kernel that is called from Python thousands of times a second, or from C, takes its parameters
as one float64 array: handing over a NamedTuple costs a Python attribute look-up a field.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast, get_type_hints

import numpy as np
from numba import types
from numba.core import cgutils
from numba.core.types import Type
from numba.extending import intrinsic, overload
from numba.np import arrayobj
from numpy.typing import NDArray


def flatten(values: tuple[Any, ...]) -> NDArray[np.float64]:
    """Return the floats of a nested NamedTuple, fields in order, as a new array."""

    def leaves(part: tuple[Any, ...]) -> Iterator[float]:
        for value in part:
            if isinstance(value, tuple):
                yield from leaves(value)
            else:
                yield float(value)

    return np.fromiter(leaves(values), dtype=np.float64)


def count_floats(tuple_class: type, variant: type | None = None) -> int:
    """Return the number of floats in a NamedTuple class; `variant` as in `tuple_from_array`."""
    return sum(
        1 if part is float else count_floats(part, variant) for part in _parts(tuple_class, variant)
    )


def _parts(tuple_class: type, variant: type | None) -> list[type]:
    """Return float or the NamedTuple class of every field."""
    return [
        hint if hint is float or issubclass(hint, tuple) else cast(type, variant)
        for hint in get_type_hints(tuple_class).values()
    ]


def tuple_from_array(array: NDArray[np.float64], tuple_class: Any, variant: Any = None) -> Any:
    """Return the NamedTuple `tuple_class` built from the first floats of a contiguous array.

    Parameters
    ----------
    array : ndarray, shape (>= count_floats(tuple_class, variant),)
        As `flatten` returns it.
    tuple_class : type
        NamedTuple class whose fields are floats, NamedTuples or an interface.
    variant : type or None
        NamedTuple class of the fields that are declared as an interface.
    """
    floats = iter(array.tolist())

    def build(kind: type) -> Any:
        return kind(
            *(next(floats) if part is float else build(part) for part in _parts(kind, variant))
        )

    return build(tuple_class)


def _tuple_type(tuple_class: type, variant: type | None) -> Type:
    parts = [
        types.float64 if part is float else _tuple_type(part, variant)
        for part in _parts(tuple_class, variant)
    ]
    return types.BaseTuple.from_types(parts, tuple_class)


def _load_tuple(typingctx: Any, array: Any, tuple_class: Any, variant: Any) -> Any:
    """Return the code that loads a tuple; see `tuple_from_array`."""
    result = _tuple_type(tuple_class.instance_class, getattr(variant, "instance_class", None))

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data = arrayobj.make_array(array)(context, builder, arguments[0]).data
        position = 0

        def build(part: Any) -> Any:
            nonlocal position
            values = []
            for kind in part.types:
                if kind is types.float64:
                    values.append(builder.load(cgutils.gep_inbounds(builder, data, position)))
                    position += 1
                else:
                    values.append(build(kind))
            return context.make_tuple(builder, part, values)

        return build(result)

    return result(array, tuple_class, variant), generate


_load_kernel: Any = intrinsic(_load_tuple)


@overload(tuple_from_array)
def _tuple_from_array(array: Any, tuple_class: Any, variant: Any = None) -> Any:
    def load(array: Any, tuple_class: Any, variant: Any = None) -> Any:
        return _load_kernel(array, tuple_class, variant)

    return load
