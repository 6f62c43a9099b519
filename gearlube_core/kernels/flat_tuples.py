"""Nested NamedTuples of floats as flat arrays, and back inside a kernel.

A kernel that is called from Python thousands of times a second, or from C, takes its parameters
as one float64 array: handing over a NamedTuple costs a Python attribute look-up a field.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, get_type_hints

import numpy as np
from numba import types
from numba.core import cgutils
from numba.core.types import Type
from numba.extending import intrinsic
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


def count_floats(tuple_class: type) -> int:
    """Return the number of floats in a NamedTuple class of floats and such NamedTuples."""
    hints = get_type_hints(tuple_class).values()
    return sum(1 if hint is float else count_floats(hint) for hint in hints)


def _tuple_type(tuple_class: type) -> Type:
    parts = [
        types.float64 if hint is float else _tuple_type(hint)
        for hint in get_type_hints(tuple_class).values()
    ]
    return types.BaseTuple.from_types(parts, tuple_class)


def _tuple_from_array(typingctx: Any, array: Any, tuple_class: Any) -> Any:
    """Return the NamedTuple `tuple_class` built from the first floats of a contiguous array."""
    result = _tuple_type(tuple_class.instance_class)

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

    return result(array, tuple_class), generate


tuple_from_array: Any = intrinsic(_tuple_from_array)
