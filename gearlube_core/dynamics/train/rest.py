"""Start of a train: speeds of all bodies, static equilibrium, and the steps that its modes ask for.

Kernels for a list, so that Python and native code start alike. They neither allocate nor raise.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.train.drivers import AllElements
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RATE
from gearlube_core.dynamics.train.rest_search import (
    NO_MODES,
    NO_REST,
    OK,
    Room,
    begin_search,
    copy,
    displace,
    find_bearing,
    find_loads,
    find_own,
    find_places,
    find_scales,
    find_speeds,
    largest_force,
    room_of,
    swap_own,
    turns,
)
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.damped_newton import damped_newton
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.spectral_radius import spectral_radius
from gearlube_core.oil.lubricant_state import LubricantState

# state, oil, numbers, memory and plan of a train, places in the work space, and that
Given = tuple[Array, LubricantState, Array, Array, Offsets, Room, Array]

LEAST_RATE = 1e3  # integrator steps a second, of a train without a mode that vibrates
_DIFFERENCE = 1e-8  # m and rad, of coordinates in a linearisation
_EASINGS = 9  # of gaps: a bearing that carries 1 mN is found at the edge of its clearance
# m and rad, a move without load: of the first search, and of one that follows tiny loads
_NO_LOAD = (1e-6, 1e-9)
_PASSES = 4  # friction of films depends on the loads, weakly


def rest_kernels(
    elements: AllElements,
    renew: Callable[..., None],
    rates: Callable[..., None],
    forces: Callable[..., None],
) -> tuple[Callable[..., int], Callable[..., int]]:
    """Return the kernels of START and STIFFNESS of a list, see `train_kernel`."""
    sizes_of, spread, expand = elements.sizes_of, elements.spread, elements.expand
    at_rest, full_contact = elements.at_rest, elements.full_contact
    ease = elements.ease

    @kernel
    def relate(given: Given) -> None:
        """Write the relations of the state `s`, and stop it."""
        s, oil, numbers, memory, plan, room, work = given
        slope = part(work, 0, room.before)
        for body in range(room.bodies):
            for i in range(N_COORDINATES):
                s[BODY_STATES * body + RATE + i] = 0.0
        renew(s, oil, numbers, memory, plan)
        for j in range(room.coordinates):
            at = BODY_STATES * (j // N_COORDINATES) + RATE + j % N_COORDINATES
            s[at] = 1.0
            rates(s, oil, numbers, memory, plan, 0, slope)
            s[at] = 0.0
            for k in range(room.own):
                work[room.relations + k * room.coordinates + j] = slope[room.first + k]

    @kernel
    def keep(given: Given) -> None:
        """Write what elements keep under the loads, and about what own states then are."""
        s, oil, numbers, memory, plan, room, work = given
        swap_own(s, room.loads, room.held, room, work)
        at_rest(s, oil, numbers, memory, plan)
        swap_own(s, room.held, room.guess, room, work)

    @kernel
    def leave_out_gaps(given: Given) -> None:
        """Take the smaller guess of both senses of the loads: one of them passes a backlash.

        What is left is the move under load alone. Differences over a share of the backlash would
        lose the contact of lightly loaded flanks.
        """
        room, work = given[5], given[6]
        for k in range(room.own):
            work[room.right + k] = abs(work[room.guess + k])
            work[room.loads + k] *= -1.0
        keep(given)
        for k in range(room.own):
            work[room.guess + k] = min(work[room.right + k], abs(work[room.guess + k]))
            work[room.loads + k] *= -1.0

    @kernel
    def unbalanced(u: Array, given: Given, out: Array) -> None:
        s, oil, numbers, memory, plan, room, work = given
        displace(u, s, room, work)
        spread(s, oil, numbers, memory, plan)
        expand(s, oil, numbers, memory, plan)
        forces(s, oil, numbers, memory, plan, 0, work)
        for i in range(u.size):
            out[i] = work[int(work[room.places + i]) + RATE]

    newton = damped_newton(unbalanced)

    @kernel
    def search(given: Given, m: int) -> None:
        """Search the static equilibrium in `m` coordinates, through gaps that close by and by."""
        s, oil, numbers, memory, plan, room, work = given
        moves, scales = part(work, room.moves, m), part(work, room.scales, m)
        easings = _EASINGS if ease(s, oil, numbers, memory, plan, 0.0) > 0.0 else 0
        for k in range(easings + _PASSES):
            share = 0.1**k if k < easings else 0.0
            ease(s, oil, numbers, memory, plan, share)
            keep(given)
            renew(s, oil, numbers, memory, plan)
            begin_search(s, m, room, work)
            newton(moves, scales, given, part(work, room.solver, room.end - room.solver))
            unbalanced(moves, given, part(work, room.out, m))

    @kernel
    def find_rest(given: Given, bearing: int) -> tuple[int, float, int]:
        """Write the static equilibrium; return a status, its number and its place."""
        s, oil, numbers, memory, plan, room, work = given
        sizes = sizes_of(plan)
        for i in range(sizes.integrated):
            s[i] = 0.0
        for i in range(sizes.kept, sizes.states):
            s[i] = 0.0
        for k in range(room.own):
            work[room.loads + k] = 0.0
        keep(given)
        relate(given)
        status, number, turnings = find_speeds(s, numbers, room, work)
        if status != OK:
            return status, number, 0
        find_bearing(numbers, bearing, turnings, room, work)
        m = find_places(numbers, True, room, work)
        keep(given)
        renew(s, oil, numbers, memory, plan)
        rates(s, oil, numbers, memory, plan, 0, part(work, 0, room.before))
        size = find_loads(numbers, m, room, work)
        number, where = math.inf, 0
        for no_load in _NO_LOAD:
            for i in range(m):
                s[int(work[room.places + i])] = 0.0
            keep(given)
            find_own(s, m, room, work)
            leave_out_gaps(given)
            find_scales(m, no_load, room, work)
            search(given, m)
            status, number, where = largest_force(m, size, room, work)
            if status == OK:
                break
        return status, number, where

    @kernel
    def stiffness(given: Given) -> int:
        """Write M^-1 K of the free coordinates into the solver's room; return their number."""
        s, oil, numbers, memory, plan, room, work = given
        n_state = room.moved - room.before
        slope, moved = part(work, 0, room.before), part(work, room.moved, n_state)
        copy(s, moved)
        relate((moved, oil, numbers, memory, plan, room, work))
        m = find_places(numbers, False, room, work)
        matrix = part(work, room.solver, m * m)
        copy(s, moved)
        renew(moved, oil, numbers, memory, plan)
        for body in range(room.bodies):
            for i in range(N_COORDINATES - 1):
                moved[BODY_STATES * body + RATE + i] = 0.0
        for j in range(m):
            place = int(work[room.places + j])
            for i in range(m):
                matrix[i * m + j] = 0.0
            for side in range(2):
                step = _DIFFERENCE * (1.0 - 2.0 * side)
                if not turns(place):  # periodic data stay where they are
                    moved[place] = s[place] + step
                for k in range(room.own):
                    gain = work[room.related + k * m + j]
                    moved[room.first + k] = s[room.first + k] + step * gain
                rates(moved, oil, numbers, memory, plan, 0, slope)
                for i in range(m):
                    matrix[i * m + j] -= slope[int(work[room.places + i]) + RATE] / (2.0 * step)
            moved[place] = s[place]
        return m

    @kernel
    def start(
        s: Array,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        per_period: float,
        work: Array,
    ) -> int:
        room, bearing = room_of(sizes_of(plan)), int(work[0])
        for body in range(room.bodies):
            work[room.wanted + body] = work[1 + body]
        before = part(work, room.before, room.moved - room.before)
        copy(s, before)
        given = (s, oil, numbers, memory, plan, room, work)
        status, number, where = find_rest(given, bearing)
        if status == NO_REST:  # the stiffness at no displacement shows why
            for i in range(room.first + room.own):
                s[i] = 0.0
        if status in (OK, NO_REST):
            for k in range(room.own):
                work[room.held + k] = s[room.first + k]
            full_contact(s, oil, numbers, memory, plan)
            ease(s, oil, numbers, memory, plan, 1.0)
            m = stiffness(given)
            ease(s, oil, numbers, memory, plan, 0.0)
            for k in range(room.own):
                s[room.first + k] = work[room.held + k]
            work[0] = m
        if status == OK:
            matrix = part(work, room.solver, m * m)
            square = spectral_radius(matrix, m, part(work, room.solver + m * m, m * m))
            highest = math.sqrt(square) / (2.0 * math.pi)
            work[0] = max(LEAST_RATE, per_period * highest)
            if highest < math.inf:
                return OK
            status = NO_MODES
        copy(before, s)
        work[1], work[2] = number, where
        return status

    @kernel
    def write_stiffness(
        s: Array, oil: LubricantState, numbers: Array, memory: Array, plan: Offsets, work: Array
    ) -> int:
        room = room_of(sizes_of(plan))
        m = stiffness((s, oil, numbers, memory, plan, room, work))
        for i in range(m * m):
            work[i] = work[room.solver + i]
        return m

    return start, write_stiffness
