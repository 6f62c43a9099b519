"""HypoidAxle.fmu: the axle model of `gearlube_core`, told in FMI names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from fmu_src.definition import Definition, Value
from fmu_src.slave_base import CoSimulationSlave
from fmu_src.variables import HYPOID_AXLE
from gearlube_core.dynamics import hypoid_axle

ARGUMENTS = {
    "bearing.preload": "bearing_preload",
    "flank.roughness_rms": "roughness_rms",
    "mesh.backlash": "backlash",
    "mesh.modal_loss_factor": "modal_loss_factor",
    "model.equations": "equations",
    "model.radii": "radii",
    "mesh.damping": "mesh_damping",
    "friction.model": "friction",
    "bearing.approach": "bearing_approach",
    "bearing.torque_loss": "bearing_torque_loss",
    "oil.name": "oil",
    "solver.steps_per_mesh_period": "steps_per_mesh_period",
    "solver.steps_per_highest_period": "steps_per_highest_period",
}


def start_axle(parameters: Mapping[str, Value], inputs: Sequence[float]) -> hypoid_axle.HypoidAxle:
    """Return an initialised axle.

    Parameters
    ----------
    parameters : mapping
        Value of every FMI parameter, enumerations by literal.
    inputs : sequence of float
        pinion.torque [N.m], wheel.torque [N.m], oil.temperature [K].
    """
    arguments: dict[str, Any] = {ARGUMENTS[n]: v for n, v in parameters.items() if n in ARGUMENTS}
    axle = hypoid_axle.HypoidAxle(hypoid_axle.mohammadpour_2015_axle(**arguments))
    pinion_torque, wheel_torque, oil_temperature = inputs
    axle.initialise(
        pinion_speed=float(parameters["pinion.speed_start"]),
        pinion_torque=pinion_torque,
        wheel_torque=wheel_torque,
        oil_temperature=oil_temperature,
    )
    return axle


DEFINITION = Definition(
    name="HypoidAxle",
    description="Lubricated hypoid gear pair on preloaded tapered roller bearings: "
    "film, friction, losses, transmission error and bearing forces",
    variables=HYPOID_AXLE,
    output_names=tuple(hypoid_axle.OUTPUT_NAMES),
    start_model=start_axle,
    stop_time=0.1,
    step_size=1e-3,
)


class HypoidAxle(CoSimulationSlave):
    """FMI 2.0 co-simulation slave of the hypoid axle of Mohammadpour et al. (2015)."""

    definition = DEFINITION
