"""Kernels of a list of elements: rates, rest and march.

The elements' kernels are called one after the other by source text made here: their classes and
places are constants of the compiled code. Order of the list is order of the sums, hence of the
bits.

State of a train: twelve states of each body, the elements' own states, the energies, and behind
these N integrated states what elements keep between steps, a mark of each energy at the start of
the last communication step, and its length, for mean powers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from gearlube_core.arrays import Array
from gearlube_core.dynamics.mean_power import LEAST_WINDOW
from gearlube_core.dynamics.ranges import MAX_ANGLE, MAX_SPEED, TOO_FAR
from gearlube_core.dynamics.train.element import (
    BODY_STATES,
    N_COORDINATES,
    RATE,
    Call,
    Layout,
    W,
)
from gearlube_core.dynamics.train.exchange import now_kernel
from gearlube_core.dynamics.train.outputs import outputs_kernel, write_work_size
from gearlube_core.dynamics.train.rest import rest_kernels
from gearlube_core.dynamics.train.rest_search import OK, rest_work_size
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import LubricantParameters, LubricantState, lubricant_state

RATES, RENEW, START, ADVANCE, WRITE, ENERGY, STIFFNESS, EXCHANGE, EVENT = range(9)
# statuses of a step, beside OK
NOT_FINITE = 1
TOO_MANY_STEPS = 2
TOO_FAST = 3

MAX_STEPS = 150_000  # in one communication interval, or their cost
DIVERGED = 0.1  # m, displacement of a body: supports long broken


def work_size(layout: Layout) -> int:
    """Return the length of `work` for all operations."""
    advance = layout.states + 2 * layout.integrated
    return max(advance, write_work_size(layout), rest_work_size(layout))


_IN_TIME = "at_rest", "full_contact", "begin", "expand", "each_step", "after_step", "finish"
_NUMBERS = "step_rate", "time_to_jump", "stored_energy"
_GIVEN = "s, oil, numbers, memory"
# kernels of all elements: what they take more, a line for each element, what they return
_LINES = {
    "at_rest": ("", "{call}", "None"),
    "full_contact": ("", "{call}", "None"),
    "begin": ("", "{call}", "None"),
    "expand": ("", "{call}", "None"),
    "each_step": (", h", "total += {call}", "total"),
    "after_step": (", h", "{call}", "None"),
    "step_rate": ("", "total = max(total, {call})", "total"),
    "finish": ("", "{call}", "None"),
    "time_to_jump": (", h", "total = min(total, {call})", "total"),
    "stored_energy": ("", "total += {call}", "total"),
    "add_forces": (", stage, ds", "{call}", "None"),
    "event": ("", "{call}", "None"),
    "write": (", out", "{call}", "None"),
    "exchange": (", out", "{call}", "None"),
}


def _text(elements: Sequence[Call]) -> tuple[str, list[Any]]:
    """Return the source of a function that makes one kernel of every kind for all elements.

    Its arguments come second: classes, places and kernels, which become constants of the compiled
    code. An element without a kernel of one kind is left out there.
    """
    names = ["kernel", "inside", "part", "tuple_from_array"]
    given: list[Any] = [kernel, inside, part, tuple_from_array]
    lines, calls = [], []
    for i, call in enumerate(elements):
        names += (f"{one}{i}" for one in ("e", "v", "at", "n", "c", "m", "z", "o", "x"))
        given += call
        chosen = "".join(f", v{i}_{k}" for k in range(len(call.variants)))
        lines += [f"    v{i}_{k} = v{i}[{k}]" for k in range(len(call.variants))]
        own = f"tuple_from_array(part(numbers, n{i}, c{i}), e{i}{chosen})"
        calls.append(f"{own}, at{i}, part(memory, m{i}, z{i}), s, oil")
    for name, (more, line, result) in _LINES.items():
        lines.append("    @inside" if name == "add_forces" else "    @kernel")
        begin = "math.inf" if name == "time_to_jump" else "0.0"
        lines += [f"    def all_{name}({_GIVEN}{more}):", f"        total = {begin}"]
        for i, call in enumerate(elements):
            if hasattr(call.numbers, name):
                names.append(f"{name}{i}")
                given.append(getattr(call.numbers, name))
                place = {"write": f", o{i}", "exchange": f", x{i}"}.get(name, "")
                code = f"{name}{i}({calls[i]}{more}{place})"
                lines.append(f"        {line.format(call=code)}")
        lines.append(f"        return {result}")
    made = f"    return {', '.join(f'all_{name}' for name in _LINES)}"
    return "\n".join([f"def make({', '.join(names)}):", *lines, made]), given


def _called(elements: Sequence[Call]) -> tuple[Callable[..., Any], ...]:
    """Return the kernels that call all elements, in the order of _LINES."""
    space: dict[str, Any] = {"__name__": __name__, "math": math}
    text, given = _text(elements)
    exec(compile(text, __file__, "exec"), space)
    made: tuple[Callable[..., Any], ...] = space["make"](*given)
    return made


@cache
def train_kernel(layout: Layout) -> Callable[..., float]:
    """Return the compiled function of all trains of a layout: one, so that it compiles once.

    Its arguments are an operation, the state, the oil's temperature [K], numbers and memory of
    the assembly, then `size`, `least_rate` and `work`:

    RATES
        Rates of all integrated states into `work`.
    RENEW
        What elements keep is found again for this state.
    ENERGY, WRITE
        The energy [J]; WRITE writes what EXCHANGE does and then the outputs into `work` before.
    EXCHANGE
        Rates of all integrated states into `work`, then rates of levels and event indicators of
        each element; returns the status of the state, and only writes where it is OK.
    EVENT
        The state is changed as between two steps, where anything is due; returns as EXCHANGE does.
    ADVANCE
        A time of `size` [s] with at least `least_rate` steps a second; returns a status.
    START
        Static equilibrium at all angles zero. `work` begins with the place among the bodies of the
        one that bears what torques leave, then the speed wanted of each body [rad/s], NaN where it
        follows; torques stand in the state; `size` is integrator steps per highest period. Returns
        OK, and the least rate for ADVANCE is work[0]; or LOOSE, APART, NO_REST or NO_MODES, whose
        number is work[1], and the state stays as it was.
    STIFFNESS
        M^-1 K of the coordinates that are free, about the state, row by row into `work`; returns
        their number.

    `work` has `work_size` numbers.
    """
    made = dict(zip(_LINES, _called(layout.calls), strict=True))
    in_time = (made[name] for name in _IN_TIME)
    at_rest, full_contact, begin, expand, each_step, after_step, finish = in_time
    step_rate, time_to_jump, stored_energy = (made[name] for name in _NUMBERS)
    add_forces, event = made["add_forces"], made["event"]
    bodies, first_mobility, energies = layout.bodies, layout.first_mobility, layout.energies
    n, n_state, n_kept, laws = layout.integrated, layout.states, layout.kept, layout.laws
    first_energy = n - energies

    @inside
    def forces(
        s: Array, oil: LubricantState, numbers: Array, memory: Array, stage: int, ds: Array
    ) -> None:
        for i in range(n):
            ds[i] = 0.0
        add_forces(s, oil, numbers, memory, stage, ds)

    @kernel
    def rates(
        s: Array, oil: LubricantState, numbers: Array, memory: Array, stage: int, ds: Array
    ) -> None:
        forces(s, oil, numbers, memory, stage, ds)
        for body in range(bodies):
            at = BODY_STATES * body
            mobility = first_mobility + N_COORDINATES * body
            for i in range(N_COORDINATES):
                ds[at + i] = s[at + RATE + i]
                ds[at + RATE + i] *= numbers[mobility + i]

    @kernel
    def rk4_step(
        s: Array, h: float, oil: LubricantState, numbers: Array, memory: Array, stages: Array
    ) -> None:
        trial = part(stages, 0, n_state)
        slope = part(stages, n_state, n)
        total = part(stages, n_state + n, n)
        rates(s, oil, numbers, memory, 1, slope)
        for i in range(n):
            total[i] = slope[i]
            trial[i] = s[i] + 0.5 * h * slope[i]
        rates(trial, oil, numbers, memory, 2, slope)
        for i in range(n):
            total[i] += 2.0 * slope[i]
            trial[i] = s[i] + 0.5 * h * slope[i]
        rates(trial, oil, numbers, memory, 3, slope)
        for i in range(n):
            total[i] += 2.0 * slope[i]
            trial[i] = s[i] + h * slope[i]
        rates(trial, oil, numbers, memory, 4, slope)
        for i in range(n):
            s[i] += h / 6.0 * (total[i] + slope[i])

    @kernel
    def status_of(s: Array) -> int:
        total = 0.0
        for i in range(n):
            total += abs(s[i])
        if not total < math.inf:
            return NOT_FINITE
        for body in range(bodies):
            at = BODY_STATES * body
            if max(abs(s[at]), max(abs(s[at + 1]), abs(s[at + 2]))) > DIVERGED:
                return NOT_FINITE
            if abs(s[at + W]) > MAX_SPEED:
                return TOO_FAST
            if abs(s[at + N_COORDINATES - 1]) > MAX_ANGLE:
                return TOO_FAR
        return OK

    @kernel
    def is_wild(s: Array) -> bool:
        """Whether a body has left its range, which is looked at after each step."""
        wild = False
        for body in range(bodies):
            at = BODY_STATES * body
            wild |= abs(s[at]) > DIVERGED or abs(s[at + 1]) > DIVERGED or abs(s[at + 2]) > DIVERGED
            wild |= abs(s[at + W]) > MAX_SPEED
        return wild

    @kernel
    def advance(
        s: Array,
        duration: float,
        oil: LubricantState,
        numbers: Array,
        memory: Array,
        least_rate: float,
        work: Array,
    ) -> int:
        wanted = duration * max(least_rate, step_rate(s, oil, numbers, memory))
        if not wanted < MAX_STEPS:
            return TOO_MANY_STEPS
        steps = max(1, math.ceil(wanted))
        h = duration / steps
        for i in range(energies):
            now = s[first_energy + i]
            s[n_kept + i] = now if duration >= LEAST_WINDOW else s[n_kept + i] - now
        if duration >= LEAST_WINDOW:
            s[n_state - 1] = duration
        cost = 0.0
        for _ in range(steps):
            rest = h
            while rest > 0.0:
                cost += each_step(s, oil, numbers, memory, rest)
                if cost > MAX_STEPS:
                    return TOO_MANY_STEPS
                for i in range(n, n_kept):
                    work[i] = s[i]
                piece = min(rest, time_to_jump(s, oil, numbers, memory, h))
                rk4_step(s, piece, oil, numbers, memory, work)
                rest -= piece
            after_step(s, oil, numbers, memory, h)
            if is_wild(s):
                break
        status = status_of(s)
        if status != OK:
            return status
        finish(s, oil, numbers, memory)
        for i in range(energies):  # a short step leaves the means as they were, see `keep_means`
            if duration < LEAST_WINDOW:
                s[n_kept + i] += s[first_energy + i]
        return OK

    @kernel
    def kinetic_energy(s: Array, numbers: Array) -> float:
        twice = 0.0
        for body in range(bodies):
            at = BODY_STATES * body + RATE
            mobility = first_mobility + N_COORDINATES * body
            for i in range(N_COORDINATES):
                if numbers[mobility + i] > 0.0:
                    twice += s[at + i] * s[at + i] / numbers[mobility + i]
        return 0.5 * twice

    @kernel
    def renew(s: Array, oil: LubricantState, numbers: Array, memory: Array) -> None:
        begin(s, oil, numbers, memory)
        each_step(s, oil, numbers, memory, 0.0)
        expand(s, oil, numbers, memory)

    start, stiffness = rest_kernels(layout, renew, expand, (at_rest, full_contact), rates, forces)
    now = now_kernel(layout, each_step, expand, rates, made["exchange"])
    write_all = outputs_kernel(layout, now, made["write"])

    @kernel
    def operate(
        operation: int,
        s: Array,
        temperature: float,
        numbers: Array,
        memory: Array,
        size: float,
        least_rate: float,
        work: Array,
    ) -> float:
        given: LubricantParameters = tuple_from_array(numbers, LubricantParameters)
        oil = lubricant_state(given, temperature, laws)
        if operation == RATES:
            rates(s, oil, numbers, memory, 0, work)
            return 0.0
        if operation == START:
            return float(start(s, oil, numbers, memory, size, work))
        if operation == STIFFNESS:
            return float(stiffness(s, oil, numbers, memory, work))
        if operation == RENEW:
            renew(s, oil, numbers, memory)
            return 0.0
        if operation in (EXCHANGE, EVENT):
            status = status_of(s)
            if status == OK:
                begin(s, oil, numbers, memory)
                if operation == EVENT:
                    event(s, oil, numbers, memory)
                    finish(s, oil, numbers, memory)
                else:
                    now(s, oil, numbers, memory, work)
            return float(status)
        begin(s, oil, numbers, memory)
        if operation == ADVANCE:
            return float(advance(s, size, oil, numbers, memory, least_rate, work))
        expand(s, oil, numbers, memory)
        stored = kinetic_energy(s, numbers) + stored_energy(s, oil, numbers, memory)
        if operation == WRITE:
            write_all(s, oil, numbers, memory, stored, work)
        return stored

    return operate
