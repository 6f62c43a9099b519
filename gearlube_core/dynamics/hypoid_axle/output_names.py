"""Names of the axle's outputs, which are the FMU's public contract, and their places."""

from __future__ import annotations

from gearlube_core.dynamics.hypoid_mesh.flank_outputs import FLANK_BOUNDS, FLANK_OUTPUTS
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS
from gearlube_core.dynamics.train.elements.held_port import PINION_HOLD_TORQUE
from gearlube_core.number import Output

# outputs that hold the continuous states, in the order of the state vector
STATE_NAMES: tuple[str, ...] = (
    "mesh.dte",
    "pinion.speed",
    "wheel.speed",
    "pinion.angle",
    "wheel.angle",
    *(
        f"{member}.{quantity}.{axis}"
        for member in ("pinion", "wheel")
        for quantity in ("displacement", "velocity")
        for axis in "xyz"
    ),
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
    "mesh.load_torque",
)
RATE_NAMES = tuple(f"der({name})" for name in STATE_NAMES)
# in micrometres: numbers of order 1, which solvers with a tolerance for roots expect
EVENT_INDICATORS = ("event.drive_flank", "event.coast_flank", "event.side")

BEARING_QUANTITIES = ("force.x", "force.y", "force.z", "roller_load_max", "roller_load_min")
N_BEARINGS = 4  # two of the pinion, then two of the gear
BEARING_OUTPUTS = tuple(
    f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in BEARING_QUANTITIES
)

# places within the outputs of one bearing
FORCE = BEARING_QUANTITIES.index("force.x")
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
_BAND = "end of the band of 95 % of the power lost in all, by its uncertain data"
OWN_OUTPUTS: tuple[Output, ...] = (
    Output("loss.low", "W", f"Lower {_BAND}", 100.0),
    Output("loss.high", "W", f"Upper {_BAND}", 100.0),
    PINION_HOLD_TORQUE,
)
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
PINION_ACCELERATION = OUTPUT_INDEX["pinion.acceleration"]
WHEEL_ACCELERATION = OUTPUT_INDEX["wheel.acceleration"]
DTE = OUTPUT_INDEX["mesh.dte"]
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
LOSS_LOW = OUTPUT_INDEX["loss.low"]
LOSS_HIGH = OUTPUT_INDEX["loss.high"]
HOLD_TORQUE = OUTPUT_INDEX[PINION_HOLD_TORQUE.name]
FIRST_ROLLER = OUTPUT_INDEX["bearing[1].roller[1].load"]
PINION_CAGE = OUTPUT_INDEX["bearing[1].cage.angle"]
GEAR_CAGE = OUTPUT_INDEX["bearing[3].cage.angle"]
STORED_ENERGY = OUTPUT_INDEX["energy.stored"]
SHARE_OUTSIDE = OUTPUT_INDEX["film.share_outside"]
BEARING_SHARE_OUTSIDE = OUTPUT_INDEX["bearing.share_outside"]

# first place of a group of outputs of one kind
FLANKS = OUTPUT_INDEX[FLANK_OUTPUTS[0]]
PINION_DISPLACEMENT = OUTPUT_INDEX["pinion.displacement.x"]
WHEEL_DISPLACEMENT = OUTPUT_INDEX["wheel.displacement.x"]
PINION_BEARINGS = OUTPUT_INDEX[BEARING_OUTPUTS[0]]
ENERGIES = OUTPUT_INDEX["energy.pinion_work"]  # in the order of the state
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
    *OUTPUT_NAMES[ENERGIES:STORED_ENERGY],
    *_OTHER_STATES,
    *OUTPUT_NAMES[LOSS_LOW : LOSS_HIGH + 1],
)

# what the right-hand side gives, besides what model exchange calls rates and event indicators
RATE_OUTPUTS: tuple[str, ...] = (
    OUTPUT_NAMES[PINION_ACCELERATION],
    OUTPUT_NAMES[WHEEL_ACCELERATION],
    OUTPUT_NAMES[HOLD_TORQUE],
)
# what follows from the flanks alone, and from forces of bearings and stored energy; films of
# rollers are dear, and come with all outputs
FLANK_GROUP: tuple[str, ...] = (
    *FLANK_OUTPUTS,
    *FLANK_BOUNDS,
    OUTPUT_NAMES[SHARE_OUTSIDE],
    *RANGE_OUTPUTS,
)
BEARING_GROUP: tuple[str, ...] = (
    *BEARING_OUTPUTS,
    OUTPUT_NAMES[FIRST_ROLLER],
    OUTPUT_NAMES[STORED_ENERGY],
)

# of motion, what an input changes at once while no step has been taken
POWERS = frozenset(
    OUTPUT_NAMES[FRICTION_LOSS : AXLE_EFFICIENCY_BOUND + 1] + OUTPUT_NAMES[LOSS_LOW : LOSS_HIGH + 1]
)
