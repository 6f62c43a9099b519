"""A train for any other integrator: its continuous states, and the kernels of rates and events.

The continuous states are the integrated ones that are not held, and the levels of the elements,
which follow by a filter of their own in `march`. What elements keep besides changes at events
alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.train.drivers import AllElements
from gearlube_core.dynamics.train.element import AFTER_STEP, BODY_STATES, COORDINATES, N_COORDINATES
from gearlube_core.dynamics.train.outputs import MOVING, TURNING, named_of
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.dynamics.train.plan import Sizes
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Output
from gearlube_core.oil.lubricant_state import LubricantState

# of the coordinates of a body, and of their rates
_OF_BODY = (*MOVING.values(), TURNING[0])
_RATES_OF_BODY = (
    *(Output(f"velocity.{c}", "m/s", f"velocity along {c}", 0.01) for c in "xyz"),
    *(Output(f"tilt_speed.{c}", "rad/s", f"tilting speed about {c}", 0.1) for c in "xy"),
    TURNING[1],
)


class Continuous(NamedTuple):
    """A continuous state."""

    record: Output  # that of the output that shows it, if there is one
    place: int  # in the state of the train
    rate: int  # place of its rate in what EXCHANGE writes


class Indicator(NamedTuple):
    """An event indicator."""

    record: Output
    place: int  # in what EXCHANGE writes


def continuous_states(
    bodies: Sequence[Body],
    elements: Sequence[Element],
    names: Sequence[str],
    kept: Mapping[str, int],
    outputs: Sequence[Output],
) -> tuple[Continuous, ...]:
    """Return the continuous states of a train, in the order of its state.

    Parameters
    ----------
    bodies, elements
    names : sequence of str
        Of the integrated states.
    kept : mapping
        First place of what each element keeps.
    outputs : sequence of Output
        Of the train.
    """
    shown = {one.name: one for one in outputs}
    found = []
    for i, body in enumerate(bodies):
        for of, records in enumerate((_OF_BODY, _RATES_OF_BODY)):
            first = BODY_STATES * i + N_COORDINATES * of
            found += [
                Continuous(named_of(body.name, record), first + j, first + j)
                for j, (record, c) in enumerate(zip(records, COORDINATES, strict=True))
                if c not in body.held
            ]
    own = [named_of(one.name, state) for one in elements for state in one.states]
    for one in elements:
        turning = [Output(f"{c}.angle", "rad", f"angle of the {c}") for c in one.angles]
        own += [named_of(one.name, other) for other in (*turning, *one.lags)]
    first = BODY_STATES * len(bodies)
    own += [shown[name] for name in names[first + len(own) :]]  # energies
    found += [Continuous(record, first + j, first + j) for j, record in enumerate(own)]
    rate = len(names)
    for one in elements:
        levels = [shown[f"{one.name}.{level}"] for level in one.levels]
        at = kept[one.name] if levels else 0
        found += [Continuous(record, at + j, rate + j) for j, record in enumerate(levels)]
        rate += len(one.levels) + len(one.events)
    return tuple(found)


def event_indicators(elements: Sequence[Element], integrated: int) -> tuple[Indicator, ...]:
    """Return the event indicators of all elements, behind so many rates of integrated states."""
    found, at = [], integrated
    for one in elements:
        at += len(one.levels)
        for event in one.events:
            found.append(Indicator(named_of(one.name, event), at))
            at += 1
    return tuple(found)


@inside
def stage_of(s: Array, sizes: Sizes) -> int:
    """Return the stage of a state by itself, see `Kernels.add_forces`."""
    return AFTER_STEP if s[sizes.states - 1] > 0.0 else 0


def now_kernel(elements: AllElements, rates: Callable[..., None]) -> Callable[..., None]:
    """Return the kernel of the rates of a state in which elements keep what they keep.

    It writes the rates of all integrated states into `work`, behind them what `Kernels.exchange`
    gives; the state stays as it is. `work` has room for a state behind that.
    """
    sizes_of, each_step = elements.sizes_of, elements.each_step
    expand, exchange = elements.expand, elements.exchange

    @kernel
    def now(
        s: Array, oil: LubricantState, numbers: Array, memory: Array, plan: Offsets, work: Array
    ) -> None:
        sizes = sizes_of(plan)
        n, n_state, exchanged = sizes.integrated, sizes.states, sizes.exchanged
        slope, begun = part(work, 0, n), part(work, n + exchanged, n_state)
        for i in range(n_state):
            begun[i] = s[i]
        each_step(begun, oil, numbers, memory, plan, 0.0)  # changes what is kept
        expand(s, oil, numbers, memory, plan)
        rates(s, oil, numbers, memory, plan, stage_of(s, sizes), slope)
        exchange(s, oil, numbers, memory, plan, part(work, n, exchanged))

    return now
