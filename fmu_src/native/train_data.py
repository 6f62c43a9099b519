"""Constants of a train in its FMU: where their parts stand, and whether they can be used.

    TrainPlaces | numbers | memory | plan | ports | bodies | motion | exchanged | limits | ranges

Places and plan are whole numbers of 64 bits, all others floats.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

from fmu_src.object_code import array_at, pointer_at, whole_at
from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.train.check import check_kernel
from gearlube_core.dynamics.train.drivers import interpreted
from gearlube_core.dynamics.train.march import work_size
from gearlube_core.dynamics.train.outputs import outputs_at
from gearlube_core.dynamics.train.part import shipped_kinds
from gearlube_core.dynamics.train.plan import FIRST_ROW, Sizes, sizes_of
from gearlube_core.kernels.checked_numbers import is_whole
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import FORMULA_LAWS
from gearlube_core.oil.lubricant_state import LubricantParameters, lubricant_state


class TrainPlaces(NamedTuple):
    """Where the parts of `data`, `state` and `work` begin, and sizes; whole numbers."""

    numbers: int  # in data, of which it is the first
    memory: int
    plan: int  # whole numbers, bit by bit
    ports: int  # places of the ports in the state
    bodies: int  # number of the body of each speed; the first bears what the torques leave
    motion: int  # pairs of places, in the outputs and in the state
    exchanged: int  # likewise, in the outputs and in what EXCHANGE writes
    limits: int  # of the inputs, then of the ranges
    ranges: int  # places of the ranges in the outputs
    data_end: int
    # sizes
    states: int
    n_ports: int
    n_speeds: int
    n_motion: int
    n_exchanged: int
    n_bodies: int
    n_ranges: int
    inputs: int  # in state, behind that of the train; then the rate of the integrator's steps
    state_end: int
    own_memory: int  # in work, behind the limits
    trial: int
    scratch: int
    work_end: int
    outputs: int
    train_outputs: int  # the first of them, from a place in what WRITE writes
    written: int
    per_period: int


N_HEAD = len(TrainPlaces._fields)
_OIL = count_floats(LubricantParameters)
_FEWEST, _MOST_STEPS = 6, 4096  # integrator steps per highest period
# places of what CHECK gets: lengths of data and work, then `gl_sizes`
(
    _DATA, _WORK, _VARIABLES, _PARAMETERS, _INPUTS, _OUTPUTS, _STATE, _CONTROL_AT, _LIMITS_AT,
    _RANGES_AT, _RANGES, _CONTINUOUS, _INDICATORS, _INPUTS_AT,
) = range(14)  # fmt: skip
N_LENGTHS = 14


@kernel
def places_in(head: Offsets) -> TrainPlaces:
    """Return the places that stand before the constants."""
    return TrainPlaces(
        head[0],
        head[1],
        head[2],
        head[3],
        head[4],
        head[5],
        head[6],
        head[7],
        head[8],
        head[9],
        head[10],
        head[11],
        head[12],
        head[13],
        head[14],
        head[15],
        head[16],
        head[17],
        head[18],
        head[19],
        head[20],
        head[21],
        head[22],
        head[23],
        head[24],
        head[25],
        head[26],
    )


@kernel
def _parts_fit(at: TrainPlaces, lengths: Array) -> bool:
    """Whether the parts of data and work follow each other and have the sizes of the model."""
    n_inputs = at.n_ports + 1
    fits = at.numbers == N_HEAD and at.numbers + _OIL <= at.memory <= at.plan <= at.ports
    fits = fits and at.plan + FIRST_ROW <= at.ports and at.bodies - at.ports == at.n_ports
    fits = fits and at.motion - at.bodies == at.n_speeds >= 1
    fits = fits and at.exchanged - at.motion == 2 * at.n_motion
    fits = fits and at.limits - at.exchanged == 2 * at.n_exchanged
    fits = fits and at.own_memory == 2 * (n_inputs + at.n_ranges)
    fits = fits and at.ranges - at.limits == at.own_memory
    fits = fits and at.data_end - at.ranges == at.n_ranges and lengths[_DATA] == at.data_end
    fits = fits and at.trial - at.own_memory == at.plan - at.memory
    fits = fits and at.scratch - at.trial == at.states == at.inputs
    fits = fits and at.state_end == at.states + n_inputs + 1
    fits = fits and at.train_outputs + 1 <= at.outputs
    fits = fits and _FEWEST <= at.per_period <= _MOST_STEPS
    fits = fits and lengths[_WORK] == at.work_end and lengths[_STATE] == at.state_end
    fits = fits and lengths[_CONTROL_AT] == at.state_end - 1 and lengths[_INPUTS_AT] == at.inputs
    fits = fits and lengths[_PARAMETERS] == at.n_speeds and lengths[_INPUTS] == n_inputs
    fits = fits and lengths[_OUTPUTS] == at.outputs and lengths[_RANGES] == at.n_ranges
    return fits and lengths[_LIMITS_AT] == 0.0 and lengths[_RANGES_AT] == 2.0 * n_inputs


@kernel
def _places_fit(values: Array, at: TrainPlaces, sizes: Sizes) -> bool:
    """Whether places of ports, bodies, outputs and ranges lie in what they are places of."""
    exchanged = float(sizes.integrated + sizes.exchanged - 1)
    first, last = float(sizes.integrated), float(sizes.kept - 1)
    out, fits = float(at.outputs - 1), True
    for i in range(at.ports, at.bodies):
        fits = fits and is_whole(values[i], first, last)
    for i in range(at.bodies, at.motion):
        fits = fits and is_whole(values[i], 0.0, float(sizes.bodies - 1))
    for i in range(at.n_motion):
        to, of = values[at.motion + 2 * i], values[at.motion + 2 * i + 1]
        fits = fits and is_whole(to, 0.0, out) and is_whole(of, 0.0, float(sizes.states - 1))
    for i in range(at.n_exchanged):
        to, of = values[at.exchanged + 2 * i], values[at.exchanged + 2 * i + 1]
        fits = fits and is_whole(to, 0.0, out) and is_whole(of, 0.0, exchanged)
    for i in range(at.ranges, at.data_end):
        fits = fits and is_whole(values[i], 0.0, float(at.train_outputs - 1))
    return fits


@cache
def train_check() -> Callable[..., int]:
    """Return the kernel that gives 0 if constants can be used by the shared entry, else 1.

    It takes the C pointer to them and an array of N_LENGTHS lengths.
    """
    is_train = check_kernel(interpreted(shipped_kinds()))

    @kernel
    def check(data: Any, lengths: Array) -> int:
        if not N_HEAD <= lengths[_DATA] <= 2.0**31:
            return 1
        head = whole_at(data, N_HEAD)
        for i in range(N_HEAD):
            if not 0 <= head[i] <= 2**31:
                return 1
        at = places_in(head)
        if not _parts_fit(at, lengths):
            return 1
        plan = whole_at(pointer_at(data, at.plan), at.ports - at.plan)
        sizes = sizes_of(plan)
        numbers = array_at(pointer_at(data, at.numbers), at.memory - at.numbers)
        memory = array_at(pointer_at(data, at.memory), at.plan - at.memory)
        given: LubricantParameters = tuple_from_array(numbers, LubricantParameters)
        oil = lubricant_state(given, 330.0, FORMULA_LAWS)
        if not is_train(oil, numbers, memory, plan):
            return 1
        values = array_at(data, at.data_end)
        room = at.work_end - at.scratch
        fits = sizes.states == at.states and sizes.bodies == at.n_bodies
        fits = fits and room == work_size(sizes) and at.written == outputs_at(sizes)
        fits = fits and at.written + at.train_outputs <= room
        return 0 if fits and _places_fit(values, at, sizes) else 1

    return check
