"""Plan of a train: whole numbers that give the kernels the place of everything in it.

    sizes | a row for each element, in the order of the list | places of coordinates

A row holds the kind of an element and what its constants, memory and outputs begin at, then its
places `at`. The coordinates at the end, for exponential steps, are those that elements
without linear forces act on.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload
from numba.np import arrayobj

from gearlube_core.arrays import Offsets
from gearlube_core.kernels.inlining import inside

MOST_EXPONENTIAL = 1000  # steps a ms
MOST = 2**40  # a number in a plan is less


class Sizes(NamedTuple):
    """Sizes of a train, whole numbers."""

    elements: int
    carriers: int  # of them, the first ones, which have nodes
    bodies: int  # shown ones, nodes, then those without outputs
    shown: int
    nodes: int
    own: int  # states of elements, behind those of the bodies
    first_mobility: int  # among the numbers
    integrated: int
    states: int
    kept: int  # end of what elements keep, then a mark of each energy and the length of the step
    outputs: int  # of elements
    works: int  # of the energies, which are the last integrated states, first those put in
    losses: int  # of them, behind those put in; then bounds of losses
    energies: int
    exchanged: int  # rates of levels and event indicators of the elements
    written: int  # outputs of the train
    free: int  # coordinates that move
    touched: int  # of them, those that elements without linear forces act on
    exponential: int  # least steps a ms, with room behind the memory of the elements; 0: RK4


FIRST_ROW = len(Sizes._fields)
# of a row: kind of the element, first constant, first place in the memory and how many, first
# output, first of what EXCHANGE writes, how many numbers are kept, how many places, whether its
# forces are LINEAR or CURVED; then the places
KIND, NUMBER, MEMORY, N_MEMORY, OUTPUT, EXCHANGED, N_KEPT, N_PLACES, WHICH, AT = range(10)
LINEAR, CURVED = 1, 2
ALL = LINEAR | CURVED
OF_TABLES = -1  # in the shape of a plan: a number that the size of a table decides
UNKNOWN = MOST - 1  # kind of an element that `interpreted` does not know


def pack_plan(sizes: Sizes, rows: Sequence[Sequence[int]], touched: Sequence[int] = ()) -> Offsets:
    """Return the plan of a train with these rows and coordinates."""
    return np.array([*sizes, *(one for row in rows for one in row), *touched], dtype=np.int64)


@inside
def sizes_of(plan: Offsets) -> Sizes:
    """Return the sizes of the train of a plan."""
    return Sizes(*places(plan, 0, FIRST_ROW))


def places(plan: Offsets, first: int, count: int) -> Any:
    """Return whole numbers of a plan as a tuple, whose length is a constant of the kernel.

    Nothing is checked: 0 <= first and first + count <= plan.size, and no number is negative.

    Examples
    --------
    >>> places(np.array([7, 8, 9]), 1, 2)
    (8, 9)
    """
    return tuple(plan[first : first + count].tolist())


def _places(typingctx: Any, plan: Any, first: Any, count: Any) -> Any:
    """Return the code that loads a tuple; see `places`."""
    if not isinstance(count, types.IntegerLiteral):
        return None
    n, whole = count.literal_value, types.int64

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data = arrayobj.make_array(plan)(context, builder, arguments[0]).data
        start = context.cast(builder, arguments[1], signature.args[1], types.intp)
        base = cgutils.gep_inbounds(builder, data, start)
        # known not to be negative: then no index is tested for one that counts from the end
        bounds = [context.get_constant(whole, bound) for bound in (0, MOST)]
        loaded = [builder.load(cgutils.gep_inbounds(builder, base, i)) for i in range(n)]
        for one in loaded:
            one.set_metadata("range", builder.module.add_metadata(bounds))
        return context.make_tuple(builder, signature.return_type, loaded)

    return types.UniTuple(whole, n)(plan, first, count), generate


_places_of: Any = intrinsic(_places)


@overload(places, prefer_literal=True)
def _overloaded(plan: Any, first: Any, count: Any) -> Any:
    def found(plan: Any, first: Any, count: Any) -> Any:
        return _places_of(plan, first, count)

    return found
