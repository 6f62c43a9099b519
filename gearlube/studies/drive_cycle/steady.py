"""Oil temperature of an axle at constant torque and speed."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from drivetrain.axle_file.axle_file import CarAxle
from gearlube.studies.drive_cycle.heat import SumpHeat
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.errors import ParameterError
from gearlube_core.units import celsius_to_kelvin

_LOOKS = 16  # temperatures between that of the air and the end of the oil's data
_TOLERANCE = 1e-6  # K


def steady_temperature(
    car: CarAxle,
    *,
    torque: float,
    speed: float,
    air_temperature: float = celsius_to_kelvin(23.0),
    heat: SumpHeat | None = None,
) -> float:
    """Return the oil temperature [K] at which the air takes what the axle loses.

    Parameters
    ----------
    car
        Axle and vehicle of an axle file; tyre and ratio give the vehicle's speed.
    torque, speed
        Of the pinion [N.m], [rad/s].
    air_temperature
        [K]
    heat
        Conductances; the capacity does not matter. Default: assumed values.

    Notes
    -----
    There is one such temperature while the loss falls with temperature. Where asperities carry
    load the loss can rise; then this is the lowest of them to 1/16 of the range, where oil that
    starts at the temperature of the air comes to rest.

    Raises
    ------
    ParameterError
        The oil would leave the range of its data, or an input is out of range.

    Examples
    --------
    >>> from drivetrain.axle_file.axle_file import read_axle
    >>> car = read_axle("mohammadpour_2015")
    >>> round(steady_temperature(car, torque=60.0, speed=240.0) - 273.15)  # degC
    59
    """
    oil = car.axle.oil
    oil.check_temperature(air_temperature, "air_temperature")
    road = car.driveline.road_load
    vehicle_speed = road.vehicle_speed(check_within("speed", speed, 1e-3, 5e3, "rad/s"))
    conductance = (heat or SumpHeat()).conductance(vehicle_speed / road.final_drive.ratio)

    def surplus(temperatures: np.ndarray) -> np.ndarray:
        found = axle_losses(
            car.axle,
            torques=np.array([torque]),
            speeds=np.array([speed]),
            temperatures=temperatures,
            extremes=False,
        )
        return np.asarray(found.total[:, 0, 0] - conductance * (temperatures - air_temperature))

    looks = np.linspace(air_temperature, oil.temperature_high, _LOOKS + 1)
    seen = surplus(looks)
    cooled = np.flatnonzero(seen <= 0.0)
    if not cooled.size:
        left = seen[-1]
        raise ParameterError(
            f"The oil must come to rest below {oil.temperature_high:g} K, the end of the data of "
            f"{oil.name}; got {left:.4g} W more lost there than the air takes, with "
            f"{conductance:.3g} W/K. Take less torque or speed, or a larger conductance."
        )
    at = int(cooled[0])
    if at == 0:
        return air_temperature
    return float(
        brentq(
            lambda t: float(surplus(np.array([t]))[0]), looks[at - 1], looks[at], xtol=_TOLERANCE
        )
    )
