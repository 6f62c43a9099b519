"""Whether a train that comes from a file can be computed with, by the interpreter.

Every place of its plan lies in its array and is that of an assembly: parts follow each other
without gaps. What elements count with in their constants and memory is looked at by their own
kernels, see `Kernels.check`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.train.drivers import AllElements
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES
from gearlube_core.dynamics.train.exponential_room import room_size
from gearlube_core.dynamics.train.outputs import count_outputs
from gearlube_core.dynamics.train.part import Element, shipped_elements
from gearlube_core.dynamics.train.plan import (
    AT,
    CURVED,
    EXCHANGED,
    FIRST_ROW,
    KIND,
    LINEAR,
    MEMORY,
    MOST_EXPONENTIAL,
    N_KEPT,
    N_MEMORY,
    N_PLACES,
    NUMBER,
    OUTPUT,
    WHICH,
    Sizes,
    sizes_of,
)
from gearlube_core.kernels.checked_numbers import all_finite
from gearlube_core.kernels.flat_tuples import count_floats
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantParameters, LubricantState

_MOST_BODIES, _MOST = 1000, 2**31 - 1
_OIL = count_floats(LubricantParameters)


class _Counts(NamedTuple):
    """How many of each an element of a kind has."""

    bodies: int
    states: int
    angles: int  # and lags
    works: int
    losses: int
    bounds: int
    keeps: int  # 1 if it has a place of what it keeps
    beside: int
    places: int  # of all these and of its sizes
    floats: int
    outputs: int
    exchanged: int
    # 1 if it carries nodes: its last bodies and its first sizes are of nodes and of modes
    carries: int


(
    _BODIES, _STATES, _ANGLES, _WORKS, _LOSSES, _BOUNDS, _KEEPS, _BESIDE, _PLACES, _FLOATS, _OUTS,
    _EXCHANGED, _CARRIES,
) = range(len(_Counts._fields))  # fmt: skip


def _counts() -> Offsets:
    """Return the counts of all kinds of the interpreter, a row for each."""
    rows = [
        _Counts(
            bodies=len(one.on),
            states=len(one.states),
            angles=len(one.angles) + len(one.lags),
            works=len(one.works),
            losses=len(one.losses),
            bounds=len(one.bounds),
            keeps=int(one.kept_size is not Element.kept_size),
            beside=len(one.beside),
            places=kind.places,
            floats=count_floats(kind.numbers, *kind.variants),
            outputs=len(one.outputs),
            exchanged=len(one.levels) + len(one.events),
            carries=int(one.carries),
        )
        for one, kind in shipped_elements()
    ]
    return np.array(rows, dtype=np.int64)


def check_kernel(elements: AllElements) -> Callable[..., bool]:
    """Return the kernel that checks whether numbers, memory and plan of a file are a train.

    It takes a state of the oil and the three arrays. `elements` are those of `interpreted`.
    """
    counts, check = _counts(), elements.check
    kinds = len(counts)

    @kernel
    def totals_fit(plan: Offsets, sizes: Sizes) -> bool:
        """Whether there are as many rows as sizes say, of known kinds, with these totals."""
        at, own, turning, works, outputs, exchanged = FIRST_ROW, 0, 0, 0, 0, 0
        for _ in range(sizes.elements):
            if at + AT > plan.size or plan[at + KIND] >= kinds:
                return False
            kind = plan[at + KIND]
            if plan[at + N_PLACES] != counts[kind, _PLACES]:
                return False
            own += counts[kind, _STATES]
            turning += counts[kind, _ANGLES]
            works += counts[kind, _WORKS]
            outputs += counts[kind, _OUTS]
            exchanged += counts[kind, _EXCHANGED]
            at += AT + counts[kind, _PLACES]
        integrated = BODY_STATES * sizes.bodies + own + turning + sizes.energies
        fits = at + sizes.touched == plan.size and own == sizes.own and works == sizes.works
        fits = fits and works + sizes.losses <= sizes.energies
        fits = fits and outputs == sizes.outputs and exchanged == sizes.exchanged
        return fits and integrated == sizes.integrated

    @kernel
    def rows_fit(numbers: Array, memory: Array, plan: Offsets, sizes: Sizes) -> bool:
        """Whether the parts of all elements follow each other in all arrays."""
        first_loss = sizes.integrated - sizes.energies + sizes.works
        first_bound = first_loss + sizes.losses
        state = BODY_STATES * sizes.bodies
        angle, work, kept = state + sizes.own, first_loss - sizes.works, sizes.integrated
        number, place, output, exchanged = _OIL, 0, 0, 0
        node = BODY_STATES * sizes.shown
        mode = node + BODY_STATES * sizes.nodes
        ground = BODY_STATES * (sizes.bodies - 1)  # where there is one
        at, fits = FIRST_ROW, True
        for i in range(sizes.elements):
            kind = plan[at + KIND]
            fits = fits and counts[kind, _CARRIES] == (1 if i < sizes.carriers else 0)
            fits = fits and plan[at + NUMBER] == number and plan[at + MEMORY] == place
            fits = fits and plan[at + OUTPUT] == output and plan[at + EXCHANGED] == exchanged
            fits = fits and plan[at + WHICH] in (LINEAR, CURVED)
            number += counts[kind, _FLOATS]
            place += plan[at + N_MEMORY]
            output += counts[kind, _OUTS]
            exchanged += counts[kind, _EXCHANGED]
            p = at + AT
            for j in range(counts[kind, _BODIES]):
                body = plan[p]
                fits = fits and body < BODY_STATES * sizes.bodies and body % BODY_STATES == 0
                fits = fits and (j == 0 or body != plan[p - 1])
                p += 1
            for _ in range(counts[kind, _STATES]):
                fits = fits and plan[p] == state
                state += 1
                p += 1
            for _ in range(counts[kind, _ANGLES]):
                fits = fits and plan[p] == angle
                angle += 1
                p += 1
            for _ in range(counts[kind, _WORKS]):
                fits = fits and plan[p] == work
                work += 1
                p += 1
            for _ in range(counts[kind, _LOSSES]):
                fits = fits and first_loss <= plan[p] < first_bound
                p += 1
            for _ in range(counts[kind, _BOUNDS]):
                fits = fits and first_bound <= plan[p] < sizes.integrated
                p += 1
            if counts[kind, _KEEPS] == 1:
                fits = fits and plan[p] == kept and plan[at + N_KEPT] > 0
                p += 1
            else:
                fits = fits and plan[at + N_KEPT] == 0
            for _ in range(counts[kind, _BESIDE]):
                fits = fits and (plan[p] == 0 or sizes.integrated <= plan[p] < sizes.kept)
                p += 1
            if counts[kind, _CARRIES] == 1:
                nodes, modes = BODY_STATES * plan[p], BODY_STATES * plan[p + 1]
                first = at + AT + counts[kind, _BODIES] - 2
                if first > at + AT:
                    fits = fits and plan[at + AT] < BODY_STATES * sizes.shown
                fits = fits and plan[first] == node
                fits = fits and plan[first + 1] == (mode if modes > 0 else ground)
                node += nodes
                mode += modes
            kept += plan[at + N_KEPT]
            at += AT + counts[kind, _PLACES]
        fits = fits and node == BODY_STATES * (sizes.shown + sizes.nodes)
        fits = (
            fits
            and sizes.exponential <= MOST_EXPONENTIAL
            and memory.size == place + 1 + room_size(sizes)
        )
        fits = fits and mode in (ground, ground + BODY_STATES)
        fits = fits and number == sizes.first_mobility
        fits = fits and numbers.size == number + N_COORDINATES * sizes.bodies
        return fits and kept == sizes.kept and sizes.states == kept + sizes.energies + 1

    @kernel
    def touches_fit(numbers: Array, plan: Offsets, sizes: Sizes) -> bool:
        """Whether those at the end, for exponential steps, are what curved elements act on."""
        at, free = plan.size - sizes.touched, 0
        for body in range(sizes.bodies):
            touched, row = False, FIRST_ROW
            for _ in range(sizes.elements):
                for j in range(counts[plan[row + KIND], _BODIES]):
                    here = plan[row + AT + j] == BODY_STATES * body
                    touched |= here and plan[row + WHICH] == CURVED
                row += AT + plan[row + N_PLACES]
            node = sizes.shown <= body < sizes.shown + sizes.nodes
            for i in range(N_COORDINATES):
                moves = numbers[sizes.first_mobility + N_COORDINATES * body + i] > 0.0
                free += 1 if moves else 0
                if sizes.exponential > 0 and touched and (moves or node):
                    if at >= plan.size or plan[at] != BODY_STATES * body + i:
                        return False
                    at += 1
        return at == plan.size and free == sizes.free

    @kernel
    def is_train(oil: LubricantState, numbers: Array, memory: Array, plan: Offsets) -> bool:
        if plan.size < FIRST_ROW:
            return False
        for i in range(plan.size):
            if not 0 <= plan[i] <= _MOST:
                return False
        sizes = sizes_of(plan)
        fits = 1 <= sizes.bodies <= _MOST_BODIES and sizes.elements <= plan.size
        fits = fits and 1 <= sizes.shown <= sizes.bodies - sizes.nodes
        fits = fits and totals_fit(plan, sizes) and rows_fit(numbers, memory, plan, sizes)
        if not (fits and all_finite(numbers, 0, numbers.size)):
            return False
        for i in range(sizes.first_mobility, numbers.size):
            fits = fits and numbers[i] >= 0.0
        fits = fits and touches_fit(numbers, plan, sizes)
        fits = fits and sizes.written == count_outputs(numbers, sizes)
        return fits and check(numbers, oil, numbers, memory, plan) > 0.0

    return is_train
