"""Room of exponential steps: where what they need stands in the memory of a train.

It follows from numbers and plan alone, but for the length of the step and the speeds: a state that
is loaded finds it again.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES
from gearlube_core.dynamics.train.plan import Sizes, places
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.jit import kernel

# head of the room: whether it is filled, the length of the step [s]
FILLED, STEP, N_HEAD = 0, 1, 8
# numbers of each mode for a step: exp(h L) and exp(h L / 2), row by row, then the last columns of
# what the force at the start and changes from it are multiplied by
(
    WHOLE, HALF, TO_HALF, OF_SECOND, TO_END, OF_THIRD, OF_BOTH, OF_LAST, N_COEFFICIENTS,
) = (0, 4, 8, 10, 12, 14, 16, 18, 20)  # fmt: skip
# vectors of all modes: displacement and speed at the start of a step and within it, force at its
# start and changes of the stages from it, constant ones, those of coupling dampers, one to
# work with
Z, V, Z_A, V_A, Z_B, V_B, FORCE, CONSTANT, COUPLED, ALSO, N_VECTORS = (
    0, 1, 2, 3, 4, 5, 6, 10, 11, 12, 13,
)  # fmt: skip
LINE = 8  # numbers that a processor reads at once: matrices and vectors begin at a multiple


class Places(NamedTuple):
    """Sizes of a train and places in the room; all whole numbers."""

    modes: int  # as many as free coordinates, rounded up to whole lines by modes that stay at 0
    free: int
    touched: int
    own: int  # states of elements, all of them
    first: int  # of them in the state
    energies: int
    first_energy: int
    losses: int
    first_loss: int
    carriers: int
    mobility: int  # among the numbers
    coordinates: int  # places of the free coordinates in the state
    shapes: int  # coordinate by coordinate
    inverse: int  # mode by mode
    touching: int  # shapes of the touched coordinates
    showing: int  # these mode by mode
    stiffness: int  # of elements without linear forces, over the touched coordinates
    related: int  # rates of own states over those of the touched coordinates, row by row
    straight: int  # rates of own states of linear elements over those of the free coordinates
    squares: int  # of the frequencies
    damping: int  # of each mode
    coupling: int  # all of damping but that, at standstill, turned
    turning: int  # that with gyroscopic moments, in half of the digits
    gyroscopic: int  # of each carrier, over its speed
    powers: int  # of each loss: P = B B^T, of so many columns as its rank
    losing: int  # how many losses linear elements have, then which, and their ranks
    coefficients: int
    vectors: int
    before: int  # touched coordinates at the start of an interval, then moves and forces
    own_room: int  # own states at the start, what they add to their relation, rates of four stages
    energy_room: int  # of the step
    lost: int  # by linear elements in the interval
    started: int  # free coordinates at the start of an interval
    slope: int
    trial: int
    solver: int
    end: int


@kernel
def whole_lines(count: int) -> int:
    """Return a count of numbers, rounded up to what fills lines of the processor's memory."""
    return -(-count // LINE) * LINE


@kernel
def places_of(sizes: Sizes) -> Places:
    """Return the places for a train."""
    n, f = whole_lines(sizes.free), sizes.touched
    first = BODY_STATES * sizes.bodies
    first_energy = sizes.integrated - sizes.energies
    own, square = first_energy - first, n * n
    shapes = N_HEAD + n
    touching = shapes + 2 * square
    showing = touching + f * n
    stiffness = showing + f * n
    related = stiffness + whole_lines(f * f)
    straight = related + whole_lines(own * f)
    squares = straight + own * n
    coupling = squares + 2 * n
    turning = coupling + square
    gyroscopic = turning + square // 2
    powers = gyroscopic + sizes.carriers * square
    losing = powers + sizes.losses * square
    coefficients = losing + whole_lines(1 + 2 * sizes.losses)
    vectors = coefficients + N_COEFFICIENTS * n
    before = vectors + N_VECTORS * n
    own_room = before + 3 * whole_lines(f)
    energy_room = own_room + 6 * own
    lost = energy_room + sizes.energies
    started = lost + sizes.losses
    slope = started + n
    trial = slope + sizes.integrated
    solver = whole_lines(trial + sizes.states)
    return Places(
        n,
        sizes.free,
        f,
        own,
        first,
        sizes.energies,
        first_energy,
        sizes.losses,
        first_energy + sizes.works,
        sizes.carriers,
        sizes.first_mobility,
        N_HEAD,
        shapes,
        shapes + square,
        touching,
        showing,
        stiffness,
        related,
        straight,
        squares,
        squares + n,
        coupling,
        turning,
        gyroscopic,
        powers,
        losing,
        coefficients,
        vectors,
        before,
        own_room,
        energy_room,
        lost,
        started,
        slope,
        trial,
        solver,
        solver + 2 * square,
    )


@kernel
def room_size(sizes: Sizes) -> int:
    """Return how many numbers stand behind the memory of the elements."""
    return places_of(sizes).end if sizes.exponential > 0 else 0


@kernel
def room_in(memory: Array, sizes: Sizes) -> Array:
    """Return the room, at the end of the memory."""
    size = room_size(sizes)
    return part(memory, memory.size - size, size)


@kernel
def touched_at(plan: Offsets, p: Places, i: int) -> int:
    """Return the place of a touched coordinate in the state."""
    return places(plan, plan.size - p.touched + i, 1)[0]  # type: ignore[no-any-return]


@kernel
def mobility_at(numbers: Array, p: Places, place: int) -> float:
    """Return acceleration over force of a coordinate at a place of the state."""
    return numbers[p.mobility + N_COORDINATES * (place // BODY_STATES) + place % BODY_STATES]


@kernel
def vector(room: Array, p: Places, which: int) -> Array:
    """Return a vector of all modes."""
    return part(room, p.vectors + which * p.modes, p.modes)


@kernel
def coefficient(room: Array, p: Places, which: int) -> Array:
    """Return a number of all modes."""
    return part(room, p.coefficients + which * p.modes, p.modes)


@kernel
def turning_in(room: Array, p: Places) -> Array:
    """Return the matrix of coupling dampers and gyroscopic moments, of single precision."""
    return part(room, p.turning, p.modes * p.modes // 2).view(np.float32)


@kernel
def short_vector(room: Array, p: Places) -> Array:
    """Return the last vector of all modes, for numbers of single precision."""
    return part(room, p.vectors + ALSO * p.modes, p.modes // 2).view(np.float32)
