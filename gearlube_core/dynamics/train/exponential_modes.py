"""Linear part of a train for exponential steps: its modes with all contacts, dampers, losses.

    q'' + D q' + w^2 q = forces of elements that are not linear, less their mean stiffness

It follows from the numbers of the train alone, so that a state needs nothing of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.train.drivers import AllElements
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RATE, RZ, W
from gearlube_core.dynamics.train.exponential_room import (
    FILLED,
    STEP,
    Places,
    mobility_at,
    places_of,
    room_in,
    touched_at,
)
from gearlube_core.dynamics.train.plan import AT, CURVED, FIRST_ROW, LINEAR, N_PLACES, Sizes
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.dense_rows import add_times, congruent, semidefinite_root, times
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.symmetric_modes import symmetric_modes
from gearlube_core.oil.lubricant_state import LubricantState

Given = tuple[LubricantState, Array, Array, Offsets]  # oil, numbers, memory, plan of a train
_MOVE = 1e-6  # m and rad, of coordinates on which forces depend linearly
_DIFFERENCE = 1e-8  # of the others
_PHASES = 61  # of the meshes, over which their stiffness is a mean: a prime number


def modes_kernel(
    elements: AllElements, renew: Callable[..., None], sums: Callable[..., None]
) -> Callable[..., None]:
    """Return the kernel that fills the room of exponential steps, see `Places`.

    `sums` sets the forces of elements of a list that are linear, or are not, into rates.
    """
    sizes_of, spread, collect = elements.sizes_of, elements.spread, elements.collect
    at_rest, full_contact, ease = elements.at_rest, elements.full_contact, elements.ease

    @kernel
    def stop(trial: Array) -> None:
        for i in range(trial.size):
            trial[i] = 0.0

    @kernel
    def forces_on_all(trial: Array, given: Given, slope: Array) -> None:
        oil, numbers, memory, plan = given
        spread(trial, oil, numbers, memory, plan)
        sums(trial, oil, numbers, memory, plan, 0, LINEAR, slope)
        collect(trial, oil, numbers, memory, plan, slope)

    @kernel
    def write_places(numbers: Array, sizes: Sizes, p: Places, room: Array) -> None:
        count = 0
        for body in range(sizes.bodies):
            for i in range(N_COORDINATES):
                place = BODY_STATES * body + i
                if mobility_at(numbers, p, place) > 0.0:
                    room[p.coordinates + count] = place
                    count += 1

    @kernel
    def write_linear(given: Given, p: Places, room: Array) -> None:
        """Write touched shapes, stiffness, dampers, gyroscopic moments, losses of coordinates."""
        oil, numbers, memory, plan = given
        n, trial, slope = p.modes, part(room, p.trial, p.solver - p.trial), room_slope(room, p)
        stop(trial)
        for j in range(p.free):
            place = int(room[p.coordinates + j])
            root = math.sqrt(mobility_at(numbers, p, place))
            trial[place] = 1.0
            spread(trial, oil, numbers, memory, plan)
            for k in range(p.touched):
                room[p.touching + k * n + j] = trial[touched_at(plan, p, k)]
            trial[place] = 0.0
            trial[place + RATE] = 1.0
            forces_on_all(trial, given, slope)
            for k in range(p.own):
                room[p.straight + k * n + j] = slope[p.first + k]
            for k in range(p.losses):
                room[p.powers + (k * n + j) * n + j] = slope[p.first_loss + k]
            add_column(numbers, p, room, slope, p.coupling, j, -root)
            trial[place + RATE] = 0.0
            for side in range(2):
                step = _MOVE * (1.0 - 2.0 * side)
                trial[place] = step
                for k in range(p.own):
                    trial[p.first + k] = step * room[p.straight + k * n + j]
                forces_on_all(trial, given, slope)
                add_column(numbers, p, room, slope, p.solver, j, -0.5 * root / step)
            stop(trial)
        write_turning(given, p, room)
        write_powers(given, p, room)

    @kernel
    def write_turning(given: Given, p: Places, room: Array) -> None:
        _, numbers, _, plan = given
        n, trial, slope = p.modes, part(room, p.trial, p.solver - p.trial), room_slope(room, p)
        at = FIRST_ROW
        for carrier in range(p.carriers):
            turning = int(plan[at + AT]) + W
            matrix = p.gyroscopic + carrier * n * n
            for j in range(p.free):
                place = int(room[p.coordinates + j])
                root = math.sqrt(mobility_at(numbers, p, place))
                if place % BODY_STATES == RZ:
                    continue  # forces of its own speed are no gyroscopic ones
                trial[place + RATE] = trial[turning] = 1.0
                forces_on_all(trial, given, slope)
                add_column(numbers, p, room, slope, matrix, j, -root)
                trial[turning] = 0.0
                forces_on_all(trial, given, slope)
                add_column(numbers, p, room, slope, matrix, j, root)
                trial[place + RATE], trial[turning] = 0.0, 1.0
                forces_on_all(trial, given, slope)
                add_column(numbers, p, room, slope, matrix, j, root)
                trial[turning] = 0.0
            stop(trial)
            at += AT + int(plan[at + N_PLACES])

    @kernel
    def write_powers(given: Given, p: Places, room: Array) -> None:
        """Write what each two rates lose together, of losses that grow with their square."""
        _, numbers, _, _ = given
        n, trial, slope = p.modes, part(room, p.trial, p.solver - p.trial), room_slope(room, p)
        for k in range(p.losses):
            most = 0.0
            for i in range(n):
                most = max(most, abs(room[p.powers + (k * n + i) * n + i]))
            if most > 0.0:
                room[p.losing + 1 + 2 * int(room[p.losing])] = k
                room[p.losing] += 1.0
        for i in range(p.free):
            trial[int(room[p.coordinates + i]) + RATE] = 1.0
            for j in range(i):
                trial[int(room[p.coordinates + j]) + RATE] = 1.0
                forces_on_all(trial, given, slope)
                trial[int(room[p.coordinates + j]) + RATE] = 0.0
                for k in range(p.losses):
                    m = p.powers + k * n * n
                    alone = room[m + i * n + i] + room[m + j * n + j]
                    room[m + i * n + j] = 0.5 * (slope[p.first_loss + k] - alone)
                    room[m + j * n + i] = room[m + i * n + j]
            trial[int(room[p.coordinates + i]) + RATE] = 0.0
        for i in range(p.free):
            root = math.sqrt(mobility_at(numbers, p, int(room[p.coordinates + i])))
            for k in range(p.losses):
                m = p.powers + k * n * n
                for j in range(n):
                    room[m + i * n + j] *= root
                    room[m + j * n + i] *= root

    @kernel
    def write_contacts(given: Given, p: Places, room: Array) -> None:
        """Write the mean stiffness of elements that are not linear, with all contacts."""
        oil, numbers, memory, plan = given
        f = p.touched
        trial, slope = part(room, p.trial, p.solver - p.trial), room_slope(room, p)
        stop(trial)
        at_rest(trial, oil, numbers, memory, plan)
        full_contact(trial, oil, numbers, memory, plan)
        renew(trial, oil, numbers, memory, plan)
        for j in range(f):
            rate = touched_at(plan, p, j) + RATE
            trial[rate] = 1.0
            sums(trial, oil, numbers, memory, plan, 0, CURVED, slope)
            for k in range(p.own):
                room[p.related + k * f + j] = slope[p.first + k]
            trial[rate] = 0.0
        sums(trial, oil, numbers, memory, plan, 0, CURVED, slope)
        for j in range(f):  # less what does not follow from motion, such as a lag
            for k in range(p.own):
                room[p.related + k * f + j] -= slope[p.first + k]
        ease(trial, oil, numbers, memory, plan, 1.0)
        for phase in range(_PHASES):
            for j in range(f):
                place = touched_at(plan, p, j)
                if place % BODY_STATES == RZ:
                    trial[place] = 2.0 * math.pi / _PHASES * ((j + 1) * phase % _PHASES)
            for j in range(f):
                place = touched_at(plan, p, j)
                for side in range(2):
                    step = _DIFFERENCE * (1.0 - 2.0 * side)
                    move(trial, p, room, place, j, step)
                    sums(trial, oil, numbers, memory, plan, 0, CURVED, slope)
                    move(trial, p, room, place, j, -step)
                    for i in range(f):
                        one = slope[touched_at(plan, p, i) + RATE] / (4.0 * step * _PHASES)
                        room[p.stiffness + i * f + j] -= one
                        room[p.stiffness + j * f + i] -= one
        ease(trial, oil, numbers, memory, plan, 0.0)

    @kernel
    def move(trial: Array, p: Places, room: Array, place: int, j: int, step: float) -> None:
        """Move a touched coordinate and own states with it; the phase of a mesh stays."""
        if place % BODY_STATES != RZ:
            trial[place] += step
        for k in range(p.own):
            trial[p.first + k] += step * room[p.related + k * p.touched + j]

    @kernel
    def find_modes(numbers: Array, p: Places, room: Array) -> None:
        """Turn stiffness and shapes of coordinates into those of modes."""
        n, f = p.modes, p.touched
        matrix, scratch = part(room, p.solver, n * n), part(room, p.solver + n * n, n * n)
        touching, vectors = part(room, p.touching, f * n), part(room, p.inverse, n * n)
        for j in range(p.free):
            root = math.sqrt(mobility_at(numbers, p, int(room[p.coordinates + j])))
            for k in range(f):
                touching[k * n + j] *= root
        row = part(scratch, 0, n)
        for k in range(f):
            for b in range(n):
                row[b] = 0.0
            add_times(touching, part(room, p.stiffness + k * f, f), row)
            for a in range(n):
                gain = touching[k * n + a]
                for b in range(n):
                    matrix[a * n + b] += gain * row[b]
        for a in range(n):
            for b in range(a):
                mean = 0.5 * (matrix[a * n + b] + matrix[b * n + a])
                matrix[a * n + b] = matrix[b * n + a] = mean
        symmetric_modes(matrix, n, vectors)
        for k in range(n):
            room[p.squares + k] = matrix[k * n + k]
        congruent(part(room, p.coupling, n * n), vectors, n, scratch)
        for k in range(n):
            room[p.damping + k] = room[p.coupling + k * n + k]
            room[p.coupling + k * n + k] = 0.0
        for k in range(p.carriers):
            congruent(part(room, p.gyroscopic + k * n * n, n * n), vectors, n, scratch)
        count = int(room[p.losing])
        for k in range(count):
            at = p.losing + 1 + 2 * k
            powers = part(room, p.powers + int(room[at]) * n * n, n * n)
            congruent(powers, vectors, n, scratch)
            room[at + 1] = semidefinite_root(powers, n, scratch)
        for k in range(count - 1):  # that of the highest rank last: it is what the others leave
            at, last = p.losing + 1 + 2 * k, p.losing + 2 * count - 1
            if room[at + 1] > room[last + 1]:
                room[at], room[last] = room[last], room[at]
                room[at + 1], room[last + 1] = room[last + 1], room[at + 1]
        for k in range(f):
            times(vectors, n, part(touching, k * n, n), row)
            for a in range(n):
                touching[k * n + a] = room[p.showing + a * f + k] = row[a]
        for j in range(p.free):
            root = math.sqrt(mobility_at(numbers, p, int(room[p.coordinates + j])))
            for k in range(n):
                room[p.shapes + j * n + k] = root * vectors[k * n + j]
                vectors[k * n + j] /= root

    @kernel
    def fill(oil: LubricantState, numbers: Array, memory: Array, plan: Offsets) -> None:
        sizes = sizes_of(plan)
        p, room = places_of(sizes), room_in(memory, sizes)
        for i in range(room.size):
            room[i] = 0.0
        write_places(numbers, sizes, p, room)
        given = oil, numbers, memory, plan
        write_linear(given, p, room)
        write_contacts(given, p, room)
        find_modes(numbers, p, room)
        room[FILLED], room[STEP] = 1.0, 0.0

    return fill


@kernel
def room_slope(room: Array, p: Places) -> Array:
    """Return the rates of the train in the room."""
    return part(room, p.slope, p.trial - p.slope)


@kernel
def add_column(
    numbers: Array, p: Places, room: Array, slope: Array, matrix: int, j: int, gain: float
) -> None:
    """Add forces in `slope`, in coordinates of mass 1, to row j of a turned matrix in the room."""
    for i in range(p.free):
        place = int(room[p.coordinates + i])
        root = math.sqrt(mobility_at(numbers, p, place))
        room[matrix + j * p.modes + i] += gain * root * slope[place + RATE]
