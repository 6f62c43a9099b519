"""The native model of a train: one entry over the kernel of its list."""

from __future__ import annotations

import hashlib
import inspect
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from fmu_src.native.model import OK, Exchange, NativeModel, Operation
from fmu_src.native.sources import fits_any_sizes
from fmu_src.native.train_data import N_HEAD, N_LENGTHS, TrainPlaces, places_in, train_check
from fmu_src.object_code import array_at, pointer_at, whole_at
from fmu_src.train import definition_with_train, train_ranges
from gearlube_core.arrays import Array
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.dynamics.train.choice import generated_kernel, interpreted_kernel, kernel_of
from gearlube_core.dynamics.train.element import BODY_STATES, RZ, W
from gearlube_core.dynamics.train.march import (
    ADVANCE,
    EVENT,
    EXCHANGE,
    REFUSALS,
    START,
    WRITE,
    work_size,
)
from gearlube_core.dynamics.train.model import MOST_TORQUE, Train
from gearlube_core.dynamics.train.outputs import outputs_at
from gearlube_core.dynamics.train.part import shipped_kinds
from gearlube_core.dynamics.train.rest_search import APART, LOOSE, NO_MODES, NO_REST
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.source_code import code_of
from gearlube_core.kernels.source_files import source_files

_NO_START = {
    LOOSE: "the start speeds leave bodies free. Give more in the train file, or connect the bodies",
    APART: "the start speeds do not fit together through meshes and shafts. Give one of them",
    NO_REST: "no static equilibrium. Reduce the torques, stiffen the supports, or give every body "
    "that may move along or about an axis a support there",
    NO_MODES: "natural frequencies at rest are not finite. Check masses and stiffness",
}
_START, _STEP, _OUTPUTS, _RESUME, _MOTION, _DERIVATIVES, _EVENT = map(int, tuple(Operation)[:7])
_CHECK = int(Operation.CHECK)


def _entry(operate: Callable[..., float], check: Callable[..., int]) -> Callable[..., int]:
    """Return the entry of trains whose kernel is `operate`; all sizes stand in the data."""

    def entry(
        operation: int,
        step: float,
        data: Any,
        parameters: Any,
        inputs: Any,
        state: Any,
        work: Any,
        outputs: Any,
    ) -> int:
        if operation == _CHECK:
            return int(check(data, array_at(parameters, N_LENGTHS)))
        at = places_in(whole_at(data, N_HEAD))
        fixed = array_at(data, at.data_end)
        numbers = array_at(pointer_at(data, at.numbers), at.memory - at.numbers)
        plan = whole_at(pointer_at(data, at.plan), at.ports - at.plan)
        room = array_at(work, at.work_end)
        memory = array_at(pointer_at(work, at.own_memory), at.trial - at.own_memory)
        if operation in (_START, _RESUME):
            for i in range(at.own_memory):
                room[i] = fixed[at.limits + i]
            for i in range(memory.size):
                memory[i] = fixed[at.memory + i]
            if operation == _RESUME:
                return OK
        kept = array_at(state, at.state_end)
        given = array_at(inputs, at.n_ports + 1)
        trial = array_at(pointer_at(work, at.trial), at.states)
        scratch = array_at(pointer_at(work, at.scratch), at.work_end - at.scratch)
        if operation not in (_START, _STEP):
            given = array_at(pointer_at(state, at.inputs), at.n_ports + 1)
        for i in range(at.states):
            trial[i] = 0.0 if operation == _START else kept[i]
        for i in range(at.n_ports):
            trial[int(fixed[at.ports + i])] = given[i]
        temperature = given[at.n_ports]
        if operation in (_START, _STEP):
            rate = 0.0
            if operation == _START:
                speeds = array_at(parameters, at.n_speeds)
                scratch[0] = fixed[at.bodies]
                for i in range(at.n_bodies):
                    scratch[1 + i] = np.nan
                for i in range(at.n_speeds):
                    scratch[1 + int(fixed[at.bodies + i])] = speeds[i]
                per_period = float(at.per_period)
                status = int(
                    operate(
                        START, trial, temperature, numbers, memory, plan, per_period, 0.0, scratch
                    )
                )
                rate = scratch[0]
            else:
                rate = kept[at.state_end - 1]
                status = int(
                    operate(ADVANCE, trial, temperature, numbers, memory, plan, step, rate, scratch)
                )
            if status != OK:
                return status
            for i in range(at.n_ports):  # again: a start leaves out what holds speeds
                trial[int(fixed[at.ports + i])] = given[i]
            for i in range(at.states):
                kept[i] = trial[i]
            for i in range(at.n_ports + 1):
                kept[at.inputs + i] = given[i]
            kept[at.state_end - 1] = rate
            if operation == _STEP:
                return OK
        out = array_at(outputs, at.outputs)
        if operation in (_MOTION, _OUTPUTS, _START):
            for i in range(at.n_motion):
                to, of = int(fixed[at.motion + 2 * i]), int(fixed[at.motion + 2 * i + 1])
                out[to] = kept[of]
        if operation == _MOTION:
            return OK
        if operation == _EVENT:
            status = int(
                operate(EVENT, trial, temperature, numbers, memory, plan, 0.0, 0.0, scratch)
            )
            for i in range(at.states if status == OK else 0):
                kept[i] = trial[i]
            return status
        if operation == _DERIVATIVES:
            status = int(
                operate(EXCHANGE, trial, temperature, numbers, memory, plan, 0.0, 0.0, scratch)
            )
        else:
            operate(WRITE, trial, temperature, numbers, memory, plan, 0.0, 0.0, scratch)
            status = OK
        for i in range(at.n_exchanged):
            to, of = int(fixed[at.exchanged + 2 * i]), int(fixed[at.exchanged + 2 * i + 1])
            out[to] = scratch[of]
        if operation == _DERIVATIVES:
            return status
        left, bit = 0.0, 1.0
        for i in range(at.train_outputs):
            out[i] = scratch[at.written + i]
        for i in range(at.n_ranges):
            value = out[int(fixed[at.ranges + i])]
            limits = 2 * (at.n_ports + 1 + i)
            if value != 0.0 and not room[limits] <= value <= room[limits + 1]:
                left += bit
            bit *= 2.0
        out[at.train_outputs] = left  # range.exceeded
        return OK

    return entry


def _motion(train: Train) -> dict[str, int]:
    """Return the outputs that stand in the state as they are, with their places."""
    found = {one.record.name: one.place for one in train.assembly.continuous}
    sizes = train.assembly.sizes
    for i, body in enumerate(train.bodies[: sizes.shown + sizes.nodes]):  # held ones too
        first = BODY_STATES * i
        found |= {f"{body.name}.angle": first + RZ, f"{body.name}.speed": first + W}
    return found


def train_model(path: str | Path) -> NativeModel:
    """Return the train of a train file for a native FMU, see `definition_with_train`."""
    definition, case = definition_with_train(path)
    train = case.train
    made = train.assembly
    names = [body.name for body in train.bodies]
    motion = _motion(train)
    pairs = [(definition.output_names.index(name), at) for name, at in motion.items()]
    of_rates = {f"der({one.record.name})": one.rate for one in made.continuous}
    of_rates |= {one.record.name: one.place for one in made.events}
    exchanged = [(definition.output_names.index(name), at) for name, at in of_rates.items()]
    oil = train.oil
    ranges = train_ranges(train)
    of_ranges = [end for one in ranges for end in (one.low, one.high)]
    ports = [*case.torques, *train.references]
    limits = [-MOST_TORQUE, MOST_TORQUE] * len(case.torques)
    limits += [-MAX_SPEED, MAX_SPEED] * len(train.references)
    parts = [
        made.numbers,
        made.memory,
        made.plan.view(float),
        np.array([train.place_of_input(name) for name in ports], float),
        np.array([names.index(name) for name in case.speeds], float),
        np.array(pairs, float).ravel(),
        np.array(exchanged, float).ravel(),
        np.array([*limits, oil.temperature_low, oil.temperature_high, *of_ranges]),
        np.array([definition.output_names.index(one.output) for one in ranges], float),
    ]
    starts = np.cumsum([N_HEAD, *(part.size for part in parts)]).tolist()
    n_inputs, states = len(ports) + 1, made.sizes.states
    own_memory = 2 * (n_inputs + len(ranges))
    trial = own_memory + made.memory.size
    scratch = trial + states
    room = work_size(made.sizes)
    at = TrainPlaces(
        **dict(zip(TrainPlaces._fields, starts, strict=False)),
        states=states,
        n_ports=len(ports),
        n_speeds=len(case.speeds),
        n_motion=len(pairs),
        n_exchanged=len(exchanged),
        n_bodies=len(names),
        n_ranges=len(ranges),
        inputs=states,
        state_end=states + n_inputs + 1,
        own_memory=own_memory,
        trial=trial,
        scratch=scratch,
        work_end=scratch + room,
        outputs=len(definition.output_names),
        train_outputs=len(made.outputs),
        written=outputs_at(made.sizes),
        per_period=train.steps_per_highest_period,
    )
    model = NativeModel(
        definition=definition,
        entry=None,
        make_data=lambda: np.concatenate([np.array(at, dtype=np.int64).view(float), *parts]),
        state_size=at.state_end,
        control_at=at.state_end - 1,
        work_size=at.work_end,
        limits_at=0,
        ranges_at=2 * n_inputs,
        ranges=ranges,
        refusals=REFUSALS | _NO_START,
        motion=frozenset(motion),
        exchange=Exchange(
            states=tuple(one.record.name for one in made.continuous),
            places=tuple(one.place for one in made.continuous),
            units=(1.0,) * len(made.continuous),
            indicators=tuple(one.record.name for one in made.events),
            inputs_at=at.inputs,
            of_states=frozenset(motion),
        ),
    )
    if kernel_of(made, train.driver) is interpreted_kernel() and fits_any_sizes(model):
        return replace(model, entry=_shared_entry(), kind=_kind(), any_sizes=True)
    return replace(model, entry=_entry(generated_kernel(made), _no_check))


@cache
def _shared_entry() -> Callable[..., int]:
    """Return the entry of all trains of the package's elements."""
    return _entry(interpreted_kernel(), train_check())


@kernel
def _no_check(data: Any, lengths: Array) -> int:
    return 1


@cache
def _kind() -> str:
    """Return what the shared library is compiled for: the elements with all that they import."""
    kinds = shipped_kinds()
    files = {inspect.getfile(one) for kind in kinds for one in (kind.numbers, *kind.variants)}
    imported = {path for file in files for path in source_files(file)}
    codes = sorted(code_of(Path(path).read_text("utf-8")) for path in imported)
    digest = hashlib.sha256("\0".join(codes).encode()).hexdigest()
    return f"{[str(kind) for kind in kinds]} {digest}"
