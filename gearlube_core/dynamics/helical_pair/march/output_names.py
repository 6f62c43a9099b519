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

# first index of each block that the output kernel writes in one go
MESH_AT = OUTPUT_INDEX["mesh.dte"]
LINES_AT = OUTPUT_INDEX["line[1].load"]
LOSSES_AT = OUTPUT_INDEX["friction.power_loss"]
DISPLACEMENTS_AT = OUTPUT_INDEX["pinion.displacement.x"]
BEARINGS_AT = OUTPUT_INDEX["bearing[1].force.x"]
ENERGIES_AT = OUTPUT_INDEX["energy.pinion_work"]
N_LINE_QUANTITIES = len(LINE_QUANTITIES)
N_BEARING_QUANTITIES = len(BEARING_QUANTITIES)
