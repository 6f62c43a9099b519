"""Kernels of a list of elements: rates, rest and march.

State of a train: twelve states of each body, the elements' own states, the energies, and behind
these N integrated states what elements keep between steps, a mark of each energy at the start of
the last communication step, and its length, for mean powers.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.mean_power import LEAST_WINDOW
from gearlube_core.dynamics.ranges import MAX_ANGLE, MAX_SPEED, TOO_FAR
from gearlube_core.dynamics.train.drivers import AllElements
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RATE, W
from gearlube_core.dynamics.train.exchange import now_kernel, stage_of
from gearlube_core.dynamics.train.exponential_march import exponential_kernel
from gearlube_core.dynamics.train.exponential_modes import modes_kernel
from gearlube_core.dynamics.train.outputs import (
    energy_at,
    of_elements_at,
    outputs_kernel,
    write_work_size,
)
from gearlube_core.dynamics.train.plan import ALL, Sizes
from gearlube_core.dynamics.train.rest import rest_kernels
from gearlube_core.dynamics.train.rest_search import OK, rest_work_size
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import OilLaws
from gearlube_core.oil.lubricant_state import LubricantParameters, LubricantState, lubricant_state

RATES, RENEW, START, ADVANCE, WRITE, ENERGY, STIFFNESS, EXCHANGE, EVENT, SHOW = range(10)
# statuses of a step, beside OK
NOT_FINITE = 1
TOO_MANY_STEPS = 2
TOO_FAST = 3

MAX_STEPS = 150_000  # in one communication interval, or their cost
_MS = 1e3  # in a second
_ROUNDING = 1e-6  # of a count of steps
_SPLIT = 2.0**17 + 1.0  # with which 36 binary digits of a number are left
_OF_PERIODS = 1.0 / 3.0  # of the steps per mesh or ripple period that RK4 takes
DIVERGED = 0.1  # m, displacement of a body: supports long broken
REFUSALS = {
    NOT_FINITE: (
        "the state is no longer finite, or a body has moved by more than 0.1 m. Reduce the "
        "torques, or dampers far above the critical one"
    ),
    TOO_MANY_STEPS: (
        f"the step costs more than {MAX_STEPS} integrator steps. Shorten the communication step, "
        "or take fewer solver.steps_per_highest_period and solver.steps_per_mesh_period"
    ),
    TOO_FAST: (
        f"a shaft turns faster than {MAX_SPEED:g} rad/s, where the model has no meaning. "
        "Reduce the torque, or load the wheel"
    ),
    TOO_FAR: (
        f"an angle of a shaft or cage is beyond {MAX_ANGLE:g} rad, where rounding blurs the phase "
        "of the mesh. Start again, or take whole turns of all shafts from the angles"
    ),
}


@kernel
def work_size(sizes: Sizes) -> int:
    """Return the length of `work` for all operations."""
    return max(3 * sizes.integrated, max(write_work_size(sizes), rest_work_size(sizes)))


def train_kernel(of_all: AllElements, laws: OilLaws) -> Callable[..., float]:
    """Return the compiled function of trains.

    Its arguments are an operation, the state, the oil's temperature [K], numbers, memory and plan
    of the assembly, then `size`, `least_rate` and `work`:

    RATES
        Rates of all integrated states into `work`.
    RENEW
        What elements keep is found again for this state.
    SHOW
        Of what WRITE writes, outputs of elements whose bits are set in `size`: those that take no
        rates, see `Kernels.show`. The stored energy too if `least_rate` is above 0. Returns OK.
    ENERGY, WRITE
        The energy [J]; WRITE writes what EXCHANGE does and then the outputs into `work` before.
    EXCHANGE
        Rates of all integrated states into `work`, then rates of levels and event indicators of
        each element, and what SHOW writes if `size` is above 0; returns the status of the state,
        and only writes where it is OK.
    EVENT
        The state is changed as between two steps, where anything is due; returns as EXCHANGE does.
    ADVANCE
        A time of `size` [s] with at least `least_rate` steps a second; returns a status.
    START
        Static equilibrium at all angles zero. `work` begins with the place among the bodies of the
        one that bears what torques leave, then the speed wanted of each body [rad/s], NaN where it
        follows; torques stand in the state; `size` is integrator steps per highest period. Returns
        OK, and the least rate for ADVANCE is work[0]; or LOOSE, APART, NO_REST or NO_MODES, whose
        number is work[1], and the state stays as it was. With NO_REST work[0] is how many
        coordinates are free, whose stiffness STIFFNESS would write is in the room of the solver.
    STIFFNESS
        M^-1 K of the coordinates that are free, about the state, row by row into `work`; returns
        their number.

    `work` has `work_size` numbers.
    """
    sizes_of, begin, expand = of_all.sizes_of, of_all.begin, of_all.expand
    each_step, finish = of_all.each_step, of_all.finish
    after_part, after_step = of_all.after_part, of_all.after_step
    add_forces, after_forces = of_all.add_forces, of_all.after_forces
    event, stored_energy = of_all.event, of_all.stored_energy
    spread, collect = of_all.spread, of_all.collect
    step_rate, stiffening = of_all.step_rate, of_all.stiffening
    time_to_jump, show = of_all.time_to_jump, of_all.show

    @kernel
    def sums(
        s: Array,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        stage: int,
        which: int,
        ds: Array,
    ) -> None:
        s, ds = part(s, 0, s.size), part(ds, 0, ds.size)  # not counted, as in `operate`
        numbers, memory = part(numbers, 0, numbers.size), part(memory, 0, memory.size)
        plan = part(plan, 0, plan.size)  # type: ignore[arg-type, assignment]
        for i in range(sizes_of(plan).integrated):
            ds[i] = 0.0
        add_forces(s, oil, numbers, memory, plan, stage, ds, which)

    @inside
    def forces(
        s: Array,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        stage: int,
        ds: Array,
    ) -> None:
        spread(s, oil, numbers, memory, plan)
        sums(s, oil, numbers, memory, plan, stage, ALL, ds)
        collect(s, oil, numbers, memory, plan, ds)

    @kernel
    def rates(
        s: Array,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        stage: int,
        ds: Array,
    ) -> None:
        s, ds = part(s, 0, s.size), part(ds, 0, ds.size)  # not counted, as in `operate`
        numbers, memory = part(numbers, 0, numbers.size), part(memory, 0, memory.size)
        plan = part(plan, 0, plan.size)  # type: ignore[arg-type, assignment]
        sizes = sizes_of(plan)
        spread(s, oil, numbers, memory, plan)
        sums(s, oil, numbers, memory, plan, stage, ALL, ds)
        collect(s, oil, numbers, memory, plan, ds)
        for body in range(sizes.bodies):
            at = BODY_STATES * body
            mobility = sizes.first_mobility + N_COORDINATES * body
            for i in range(N_COORDINATES):
                ds[at + i] = s[at + RATE + i]
                ds[at + RATE + i] *= numbers[mobility + i]
        after_forces(s, oil, numbers, memory, plan, stage, ds)

    @kernel
    def rk4_step(
        s: Array,
        h: float,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        stages: Array,
    ) -> None:
        s, stages = part(s, 0, s.size), part(stages, 0, stages.size)  # not counted, as in `rates`
        numbers, memory = part(numbers, 0, numbers.size), part(memory, 0, memory.size)
        plan = part(plan, 0, plan.size)  # type: ignore[arg-type, assignment]
        # the state takes the stages itself: what elements keep, which may be long, stays in place
        n = sizes_of(plan).integrated
        begin, slope, total = part(stages, 0, n), part(stages, n, n), part(stages, 2 * n, n)
        rates(s, oil, numbers, memory, plan, 1, slope)
        for i in range(n):
            begin[i] = s[i]
            total[i] = slope[i]
            s[i] = begin[i] + 0.5 * h * slope[i]
        rates(s, oil, numbers, memory, plan, 2, slope)
        for i in range(n):
            total[i] += 2.0 * slope[i]
            s[i] = begin[i] + 0.5 * h * slope[i]
        rates(s, oil, numbers, memory, plan, 3, slope)
        for i in range(n):
            total[i] += 2.0 * slope[i]
            s[i] = begin[i] + h * slope[i]
        rates(s, oil, numbers, memory, plan, 4, slope)
        for i in range(n):
            s[i] = begin[i] + h / 6.0 * (total[i] + slope[i])
        spread(s, oil, numbers, memory, plan)

    @kernel
    def status_of(s: Array, plan: Offsets) -> int:
        total, sizes = 0.0, sizes_of(plan)
        for i in range(sizes.integrated):
            total += abs(s[i])
        if not total < math.inf:
            return NOT_FINITE
        for body in range(sizes.bodies):
            at = BODY_STATES * body
            if max(abs(s[at]), max(abs(s[at + 1]), abs(s[at + 2]))) > DIVERGED:
                return NOT_FINITE
            if abs(s[at + W]) > MAX_SPEED:
                return TOO_FAST
            if abs(s[at + N_COORDINATES - 1]) > MAX_ANGLE:
                return TOO_FAR
        return OK

    @kernel
    def is_wild(s: Array, plan: Offsets) -> bool:
        """Whether a body has left its range, which is looked at after each step."""
        wild = False
        for body in range(sizes_of(plan).bodies):
            at = BODY_STATES * body
            wild |= abs(s[at]) > DIVERGED or abs(s[at + 1]) > DIVERGED or abs(s[at + 2]) > DIVERGED
            wild |= abs(s[at + W]) > MAX_SPEED
        return wild

    @kernel
    def march(
        s: Array,
        h: float,
        steps: int,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        work: Array,
    ) -> bool:
        """Make RK4 steps of `h` [s]; return whether they cost no more than MAX_STEPS."""
        cost = 0.0
        for _ in range(steps):
            rest = h
            while rest > 0.0:
                piece = min(rest, time_to_jump(s, oil, numbers, memory, plan, h))
                cost += each_step(s, oil, numbers, memory, plan, piece)
                if cost > MAX_STEPS:
                    return False
                rk4_step(s, piece, oil, numbers, memory, plan, work)
                after_part(s, oil, numbers, memory, plan, piece)
                rest -= piece
            after_step(s, oil, numbers, memory, plan, h)
            if is_wild(s, plan):
                break
        return True

    @kernel
    def renew(s: Array, oil: LubricantState, numbers: Array, memory: Array, plan: Offsets) -> None:
        spread(s, oil, numbers, memory, plan)
        begin(s, oil, numbers, memory, plan)
        each_step(s, oil, numbers, memory, plan, 0.0)
        expand(s, oil, numbers, memory, plan)

    fill = modes_kernel(of_all, renew, sums)
    run = exponential_kernel(of_all, fill, sums, is_wild)

    @kernel
    def advance(
        s: Array,
        duration: float,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        least_rate: float,
        work: Array,
    ) -> int:
        s, work = part(s, 0, s.size), part(work, 0, work.size)  # not counted, as in `rates`
        numbers, memory = part(numbers, 0, numbers.size), part(memory, 0, memory.size)
        plan = part(plan, 0, plan.size)  # type: ignore[arg-type, assignment]
        sizes = sizes_of(plan)
        highest = least_rate * max(1.0, stiffening(s, oil, numbers, memory, plan))
        rate = step_rate(s, oil, numbers, memory, plan)
        exact = sizes.exponential > 0
        longest = max(_MS * sizes.exponential, _OF_PERIODS * rate) if exact else max(highest, rate)
        wanted = duration * longest
        if not wanted < MAX_STEPS:
            return TOO_MANY_STEPS
        steps = max(1, math.ceil(wanted - _ROUNDING if exact else wanted))
        h = duration / steps
        if exact:  # hosts round their times: the numbers of a step serve all that they mean
            h = _SPLIT * h - (_SPLIT * h - h)
        n, n_kept, energies = sizes.integrated, sizes.kept, sizes.energies
        first_energy = n - energies
        for i in range(energies):
            now = s[first_energy + i]
            s[n_kept + i] = now if duration >= LEAST_WINDOW else s[n_kept + i] - now
        if duration >= LEAST_WINDOW:
            s[sizes.states - 1] = duration
        if not exact and not march(s, h, steps, oil, numbers, memory, plan, work):
            return TOO_MANY_STEPS
        while exact and steps > 0:
            steps -= run(s, h, steps, oil, numbers, memory, plan)
            if is_wild(s, plan):
                break
            if steps > 0:  # one that has parts
                parts = max(1, math.ceil(h * max(highest, rate)))
                if not march(s, h / parts, parts, oil, numbers, memory, plan, work):
                    return TOO_MANY_STEPS
                steps -= 1
        status = status_of(s, plan)
        if status != OK:
            return status
        finish(s, oil, numbers, memory, plan)
        for i in range(energies):  # a short step leaves the means as they were
            if duration < LEAST_WINDOW:
                s[n_kept + i] += s[first_energy + i]
        return OK

    @kernel
    def kinetic_energy(s: Array, numbers: Array, plan: Offsets) -> float:
        twice, sizes = 0.0, sizes_of(plan)
        for body in range(sizes.bodies):
            at = BODY_STATES * body + RATE
            mobility = sizes.first_mobility + N_COORDINATES * body
            for i in range(N_COORDINATES):
                if numbers[mobility + i] > 0.0:
                    twice += s[at + i] * s[at + i] / numbers[mobility + i]
        return 0.5 * twice

    start, stiffness = rest_kernels(of_all, renew, rates, forces)
    now = now_kernel(of_all, rates)
    write_all = outputs_kernel(of_all, now)

    @kernel
    def operate(
        operation: int,
        s: Array,
        temperature: float,
        numbers: Array,
        memory: Array,
        plan: Offsets,
        size: float,
        least_rate: float,
        work: Array,
    ) -> float:
        # parts of arrays are not counted: kernels that pass them on pay no atomic operations
        s, work = part(s, 0, s.size), part(work, 0, work.size)
        numbers, memory = part(numbers, 0, numbers.size), part(memory, 0, memory.size)
        plan = part(plan, 0, plan.size)  # type: ignore[arg-type, assignment]
        given: LubricantParameters = tuple_from_array(numbers, LubricantParameters)
        oil = lubricant_state(given, temperature, laws)
        if operation == RATES:
            rates(s, oil, numbers, memory, plan, 0, work)
            return 0.0
        if operation == START:
            return float(start(s, oil, numbers, memory, plan, size, work))
        if operation == STIFFNESS:
            return float(stiffness(s, oil, numbers, memory, plan, work))
        if operation == RENEW:
            renew(s, oil, numbers, memory, plan)
            return 0.0
        if operation in (EXCHANGE, EVENT):
            status = status_of(s, plan)
            if status != OK:
                return float(status)
            spread(s, oil, numbers, memory, plan)
        begin(s, oil, numbers, memory, plan)
        if operation == EVENT:
            event(s, oil, numbers, memory, plan)
            finish(s, oil, numbers, memory, plan)
            return float(OK)
        if operation == ADVANCE:
            return float(advance(s, size, oil, numbers, memory, plan, least_rate, work))
        if operation == EXCHANGE:
            now(s, oil, numbers, memory, plan, work)
        sizes = sizes_of(plan)
        of_elements, shows = of_elements_at(sizes), operation in (EXCHANGE, SHOW)
        if shows and size > 0.0:
            out = part(work, of_elements, sizes.outputs)
            show(s, oil, numbers, memory, plan, stage_of(s, sizes), out, int(size))
        if shows and (size <= 0.0 or least_rate <= 0.0):
            return float(OK)
        stored = kinetic_energy(s, numbers, plan) + stored_energy(s, oil, numbers, memory, plan)
        if operation == WRITE:
            write_all(s, oil, numbers, memory, plan, stored, work)
        elif shows:
            work[energy_at(of_elements, sizes)] = stored
        return float(OK) if shows else stored

    return operate
