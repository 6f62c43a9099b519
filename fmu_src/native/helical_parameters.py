"""From FMI parameters of the helical pair to its train, and the layout of the work array."""

from __future__ import annotations

import numpy as np

from fmu_src.helical_variables import CUSTOM, HELICAL_PAIR
from fmu_src.native.helical_cases import (
    GIVEN_FLOATS,
    HEAD_FLOATS,
    STIFFNESS_MODELS,
    CaseHead,
    CasePlaces,
)
from fmu_src.native.model import OK
from fmu_src.variable import OF_HOLDER
from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.helical_model.model import FREE, StepControl
from gearlube_core.dynamics.helical_model.outputs import N_STATE
from gearlube_core.dynamics.helical_model.pair import (
    BEARING_FIELDS,
    N_BEARINGS,
    N_NUMBERS,
    helical_pair,
    write_bearing_shares,
    write_numbers,
)
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.helical_pair.march.given_pair import (
    GivenOil,
    GivenPair,
    MarchChoices,
    replace_bearings,
    write_constants,
)
from gearlube_core.dynamics.helical_pair.march.kept_films import forget
from gearlube_core.dynamics.helical_pair.march.mesh_data import FILM_AT, KEPT_AT, place_mesh
from gearlube_core.dynamics.helical_pair.march.parameters import FRICTION_FORMS, HELD, LINE_WORK
from gearlube_core.dynamics.ranges import MAX_SPEED, RangeLimits
from gearlube_core.dynamics.train.assemble import Assembly, assemble
from gearlube_core.dynamics.train.elements.helical_mesh_kernels import (
    TABLE,
    line_table,
    pair_data_at,
)
from gearlube_core.dynamics.train.march import work_size
from gearlube_core.dynamics.train.plan import OF_TABLES
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_laws import SOLVED
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import Lubricant

_PARAMETERS = {v.argument: v for v in HELICAL_PAIR if v.is_model_parameter}
_PLACE = {argument: place for place, argument in enumerate(_PARAMETERS)}
N_PARAMETERS = len(_PARAMETERS)
N_INPUTS = sum(v.causality == "input" for v in HELICAL_PAIR)
N_CONTROL = len(StepControl._fields)


def pair_assembly(oil: Lubricant | None = None) -> Assembly:
    """Return the train of a pair, whose list and sizes but those of tables are those of all."""
    given = helical_march_parameters(HelicalGearFile.named("he_2007"), oil=oil)
    return assemble(*helical_pair(given), given.oil, kinds=())


PAIR = pair_assembly()
PLAN = np.array(PAIR.shape)
# in the plan: first number of the mesh in the memory and how many, then the sizes of the mesh
_OF_TABLES = np.flatnonzero(PLAN == OF_TABLES)

# places of the parameters that kernels read
GEAR = _PLACE["gear_name"]
SPEED = _PLACE["pinion_speed"]
FRICTION = _PLACE["friction"]
OIL = _PLACE["oil"]
STIFFNESS_MODEL = _PLACE["stiffness_model"]
DENSITY = _PLACE["stiffness_density"]
SUPPORT_DAMPING = _PLACE["support_damping_ratio"]
RADIAL = _PLACE["radial_stiffness"]
AXIAL = _PLACE["axial_stiffness"]
DISTANCE = _PLACE["bearing_distance"]
FORM = _PLACE["form"]
EQUATIONS = _PLACE["equations"]
PER_MESH_PERIOD = _PLACE["steps_per_mesh_period"]
PER_HIGHEST_PERIOD = _PLACE["steps_per_highest_period"]
FILM = _PLACE["film"]
HOLD = _PLACE["mode"]  # with the others of OF_HOLDER behind

# places of the choices, of those that are parameters as they stand, and of these
_FORM_AT, _HELD_AT, _WORK_AT, _FILM_CHOICE = (
    MarchChoices._fields.index(name) for name in ("friction_form", "held", "line_work", "film")
)
_CHOSEN = np.array([i for i, name in enumerate(MarchChoices._fields) if name in _PLACE])
_CHOSEN_FROM = np.array([_PLACE[name] for name in MarchChoices._fields if name in _PLACE])

# numbers of the options, by their literals
_GEARS = len(_PARAMETERS["gear_name"].literals)
CUSTOM_GEAR = _PARAMETERS["gear_name"].literals.index(CUSTOM) + 1.0
FILM_MODELS_AT = _GEARS * STIFFNESS_MODELS  # of shipped pairs, then of the custom one
OILS_AT = FILM_MODELS_AT + 2 * N_ARRAY
_FRICTIONS = np.array([FRICTION_FORMS[literal] for literal in _PARAMETERS["friction"].literals])
_HELD = np.array([HELD[literal] for literal in _PARAMETERS["form"].literals])
FREE_OF_FORM = np.array([FREE[literal] for literal in _PARAMETERS["form"].literals])
_LINE_WORK = np.array([LINE_WORK[literal] for literal in _PARAMETERS["equations"].literals])

# places in the state
INPUTS_AT = N_STATE
CONTROL_AT = N_STATE + N_INPUTS
STATE_SIZE = CONTROL_AT + N_CONTROL

# number of pinion teeth among the floats of GivenPair
_TEETH = int(tuple_from_array(np.arange(float(GIVEN_FLOATS)), GivenPair).teeth)

# places in the work array
CASE_AT = 0
LIMITS_AT = 1
RANGES_AT = LIMITS_AT + 2 * N_INPUTS
BEARINGS_AT = RANGES_AT + count_floats(RangeLimits)
GIVEN_AT = BEARINGS_AT + N_BEARINGS * BEARING_FIELDS
TEETH_AT = GIVEN_AT + _TEETH
CHOICES_AT = GIVEN_AT + GIVEN_FLOATS
NUMBERS_AT = CHOICES_AT + count_floats(MarchChoices)
PLAN_AT = NUMBERS_AT + N_NUMBERS  # whole numbers
TRIAL_AT = PLAN_AT + PLAN.size
SCRATCH_AT = TRIAL_AT + N_STATE
MEMORY_AT = SCRATCH_AT + int(work_size(PAIR.sizes))

# statuses beyond those of a step
NO_EQUILIBRIUM = 4
NO_FREQUENCIES = 5
INPUT_OUT_OF_RANGE = 6
DENSITY_WITH_LINE_MESH = 7
COUPLING_TOO_LARGE = 8
MISSING_CASE = 10  # and its number

PLACES = CasePlaces(FILM_MODELS_AT, OILS_AT, OIL, MEMORY_AT)


@kernel
def case_number(parameters: Array) -> int:
    """Return the number of gear.name with mesh.stiffness_model, see `helical_cases`."""
    gear = int(parameters[GEAR]) - 1
    return gear * STIFFNESS_MODELS + int(parameters[STIFFNESS_MODEL]) - 1


@kernel
def take_parameters(
    parameters: Array, oil: Array, film_model: Array, case: Array, work: Array, data: Array
) -> int:
    """Write what follows from the FMI parameters, but for plan and line mesh; return a status.

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
        Up to the plan.
    data : ndarray
        Pair data in the memory of the mesh.
    """
    if parameters[STIFFNESS_MODEL] != 1.0 and parameters[DENSITY] > 0.0:
        return DENSITY_WITH_LINE_MESH
    given = part(work, GIVEN_AT, GIVEN_FLOATS)
    if not replace_bearings(
        case[HEAD_FLOATS:], parameters[RADIAL], parameters[AXIAL], parameters[DISTANCE], given
    ):
        return COUPLING_TOO_LARGE
    choices = part(work, CHOICES_AT, NUMBERS_AT - CHOICES_AT)
    for i in range(_CHOSEN.size):
        choices[_CHOSEN[i]] = parameters[_CHOSEN_FROM[i]]
    choices[_FORM_AT] = _FRICTIONS[int(parameters[FRICTION]) - 1]
    choices[_HELD_AT] = _HELD[int(parameters[FORM]) - 1]
    choices[_WORK_AT] = _LINE_WORK[int(parameters[EQUATIONS]) - 1]
    choices[_FILM_CHOICE] = parameters[FILM] - 1.0
    write_constants(given, oil, choices, data)
    solved = parameters[FILM] - 1.0 == SOLVED
    for i in range(N_ARRAY):
        data[FILM_AT + i] = film_model[i] if solved else 0.0
    forget(data[KEPT_AT:])
    of_oil: GivenOil = tuple_from_array(oil, GivenOil)
    numbers = part(work, NUMBERS_AT, N_NUMBERS)
    holder = part(parameters, HOLD, len(OF_HOLDER))
    write_numbers(given, of_oil.parameters, choices, parameters[PER_MESH_PERIOD], holder, numbers)
    shares = part(work, BEARINGS_AT, GIVEN_AT - BEARINGS_AT)
    write_bearing_shares(given, parameters[SUPPORT_DAMPING], shares)
    for i in range(BEARINGS_AT - RANGES_AT):
        work[RANGES_AT + i] = data[FILM_AT - (BEARINGS_AT - RANGES_AT) + i]
    head: CaseHead = tuple_from_array(case, CaseHead)
    limits = part(work, LIMITS_AT, RANGES_AT - LIMITS_AT)
    limits[0] = head.pinion_low
    limits[1] = head.pinion_high
    limits[2] = -head.wheel
    limits[3] = head.wheel
    limits[4] = of_oil.ranges.temperature_low
    limits[5] = of_oil.ranges.temperature_high
    limits[6], limits[7] = -MAX_SPEED, MAX_SPEED
    return OK


@kernel
def take_mesh(block: Array, head: CaseHead, density: float, memory: Array, plan: Offsets) -> None:
    """Write the line mesh into the memory of the mesh, and the plan of the train.

    Parameters
    ----------
    block : ndarray
        Stations, torque levels, density and offset of a case.
    head : CaseHead
    density : float
        Of all lines [N/m2]; 0: that of the case.
    memory : ndarray
    plan : ndarray
    """
    stations, levels, size = int(head.stations), int(head.levels), int(head.size)
    at, n = pair_data_at(levels, size), levels * size
    table = line_table(memory, levels, size)
    for i in range(TABLE):
        memory[i] = 0.0
    for i in range(levels):
        table[0][i] = block[stations + i]
    for i in range(n):
        row, column, first = i // size, i % size, stations + levels + i
        table[1][row, column] = density if density > 0.0 else block[first]
        table[2][row, column] = block[first + n]
    for i in range(PLAN.size):
        plan[i] = PLAN[i]
    sizes = (0, memory.size, levels, size, at, memory.size - at)
    for i in range(_OF_TABLES.size):
        plan[_OF_TABLES[i]] = sizes[i]
    place_mesh(part(block, 0, stations), table, part(memory, at, memory.size - at))
