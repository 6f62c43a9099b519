"""The helical pair for a native FMU: its entry over the kernels, and its constants."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from fmu_src.definition import Definition
from fmu_src.helical_pair import embedded_pair
from fmu_src.helical_variables import CUSTOM, HELICAL_PAIR
from fmu_src.native.helical_cases import (
    GIVEN_FLOATS,
    HEAD_FLOATS,
    OIL_FLOATS,
    STIFFNESS_MODELS,
    CaseHead,
    CasePlaces,
    check_cases,
    helical_cases,
    within_limits,
)
from fmu_src.native.model import OK, Exchange, NativeModel, Operation
from fmu_src.object_code import array_at, matrix_at, pointer_at
from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march import equilibrium, integrate
from gearlube_core.dynamics.helical_pair.march.communication import (
    state_status,
    step_without_outputs,
)
from gearlube_core.dynamics.helical_pair.march.continuous import (
    EVENT_INDICATORS,
    STATE_NAMES,
    event,
)
from gearlube_core.dynamics.helical_pair.march.equilibrium import (
    EQUILIBRIUM_WORK,
    highest_frequency,
    rest,
)
from gearlube_core.dynamics.helical_pair.march.flanks import LINES_MAX, MarchConstants
from gearlube_core.dynamics.helical_pair.march.gear_file_march import DENSITY_WITH_MESH_WORDS
from gearlube_core.dynamics.helical_pair.march.given_pair import (
    BEARING_FIELDS,
    N_BEARINGS,
    GivenOil,
    MarchChoices,
    replace_bearings,
    write_bearing_shares,
    write_constants,
)
from gearlube_core.dynamics.helical_pair.march.integrate import WORK_SIZE, StepControl
from gearlube_core.dynamics.helical_pair.march.kept_films import forget
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    FILM_AT,
    KEPT_AT,
    LEAST_OFFSET,
    data_size,
    place_mesh,
)
from gearlube_core.dynamics.helical_pair.march.model import (
    NO_EQUILIBRIUM_CURE,
    NO_FREQUENCIES_WORDS,
    WORDS,
)
from gearlube_core.dynamics.helical_pair.march.outputs import (
    MOTION_OUTPUTS,
    N_OUTPUTS,
    POWERS,
    write_derivatives,
    write_motion,
    write_outputs,
)
from gearlube_core.dynamics.helical_pair.march.parameters import (
    FRICTION_FORMS,
    HELD,
    LINE_WORK,
)
from gearlube_core.dynamics.helical_pair.march.state import N_CONTINUOUS, N_STATE, TIME_IN_STEP
from gearlube_core.dynamics.helical_pair.supports import COUPLING_CURE
from gearlube_core.dynamics.ranges import RangeLimits
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_laws import SOLVED
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import OilLaws

_PARAMETERS = {v.argument: v for v in HELICAL_PAIR if v.is_model_parameter}
_PLACE = {argument: place for place, argument in enumerate(_PARAMETERS)}
N_PARAMETERS = len(_PARAMETERS)
N_INPUTS = sum(v.causality == "input" for v in HELICAL_PAIR)
N_CONTROL = len(StepControl._fields)

# places of the parameters that kernels read
GEAR = _PLACE["gear_name"]
SPEED = _PLACE["pinion_speed"]
FRICTION = _PLACE["friction"]
OIL = _PLACE["oil"]
STIFFNESS_MODEL = _PLACE["stiffness_model"]
DENSITY = _PLACE["stiffness_density"]
RADIAL = _PLACE["radial_stiffness"]
AXIAL = _PLACE["axial_stiffness"]
DISTANCE = _PLACE["bearing_distance"]
FORM = _PLACE["form"]
EQUATIONS = _PLACE["equations"]
PER_MESH_PERIOD = _PLACE["steps_per_mesh_period"]
PER_HIGHEST_PERIOD = _PLACE["steps_per_highest_period"]
FILM = _PLACE["film"]

# places of the choices, of those that are parameters as they stand, and of these
_FORM_AT, _HELD_AT, _WORK_AT, _FILM_CHOICE = (
    MarchChoices._fields.index(name) for name in ("friction_form", "held", "line_work", "film")
)
_CHOSEN = np.array([i for i, name in enumerate(MarchChoices._fields) if name in _PLACE])
_CHOSEN_FROM = np.array([_PLACE[name] for name in MarchChoices._fields if name in _PLACE])

# numbers of the options, by their literals
_GEARS = len(_PARAMETERS["gear_name"].literals)
_CUSTOM_GEAR = _PARAMETERS["gear_name"].literals.index(CUSTOM) + 1.0
_FILM_MODELS_AT = _GEARS * STIFFNESS_MODELS  # of shipped pairs, then of the custom one
_OILS_AT = _FILM_MODELS_AT + 2 * N_ARRAY
_FRICTIONS = np.array([FRICTION_FORMS[literal] for literal in _PARAMETERS["friction"].literals])
_HELD = np.array([HELD[literal] for literal in _PARAMETERS["form"].literals])
_LINE_WORK = np.array([LINE_WORK[literal] for literal in _PARAMETERS["equations"].literals])

# places in the state
INPUTS_AT = N_STATE
CONTROL_AT = N_STATE + N_INPUTS
STATE_SIZE = CONTROL_AT + N_CONTROL

# places in the work array
CASE_AT = 0
LIMITS_AT = 1
BEARINGS_AT = LIMITS_AT + 2 * N_INPUTS
GIVEN_AT = BEARINGS_AT + N_BEARINGS * BEARING_FIELDS
CHOICES_AT = GIVEN_AT + GIVEN_FLOATS
DENSITY_AT = CHOICES_AT + count_floats(MarchChoices)  # of stiffness model uniform
_UNIFORM_SIZE = 2 * LINES_MAX  # both ends of each line
TRIAL_AT = DENSITY_AT + _UNIFORM_SIZE
SCRATCH_AT = TRIAL_AT + N_STATE
_SCRATCH = max(WORK_SIZE, EQUILIBRIUM_WORK + N_STATE)
DATA_AT = SCRATCH_AT + _SCRATCH
RANGES_AT = DATA_AT + FILM_AT - count_floats(RangeLimits)

# statuses beyond those of `integrate.advance`
NO_EQUILIBRIUM = 4
NO_FREQUENCIES = 5
INPUT_OUT_OF_RANGE = 6
DENSITY_WITH_LINE_MESH = 7
COUPLING_TOO_LARGE = 8
MISSING_CASE = 10  # and its number

_START, _STEP, _, _RESUME, _MOTION, _DERIVATIVES, _EVENT = map(int, tuple(Operation)[:7])
_CHECK = int(Operation.CHECK)
_CASES_AT = _OILS_AT + OIL_FLOATS * len(_PARAMETERS["oil"].literals)
_PLACES = CasePlaces(_FILM_MODELS_AT, _CASES_AT, DATA_AT, _UNIFORM_SIZE)


@kernel
def case_number(parameters: Array) -> int:
    """Return the number of gear.name with mesh.stiffness_model, see `helical_cases`."""
    gear = int(parameters[GEAR]) - 1
    return gear * STIFFNESS_MODELS + int(parameters[STIFFNESS_MODEL]) - 1


@kernel
def take_parameters(
    parameters: Array, oil: Array, film_model: Array, case: Array, work: Array
) -> int:
    """Write what follows from the FMI parameters, but for the pair data's mesh; return a status.

    Parameters
    ----------
    parameters : ndarray of shape (N_PARAMETERS,)
    oil : ndarray
        GivenOil of the chosen one.
    film_model : ndarray
        Numbers of the film model of the chosen pair.
    case : ndarray
        CaseHead and GivenPair of the chosen case.
    work : ndarray
        Up to the end of the kept films in the pair data.
    """
    if parameters[STIFFNESS_MODEL] != 1.0 and parameters[DENSITY] > 0.0:
        return DENSITY_WITH_LINE_MESH
    given = work[GIVEN_AT:CHOICES_AT]
    if not replace_bearings(
        case[HEAD_FLOATS:], parameters[RADIAL], parameters[AXIAL], parameters[DISTANCE], given
    ):
        return COUPLING_TOO_LARGE
    choices = work[CHOICES_AT:DENSITY_AT]
    for i in range(_CHOSEN.size):
        choices[_CHOSEN[i]] = parameters[_CHOSEN_FROM[i]]
    choices[_FORM_AT] = _FRICTIONS[int(parameters[FRICTION]) - 1]
    choices[_HELD_AT] = _HELD[int(parameters[FORM]) - 1]
    choices[_WORK_AT] = _LINE_WORK[int(parameters[EQUATIONS]) - 1]
    choices[_FILM_CHOICE] = parameters[FILM] - 1.0
    constants = work[DATA_AT:]
    write_constants(given, oil, choices, constants)
    solved = parameters[FILM] - 1.0 == SOLVED
    for i in range(N_ARRAY):
        constants[FILM_AT + i] = film_model[i] if solved else 0.0
    forget(constants[KEPT_AT:])
    write_bearing_shares(given, constants, work[BEARINGS_AT:GIVEN_AT])
    head: CaseHead = tuple_from_array(case, CaseHead)
    of_oil: GivenOil = tuple_from_array(oil, GivenOil)
    limits = work[LIMITS_AT:BEARINGS_AT]
    limits[0] = head.pinion_low
    limits[1] = head.pinion_high
    limits[2] = -head.wheel
    limits[3] = head.wheel
    limits[4] = of_oil.ranges.temperature_low
    limits[5] = of_oil.ranges.temperature_high
    return OK


@kernel
def start(
    parameters: Array,
    inputs: Array,
    mesh: tuple[Array, Array, Array],
    pair_data: Array,
    trial: Array,
    scratch: Array,
    state: Array,
) -> int:
    """Write the state of static equilibrium, its inputs and its step control; return a status."""
    torque, temperature = inputs[0], inputs[2]
    status, _ = rest(trial, torque, parameters[SPEED], temperature, mesh, pair_data, scratch)
    if status != equilibrium.OK:
        return NO_EQUILIBRIUM
    before = scratch[EQUILIBRIUM_WORK : EQUILIBRIUM_WORK + N_STATE]
    for i in range(N_STATE):
        before[i] = trial[i]
    status, highest = highest_frequency(trial, torque, temperature, mesh, pair_data, scratch)
    if status != equilibrium.OK:
        return NO_EQUILIBRIUM if status == equilibrium.NO_EQUILIBRIUM else NO_FREQUENCIES
    for i in range(N_STATE):
        state[i] = before[i]
    for i in range(N_INPUTS):
        state[INPUTS_AT + i] = inputs[i]
    state[CONTROL_AT] = parameters[PER_MESH_PERIOD]
    state[CONTROL_AT + 1] = parameters[PER_HIGHEST_PERIOD]
    state[CONTROL_AT + 2] = highest
    return OK


def _entry(laws: tuple[OilLaws, ...]) -> Callable[..., int]:
    """Return the entry of pairs in an oil with these laws of its own, one tuple or none."""

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
            literals = array_at(inputs, N_PARAMETERS)
            return check_cases(data, array_at(parameters, 2), literals, _PLACES)
        given = array_at(parameters, N_PARAMETERS)
        fixed = array_at(work, DATA_AT)
        if operation in (_START, _RESUME):
            number = case_number(given)
            place = int(array_at(data, _FILM_MODELS_AT)[number])
            if place == 0:
                return MISSING_CASE + number
            fixed[CASE_AT] = place
            own_model = N_ARRAY if given[GEAR] == _CUSTOM_GEAR else 0
            oil_at = _OILS_AT + OIL_FLOATS * (int(given[OIL]) - 1)
            status = take_parameters(
                given,
                array_at(pointer_at(data, oil_at), OIL_FLOATS),
                array_at(pointer_at(data, _FILM_MODELS_AT + own_model), N_ARRAY),
                array_at(pointer_at(data, place), HEAD_FLOATS + GIVEN_FLOATS),
                array_at(work, DATA_AT + LEAST_OFFSET),
            )
            if status != OK:
                return status
        place = int(fixed[CASE_AT])
        head = tuple_from_array(array_at(pointer_at(data, place), HEAD_FLOATS), CaseHead)
        stations, levels, size = int(head.stations), int(head.levels), int(head.size)
        stations_at = place + HEAD_FLOATS + GIVEN_FLOATS
        levels_at = stations_at + stations
        densities_at = levels_at + levels
        uniform = given[STIFFNESS_MODEL] == 1.0
        densities = pointer_at(work, DENSITY_AT) if uniform else pointer_at(data, densities_at)
        mesh = (
            array_at(pointer_at(data, levels_at), levels),
            matrix_at(densities, levels, size),
            matrix_at(pointer_at(data, densities_at + levels * size), levels, size),
            *laws,
        )
        pair_data = array_at(pointer_at(work, DATA_AT), data_size(stations, size))
        if operation in (_START, _RESUME):
            if uniform:
                of_gear = array_at(pointer_at(data, densities_at), size)
                for i in range(size):
                    fixed[DENSITY_AT + i] = given[DENSITY] if given[DENSITY] > 0.0 else of_gear[i]
            place_mesh(array_at(pointer_at(data, stations_at), stations), mesh, pair_data)
        if operation == _RESUME:
            return OK
        wanted = array_at(inputs, N_INPUTS)
        trial = fixed[TRIAL_AT:SCRATCH_AT]
        scratch = fixed[SCRATCH_AT:DATA_AT]
        bearings = fixed[BEARINGS_AT:GIVEN_AT]
        out = array_at(outputs, N_OUTPUTS)
        own = array_at(state, STATE_SIZE)
        if operation != _START:
            status = state_status(own[:N_STATE])
            if status != OK:
                return status
        sets_inputs = operation in (_START, _STEP)
        if sets_inputs and not within_limits(wanted, fixed[LIMITS_AT:BEARINGS_AT]):
            return INPUT_OUT_OF_RANGE
        if operation == _STEP:
            control = own[CONTROL_AT:]
            status = step_without_outputs(
                own[:N_STATE], trial, step, wanted, mesh, pair_data, control, scratch
            )
            if status == integrate.OK:
                for i in range(N_INPUTS):
                    own[INPUTS_AT + i] = wanted[i]
            return status
        if operation == _START:
            status = start(given, wanted, mesh, pair_data, trial, scratch, own)
            if status != OK:
                return status
        if operation == _DERIVATIVES:
            last = own[INPUTS_AT:CONTROL_AT]
            write_derivatives(own[:N_STATE], last, mesh, pair_data, scratch, out)
            return OK
        if operation == _EVENT:
            event(own[:N_STATE], own[CONTROL_AT - 1], mesh, pair_data)
            return OK
        if operation == _MOTION and own[TIME_IN_STEP] > 0.0:  # before, powers are rates
            constants: MarchConstants = tuple_from_array(pair_data, MarchConstants)
            write_motion(own[:N_STATE], scratch, constants.teeth, bearings, out)
            return OK
        last = own[INPUTS_AT:CONTROL_AT]
        write_outputs(own[:N_STATE], last, mesh, pair_data, bearings, scratch, out)
        return OK

    return entry


_PLAIN_ENTRY = _entry(())


def native_model(definition: Definition) -> NativeModel:
    """Return the helical pair of a definition for a native FMU.

    Parameters
    ----------
    definition : Definition
        Of `fmu_src.helical_pair`, with the gear file and the line mesh that it carries.
    """
    cases = helical_cases(definition)
    embedded = embedded_pair(definition.resources)
    laws = embedded.oil.own_laws() if embedded and embedded.oil else ()
    refusals = {
        **WORDS.refusals,
        NO_EQUILIBRIUM: f"no static equilibrium at the pinion torque. {NO_EQUILIBRIUM_CURE}",
        NO_FREQUENCIES: NO_FREQUENCIES_WORDS,
        INPUT_OUT_OF_RANGE: "an input is outside its limits",
        DENSITY_WITH_LINE_MESH: DENSITY_WITH_MESH_WORDS,
        COUPLING_TOO_LARGE: "a bearing of the gear file couples more than the given stiffness "
        f"allows. {COUPLING_CURE.removesuffix('.')}",
        **{MISSING_CASE + number: words for number, words in cases.missing.items()},
    }
    return NativeModel(
        definition=definition,
        entry=_entry(laws) if laws else _PLAIN_ENTRY,
        kind="" if laws else "laws of the package",
        data=cases.data,
        state_size=STATE_SIZE,
        control_at=CONTROL_AT,
        work_size=DATA_AT + cases.longest_data,
        limits_at=LIMITS_AT,
        ranges_at=RANGES_AT,
        ranges=cases.ranges,
        refusals=refusals,
        motion=frozenset(MOTION_OUTPUTS),
        exchange=Exchange(
            states=STATE_NAMES,
            places=tuple(range(len(STATE_NAMES))),
            units=(1.0,) * N_CONTINUOUS,
            indicators=EVENT_INDICATORS,
            inputs_at=INPUTS_AT,
            of_states=frozenset(MOTION_OUTPUTS) - POWERS,
        ),
    )
