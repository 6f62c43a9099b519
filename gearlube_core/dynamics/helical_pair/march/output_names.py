"""Names of the helical pair's outputs; the same names are the FMU's public contract."""

from __future__ import annotations

LINES_MAX = 6  # contact lines at once; a total contact ratio above 6 is refused

LINE_QUANTITIES = (
    "load",
    "length",
    "film_thickness_min",
    "film_thickness_mean",
    "film_ratio",
    "friction_coefficient",
    "sliding_speed",
    "temperature",
)
BEARING_QUANTITIES = ("force.x", "force.y", "force.z")
N_BEARINGS = 4

OUTPUT_NAMES: tuple[str, ...] = (
    "pinion.angle",
    "wheel.angle",
    "pinion.speed",
    "wheel.speed",
    "pinion.acceleration",
    "wheel.acceleration",
    "mesh.dte",
    "mesh.load",
    "mesh.force.x",
    "mesh.force.y",
    "mesh.force.z",
    "mesh.separated",
    "mesh.coast_contact",
    "mesh.stiffness",
    "mesh.frequency",
    "mesh.film_thickness_min",
    *(f"line[{i}].{q}" for i in range(1, LINES_MAX + 1) for q in LINE_QUANTITIES),
    "friction.power_loss",
    "damping.power_loss",
    "bearing.power_loss",
    "efficiency",
    "pair.efficiency",
    *(
        f"{member}.{quantity}.{c}"
        for member in ("pinion", "wheel")
        for quantity, axes in (("displacement", "xyz"), ("tilt", "xy"))
        for c in axes
    ),
    *(f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in BEARING_QUANTITIES),
    "energy.pinion_work",
    "energy.wheel_work",
    "energy.friction",
    "energy.mesh_damping",
    "energy.bearing_damping",
    "energy.stored",
)
OUTPUT_INDEX = {name: index for index, name in enumerate(OUTPUT_NAMES)}
N_OUTPUTS = len(OUTPUT_NAMES)

# places of the outputs that the kernels write by name
PINION_ANGLE = OUTPUT_INDEX["pinion.angle"]
WHEEL_ANGLE = OUTPUT_INDEX["wheel.angle"]
PINION_SPEED = OUTPUT_INDEX["pinion.speed"]
WHEEL_SPEED = OUTPUT_INDEX["wheel.speed"]
PINION_ACCELERATION = OUTPUT_INDEX["pinion.acceleration"]
WHEEL_ACCELERATION = OUTPUT_INDEX["wheel.acceleration"]
DTE = OUTPUT_INDEX["mesh.dte"]
MESH_LOAD = OUTPUT_INDEX["mesh.load"]
SEPARATED = OUTPUT_INDEX["mesh.separated"]
COAST_CONTACT = OUTPUT_INDEX["mesh.coast_contact"]
MESH_STIFFNESS = OUTPUT_INDEX["mesh.stiffness"]
MESH_FREQUENCY = OUTPUT_INDEX["mesh.frequency"]
THINNEST_FILM = OUTPUT_INDEX["mesh.film_thickness_min"]
FRICTION_LOSS = OUTPUT_INDEX["friction.power_loss"]
DAMPING_LOSS = OUTPUT_INDEX["damping.power_loss"]
BEARING_LOSS = OUTPUT_INDEX["bearing.power_loss"]
EFFICIENCY = OUTPUT_INDEX["efficiency"]
PAIR_EFFICIENCY = OUTPUT_INDEX["pair.efficiency"]
STORED_ENERGY = OUTPUT_INDEX["energy.stored"]

# first place of a group of outputs of one kind
MESH_FORCE = OUTPUT_INDEX["mesh.force.x"]
LINES = OUTPUT_INDEX["line[1].load"]
DISPLACEMENTS = OUTPUT_INDEX["pinion.displacement.x"]  # in the order of the state
BEARINGS = OUTPUT_INDEX["bearing[1].force.x"]
ENERGIES = OUTPUT_INDEX["energy.pinion_work"]  # in the order of the state

# places within the outputs of one contact line
LINE_LOAD = LINE_QUANTITIES.index("load")
LINE_LENGTH = LINE_QUANTITIES.index("length")
FILM_THICKNESS_MIN = LINE_QUANTITIES.index("film_thickness_min")
FILM_THICKNESS_MEAN = LINE_QUANTITIES.index("film_thickness_mean")
FILM_RATIO = LINE_QUANTITIES.index("film_ratio")
FRICTION_COEFFICIENT = LINE_QUANTITIES.index("friction_coefficient")
SLIDING_SPEED = LINE_QUANTITIES.index("sliding_speed")
TEMPERATURE = LINE_QUANTITIES.index("temperature")
N_LINE_QUANTITIES = len(LINE_QUANTITIES)
N_BEARING_QUANTITIES = len(BEARING_QUANTITIES)
