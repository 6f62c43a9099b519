"""The helical pair for a native FMU: its entry over the kernels, and its constants."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from fmu_src.definition import Definition
from fmu_src.helical_pair import embedded_pair
from fmu_src.native import helical_parameters as layout
from fmu_src.native.helical_cases import (
    GIVEN_FLOATS,
    HEAD_FLOATS,
    OIL_FLOATS,
    CaseHead,
    check_cases,
    helical_cases,
    within_limits,
)
from fmu_src.native.model import OK, Exchange, NativeModel, Operation
from fmu_src.object_code import array_at, pointer_at, whole_at
from gearlube_core.dynamics.helical_model.model import (
    NO_EQUILIBRIUM_CURE,
    NO_FREQUENCIES_WORDS,
    WORDS,
    state_status,
)
from gearlube_core.dynamics.helical_model.outputs import (
    DURATION,
    EVENT_INDICATORS,
    MOTION_OUTPUTS,
    N_STATE,
    OUTPUT_NAMES,
    POWERS,
    SENSES,
    SPEED_REFERENCE,
    STATE_NAMES,
    STATE_PLACES,
    TORQUES,
    WHEEL_TORQUE,
    write_derivatives,
    write_motion,
    write_pair,
)
from gearlube_core.dynamics.helical_model.pair import N_NUMBERS
from gearlube_core.dynamics.helical_pair.gear_file_pair import USUAL_OIL
from gearlube_core.dynamics.helical_pair.march.gear_file_march import DENSITY_WITH_MESH_WORDS
from gearlube_core.dynamics.helical_pair.march.mesh_data import data_size
from gearlube_core.dynamics.helical_pair.supports import COUPLING_CURE
from gearlube_core.dynamics.helical_uncertain import uncertain_of
from gearlube_core.dynamics.train.assemble import Assembly
from gearlube_core.dynamics.train.choice import generated_kernel
from gearlube_core.dynamics.train.elements.helical_mesh_kernels import pair_data_at
from gearlube_core.dynamics.train.march import ADVANCE, EVENT, EXCHANGE, START, WRITE
from gearlube_core.dynamics.train.rest_search import NO_REST
from gearlube_core.dynamics.train.stepped_model import REVERSED, REVERSED_WORDS, put_speed
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_laws import AranaShare
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.oil.lubricant import Lubricant

_START, _STEP, _, _RESUME, _MOTION, _DERIVATIVES, _EVENT = map(int, tuple(Operation)[:7])
_CHECK = int(Operation.CHECK)


def _entry(made: Assembly) -> Callable[..., int]:
    """Return the entry of pairs in an oil with the laws of that of this train."""
    operate = generated_kernel(made)

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
            literals = array_at(inputs, layout.N_PARAMETERS)
            return check_cases(data, array_at(parameters, 2), literals, layout.PLACES)
        given = array_at(parameters, layout.N_PARAMETERS)
        fixed = array_at(work, layout.MEMORY_AT)
        if operation in (_START, _RESUME):
            number = layout.case_number(given)
            if array_at(data, layout.FILM_MODELS_AT)[number] == 0.0:
                return layout.MISSING_CASE + number
            fixed[layout.CASE_AT] = array_at(data, layout.FILM_MODELS_AT)[number]
        place = int(fixed[layout.CASE_AT])
        head = tuple_from_array(array_at(pointer_at(data, place), HEAD_FLOATS), CaseHead)
        stations, levels, size = int(head.stations), int(head.levels), int(head.size)
        at = pair_data_at(levels, size)
        memory = array_at(pointer_at(work, layout.MEMORY_AT), at + data_size(stations, size))
        plan = whole_at(pointer_at(work, layout.PLAN_AT), layout.PLAN.size)
        if operation in (_START, _RESUME):
            own_model = N_ARRAY if given[layout.GEAR] == layout.CUSTOM_GEAR else 0
            oil_at = layout.OILS_AT + OIL_FLOATS * (int(given[layout.OIL]) - 1)
            status = layout.take_parameters(
                given,
                array_at(pointer_at(data, oil_at), OIL_FLOATS),
                array_at(pointer_at(data, layout.FILM_MODELS_AT + own_model), N_ARRAY),
                array_at(pointer_at(data, place), HEAD_FLOATS + GIVEN_FLOATS),
                array_at(work, layout.PLAN_AT),
                part(memory, at, memory.size - at),
            )
            if status != OK:
                return status
            block = pointer_at(data, place + HEAD_FLOATS + GIVEN_FLOATS)
            n_block = stations + levels + 2 * levels * size
            layout.take_mesh(array_at(block, n_block), head, given[layout.DENSITY], memory, plan)
        if operation == _RESUME:
            return OK
        own = array_at(state, layout.STATE_SIZE)
        if operation != _START:
            status = state_status(own)
            if status != OK:
                return status
        wanted = array_at(inputs, layout.N_INPUTS)
        if operation in (_START, _STEP):
            if not within_limits(
                wanted, part(fixed, layout.LIMITS_AT, layout.RANGES_AT - layout.LIMITS_AT)
            ):
                return layout.INPUT_OUT_OF_RANGE
        else:
            wanted = array_at(pointer_at(state, layout.INPUTS_AT), layout.N_INPUTS)
        numbers = part(fixed, layout.NUMBERS_AT, N_NUMBERS)
        trial = part(fixed, layout.TRIAL_AT, N_STATE)
        scratch = part(fixed, layout.SCRATCH_AT, layout.MEMORY_AT - layout.SCRATCH_AT)
        bearings = part(fixed, layout.BEARINGS_AT, layout.GIVEN_AT - layout.BEARINGS_AT)
        out = array_at(outputs, len(OUTPUT_NAMES))
        teeth = fixed[layout.TEETH_AT]
        if operation == _MOTION and own[DURATION] > 0.0:  # before, powers are rates
            write_motion(own, scratch, teeth, bearings, out)
            return OK
        for i in range(N_STATE):
            trial[i] = 0.0 if operation == _START else own[i]
        trial[TORQUES], trial[WHEEL_TORQUE] = wanted[0], wanted[1]
        trial[SPEED_REFERENCE] = wanted[3]
        temperature = wanted[2]
        if operation == _DERIVATIVES:
            status = int(
                operate(EXCHANGE, trial, temperature, numbers, memory, plan, 0.0, 0.0, scratch)
            )
            if status == OK:
                write_derivatives(scratch, out)
            return status
        if operation == _EVENT:
            status = int(
                operate(EVENT, trial, temperature, numbers, memory, plan, 0.0, 0.0, scratch)
            )
        elif operation == _STEP:
            rate = own[layout.CONTROL_AT + 1] * own[layout.CONTROL_AT + 2]
            status = int(
                operate(ADVANCE, trial, temperature, numbers, memory, plan, step, rate, scratch)
            )
            status = state_status(trial) if status == OK else status
        elif operation == _START:
            if given[layout.HOLD] > 1.0 and wanted[3] * given[layout.SPEED] < 0.0:
                return REVERSED
            put_speed(-given[layout.SPEED], scratch)
            per_period = given[layout.PER_HIGHEST_PERIOD]
            status = int(
                operate(START, trial, temperature, numbers, memory, plan, per_period, 0.0, scratch)
            )
            if status != OK:
                return layout.NO_EQUILIBRIUM if status == NO_REST else layout.NO_FREQUENCIES
            trial[SPEED_REFERENCE] = wanted[3]  # which a start leaves out
            own[layout.CONTROL_AT] = given[layout.PER_MESH_PERIOD]
            own[layout.CONTROL_AT + 1] = per_period
            own[layout.CONTROL_AT + 2] = scratch[0] / per_period
        else:
            status = OK
        if status != OK:
            return status
        if operation in (_START, _STEP, _EVENT):
            for i in range(N_STATE):
                own[i] = trial[i]
            for i in range(layout.N_INPUTS):
                own[layout.INPUTS_AT + i] = wanted[i]
        if operation in (_STEP, _EVENT):
            return OK
        operate(WRITE, trial, temperature, numbers, memory, plan, 0.0, 0.0, scratch)
        free = layout.FREE_OF_FORM[int(given[layout.FORM]) - 1]
        write_pair(trial, free, teeth, bearings, scratch, out)
        return OK

    return entry


_PLAIN_ENTRY = _entry(layout.PAIR)


def native_model(definition: Definition) -> NativeModel:
    """Return the helical pair of a definition for a native FMU.

    Parameters
    ----------
    definition : Definition
        Of `fmu_src.helical_pair`, with the gear file and the line mesh that it carries.
    """
    cases = helical_cases(definition)
    embedded = embedded_pair(definition.resources)
    oil = embedded.oil if embedded else None
    own_laws = oil is not None and oil.own_laws()
    refusals = {
        **WORDS.refusals,
        layout.NO_EQUILIBRIUM: f"no static equilibrium at the pinion torque. {NO_EQUILIBRIUM_CURE}",
        layout.NO_FREQUENCIES: NO_FREQUENCIES_WORDS,
        REVERSED: REVERSED_WORDS,
        layout.INPUT_OUT_OF_RANGE: "an input is outside its limits",
        layout.DENSITY_WITH_LINE_MESH: DENSITY_WITH_MESH_WORDS,
        layout.COUPLING_TOO_LARGE: "a bearing of the gear file couples more than the given "
        f"stiffness allows. {COUPLING_CURE.removesuffix('.')}",
        **{layout.MISSING_CASE + number: words for number, words in cases.missing.items()},
    }
    return NativeModel(
        definition=definition,
        entry=_entry(layout.pair_assembly(oil)) if own_laws else _PLAIN_ENTRY,
        kind="" if own_laws else "laws of the package",
        make_data=lambda: cases.data,
        state_size=layout.STATE_SIZE,
        control_at=layout.CONTROL_AT,
        work_size=layout.MEMORY_AT + cases.longest_memory,
        limits_at=layout.LIMITS_AT,
        ranges_at=layout.RANGES_AT,
        ranges=cases.ranges,
        refusals=refusals,
        uncertain=tuple(
            one
            for one in uncertain_of(oil or Lubricant.named(USUAL_OIL), AranaShare())
            if one.name != "rolling"
        ),  # rolling of the flanks is not in the model
        motion=MOTION_OUTPUTS,
        exchange=Exchange(
            states=STATE_NAMES,
            places=tuple(STATE_PLACES.tolist()),
            units=tuple(SENSES.tolist()),
            indicators=EVENT_INDICATORS,
            inputs_at=layout.INPUTS_AT,
            of_states=MOTION_OUTPUTS - POWERS,
        ),
    )
