"""The native model of HypoidAxle.fmu: one entry over the kernels of `gearlube_core`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple, get_args

import numpy as np

from fmu_src.axle_arguments import axle_parameters
from fmu_src.definition import Definition, Value
from fmu_src.hypoid_axle import car_axle_in
from fmu_src.native.axle_data import (
    N_SIZES,
    AxleStructure,
    DataEnds,
    DataSizes,
    axle_structure,
    check_axle_data,
    counting_floats,
    data_ends,
    kind_of_classes,
    mesh_data,
    scratch_size,
)
from fmu_src.native.model import Exchange, NativeModel, Operation
from fmu_src.native.parameter_map import (
    AxleSettings,
    KernelClasses,
    ParameterMap,
    axle_settings,
    derived_places,
    parameter_map,
    place_of_each,
    write_packed,
)
from fmu_src.object_code import array_at, pointer_at
from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftBearings, write_derived
from gearlube_core.bearings.losses.race_rolling import roller_film_model
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.dynamics.hypoid_axle import output_names
from gearlube_core.dynamics.hypoid_axle.communication import axle_kernels, state_status
from gearlube_core.dynamics.hypoid_axle.continuous import (
    EVENT_INDICATORS,
    STATE_NAMES,
    UNITS_OF_STATES,
)
from gearlube_core.dynamics.hypoid_axle.force_derivatives import NO_MODES, NO_MODES_WORDS
from gearlube_core.dynamics.hypoid_axle.integrate import StepControl
from gearlube_core.dynamics.hypoid_axle.model import STEP_REFUSALS
from gearlube_core.dynamics.hypoid_axle.output_names import N_OUTPUTS
from gearlube_core.dynamics.hypoid_axle.start import NO_EQUILIBRIUM, NO_EQUILIBRIUM_CURE, OK
from gearlube_core.dynamics.hypoid_axle.state import N_STATE, TIME_IN_STEP
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters, without_losses
from gearlube_core.dynamics.hypoid_mesh.mesh_force import equivalent_mass, modal_damping
from gearlube_core.dynamics.hypoid_mesh.parameters import (
    NO_MODAL_LOSS,
    PRINTED_WITH_SOLVED_FILM,
    MeshStiffness,
)
from gearlube_core.film_model.model import FLANK, shipped_model
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_film import N_FLANK_MODEL, flank_film_model
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.kernels.flat_tuples import count_floats, flatten, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import OilLaws

MODAL_WITHOUT_LOSS, PRINTED_FILM = 6, 7  # statuses, beside those of the kernels
REFUSALS: Mapping[int, str] = {
    **STEP_REFUSALS,
    NO_EQUILIBRIUM: f"no static equilibrium at this pinion torque. {NO_EQUILIBRIUM_CURE}",
    NO_MODES: NO_MODES_WORDS,
    MODAL_WITHOUT_LOSS: NO_MODAL_LOSS,
    PRINTED_FILM: PRINTED_WITH_SOLVED_FILM,
}
_START, _STEP, _, _RESUME, _MOTION, _DERIVATIVES, _EVENT = map(int, tuple(Operation)[:7])
_CHECK = int(Operation.CHECK)
_FLANKS = int(Operation.FLANKS)  # the groups follow in the order of `communication`
_N_INPUTS = 3
_N_CONTROL = count_floats(StepControl)
_CONTROL_AT = N_STATE + _N_INPUTS
_STATE_SIZE = _CONTROL_AT + _N_CONTROL


class _Places(NamedTuple):
    """Where the parts of `data` and `work` begin; whole numbers, alike for all axles of a kind.

    In data `DataSizes` come first, then the packed floats of the start values. What has any length
    lies from the options on, see `data_ends`.
    """

    # in data
    lossless: int  # for each float of `AxleParameters` its value without losses, or NaN: unchanged
    film_model: int
    roller_model: int
    options: int
    # in work
    settings: int
    without_losses: int
    trial: int
    control: int
    rollers: int
    films: int  # the film models of flanks and rollers, whose numbers are written into
    roller_films: int
    scratch: int
    # packed floats that are written here or by the bearings
    preload_g: int
    modal_damping: int
    bearing_p: int
    bearing_g: int


_N_SETTINGS = count_floats(AxleSettings)
_STIFFNESSES = len(get_args(MeshStiffness))


@kernel
def _write_parameters(
    parameters: Array,
    data: Array,
    at: _Places,
    ends: DataEnds,
    bearing: type[ShaftBearings],
    law: type[FlankLaw],
    work: Array,
) -> int:
    """Write everything that follows from the FMI parameters into `work`; return a status."""
    write_packed(
        parameters,
        data[N_SIZES : at.lossless],
        data[at.options : ends.options],
        data[ends.options : ends.rows],
        data[ends.rows : ends.numbers],
        work,
    )
    p: AxleParameters = tuple_from_array(work, AxleParameters, bearing, law)
    settings: AxleSettings = tuple_from_array(work[at.settings :], AxleSettings)
    preload = p.preload_g if p.preload_g >= 0.0 else p.preload_p
    work[at.preload_g] = preload
    write_derived(p.bearing_p, p.preload_p, work[at.bearing_p :])
    write_derived(p.bearing_g, preload, work[at.bearing_g :])
    work[at.modal_damping] = 0.0
    if settings.modal != 0.0:
        mass = equivalent_mass(settings.mean_pinion_radius, p.ratio, p.I_p, p.I_g)
        work[at.modal_damping] = modal_damping(
            settings.modal_loss_factor, settings.reference_stiffness, mass
        )
    for i in range(at.settings):
        value = data[at.lossless + i]
        work[at.without_losses + i] = value if value == value else work[i]
    for i in range(at.scratch - at.films):
        work[at.films + i] = data[at.film_model + i]
    if settings.modal != 0.0 and settings.modal_loss_factor == 0.0:
        return MODAL_WITHOUT_LOSS
    if settings.solved != 0.0 and settings.own_film != 0.0:
        return PRINTED_FILM
    return OK


@kernel
def _chosen_mesh(ends: DataEnds, at: _Places, work: Array) -> tuple[int, int]:
    """Return where series and windows of the options that are set in `work` begin in data."""
    settings: AxleSettings = tuple_from_array(work[at.settings :], AxleSettings)
    variant = int(settings.radii) * _STIFFNESSES + int(settings.stiffness)
    series = ends.levels + variant * ends.series_size
    return series, ends.series + int(settings.pressure) * ends.windows_size


def _entry(
    kinds: KernelClasses,
    laws: tuple[OilLaws, ...],
    at: _Places,
    n_parameters: int,
    at_speed: int,
    structure: AxleStructure,
    counting: Array,
) -> Callable[..., int]:
    """Return the entry of a model with these bearings, flanks and own laws of the oil.

    `at` says how its data and work lie; the last two, what the data must be like.
    """
    bearing, law = kinds
    kernels = axle_kernels(bearing, law)
    static_state, step_control = kernels.static_state, kernels.step_control
    step_without_outputs, write_outputs = kernels.step_without_outputs, kernels.outputs
    motion_outputs, event = kernels.motion_outputs, kernels.event
    group_outputs = kernels.group_outputs
    continuous_rates = kernels.continuous_rates

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
        constants = array_at(data, ends.numbers)
        work_end = at.scratch + scratch_size(head)
        values = array_at(work, work_end)
        kept = array_at(state, _STATE_SIZE)
        given = array_at(inputs, _N_INPUTS)
        out = array_at(outputs, N_OUTPUTS)
        if operation in (_START, _RESUME):
            given_parameters = array_at(parameters, n_parameters)
            status = _write_parameters(given_parameters, constants, at, ends, bearing, law, values)
            if status != OK or operation == _RESUME:
                return status
        series, windows = _chosen_mesh(ends, at, values)
        mesh = (
            array_at(pointer_at(data, ends.numbers), int(head.levels)),
            array_at(pointer_at(data, series), ends.series_size),
            int(head.orders),
            array_at(pointer_at(data, windows), ends.windows_size),
            int(head.nodes),
            array_at(pointer_at(work, at.films), at.roller_films - at.films),
            array_at(pointer_at(work, at.roller_films), at.scratch - at.roller_films),
            *laws,
        )
        packed = values[0 : at.settings]
        s = kept[0:N_STATE]
        if operation not in (_START, _RESUME):
            status = state_status(s)
            if status != OK:
                return status
        trial = values[at.trial : at.control]
        rollers = values[at.rollers : at.films]
        scratch = values[at.scratch : work_end]
        if operation == _STEP:
            control = kept[_CONTROL_AT:_STATE_SIZE]
            status = step_without_outputs(s, trial, step, given, mesh, packed, control, scratch)
            if status == OK:
                for i in range(_N_INPUTS):
                    kept[N_STATE + i] = given[i]
            return status
        last = kept[N_STATE:_CONTROL_AT]
        if operation == _DERIVATIVES:
            continuous_rates(s, last, mesh, packed, scratch, out)
            return OK
        if operation == _EVENT:
            event(s, mesh, packed, scratch)
            return OK
        if operation == _START:
            settings: AxleSettings = tuple_from_array(values[at.settings :], AxleSettings)
            lossless = values[at.without_losses : at.trial]
            control = values[at.control : at.rollers]
            speed = array_at(parameters, n_parameters)[at_speed]
            status, _ = static_state(trial, speed, given, mesh, lossless, scratch)
            if status != OK:
                return status
            status = step_control(
                trial,
                settings.steps_per_mesh_period,
                settings.steps_per_highest_period,
                given,
                mesh,
                lossless,
                scratch,
                control,
            )
            if status != OK:
                return status
            for i in range(N_STATE):
                s[i] = trial[i]
            for i in range(_N_INPUTS):
                last[i] = given[i]
            for i in range(_N_CONTROL):
                kept[_CONTROL_AT + i] = control[i]
        if operation == _MOTION and s[TIME_IN_STEP] > 0.0:  # before, powers are rates
            motion_outputs(s, mesh, packed, scratch, out)
        elif operation >= _FLANKS:
            group_outputs(operation - _FLANKS, s, last, mesh, packed, scratch, rollers, out)
        else:
            write_outputs(s, last, mesh, packed, scratch, rollers, out)
        return OK

    return entry


def _places(found: ParameterMap, place: Any) -> _Places:
    """Return the layout of data and work; `place` is that of `place_of_each`."""
    n_parameters = flatten(place).size
    lossless = N_SIZES + found.base.size
    film_model = lossless + n_parameters
    roller_model = film_model + N_FLANK_MODEL
    without = n_parameters + _N_SETTINGS
    trial = without + n_parameters
    rollers = trial + N_STATE + _N_CONTROL
    films = rollers + ROLLERS_MAX
    roller_films = films + N_FLANK_MODEL
    scratch = roller_films + N_ARRAY
    return _Places(
        lossless=lossless,
        film_model=film_model,
        roller_model=roller_model,
        options=roller_model + N_ARRAY,
        settings=n_parameters,
        without_losses=without,
        trial=trial,
        control=trial + N_STATE,
        rollers=rollers,
        films=films,
        roller_films=roller_films,
        scratch=scratch,
        preload_g=int(place.preload_g),
        modal_damping=int(place.mesh.modal_damping),
        bearing_p=int(flatten(place.bearing_p)[0]),
        bearing_g=int(flatten(place.bearing_g)[0]),
    )


def native_model(definition: Definition) -> NativeModel:
    """Return the axle of a definition for a native FMU.

    Raises
    ------
    ParameterError
        The definition has a parameter whose effect no kernel of the entry knows.
    """
    by_default = car_axle_in(definition.resources).axle

    def pack(arguments: Mapping[str, Value]) -> Array:
        given = {name: value for name, value in arguments.items() if name != "pinion_speed"}
        one = axle_parameters(given, by_default)
        return np.concatenate([flatten(one.kernel_parameters()), flatten(axle_settings(one))])

    p = by_default.kernel_parameters()
    kinds = KernelClasses(type(p.bearing_p), type(p.flank_law))
    place = place_of_each(kinds)
    found = parameter_map(definition.variables, pack, derived_places(place, p))
    packed_mesh, series, windows = mesh_data(by_default)
    at = _places(found, place)
    sizes = DataSizes.of(packed_mesh, found)
    unknown = tuple_from_array(np.full(at.settings, np.nan), AxleParameters, *kinds)
    data = np.concatenate(
        [
            flatten(sizes),
            found.base,
            flatten(without_losses(unknown)),  # NaN where they stay
            flank_film_model(by_default.flank_film_model or shipped_model(FLANK)),
            roller_film_model("solved_films", by_default.roller_film_model),
            *found.arrays[1:],
            packed_mesh.levels,
            *series,
            *windows,
        ]
    )
    unnamed = replace(by_default, oil=replace(by_default.oil, name="the oil"))
    parameters = [v.argument for v in definition.variables if v.is_model_parameter]
    at_speed = parameters.index("pinion_speed")
    laws = by_default.oil.own_laws()
    structure, counting = axle_structure(at, len(parameters)), counting_floats(place, at)
    words = (len(parameters), at_speed, at, counting.tolist())
    return NativeModel(
        definition=definition,
        entry=_entry(kinds, laws, at, len(parameters), at_speed, structure, counting),
        kind="" if laws else kind_of_classes(kinds, words),
        data=data,
        state_size=_STATE_SIZE,
        control_at=_CONTROL_AT,
        work_size=at.scratch + scratch_size(sizes),
        limits_at=at.settings,
        ranges_at=int(place.ranges.torque_low),
        ranges=unnamed.ranges,
        refusals=REFUSALS,
        motion=frozenset(output_names.MOTION_OUTPUTS),
        groups={
            Operation.DERIVATIVES: frozenset(output_names.RATE_OUTPUTS),
            Operation.FLANKS: frozenset(output_names.FLANK_GROUP),
            Operation.BEARINGS: frozenset(output_names.BEARING_GROUP),
            Operation.RACEWAYS: frozenset(output_names.RACEWAY_GROUP),
        },
        exchange=Exchange(
            states=STATE_NAMES,
            places=tuple(range(len(STATE_NAMES))),
            units=UNITS_OF_STATES,
            indicators=EVENT_INDICATORS,
            inputs_at=N_STATE,
            of_states=frozenset(output_names.MOTION_OUTPUTS) - output_names.POWERS,
        ),
    )
