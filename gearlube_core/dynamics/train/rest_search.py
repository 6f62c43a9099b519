"""Searches of a train that starts: speeds, loads and own states from the relations between bodies.

Kernels of every list. They share one work space, whose places `Room` has.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RATE, RZ, W
from gearlube_core.dynamics.train.plan import Sizes
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.damped_newton import newton_work_size
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.least_squares import least_squares, least_squares_work

OK = 0
# statuses of a start, beside those of a step, and the number that comes with each
LOOSE = 4  # speeds leave bodies free: how many
APART = 5  # speeds do not fit together: by how much [rad/s]
NO_REST = 6  # no static equilibrium: the largest force out of balance [N, N.m], then its place
NO_MODES = 7  # natural frequencies are not finite


_newton_size, _squares_size = kernel(newton_work_size), kernel(least_squares_work)
_SETTLED = 1e-6  # of the largest force that acts, or of a member, at rest
_SAME_SPEED = 1e-6  # of the largest speed
_SHARE = 0.1  # of an own state, a move that matters


class Room(NamedTuple):
    """Sizes of a train, and places in the work space behind the rates; all whole numbers."""

    bodies: int
    own: int
    coordinates: int  # of all bodies
    first: int  # own state
    first_mobility: int
    vector: int  # one number for each body and each own state
    before: int  # state to go back to
    moved: int  # state
    relations: int  # rates of own states over those of all coordinates, row by row
    related: int  # the same for the coordinates of the search
    places: int  # of the coordinates of the search in the state, and so on for each of them
    scales: int
    out: int  # forces [N, N.m]
    moves: int
    base: int  # where they began, then where own states did
    loads: int  # on own states [N, N.m], and so on, vectors
    guess: int  # of own states
    held: int
    right: int
    found: int
    wanted: int  # speeds [rad/s]
    turning: int  # bodies
    solver: int
    end: int


@kernel
def room_of(sizes: Sizes) -> Room:
    """Return the places for a train."""
    bodies, own = sizes.bodies, sizes.own
    m, q = N_COORDINATES * bodies, bodies + own
    before = sizes.integrated
    relations = before + 2 * sizes.states
    places = relations + 2 * own * m
    base = places + 4 * m
    loads = base + m + own
    solver = loads + 7 * q
    end = solver + max(_newton_size(m), max(2 * m * m, q * q + _squares_size(q)))
    return Room(
        bodies,
        own,
        m,
        BODY_STATES * bodies,
        sizes.first_mobility,
        q,
        before,
        before + sizes.states,
        relations,
        relations + own * m,
        places,
        places + m,
        places + 2 * m,
        places + 3 * m,
        base,
        loads,
        loads + q,
        loads + 2 * q,
        loads + 3 * q,
        loads + 4 * q,
        loads + 5 * q,
        loads + 6 * q,
        solver,
        end,
    )


@kernel
def rest_work_size(sizes: Sizes) -> int:
    """Return the length of `work` for the kernels of `rest_kernels`."""
    return room_of(sizes).end


@kernel
def copy(one: Array, other: Array) -> None:
    """Write the first numbers of one array into another one."""
    for i in range(other.size):
        other[i] = one[i]


@kernel
def _mobility(numbers: Array, place: int, room: Room) -> float:
    body, i = place // BODY_STATES, place % BODY_STATES
    return numbers[room.first_mobility + N_COORDINATES * body + i]


@kernel
def _column(place: float) -> int:
    """Return which of all coordinates stands at a place of the state."""
    return int(place) // BODY_STATES * N_COORDINATES + int(place) % BODY_STATES


@kernel
def turns(place: float) -> bool:
    """Return whether the angle about z of a body stands at a place of the state."""
    return int(place) % BODY_STATES == RZ


@kernel
def find_places(numbers: Array, balanced: bool, room: Room, work: Array) -> int:
    """Write the places of the free coordinates and what relates them; return how many there are.

    Where torques are to be balanced, rotations of bodies that bear them are left out.
    """
    m = 0
    for body in range(room.bodies):
        bears = balanced and not math.isnan(work[room.wanted + body])
        for i in range(N_COORDINATES):
            place = BODY_STATES * body + i
            if _mobility(numbers, place, room) > 0.0 and not (bears and i == RZ):
                work[room.places + m] = place
                m += 1
    for i in range(m):
        column = _column(work[room.places + i])
        for k in range(room.own):
            one = work[room.relations + k * room.coordinates + column]
            work[room.related + k * m + i] = one
    return m


@kernel
def relate_turning(count: int, room: Room, work: Array) -> None:
    """Write the rates of own states over the speeds of the bodies that turn, row by row.

    Rows are scaled, so that base radii and ones compare. They have nothing on their right.
    """
    relations = part(work, room.relations, room.own * room.coordinates)
    turning, right = part(work, room.turning, room.vector), part(work, room.right, room.vector)
    matrix = part(work, room.solver, room.vector * room.vector)
    for k in range(room.own):
        right[k], most = 0.0, 0.0
        for j in range(count):
            one = relations[k * room.coordinates + int(turning[j]) * N_COORDINATES + RZ]
            matrix[k * count + j] = one
            most = max(most, abs(one))
        for j in range(count):
            matrix[k * count + j] /= most if most > 0.0 else 1.0


@kernel
def find_speeds(s: Array, numbers: Array, room: Room, work: Array) -> tuple[int, float, int]:
    """Write the speeds at which no own state changes.

    Returns
    -------
    tuple of (int, float, int)
        A status and its number; in how many ways bodies can turn without a change of own states.
    """
    bodies, own, q = room.bodies, room.own, room.vector
    relations = part(work, room.relations, own * room.coordinates)
    wanted, turning = part(work, room.wanted, q), part(work, room.turning, q)
    right, found = part(work, room.right, q), part(work, room.found, q)
    matrix = part(work, room.solver, q * q)
    count = 0
    for body in range(bodies):
        if _mobility(numbers, BODY_STATES * body + RZ, room) > 0.0:
            turning[count] = body
            count += 1
    solver = part(work, room.solver + q * q, count * count)
    relate_turning(count, room, work)
    turnings = least_squares(matrix, own, count, right, found, solver)
    relate_turning(count, room, work)
    rows, largest = own, 1.0
    for body in range(bodies):
        if not math.isnan(wanted[body]):
            largest = max(largest, abs(wanted[body]))
            right[rows] = wanted[body]
            for j in range(count):
                matrix[rows * count + j] = 1.0 if int(turning[j]) == body else 0.0
            rows += 1
    free = least_squares(matrix, rows, count, right, found, solver)
    if free > 0:
        return LOOSE, float(free), turnings
    for j in range(count):
        s[BODY_STATES * int(turning[j]) + W] = found[j]
    apart = 0.0
    for body in range(bodies):
        if not math.isnan(wanted[body]):
            apart = max(apart, abs(s[BODY_STATES * body + W] - wanted[body]))
    for k in range(own):
        total = most = 0.0
        for body in range(bodies):
            one = relations[k * room.coordinates + body * N_COORDINATES + RZ]
            total += one * s[BODY_STATES * body + W]
            most = max(most, abs(one))
        apart = max(apart, abs(total) / most if most > 0.0 else 0.0)
    return OK if apart <= _SAME_SPEED * largest else APART, apart, turnings


@kernel
def find_bearing(numbers: Array, bearing: int, turnings: int, room: Room, work: Array) -> None:
    """Leave numbers only in the wanted speeds of bodies that bear what torques leave.

    They are as many as bodies can turn independently, `bearing` the first; none where nothing turns
    freely, as on a shaft locked at one end: torques balance there by themselves. `find_speeds` has
    been before.
    """
    bodies, own, q = room.bodies, room.own, room.vector
    wanted, turning = part(work, room.wanted, q), part(work, room.turning, q)
    right, found, bears = (
        part(work, room.right, q),
        part(work, room.found, q),
        part(work, room.guess, q),
    )
    count = 0
    for body in range(bodies):
        bears[body] = 1.0 if body == bearing and turnings == 1 else 0.0
        count += 1 if _mobility(numbers, BODY_STATES * body + RZ, room) > 0.0 else 0
    matrix, solver = part(work, room.solver, q * q), part(work, room.solver + q * q, count * count)
    left = turnings if turnings > 1 else 0
    for i in range(bodies + 1):
        one = bearing if i == 0 else i - 1
        if left == 0 or bears[one] > 0.0 or (i > 0 and math.isnan(wanted[one])):
            continue
        bears[one], rows = 1.0, own
        relate_turning(count, room, work)
        for body in range(bodies):
            if bears[body] > 0.0:
                right[rows] = 0.0
                for j in range(count):
                    matrix[rows * count + j] = 1.0 if int(turning[j]) == body else 0.0
                rows += 1
        free = least_squares(matrix, rows, count, right, found, solver)
        if free == left:  # its speed follows from the others
            bears[one] = 0.0
        left = free
    for body in range(bodies):
        wanted[body] = 0.0 if bears[body] > 0.0 else math.nan


@kernel
def find_loads(numbers: Array, m: int, room: Room, work: Array) -> float:
    """Write the loads on own states that balance the torques in the rates.

    Return the largest force among the rates [N, N.m], at least 1.
    """
    largest = 1.0
    own, q = room.own, room.vector
    right, matrix = part(work, room.right, q), part(work, room.solver, q * q)
    count = 0
    for i in range(m):
        place = int(work[room.places + i])
        force = work[place + RATE] / _mobility(numbers, place, room)
        largest = max(largest, abs(force))
        if turns(place):
            right[count] = force
            for k in range(own):
                matrix[count * own + k] = work[room.related + k * m + i]
            count += 1
    solver = part(work, room.solver + q * q, own * own)
    least_squares(matrix, count, own, right, part(work, room.loads, q), solver)
    return largest


@kernel
def find_own(s: Array, m: int, room: Room, work: Array) -> None:
    """Write the own states nearest to the guess that turns of the bodies can give."""
    own, q = room.own, room.vector
    related, places = part(work, room.related, own * m), part(work, room.places, m)
    found, matrix = part(work, room.found, q), part(work, room.solver, q * q)
    count = 0
    for i in range(m):
        count += 1 if turns(places[i]) else 0
    j = 0
    for i in range(m):
        if turns(places[i]):
            for k in range(own):
                matrix[k * count + j] = related[k * m + i]
            j += 1
    solver = part(work, room.solver + q * q, count * count)
    least_squares(matrix, own, count, part(work, room.guess, q), found, solver)
    for k in range(own):
        s[room.first + k], j = 0.0, 0
        for i in range(m):
            if turns(places[i]):
                s[room.first + k] += related[k * m + i] * found[j]
                j += 1


@kernel
def find_scales(m: int, no_load: float, room: Room, work: Array) -> None:
    """Write what move of each coordinate matters: a share of what moves the own states.

    Members without load, such as the shaft of a wheel that turns freely, count as if they had moved
    by `no_load` [m, rad].
    """
    scales, guess = part(work, room.scales, m), part(work, room.guess, room.own)
    least = _SHARE * no_load
    others = least if room.own == 0 else math.inf
    for k in range(room.own):
        others = min(others, _SHARE * abs(guess[k]))
    for i in range(m):
        scales[i] = math.inf
        for k in range(room.own):
            gain = abs(work[room.related + k * m + i])
            if gain > 0.0:
                scales[i] = min(scales[i], _SHARE * abs(guess[k]) / gain)
        if not scales[i] < math.inf:
            scales[i] = others
        scales[i] = max(scales[i], least)


@kernel
def largest_force(m: int, size: float, room: Room, work: Array) -> tuple[int, float, int]:
    """Return a status, the largest force out of balance and its place.

    `size` is that of the forces which have to be balanced [N, N.m].
    """
    worst, where = 0.0, 0
    for i in range(m):
        one = abs(work[room.out + i])
        if worst < math.inf and not one <= worst:
            worst, where = one, int(work[room.places + i])
    for k in range(room.own):
        size = max(size, abs(work[room.loads + k]))
    return OK if worst <= _SETTLED * size else NO_REST, worst, where


@kernel
def displace(u: Array, s: Array, room: Room, work: Array) -> None:
    """Move the coordinates of the search, and own states with them."""
    m = u.size
    for i in range(m):
        s[int(work[room.places + i])] = work[room.base + i] + u[i]
    for k in range(room.own):
        found = work[room.base + m + k]
        for i in range(m):
            found += work[room.related + k * m + i] * u[i]
        s[room.first + k] = found
    for body in range(room.bodies):  # angles move own states alone: periodic data stay
        s[BODY_STATES * body + RZ] = 0.0


@kernel
def begin_search(s: Array, m: int, room: Room, work: Array) -> None:
    """Write where a search in `m` coordinates begins."""
    for i in range(m):
        work[room.moves + i] = 0.0
        work[room.base + i] = s[int(work[room.places + i])]
    for k in range(room.own):
        work[room.base + m + k] = s[room.first + k]


@kernel
def swap_own(s: Array, put: int, into: int, room: Room, work: Array) -> None:
    """Put a vector of the work space into the own states, and these into another one."""
    for k in range(room.own):
        before = s[room.first + k]
        s[room.first + k] = work[put + k]
        work[into + k] = before
