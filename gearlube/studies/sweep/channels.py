"""Outputs of the axle that a sweep records."""

from __future__ import annotations

FLANKS = (1, 2, 3)
BEARINGS = (1, 2, 3, 4)
AXES = ("x", "y", "z")
LOSSES = (
    "friction_viscous",
    "friction_boundary",
    "mesh_damping",
    "bearing_damping",
    "bearing_torque",
    "churning",
    "seals",
    "friction_rolling",
)
FLANK_QUANTITIES = ("load", "film_thickness", "film_ratio", "friction_coefficient", "temperature")

CHANNELS = (
    "pinion.angle",
    "pinion.speed",
    "wheel.angle",
    "wheel.speed",
    "mesh.dte",
    "mesh.force",
    "mesh.frequency",
    *(f"pinion.displacement.{axis}" for axis in AXES),
    *(f"wheel.displacement.{axis}" for axis in AXES),
    *(f"flank[{i}].{quantity}" for i in FLANKS for quantity in FLANK_QUANTITIES),
    *(f"bearing[{j}].force.{axis}" for j in BEARINGS for axis in AXES),
    *(f"bearing[{j}].roller_load_{end}" for j in BEARINGS for end in ("max", "min")),
    "bearing[1].roller[1].load",
    "bearing[1].cage.angle",
    "bearing[3].cage.angle",
    "energy.pinion_work",
    "energy.wheel_work",
    *(f"energy.{loss}" for loss in LOSSES),
    "energy.stored",
    "film.share_outside",
    "friction.power_loss_bound",
    "bearing.share_outside",
    "bearing.power_loss_bound",
)
