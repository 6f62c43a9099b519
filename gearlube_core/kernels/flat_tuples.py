"""Nested NamedTuples of floats as flat arrays, and back inside a kernel.

A kernel that is called from Python thousands of times a second, or from C, takes its parameters
as one float64 array: handing over a NamedTuple costs a Python attribute look-up a field.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any, get_type_hints

import numpy as np
from numba import types
from numba.core import cgutils
from numba.core.types import Type
from numba.extending import intrinsic, overload
from numba.np import arrayobj

from gearlube_core.arrays import Array


def flatten(values: tuple[Any, ...]) -> Array:
    """Return the floats of a nested NamedTuple, fields in order, as a new array."""

    def leaves(part: tuple[Any, ...]) -> Iterator[float]:
        for value in part:
            if isinstance(value, tuple):
                yield from leaves(value)
            else:
                yield float(value)

    return np.fromiter(leaves(values), dtype=np.float64)


def count_floats(tuple_class: type, *variants: type) -> int:
    """Return the number of floats in a NamedTuple class; `variants` as in `tuple_from_array`."""
    return sum(1 if part is float else count_floats(part) for part in _parts(tuple_class, variants))


@cache
def _parts(tuple_class: type, variants: tuple[type, ...] = ()) -> list[type]:
    """Return float or the NamedTuple class of every field.

    Kept, because Python evaluates annotations again at each call.
    """
    hints = get_type_hints(tuple_class).values()
    interfaces = dict.fromkeys(h for h in hints if h is not float and not issubclass(h, tuple))
    chosen = dict(zip(interfaces, variants, strict=True))
    return [chosen.get(hint, hint) for hint in hints]


def tuple_from_array(array: Array, tuple_class: Any, *variants: Any) -> Any:
    """Return the NamedTuple `tuple_class` built from the first floats of a contiguous array.

    Parameters
    ----------
    array : ndarray, shape (>= count_floats(tuple_class, *variants),)
        As `flatten` returns it.
    tuple_class : type
        NamedTuple class whose fields are floats, NamedTuples or interfaces.
    variants : type
        For each interface among the fields, in order, the NamedTuple class that stands there.
    """
    floats = iter(array.tolist())

    def build(kind: type, chosen: tuple[type, ...]) -> Any:
        return kind(
            *(next(floats) if part is float else build(part, ()) for part in _parts(kind, chosen))
        )

    return build(tuple_class, variants)


def _tuple_type(tuple_class: type, variants: tuple[type, ...] = ()) -> Type:
    parts = [
        types.float64 if part is float else _tuple_type(part)
        for part in _parts(tuple_class, variants)
    ]
    return types.BaseTuple.from_types(parts, tuple_class)


def _load_tuple(typingctx: Any, array: Any, tuple_class: Any, variants: Any) -> Any:
    """Return the code that loads a tuple; see `tuple_from_array`."""
    chosen = tuple(variant.instance_class for variant in variants)
    result = _tuple_type(tuple_class.instance_class, chosen)

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

    return result(array, tuple_class, variants), generate


_load_kernel: Any = intrinsic(_load_tuple)


@overload(tuple_from_array)
def _tuple_from_array(array: Any, tuple_class: Any, *variants: Any) -> Any:
    def load(array: Any, tuple_class: Any, *variants: Any) -> Any:
        return _load_kernel(array, tuple_class, variants)

    return load


def tuple_to_array(values: tuple[Any, ...], array: Array) -> None:
    """Write the floats of a nested NamedTuple into the first places of a contiguous array.

    The kernels' `flatten`.

    Parameters
    ----------
    values : NamedTuple
        Its fields are numbers and NamedTuples.
    array : ndarray of shape (>= number of floats,)
    """
    floats = flatten(values)
    array[: floats.size] = floats


def _store_tuple(typingctx: Any, values: Any, array: Any) -> Any:
    """Return the code that stores a tuple; see `tuple_to_array`."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data = arrayobj.make_array(array)(context, builder, arguments[1]).data
        position = 0

        def store(part: Any, found: Any) -> None:
            nonlocal position
            for kind, value in zip(part.types, cgutils.unpack_tuple(builder, found), strict=True):
                if isinstance(kind, types.BaseTuple):
                    store(kind, value)
                else:
                    number = context.cast(builder, value, kind, types.float64)
                    builder.store(number, cgutils.gep_inbounds(builder, data, position))
                    position += 1

        store(values, arguments[0])
        return context.get_dummy_value()

    return types.none(values, array), generate


_store_kernel: Any = intrinsic(_store_tuple)


@overload(tuple_to_array)
def _tuple_to_array(values: Any, array: Any) -> Any:
    def store(values: Any, array: Any) -> None:
        _store_kernel(values, array)

    return store
