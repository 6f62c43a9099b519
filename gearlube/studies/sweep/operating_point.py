"""Operating point of the axle: its driver, speed and recorded channels."""

from __future__ import annotations

from dataclasses import dataclass

from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.drivers import CoupledVehicle, Driver, SpeedHold
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.units import kmh_to_ms

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Operation:
    """Operating point of the axle.

    Parameters
    ----------
    driver : Driver
        Partner of the axle.
    pinion_speed : float
        Speed of the pinion at the start [rad/s].
    """

    driver: Driver
    pinion_speed: float


def operation(
    settings: SweepSettings,
    speed_kmh: float,
    driveline: DrivelineParameters,
    axle_power_loss: float = 0.0,
) -> Operation:
    """Return the driver and the start of the point at `speed_kmh` [km/h] in a car.

    The drivers start in the steady state with an axle that loses `axle_power_loss` [W].
    """
    speed = kmh_to_ms(speed_kmh)
    driver: CoupledVehicle | SpeedHold
    if settings.driver == "vehicle":
        driver = CoupledVehicle(driveline, speed, axle_power_loss=axle_power_loss)
    else:
        driver = SpeedHold(driveline.road_load, speed, axle_power_loss=axle_power_loss)
    return Operation(driver=driver, pinion_speed=driver.initial_pinion_speed)
