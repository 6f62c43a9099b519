"""Kernels of a list of elements: rates, rest and march.

The elements' kernels are called one after the other by source text made here, which differs with
the number of elements alone: their classes and places are constants of the compiled code. Order of
the list is order of the sums, hence of the bits.

State of a train: twelve states of each body, the elements' own states, the energies, and behind
these N integrated states what elements keep between steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.ranges import MAX_ANGLE, MAX_SPEED, TOO_FAR
from gearlube_core.dynamics.train import element as calls
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RATE, RZ, W
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.damped_newton import damped_newton
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import LubricantParameters, LubricantState, lubricant_state

OK = 0
NOT_FINITE = 1
TOO_MANY_STEPS = 2
TOO_FAST = 3

MAX_STEPS = 150_000  # in one communication interval, or their cost
DIVERGED = 0.1  # m, displacement of a body: supports long broken


class Call(NamedTuple):
    """How an element is called."""

    numbers: type  # NamedTuple class of its constants
    variants: tuple[type, ...]  # classes of its parts, see `tuple_from_array`
    at: tuple[int, ...]
    first_number: int
    n_numbers: int
    first_memory: int
    n_memory: int
    first_output: int


class Layout(NamedTuple):
    """What is compiled for: all of it constant."""

    calls: tuple[Call, ...]
    bodies: int
    own: int  # states of elements, behind those of the bodies
    first_mobility: int  # among the numbers
    integrated: int
    states: int


class TrainKernels(NamedTuple):
    """Compiled functions of a train."""

    rates: Callable[..., None]
    renew: Callable[..., None]
    settle: Callable[..., None]
    advance: Callable[..., int]
    write: Callable[..., None]
    stored_energy: Callable[..., float]


_GIVEN = "s, oil, numbers, memory"
# kernels of all elements: what they take more, a line for each element, what they return
_LINES = {
    "begin": ("", "{call}", "None"),
    "each_step": (", h", "total += {call}", "total"),
    "after_step": (", h", "{call}", "None"),
    "step_rate": ("", "total = max(total, {call})", "total"),
    "stored_energy": ("", "total += {call}", "total"),
    "add_forces": (", ds", "{call}", "None"),
    "write": (", out", "{call}", "None"),
}


def _text(variants: Sequence[int]) -> str:
    """Return the source of a function that makes one kernel of every kind for all elements.

    `variants` has how many each element takes. Classes and places are its arguments, so that they
    become constants of the compiled code.
    """
    count = range(len(variants))
    constants = "".join(f", e{i}, v{i}, at{i}, n{i}, c{i}, m{i}, z{i}, o{i}" for i in count)
    lines = [f"def make(kernel, inside, part, tuple_from_array, {', '.join(_LINES)}{constants}):"]
    for i in count:
        lines += [f"    v{i}_{k} = v{i}[{k}]" for k in range(variants[i])]
    for name, (more, line, result) in _LINES.items():
        lines.append("    @inside" if name == "add_forces" else "    @kernel")
        lines += [f"    def all_{name}({_GIVEN}{more}):", "        total = 0.0"]
        for i in count:
            chosen = "".join(f", v{i}_{k}" for k in range(variants[i]))
            own = f"tuple_from_array(part(numbers, n{i}, c{i}), e{i}{chosen})"
            given = f"{own}, at{i}, part(memory, m{i}, z{i}), s, oil{more}"
            given += f", o{i}" if name == "write" else ""
            lines.append(f"        {line.format(call=f'{name}({given})')}")
        lines.append(f"        return {result}")
    return "\n".join([*lines, f"    return {', '.join(f'all_{name}' for name in _LINES)}"])


def _called(elements: Sequence[Call]) -> tuple[Callable[..., Any], ...]:
    """Return the kernels that call all elements, in the order of _LINES."""
    space: dict[str, Any] = {"__name__": __name__}
    text = _text([len(call.variants) for call in elements])
    exec(compile(text, __file__, "exec"), space)
    constants = [one for call in elements for one in call]
    by_class = [getattr(calls, name) for name in _LINES]
    made: tuple[Callable[..., Any], ...] = space["make"](
        kernel, inside, part, tuple_from_array, *by_class, *constants
    )
    return made


@cache
def train_kernels(layout: Layout) -> TrainKernels:
    """Return the compiled functions of all trains of a layout."""
    begin, each_step, after_step, step_rate, stored_energy, add_forces, write = _called(
        layout.calls
    )
    bodies, own, first_mobility, n, n_state = layout[1:]

    @kernel
    def oil_at(temperature: float, numbers: Array) -> LubricantState:
        oil: LubricantParameters = tuple_from_array(numbers, LubricantParameters)
        return lubricant_state(oil, temperature)

    @inside
    def forces(s: Array, oil: LubricantState, numbers: Array, memory: Array, ds: Array) -> None:
        for i in range(n):
            ds[i] = 0.0
        add_forces(s, oil, numbers, memory, ds)

    @kernel
    def rates(s: Array, oil: LubricantState, numbers: Array, memory: Array, ds: Array) -> None:
        forces(s, oil, numbers, memory, ds)
        for body in range(bodies):
            at = BODY_STATES * body
            mobility = first_mobility + N_COORDINATES * body
            for i in range(N_COORDINATES):
                ds[at + i] = s[at + RATE + i]
                ds[at + RATE + i] *= numbers[mobility + i]

    @kernel
    def rates_under(s: Array, temperature: float, numbers: Array, memory: Array, ds: Array) -> None:
        rates(s, oil_at(temperature, numbers), numbers, memory, ds)

    @kernel
    def renew(s: Array, temperature: float, numbers: Array, memory: Array) -> None:
        oil = oil_at(temperature, numbers)
        begin(s, oil, numbers, memory)
        each_step(s, oil, numbers, memory, 0.0)

    @kernel
    def unbalanced(u: Array, problem: Any, out: Array) -> None:
        s, oil, numbers, memory, places, relations, ds = problem
        for i in range(u.size):
            s[int(places[i])] = u[i]
        for k in range(own):
            found = 0.0
            for i in range(u.size):
                found += relations[k * u.size + i] * u[i]
            s[BODY_STATES * bodies + k] = found
        for body in range(bodies):  # angles move own states alone: periodic data stay
            s[BODY_STATES * body + RZ] = 0.0
        forces(s, oil, numbers, memory, ds)
        for i in range(u.size):
            out[i] = ds[int(places[i]) + RATE]

    newton = damped_newton(unbalanced)

    @kernel
    def settle(
        s: Array,
        temperature: float,
        numbers: Array,
        memory: Array,
        places: Array,
        relations: Array,
        scales: Array,
        u: Array,
        out: Array,
        work: Array,
    ) -> None:
        oil = oil_at(temperature, numbers)
        problem = (s, oil, numbers, memory, places, relations, part(work, 0, n))
        newton(u, scales, problem, part(work, n, work.size - n))
        unbalanced(u, problem, out)

    @kernel
    def rk4_step(
        s: Array, h: float, oil: LubricantState, numbers: Array, memory: Array, stages: Array
    ) -> None:
        trial = part(stages, 0, n_state)
        slope = part(stages, n_state, n)
        total = part(stages, n_state + n, n)
        rates(s, oil, numbers, memory, slope)
        for i in range(n):
            total[i] = slope[i]
            trial[i] = s[i] + 0.5 * h * slope[i]
        rates(trial, oil, numbers, memory, slope)
        for i in range(n):
            total[i] += 2.0 * slope[i]
            trial[i] = s[i] + 0.5 * h * slope[i]
        rates(trial, oil, numbers, memory, slope)
        for i in range(n):
            total[i] += 2.0 * slope[i]
            trial[i] = s[i] + h * slope[i]
        rates(trial, oil, numbers, memory, slope)
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
    def advance(
        s: Array,
        duration: float,
        temperature: float,
        numbers: Array,
        memory: Array,
        least_rate: float,
        work: Array,
    ) -> int:
        oil = oil_at(temperature, numbers)
        begin(s, oil, numbers, memory)
        wanted = duration * max(least_rate, step_rate(s, oil, numbers, memory))
        if not wanted < MAX_STEPS:
            return TOO_MANY_STEPS
        steps = max(1, math.ceil(wanted))
        h = duration / steps
        cost = 0.0
        for _ in range(steps):
            cost += each_step(s, oil, numbers, memory, h)
            if cost > MAX_STEPS:
                return TOO_MANY_STEPS
            for i in range(n, n_state):
                work[i] = s[i]
            rk4_step(s, h, oil, numbers, memory, work)
            after_step(s, oil, numbers, memory, h)
            status = status_of(s)
            if status != OK:
                return status
        return OK

    @kernel
    def write_under(
        s: Array, temperature: float, numbers: Array, memory: Array, out: Array
    ) -> None:
        oil = oil_at(temperature, numbers)
        begin(s, oil, numbers, memory)
        write(s, oil, numbers, memory, out)

    @kernel
    def energy_under(s: Array, temperature: float, numbers: Array, memory: Array) -> float:
        oil = oil_at(temperature, numbers)
        kinetic = 0.0
        for body in range(bodies):
            at = BODY_STATES * body + RATE
            mobility = first_mobility + N_COORDINATES * body
            for i in range(N_COORDINATES):
                if numbers[mobility + i] > 0.0:
                    kinetic += s[at + i] * s[at + i] / numbers[mobility + i]
        return 0.5 * kinetic + stored_energy(s, oil, numbers, memory)

    return TrainKernels(rates_under, renew, settle, advance, write_under, energy_under)
