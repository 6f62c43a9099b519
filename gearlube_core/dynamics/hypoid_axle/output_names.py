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

# first index of each block that the output kernel writes in one go
FLANKS_AT = OUTPUT_INDEX["flank[1].load"]
LOSSES_AT = OUTPUT_INDEX["friction.power_loss"]
DISPLACEMENTS_AT = OUTPUT_INDEX["pinion.displacement.x"]
BEARINGS_AT = OUTPUT_INDEX["bearing[1].force.x"]
ROLLER_AT = OUTPUT_INDEX["bearing[1].roller[1].load"]
ENERGIES_AT = OUTPUT_INDEX["energy.pinion_work"]
N_FLANK_QUANTITIES = len(FLANK_QUANTITIES)
N_BEARING_QUANTITIES = len(BEARING_QUANTITIES)
