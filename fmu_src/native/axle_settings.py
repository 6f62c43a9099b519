"""What run-time parameters change of the native axle beside its packed parameters."""

from __future__ import annotations

from typing import NamedTuple, get_args

from fmu_src.axle_arguments import tapered_bearings
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.dynamics.hypoid_axle.parameters import (
    HypoidAxleParameters,
    MeshStiffness,
    Radii,
)
from gearlube_core.friction.thermal_eyring_data import PRESSURES


class AxleSettings(NamedTuple):
    """What else of an axle a parameter can change, packed behind its `AxleParameters`."""

    torque_low: float  # N.m, limits of the inputs in their order
    torque_high: float
    wheel_low: float  # N.m
    wheel_high: float
    oil_low: float  # K
    oil_high: float
    steps_per_mesh_period: float
    steps_per_highest_period: float
    radii: float  # place of the option in `Radii`
    stiffness: float  # ditto in `MeshStiffness`
    pressure: float  # ditto in `PRESSURES`
    modal: float  # 1 with modal damping of the mesh, 0 with hysteresis
    modal_loss_factor: float
    reference_stiffness: float  # N/m, of the modal damping
    mean_pinion_radius: float  # m, ditto
    gear_preload: float  # N, as given: below 0 that of the pinion's shaft holds
    contact_angle_p: float  # rad
    contact_angle_g: float  # rad
    solved: float  # 1 with solved films of the flanks
    own_film: float  # 1 if the law of friction has a film that a solved one cannot replace


def axle_settings(axle: HypoidAxleParameters, gear_preload: float) -> AxleSettings:
    """Return the settings of an axle; a gear preload [N] below 0 is that of the pinion's shaft."""
    torques = torque_limits(axle)
    of_pinion, of_gear = tapered_bearings(axle)
    return AxleSettings(
        torques.pinion_low,
        torques.pinion_high,
        -torques.wheel,
        torques.wheel,
        axle.oil.temperature_low,
        axle.oil.temperature_high,
        float(axle.steps_per_mesh_period),
        float(axle.steps_per_highest_period),
        float(get_args(Radii).index(axle.radii)),
        float(get_args(MeshStiffness).index(axle.mesh_stiffness)),
        float(list(PRESSURES).index(axle.friction_law.pressure)),
        1.0 if axle.mesh_damping == "modal" else 0.0,
        float(axle.modal_loss_factor),
        axle.reference_stiffness,
        axle.mean_pinion_radius,
        gear_preload,
        float(of_pinion.contact_angle),
        float(of_gear.contact_angle),
        1.0 if axle.film == "solved" else 0.0,
        0.0 if axle.friction_law.solved_film else 1.0,
    )
