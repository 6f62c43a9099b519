"""Names of the axle's outputs, which are the FMU's public contract, and their places."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    ShaftBearings,
    ShaftMotion,
    bearing_loads,
)
from gearlube_core.dynamics.hypoid_axle.continuous import EVENT_INDICATORS, RATE_NAMES, STATE_NAMES
from gearlube_core.dynamics.hypoid_axle.rhs import AxleRaceways
from gearlube_core.dynamics.hypoid_axle.state import (
    BEARING_DAMPING,
    BEARING_TORQUE,
    BOUNDARY,
    CHURNING,
    DRAG_BOUND,
    FRICTION_BOUND,
    MESH_DAMPING,
    N_ENERGIES,
    PINION_WORK,
    ROLLING,
    SEALS,
    TIME_IN_STEP,
    VISCOUS,
    WHEEL_WORK,
    WORK_MARK,
)
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import FLANK_BOUNDS, FLANK_OUTPUTS
from gearlube_core.dynamics.mean_power import mean_power
from gearlube_core.dynamics.ranges import RANGE_EXCEEDED, RANGE_OUTPUTS
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Output
from gearlube_core.oil.lubricant import LubricantState

BEARING_QUANTITIES = ("force.x", "force.y", "force.z", "roller_load_max", "roller_load_min")
N_BEARINGS = 4  # two of the pinion, then two of the gear
BEARING_OUTPUTS = tuple(
    f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in BEARING_QUANTITIES
)

# places within the outputs of one bearing
FORCE = BEARING_QUANTITIES.index("force.x")
ROLLER_LOAD_MAX = BEARING_QUANTITIES.index("roller_load_max")
ROLLER_LOAD_MIN = BEARING_QUANTITIES.index("roller_load_min")
N_BEARING_QUANTITIES = len(BEARING_QUANTITIES)
# by solved films, in a group of their own
FILM_QUANTITIES = ("film_thickness", "film_bound")
BEARING_FILMS = tuple(
    f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in FILM_QUANTITIES
)
_OUTPUTS: tuple[str, ...] = (
    "pinion.angle",
    "wheel.angle",
    "pinion.speed",
    "wheel.speed",
    "pinion.acceleration",
    "wheel.acceleration",
    "mesh.dte",
    "mesh.force",
    "mesh.separated",
    "mesh.stiffness",
    "mesh.frequency",
    *FLANK_OUTPUTS,
    "friction.power_loss",
    "friction.power_loss_boundary",
    "bearing.power_loss",
    "churning.power_loss",
    "seal.power_loss",
    "friction.power_loss_rolling",
    "damping.power_loss",
    "efficiency",
    "axle.efficiency",
    "friction.power_loss_bound",
    "efficiency_bound",
    "bearing.power_loss_bound",
    "axle.efficiency_bound",
    *(f"{member}.displacement.{c}" for member in ("pinion", "wheel") for c in "xyz"),
    *BEARING_OUTPUTS,
    "bearing[1].roller[1].load",
    "bearing[1].cage.angle",
    "bearing[3].cage.angle",
    "energy.pinion_work",
    "energy.wheel_work",
    "energy.friction_viscous",
    "energy.friction_boundary",
    "energy.mesh_damping",
    "energy.bearing_damping",
    "energy.bearing_torque",
    "energy.churning",
    "energy.seals",
    "energy.friction_rolling",
    "energy.stored",
    *RANGE_OUTPUTS,
    "film.share_outside",
    *FLANK_BOUNDS,
    "bearing.share_outside",
    *BEARING_FILMS,
)
# outputs that the table of the FMU's variables takes from here, with unit and text
OWN_OUTPUTS: tuple[Output, ...] = ()
# for another integrator: the other states, the rates of all, and the event indicators
_OTHER_STATES = tuple(name for name in STATE_NAMES if name not in _OUTPUTS)
OUTPUT_NAMES = (
    *_OUTPUTS,
    *_OTHER_STATES,
    *RATE_NAMES,
    *EVENT_INDICATORS,
    *(one.name for one in OWN_OUTPUTS),
)
OUTPUT_INDEX = {name: index for index, name in enumerate(OUTPUT_NAMES)}
N_OUTPUTS = len(OUTPUT_NAMES)

# places of the outputs that the kernel writes by name
PINION_ANGLE = OUTPUT_INDEX["pinion.angle"]
WHEEL_ANGLE = OUTPUT_INDEX["wheel.angle"]
PINION_SPEED = OUTPUT_INDEX["pinion.speed"]
WHEEL_SPEED = OUTPUT_INDEX["wheel.speed"]
PINION_ACCELERATION = OUTPUT_INDEX["pinion.acceleration"]
WHEEL_ACCELERATION = OUTPUT_INDEX["wheel.acceleration"]
DTE = OUTPUT_INDEX["mesh.dte"]
MESH_FORCE = OUTPUT_INDEX["mesh.force"]
SEPARATED = OUTPUT_INDEX["mesh.separated"]
MESH_STIFFNESS = OUTPUT_INDEX["mesh.stiffness"]
MESH_FREQUENCY = OUTPUT_INDEX["mesh.frequency"]
FRICTION_LOSS = OUTPUT_INDEX["friction.power_loss"]
BOUNDARY_LOSS = OUTPUT_INDEX["friction.power_loss_boundary"]
BEARING_LOSS = OUTPUT_INDEX["bearing.power_loss"]
CHURNING_LOSS = OUTPUT_INDEX["churning.power_loss"]
SEAL_LOSS = OUTPUT_INDEX["seal.power_loss"]
ROLLING_LOSS = OUTPUT_INDEX["friction.power_loss_rolling"]
DAMPING_LOSS = OUTPUT_INDEX["damping.power_loss"]
EFFICIENCY = OUTPUT_INDEX["efficiency"]
AXLE_EFFICIENCY = OUTPUT_INDEX["axle.efficiency"]
LOSS_BOUND = OUTPUT_INDEX["friction.power_loss_bound"]
EFFICIENCY_BOUND = OUTPUT_INDEX["efficiency_bound"]
DRAG_LOSS_BOUND = OUTPUT_INDEX["bearing.power_loss_bound"]
AXLE_EFFICIENCY_BOUND = OUTPUT_INDEX["axle.efficiency_bound"]
FIRST_ROLLER = OUTPUT_INDEX["bearing[1].roller[1].load"]
PINION_CAGE = OUTPUT_INDEX["bearing[1].cage.angle"]
GEAR_CAGE = OUTPUT_INDEX["bearing[3].cage.angle"]
STORED_ENERGY = OUTPUT_INDEX["energy.stored"]
SHARE_OUTSIDE = OUTPUT_INDEX["film.share_outside"]
BEARING_SHARE_OUTSIDE = OUTPUT_INDEX["bearing.share_outside"]

# first place of a group of outputs of one kind
FLANKS = OUTPUT_INDEX[FLANK_OUTPUTS[0]]
FIRST_FLANK_BOUND = OUTPUT_INDEX[FLANK_BOUNDS[0]]
FIRST_BEARING_FILM = OUTPUT_INDEX[BEARING_FILMS[0]]
PINION_DISPLACEMENT = OUTPUT_INDEX["pinion.displacement.x"]
WHEEL_DISPLACEMENT = OUTPUT_INDEX["wheel.displacement.x"]
PINION_BEARINGS = OUTPUT_INDEX[BEARING_OUTPUTS[0]]
GEAR_BEARINGS = PINION_BEARINGS + 2 * N_BEARING_QUANTITIES
ENERGIES = OUTPUT_INDEX["energy.pinion_work"]  # in the order of the state
RANGES = OUTPUT_INDEX[RANGE_EXCEEDED]
PINION_VELOCITY = OUTPUT_INDEX["pinion.velocity.x"]
WHEEL_VELOCITY = OUTPUT_INDEX["wheel.velocity.x"]
LOAD_LEVEL = OUTPUT_INDEX["mesh.load_torque"]
RATES = OUTPUT_INDEX[RATE_NAMES[0]]  # in the order of the state
EVENTS = OUTPUT_INDEX[EVENT_INDICATORS[0]]

# what follows from the state and the mean mesh data alone
MOTION_OUTPUTS: tuple[str, ...] = (
    *OUTPUT_NAMES[:PINION_ACCELERATION],
    *OUTPUT_NAMES[DTE:FLANKS],
    *OUTPUT_NAMES[FRICTION_LOSS : AXLE_EFFICIENCY_BOUND + 1],
    *OUTPUT_NAMES[PINION_DISPLACEMENT : WHEEL_DISPLACEMENT + 3],
    OUTPUT_NAMES[PINION_CAGE],
    OUTPUT_NAMES[GEAR_CAGE],
    *OUTPUT_NAMES[ENERGIES : ENERGIES + N_ENERGIES],
    *_OTHER_STATES,
)

# what the right-hand side gives, besides what model exchange calls rates and event indicators
RATE_OUTPUTS: tuple[str, ...] = (
    OUTPUT_NAMES[PINION_ACCELERATION],
    OUTPUT_NAMES[WHEEL_ACCELERATION],
)
# what follows from the flanks alone, from raceways alone, and from bearings and mesh
FLANK_GROUP: tuple[str, ...] = (
    *FLANK_OUTPUTS,
    *FLANK_BOUNDS,
    OUTPUT_NAMES[SHARE_OUTSIDE],
    *RANGE_OUTPUTS,
)
RACEWAY_GROUP: tuple[str, ...] = (*BEARING_FILMS, OUTPUT_NAMES[BEARING_SHARE_OUTSIDE])
BEARING_GROUP: tuple[str, ...] = (
    *BEARING_OUTPUTS,
    OUTPUT_NAMES[FIRST_ROLLER],
    OUTPUT_NAMES[STORED_ENERGY],
)

# of motion, what an input changes at once while no step has been taken
POWERS = frozenset(OUTPUT_NAMES[FRICTION_LOSS : AXLE_EFFICIENCY_BOUND + 1])
_IDLE_WORK = 1e-12  # J; no efficiency is stated for less work


@kernel
def write_raceways(raceways: AxleRaceways, first: int, at_share: int, out: Array) -> None:
    """Write the thinnest film of each bearing with its bound, from `first` on.

    At `at_share` the share of the rollers' load outside the film model's domain. All zeros where
    no model tells them.
    """
    one, two = raceways.pinion, raceways.gear
    out[first] = one.first_film
    out[first + 1] = one.first_bound
    out[first + 2] = one.second_film
    out[first + 3] = one.second_bound
    out[first + 4] = two.first_film
    out[first + 5] = two.first_bound
    out[first + 6] = two.second_film
    out[first + 7] = two.second_bound
    load = one.load + two.load
    out[at_share] = (one.load_outside + two.load_outside) / load if load > 0.0 else 0.0


@kernel
def write_shaft(
    motion: ShaftMotion,
    f_ref: float,
    oil: LubricantState,
    bearings: ShaftBearings,
    first: int,
    axes: tuple[int, int, int],
    rollers: Array,
    out: Array,
) -> float:
    """Write forces and extreme roller loads of two bearings; return roller 1 of the first [N].

    Their outputs begin at `first`. `axes` are the places (0, 1, 2) of r1, r2 and the shaft in
    x, y, z; `rollers` is work space of shape (ROLLERS_MAX,).
    """
    first_roller = 0.0
    for k in range(2):
        side = 1.0 - 2.0 * k
        F_r1, F_r2, F_a, load, largest, smallest = bearing_loads(
            bearings, motion, f_ref, oil, side, rollers
        )
        base = first + k * N_BEARING_QUANTITIES
        out[base + FORCE + axes[0]] = F_r1
        out[base + FORCE + axes[1]] = F_r2
        out[base + FORCE + axes[2]] = F_a
        out[base + ROLLER_LOAD_MAX] = largest
        out[base + ROLLER_LOAD_MIN] = smallest
        if k == 0:
            first_roller = load
    return first_roller


@kernel
def write_losses(
    s: Array, rates: Array, friction_bound: float, drag_bound: float, out: Array
) -> None:
    """Write powers lost and efficiencies, averaged over the last communication step.

    The bounds are those of the power lost in flank friction and in the bearings [W], read before
    the first step only.

    Efficiency is 1 - loss/input with the work put in at the side that drives; 0 where no work is
    put in.

    References
    ----------
    [mohammadpour_2015 (20)] [mohammadpour_2015 (21)]
    """
    duration = s[TIME_IN_STEP]
    pinion = mean_power(s, rates, PINION_WORK, WORK_MARK, duration)
    wheel = mean_power(s, rates, WHEEL_WORK, WORK_MARK + 1, duration)
    viscous = mean_power(s, rates, VISCOUS, WORK_MARK + 2, duration)
    boundary = mean_power(s, rates, BOUNDARY, WORK_MARK + 3, duration)
    mesh = mean_power(s, rates, MESH_DAMPING, WORK_MARK + 4, duration)
    rollers = mean_power(s, rates, BEARING_DAMPING, WORK_MARK + 5, duration)
    drag = mean_power(s, rates, BEARING_TORQUE, WORK_MARK + 6, duration)
    churning = mean_power(s, rates, CHURNING, WORK_MARK + 7, duration)
    seals = mean_power(s, rates, SEALS, WORK_MARK + 8, duration)
    rolling = mean_power(s, rates, ROLLING, WORK_MARK + 9, duration)
    friction = viscous + boundary
    out[FRICTION_LOSS] = friction
    out[BOUNDARY_LOSS] = boundary
    out[BEARING_LOSS] = drag
    out[CHURNING_LOSS] = churning
    out[SEAL_LOSS] = seals
    out[ROLLING_LOSS] = rolling
    out[DAMPING_LOSS] = mesh + rollers
    out[EFFICIENCY] = 0.0
    out[AXLE_EFFICIENCY] = 0.0
    idle_power = _IDLE_WORK * (1.0 / duration) if duration > 0.0 else _IDLE_WORK
    put_in = pinion if pinion > 0.0 else -wheel
    if duration > 0.0:
        friction_bound = s[FRICTION_BOUND] * (1.0 / duration)
        drag_bound = s[DRAG_BOUND] * (1.0 / duration)
    out[LOSS_BOUND] = friction_bound
    out[DRAG_LOSS_BOUND] = drag_bound
    out[EFFICIENCY_BOUND] = 0.0
    out[AXLE_EFFICIENCY_BOUND] = 0.0
    if put_in > idle_power:
        out[EFFICIENCY_BOUND] = friction_bound / put_in
        out[AXLE_EFFICIENCY_BOUND] = (friction_bound + drag_bound) / put_in
        out[EFFICIENCY] = 1.0 - friction / put_in
        others = mesh + rollers + drag + churning + seals + rolling
        out[AXLE_EFFICIENCY] = 1.0 - (friction + others) / put_in
