"""Exponential Runge-Kutta steps of a train: its linear part exactly, by modes.

Steps are ETDRK4-B of [krogstad_2005]: half the error of those of [cox_matthews_2002].

State between two intervals is that of any train. Within one the modes move: displacements count
from its start, so that angles that turn on cost no digits.
"""

from __future__ import annotations

from collections.abc import Callable

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.train.drivers import AllElements
from gearlube_core.dynamics.train.element import RATE, W
from gearlube_core.dynamics.train.exponential_room import (
    ALSO,
    CONSTANT,
    COUPLED,
    FILLED,
    FORCE,
    HALF,
    OF_BOTH,
    OF_LAST,
    OF_SECOND,
    OF_THIRD,
    STEP,
    TO_END,
    TO_HALF,
    WHOLE,
    Z_A,
    Z_B,
    Places,
    V,
    Z,
    coefficient,
    places_of,
    room_in,
    short_vector,
    touched_at,
    turning_in,
    vector,
)
from gearlube_core.dynamics.train.plan import AT, CURVED, FIRST_ROW, LINEAR, N_PLACES
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.dense_rows import (
    add_products,
    add_scaled,
    add_times,
    add_times_both,
    dot,
    times,
)
from gearlube_core.kernels.exponential_step import phi_functions
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState


@kernel
def write_coefficients(h: float, p: Places, room: Array) -> None:
    """Write the numbers of a step of `h` [s]."""
    n, c = p.modes, part(room, p.coefficients, p.vectors - p.coefficients)
    for k in range(n):
        square, damping = room[p.squares + k], room[p.damping + k]
        half, to_half, of_half, _ = phi_functions(square, damping, 0.5 * h)
        whole, one, two, three = phi_functions(square, damping, h)
        for i in range(4):
            c[(WHOLE + i) * n + k], c[(HALF + i) * n + k] = whole[i], half[i]
        for i in range(2):
            j = 2 * i + 1
            c[(TO_HALF + i) * n + k] = 0.5 * h * to_half[j]
            c[(OF_SECOND + i) * n + k] = h * of_half[j]
            c[(TO_END + i) * n + k] = h * one[j]
            c[(OF_THIRD + i) * n + k] = 2.0 * h * two[j]
            c[(OF_BOTH + i) * n + k] = h * (2.0 * two[j] - 4.0 * three[j])
            c[(OF_LAST + i) * n + k] = h * (4.0 * three[j] - two[j])
    room[STEP] = h


@kernel
def move_freely(p: Places, room: Array, linear: int, gain: int, end: int) -> None:
    """Write displacement and speed of the modes under the force at the start of a step."""
    for i in range(2):
        out = vector(room, p, end + i)
        for k in range(p.modes):
            out[k] = 0.0
        add_products(coefficient(room, p, linear + 2 * i), vector(room, p, Z), out)
        add_products(coefficient(room, p, linear + 2 * i + 1), vector(room, p, V), out)
        add_products(coefficient(room, p, gain + i), vector(room, p, FORCE), out)


@kernel
def add_change(p: Places, room: Array, gain: int, stage: int, start: int, end: int) -> None:
    """Write displacement and speed as at `start` and what the change of a force adds."""
    for i in range(2):
        begun, out = vector(room, p, start + i), vector(room, p, end + i)
        for k in range(p.modes):
            out[k] = begun[k]
        add_products(coefficient(room, p, gain + i), vector(room, p, FORCE + stage), out)


def exponential_kernel(
    elements: AllElements,
    fill: Callable[..., None],
    sums: Callable[..., None],
    is_wild: Callable[..., bool],
) -> Callable[..., int]:
    """Return the kernel that steps a train until one step has to be made in parts.

    `fill` is that of `modes_kernel`, with the same `sums`. Steps end where a state `is_wild`.
    """
    sizes_of, spread, collect = elements.sizes_of, elements.spread, elements.collect
    each_step, time_to_jump = elements.each_step, elements.time_to_jump
    after_part, after_step, begin = elements.after_part, elements.after_step, elements.begin

    @kernel
    def loads_of(
        s: Array,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        p: Places,
        room: Array,
    ) -> Array:
        """Return the forces of linear elements on the modes."""
        slope, loads = part(room, p.slope, p.trial - p.slope), vector(room, p, COUPLED)
        forces = vector(room, p, ALSO)
        sums(s, oil, numbers, memory, plan, 0, LINEAR, slope)
        collect(s, oil, numbers, memory, plan, slope)
        for i in range(p.modes):
            loads[i] = forces[i] = 0.0
        for i in range(p.free):
            forces[i] = slope[int(room[p.coordinates + i]) + RATE]
        add_times(part(room, p.shapes, p.modes * p.modes), forces, loads)
        return loads

    @kernel
    def begin_interval(
        s: Array,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        p: Places,
        room: Array,
    ) -> None:
        spread(s, oil, numbers, memory, plan)
        n = p.modes
        z, v, constant = vector(room, p, Z), vector(room, p, V), vector(room, p, CONSTANT)
        coupling, still, at = part(room, p.solver, n * n), part(room, p.coupling, n * n), FIRST_ROW
        for i in range(n * n):
            coupling[i] = still[i]
        for carrier in range(p.carriers):
            turning = s[int(plan[at + AT]) + W]
            add_scaled(turning, part(room, p.gyroscopic + carrier * n * n, n * n), coupling)
            at += AT + int(plan[at + N_PLACES])
        short = turning_in(room, p)
        for i in range(n * n):
            short[i] = coupling[i]
        rates = vector(room, p, ALSO)
        for k in range(n):
            z[k] = rates[k] = constant[k] = 0.0
        for i in range(p.free):
            place = int(room[p.coordinates + i])
            room[p.started + i], rates[i] = s[place], s[place + RATE]
        times(part(room, p.inverse, n * n), n, rates, v)
        add_times(coupling, v, constant)
        loads = loads_of(s, oil, numbers, memory, plan, p, room)
        for k in range(n):
            constant[k] += loads[k] + room[p.damping + k] * v[k]
        for i in range(p.touched):
            room[p.before + i] = s[touched_at(plan, p, i)]
            room[p.before + p.touched + i] = 0.0
        for i in range(p.own):
            room[p.own_room + i] = s[p.first + i]
            room[p.own_room + p.own + i] = 0.0
        for i in range(p.energies):
            room[p.energy_room + i] = 0.0
        for k in range(p.losses):
            room[p.lost + k] = 0.0

    @kernel
    def show_touched(s: Array, plan: Offsets, p: Places, room: Array, at: int) -> None:
        """Put the touched coordinates at displacement and speed `at` of the modes into the state.

        Own states follow.
        """
        n, f, own = p.modes, p.touched, p.own
        showing = part(room, p.showing, n * f)
        moved, rates = part(room, p.before + f, f), part(room, p.before + 2 * f, f)
        for i in range(f):
            moved[i] = rates[i] = 0.0
        add_times_both(showing, vector(room, p, at), vector(room, p, at + 1), moved, rates)
        for i in range(f):
            place = touched_at(plan, p, i)
            s[place], s[place + RATE] = room[p.before + i] + moved[i], rates[i]
        times(part(room, p.related, own * f), own, moved, part(s, p.first, own))
        for i in range(own):
            s[p.first + i] += room[p.own_room + i] + room[p.own_room + own + i]

    @kernel
    def couple(p: Places, room: Array, at: int) -> None:
        """Write the forces of coupling dampers and gyroscopic moments at a speed of the modes."""
        out, v = vector(room, p, COUPLED), vector(room, p, at)
        short = short_vector(room, p)
        for k in range(p.modes):
            out[k], short[k] = 0.0, v[k]
        add_times(turning_in(room, p), short, out)

    @kernel
    def force_of_stage(
        s: Array,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        p: Places,
        room: Array,
        at: int,
        stage: int,
    ) -> None:
        """Write the forces on the modes at a stage, whose coordinates stand in the state.

        Of later stages than the first their changes from it.
        """
        n, f, own = p.modes, p.touched, p.own
        force, slope = vector(room, p, FORCE + stage), part(room, p.slope, p.trial - p.slope)
        moved, push = part(room, p.before + f, f), part(room, p.before + 2 * f, f)
        rates = part(room, p.own_room + (2 + stage) * own, own)
        sums(s, oil, numbers, memory, plan, stage + 1, CURVED, slope)
        for i in range(f):
            push[i] = s[touched_at(plan, p, i) + RATE]
        times(part(room, p.related, own * f), own, push, rates)
        for i in range(own):  # what does not follow from motion
            rates[i] = slope[p.first + i] - rates[i]
        share = 2.0 if stage in (1, 2) else 1.0
        for i in range(p.energies):
            room[p.energy_room + i] += share * slope[p.first_energy + i]
        for i in range(f):
            push[i] = slope[touched_at(plan, p, i) + RATE]
        add_times(part(room, p.stiffness, f * f), moved, push)
        constant, coupled = vector(room, p, CONSTANT), vector(room, p, COUPLED)
        couple(p, room, at + 1)
        for k in range(n):
            force[k] = constant[k] - coupled[k]
        add_times(part(room, p.touching, f * n), push, force)
        if stage > 0:
            first = vector(room, p, FORCE)
            for k in range(n):
                force[k] -= first[k]

    @kernel
    def add_own(s: Array, p: Places, room: Array, stage: int, h: float) -> None:
        """Add to own states what the rates of a stage, beside those that follow, do in `h` [s]."""
        for i in range(p.own):
            s[p.first + i] += h * room[p.own_room + (2 + stage) * p.own + i]

    @kernel
    def add_losses(p: Places, room: Array, at: int, weight: float) -> None:
        """Add losses of linear elements at a speed of the modes times a weight.

        The forces of `couple` stand there: they give all losses together, so one of them suffices.
        """
        n, v, last = p.modes, vector(room, p, at), 0
        left, count = dot(v, vector(room, p, COUPLED)), int(room[p.losing])
        for k in range(n):
            left += room[p.damping + k] * v[k] * v[k]
        for k in range(count):
            last = int(room[p.losing + 1 + 2 * k])
            if k + 1 < count:
                rank = int(room[p.losing + 2 + 2 * k])
                along = part(room, p.vectors + ALSO * n, rank)
                for i in range(rank):
                    along[i] = 0.0
                add_times(part(room, p.powers + last * n * n, n * rank), v, along)
                one = dot(along, along)
                room[p.lost + last] += weight * one
                left -= one
        if count > 0:
            room[p.lost + last] += weight * left

    @kernel
    def step(
        s: Array,
        h: float,
        share: float,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        p: Places,
        room: Array,
    ) -> None:
        """Make a step of `h` [s], with a share of the losses at its start."""
        n, own = p.modes, p.own
        force_of_stage(s, oil, numbers, memory, plan, p, room, Z, 0)
        add_losses(p, room, V, share * h)
        move_freely(p, room, HALF, TO_HALF, Z_A)
        show_touched(s, plan, p, room, Z_A)
        add_own(s, p, room, 0, 0.5 * h)
        force_of_stage(s, oil, numbers, memory, plan, p, room, Z_A, 1)
        add_change(p, room, OF_SECOND, 1, Z_A, Z_B)
        show_touched(s, plan, p, room, Z_B)
        add_own(s, p, room, 1, 0.5 * h)
        force_of_stage(s, oil, numbers, memory, plan, p, room, Z_B, 2)
        move_freely(p, room, WHOLE, TO_END, Z_A)
        add_change(p, room, OF_THIRD, 2, Z_A, Z_B)
        show_touched(s, plan, p, room, Z_B)
        add_own(s, p, room, 2, h)
        force_of_stage(s, oil, numbers, memory, plan, p, room, Z_B, 3)
        second, third = vector(room, p, FORCE + 1), vector(room, p, FORCE + 2)
        for k in range(n):
            second[k] += third[k]
        add_change(p, room, OF_BOTH, 1, Z_A, Z)
        add_change(p, room, OF_LAST, 3, Z, Z)
        k_1 = p.own_room + 2 * own
        for i in range(own):
            j = k_1 + i
            total = room[j] + 2.0 * (room[j + own] + room[j + 2 * own]) + room[j + 3 * own]
            room[p.own_room + own + i] += h / 6.0 * total
        for i in range(p.energies):
            s[p.first_energy + i] += h / 6.0 * room[p.energy_room + i]
            room[p.energy_room + i] = 0.0
        show_touched(s, plan, p, room, Z)

    @kernel
    def end_interval(
        s: Array,
        duration: float,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        p: Places,
        room: Array,
    ) -> None:
        n, z, v = p.modes, vector(room, p, Z), vector(room, p, V)
        shapes, out = part(room, p.shapes, p.free * n), vector(room, p, ALSO)
        times(shapes, p.free, z, out)
        for i in range(p.free):
            place = int(room[p.coordinates + i])
            s[place] = room[p.started + i] + out[i]
            s[place + RATE] = out[i] / duration
            for k in range(p.own):
                s[p.first + k] += room[p.straight + k * n + i] * out[i]
        # linear elements lose what they do at the mean speeds, and more by what differs from these
        slope = part(room, p.slope, p.trial - p.slope)
        spread(s, oil, numbers, memory, plan)
        sums(s, oil, numbers, memory, plan, 0, LINEAR, slope)
        couple(p, room, Z)
        add_losses(p, room, Z, -1.0 / duration)
        for i in range(p.energies):
            s[p.first_energy + i] += duration * slope[p.first_energy + i]
        for k in range(p.losses):
            s[p.first_loss + k] += room[p.lost + k]
        times(shapes, p.free, v, out)
        for i in range(p.free):
            s[int(room[p.coordinates + i]) + RATE] = out[i]
        spread(s, oil, numbers, memory, plan)

    @kernel
    def run(
        s: Array,
        h: float,
        most: int,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
    ) -> int:
        """Make at most so many steps of `h` [s]; return how many there are until one has parts."""
        sizes = sizes_of(plan)
        p, room = places_of(sizes), room_in(memory, sizes)
        if room[FILLED] == 0.0:
            fill(oil, numbers, memory, plan)
            begin(s, oil, numbers, memory, plan)
        if room[STEP] != h:
            write_coefficients(h, p, room)
        done = 0
        while done < most and not time_to_jump(s, oil, numbers, memory, plan, h) < h:
            if done == 0:
                begin_interval(s, oil, numbers, memory, plan, p, room)
            each_step(s, oil, numbers, memory, plan, h)
            step(s, h, 0.5 if done == 0 else 1.0, oil, numbers, memory, plan, p, room)
            after_part(s, oil, numbers, memory, plan, h)
            after_step(s, oil, numbers, memory, plan, h)
            done += 1
            if is_wild(s, plan):
                break
        if done > 0:
            couple(p, room, V)
            add_losses(p, room, V, 0.5 * h)
            end_interval(s, done * h, oil, numbers, memory, plan, p, room)
        return done

    return run
