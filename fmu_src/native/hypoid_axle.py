"""The native model of HypoidAxle.fmu: one entry over the train of the axle."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from fmu_src.axle_arguments import axle_parameters
from fmu_src.definition import Definition, Value
from fmu_src.hypoid_axle import car_axle_in
from fmu_src.native.axle_data import (
    N_SIZES,
    AxleStructure,
    DataSizes,
    axle_structure,
    check_axle_data,
    counting_floats,
    data_ends,
    kind_of_classes,
    memory_of_mesh,
    mesh_data,
    work_behind,
)
from fmu_src.native.axle_layout import (
    MODAL_WITHOUT_LOSS,
    PRINTED_FILM,
    AxlePlaces,
    axle_places,
    write_memory,
    write_parameters,
)
from fmu_src.native.axle_numbers import AxleTrain, axle_of_kind, write_numbers
from fmu_src.native.model import Exchange, Group, NativeModel, Operation
from fmu_src.native.parameter_map import (
    AxleSettings,
    KernelClasses,
    axle_settings,
    derived_places,
    parameter_map,
    place_of_each,
)
from fmu_src.object_code import array_at, pointer_at, whole_at
from fmu_src.variable import OF_HOLDER, OF_RUN
from gearlube_core.arrays import Array, Offsets
from gearlube_core.bearings.followed_shaft import SOLVED_FILMS
from gearlube_core.bearings.losses.race_rolling import roller_film_model
from gearlube_core.dynamics.hypoid_axle import output_names
from gearlube_core.dynamics.hypoid_axle.loss_band import loss_sensitivities
from gearlube_core.dynamics.hypoid_axle.model import (
    NO_EQUILIBRIUM_CURE,
    NO_MODES_WORDS,
    STEP_REFUSALS,
    state_status,
    take_speeds,
)
from gearlube_core.dynamics.hypoid_axle.output_names import N_OUTPUTS
from gearlube_core.dynamics.hypoid_axle.state import PINION_TORQUE, SPEED_REFERENCE, WHEEL_TORQUE
from gearlube_core.dynamics.hypoid_axle.train_outputs import (
    N_BAND,
    gather_group,
    gather_motion,
    gather_outputs,
    gather_rates,
)
from gearlube_core.dynamics.hypoid_axle.uncertain import uncertain_of
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters, without_losses
from gearlube_core.dynamics.hypoid_mesh.parameters import NO_MODAL_LOSS, PRINTED_WITH_SOLVED_FILM
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import AT_MEANS
from gearlube_core.dynamics.train.march import ADVANCE, EVENT, EXCHANGE, SHOW, START, WRITE
from gearlube_core.dynamics.train.rest_search import APART, LOOSE, NO_MODES, NO_REST, OK
from gearlube_core.dynamics.train.stepped_model import REVERSED, REVERSED_WORDS, put_speed
from gearlube_core.film_model.model import FLANK, shipped_model
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_film import N_FLANK_MODEL, flank_film_model
from gearlube_core.kernels.flat_tuples import flatten, tuple_from_array
from gearlube_core.kernels.jit import kernel

_NO_EQUILIBRIUM = f"no static equilibrium at this pinion torque. {NO_EQUILIBRIUM_CURE}"
REFUSALS: Mapping[int, str] = {
    **STEP_REFUSALS,
    **dict.fromkeys((LOOSE, APART, NO_REST), _NO_EQUILIBRIUM),
    NO_MODES: NO_MODES_WORDS,
    MODAL_WITHOUT_LOSS: NO_MODAL_LOSS,
    PRINTED_FILM: PRINTED_WITH_SOLVED_FILM,
    REVERSED: REVERSED_WORDS,
}
_START, _STEP, _, _RESUME, _MOTION, _DERIVATIVES, _EVENT = map(int, tuple(Operation)[:7])
_SHOW, _CHECK = map(int, tuple(Operation)[7:])
_RATES, _FLANKS, _BEARINGS = map(int, Group)
_N_INPUTS = 4


def _entry(
    kinds: KernelClasses,
    axle: AxleTrain,
    at: AxlePlaces,
    n_parameters: int,
    of_run: tuple[int, int, int],
    structure: AxleStructure,
    counting: Array,
) -> Callable[..., int]:
    """Return the entry of a model with these bearings and flanks.

    `at` says how its data and work lie, `of_run` where among the parameters the start speed
    and the holder stand, and how many the latter has; the last two, what the data must be like.
    """
    bearing, law = kinds
    operate, numbers_of, base_plan = axle.operate, axle.numbers, axle.plan
    mesh_sizes, roller_films, behind = axle.mesh_sizes, axle.roller_films, axle.behind
    mesh_memory, at_mesh, films = axle.mesh_memory, axle.mesh, axle.films
    outputs_of, motion_of = axle.outputs, axle.motion
    of_flanks, of_bearings = axle.of_flanks, axle.of_bearings
    bits = axle.bits
    at_control, state_size = at.states + _N_INPUTS, at.states + _N_INPUTS + 1
    sizes = axle.sizes
    at_speed, at_holder, n_holder = of_run

    @kernel
    def write_plan(
        head: DataSizes, settings: AxleSettings, law_of_drag: float, plan: Offsets
    ) -> None:
        for i in range(plan.size):
            plan[i] = base_plan[i]
        of_mesh = memory_of_mesh(head)
        plan[mesh_memory] = of_mesh
        for i in range(behind.size):
            plan[behind[i]] += of_mesh
        plan[mesh_sizes] = int(head.levels)
        plan[mesh_sizes + 1] = int(head.orders)
        plan[mesh_sizes + 2] = int(head.nodes)
        plan[mesh_sizes + 3] = int(head.series)
        plan[mesh_sizes + 4] = N_FLANK_MODEL if settings.solved != 0.0 else 0
        for i in range(roller_films.size):
            plan[roller_films[i]] = N_ARRAY if law_of_drag == SOLVED_FILMS else 0

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
            literals = array_at(inputs, n_parameters)
            return check_axle_data(data, array_at(parameters, 2), structure, literals, counting)
        head: DataSizes = tuple_from_array(array_at(data, N_SIZES), DataSizes)
        ends = data_ends(at.options, head)
        work_end = at.series + work_behind(head, at.others)
        values = array_at(work, work_end)
        kept = array_at(state, state_size)
        given = array_at(inputs, _N_INPUTS)
        out = array_at(outputs, N_OUTPUTS)
        at_memory = at.series + int(head.series)
        memory = array_at(pointer_at(work, at_memory), work_end - at_memory)
        plan = whole_at(pointer_at(work, at.plan), at.n_plan)
        numbers = array_at(pointer_at(work, at.own_numbers), at.n_numbers)
        scratch = array_at(pointer_at(work, at.scratch), at.series - at.scratch)
        s = array_at(state, at.states)
        band = array_at(pointer_at(data, at.options - N_BAND), N_BAND)
        if operation in (_START, _RESUME):
            constants = array_at(data, ends.windows)
            given_parameters = array_at(parameters, n_parameters)
            status = write_parameters(given_parameters, constants, at, ends, bearing, law, values)
            if status != OK:
                return status
            settings: AxleSettings = tuple_from_array(values[at.settings :], AxleSettings)
            p: AxleParameters = tuple_from_array(values, AxleParameters, bearing, law)
            without = values[at.without_losses : at.own_numbers]
            at_rest = array_at(pointer_at(work, at.at_rest), at.n_numbers)
            for i in range(at.n_numbers):
                numbers[i] = at_rest[i] = constants[at.numbers + i]
            write_numbers(values, p, settings, numbers_of, 1.0, numbers)
            for i in range(n_holder):
                numbers[numbers_of.holder + i] = given_parameters[at_holder + i]
            write_numbers(without, p, settings, numbers_of, 0.0, at_rest)
            write_memory(settings, constants, head, ends, at, films, memory)
            write_plan(head, settings, p.drag, plan)
            if operation == _RESUME:
                return OK
            trial = array_at(pointer_at(work, at.trial), at.states)
            for i in range(at.states):
                trial[i] = 0.0
            speed = given_parameters[at_speed]
            if given_parameters[at_holder] > 1.0 and given[3] * speed < 0.0:
                return REVERSED
            trial[PINION_TORQUE], trial[WHEEL_TORQUE] = given[0], given[1]
            put_speed(0.0, scratch)  # shafts do not turn yet
            memory[AT_MEANS] = 1.0
            per_period = settings.steps_per_highest_period
            status = int(
                operate(START, trial, given[2], at_rest, memory, plan, per_period, 0.0, scratch)
            )
            memory[AT_MEANS] = 0.0
            if status != OK:
                return status
            take_speeds(trial, speed, p.ratio, given[0])
            trial[SPEED_REFERENCE] = given[3]
            for i in range(at.states):
                s[i] = trial[i]
            for i in range(_N_INPUTS):
                kept[at.states + i] = given[i]
            kept[at_control] = scratch[0]
        else:
            status = state_status(s)
            if status != OK:
                return status
        if operation == _MOTION and s[at.states - 1] > 0.0:  # before, powers are rates
            mesh: AxleParameters = tuple_from_array(values, AxleParameters, bearing, law)
            series = array_at(pointer_at(work, at.series), int(head.series))
            of_table = int(head.levels), int(head.orders), int(head.nodes), int(head.series), 0
            gather_motion(
                s,
                mesh.mesh,
                (*at_mesh, *of_table),
                memory,
                series,
                numbers,
                sizes,
                scratch,
                outputs_of,
                band,
                motion_of,
                out,
            )
            return OK
        # one call of the train for all: the compiler would copy its code for each
        own, todo, size, rate, groups = s, WRITE, 0.0, 0.0, 0
        torque_p, torque_g, reference = s[PINION_TORQUE], s[WHEEL_TORQUE], s[SPEED_REFERENCE]
        temperature = kept[at.states + 2]
        if operation == _STEP:
            own = array_at(pointer_at(work, at.trial), at.states)
            for i in range(at.states):
                own[i] = s[i]
            own[PINION_TORQUE], own[WHEEL_TORQUE], temperature = given[0], given[1], given[2]
            own[SPEED_REFERENCE] = given[3]
            todo, size, rate = ADVANCE, step, kept[at_control]
        else:  # a host may have set the inputs that stand behind the state
            s[PINION_TORQUE], s[WHEEL_TORQUE] = kept[at.states], kept[at.states + 1]
            s[SPEED_REFERENCE] = kept[at.states + 3]
        if operation == _EVENT:
            todo = EVENT
        elif operation in (_DERIVATIVES, _SHOW):
            groups = int(step) if operation == _SHOW else _RATES
            todo = EXCHANGE if groups & _RATES else SHOW
            if groups & _FLANKS:
                size += float(bits[0])
            if groups & _BEARINGS:
                size += float(bits[1])
                rate = 1.0  # the stored energy too
        status = int(operate(todo, own, temperature, numbers, memory, plan, size, rate, scratch))
        if todo == WRITE:
            gather_outputs(s, scratch, outputs_of, band, out)
            return OK
        if status == OK and groups & _RATES:
            gather_rates(s, scratch, outputs_of, out)
        if status == OK and groups & _FLANKS:
            gather_group(s, scratch, outputs_of, of_flanks, out)
        if status == OK and groups & _BEARINGS:
            gather_group(s, scratch, outputs_of, of_bearings, out)
        if status != OK:  # what is refused changes nothing
            s[PINION_TORQUE], s[WHEEL_TORQUE], s[SPEED_REFERENCE] = torque_p, torque_g, reference
        if status == OK and operation == _STEP:
            for i in range(at.states):
                s[i] = own[i]
            for i in range(_N_INPUTS):
                kept[at.states + i] = given[i]
        return status

    return entry


def native_model(definition: Definition) -> NativeModel:
    """Return the axle of a definition for a native FMU.

    Raises
    ------
    ParameterError
        The definition has a parameter whose effect no kernel of the entry knows.
    """
    by_default = car_axle_in(definition.resources).axle

    def pack(arguments: Mapping[str, Value]) -> Array:
        given = {name: value for name, value in arguments.items() if name not in OF_RUN}
        one = axle_parameters(given, by_default)
        return np.concatenate([flatten(one.kernel_parameters()), flatten(axle_settings(one))])

    p = by_default.kernel_parameters()
    kinds = KernelClasses(type(p.bearing_p), type(p.flank_law))
    place = place_of_each(kinds)
    found = parameter_map(definition.variables, pack, derived_places(place, p))
    packed_mesh, series, windows = mesh_data(by_default)
    axle = axle_of_kind(by_default, place)
    at = axle_places(found, place, axle)
    sizes = DataSizes.of(packed_mesh, found)
    unknown = tuple_from_array(np.full(at.settings, np.nan), AxleParameters, *kinds)

    def make_data() -> Array:
        return np.concatenate(
            [
                flatten(sizes),
                found.base,
                flatten(without_losses(unknown)),  # NaN where they stay
                axle.constants,
                flank_film_model(by_default.flank_film_model or shipped_model(FLANK)),
                roller_film_model("solved_films", by_default.roller_film_model),
                loss_sensitivities(by_default).ravel(),
                *found.arrays[1:],
                packed_mesh.levels,
                *series,
                *windows,
            ]
        )

    unnamed = replace(by_default, oil=replace(by_default.oil, name="the oil"))
    parameters = [v.argument for v in definition.variables if v.is_model_parameter]
    of_run = parameters.index("pinion_speed"), parameters.index(OF_HOLDER[0]), len(OF_HOLDER)
    laws = by_default.oil.own_laws()
    structure, counting = axle_structure(at, len(parameters)), counting_floats(place, at)
    words = (len(parameters), of_run, at, counting.tolist(), axle.words)
    states = at.states
    return NativeModel(
        definition=definition,
        entry=_entry(kinds, axle, at, len(parameters), of_run, structure, counting),
        kind="" if laws else kind_of_classes(kinds, words),
        make_data=make_data,
        state_size=states + _N_INPUTS + 1,
        control_at=states + _N_INPUTS,
        work_size=at.series + work_behind(sizes, at.others),
        limits_at=at.settings,
        ranges_at=int(place.ranges.torque_low),
        ranges=unnamed.ranges,
        refusals=REFUSALS,
        uncertain=uncertain_of(by_default),
        motion=frozenset(output_names.MOTION_OUTPUTS),
        groups={
            Group.RATES: frozenset(output_names.RATE_OUTPUTS),
            Group.FLANKS: frozenset(output_names.FLANK_GROUP),
            Group.BEARINGS: frozenset(output_names.BEARING_GROUP),
        },
        exchange=Exchange(
            states=output_names.STATE_NAMES,
            places=axle.state_places,
            units=axle.state_units,
            indicators=output_names.EVENT_INDICATORS,
            inputs_at=states,
            of_states=frozenset(output_names.MOTION_OUTPUTS) - output_names.POWERS,
        ),
    )
