"""Names of the axle's outputs; the same names are the FMU's public contract."""

from __future__ import annotations

FLANK_QUANTITIES = (
    "load",
    "film_thickness",
    "film_ratio",
    "friction_coefficient",
    "temperature",
)
BEARING_QUANTITIES = ("force.x", "force.y", "force.z", "roller_load_max", "roller_load_min")
N_FLANKS = 3
N_BEARINGS = 4

OUTPUT_NAMES: tuple[str, ...] = (
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
    *(f"flank[{i}].{q}" for i in range(1, N_FLANKS + 1) for q in FLANK_QUANTITIES),
    "friction.power_loss",
    "friction.power_loss_boundary",
    "bearing.power_loss",
    "damping.power_loss",
    "efficiency",
    "axle.efficiency",
    *(f"{member}.displacement.{c}" for member in ("pinion", "wheel") for c in "xyz"),
    *(f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in BEARING_QUANTITIES),
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
    "energy.stored",
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
DAMPING_LOSS = OUTPUT_INDEX["damping.power_loss"]
EFFICIENCY = OUTPUT_INDEX["efficiency"]
AXLE_EFFICIENCY = OUTPUT_INDEX["axle.efficiency"]
FIRST_ROLLER = OUTPUT_INDEX["bearing[1].roller[1].load"]
PINION_CAGE = OUTPUT_INDEX["bearing[1].cage.angle"]
GEAR_CAGE = OUTPUT_INDEX["bearing[3].cage.angle"]
STORED_ENERGY = OUTPUT_INDEX["energy.stored"]

# first place of a group of outputs of one kind
FLANKS = OUTPUT_INDEX["flank[1].load"]
PINION_DISPLACEMENT = OUTPUT_INDEX["pinion.displacement.x"]
WHEEL_DISPLACEMENT = OUTPUT_INDEX["wheel.displacement.x"]
PINION_BEARINGS = OUTPUT_INDEX["bearing[1].force.x"]
GEAR_BEARINGS = OUTPUT_INDEX["bearing[3].force.x"]
ENERGIES = OUTPUT_INDEX["energy.pinion_work"]  # in the order of the state

# places within the outputs of one flank and of one bearing
FLANK_LOAD = FLANK_QUANTITIES.index("load")
FILM_THICKNESS = FLANK_QUANTITIES.index("film_thickness")
FILM_RATIO = FLANK_QUANTITIES.index("film_ratio")
FRICTION_COEFFICIENT = FLANK_QUANTITIES.index("friction_coefficient")
TEMPERATURE = FLANK_QUANTITIES.index("temperature")
BEARING_FORCE = BEARING_QUANTITIES.index("force.x")
ROLLER_LOAD_MAX = BEARING_QUANTITIES.index("roller_load_max")
ROLLER_LOAD_MIN = BEARING_QUANTITIES.index("roller_load_min")
N_FLANK_QUANTITIES = len(FLANK_QUANTITIES)
N_BEARING_QUANTITIES = len(BEARING_QUANTITIES)
