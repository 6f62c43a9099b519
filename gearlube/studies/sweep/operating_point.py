"""Operating point of the axle: its driver, and the shaft speed of a vehicle speed."""

from __future__ import annotations

from dataclasses import dataclass

from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.drivers import CoupledVehicle, Driver, SpeedHold
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.units import kmh_to_ms


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
