"""Oil temperature of an axle at constant torque and speed."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.sump_heat import SumpHeat
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.units import celsius_to_kelvin

_LOOKS = 16  # temperatures between that of the air and the end of the oil's data
_LOOKS_OF_MANY = 32  # the same where the loss is interpolated between them
_ANGLES_OF_MANY = 8  # of a mesh period, within 4e-4 of 256
_TOLERANCE = 1e-6  # K


@dataclass(frozen=True, slots=True, kw_only=True)
class Cooling:
    """Cooling of an axle by air in a moving car.

    Parameters
    ----------
    driveline : DrivelineParameters
        Tyre and ratio give the vehicle's speed.
    air_temperature : float
        [K]
    heat : SumpHeat
        Conductances; the capacity does not matter.
    """

    driveline: DrivelineParameters
    air_temperature: float = celsius_to_kelvin(23.0)
    heat: SumpHeat = field(default_factory=SumpHeat)

    def conductance(self, speed: float) -> float:
        """Return hA [W/K] at a speed of the pinion [rad/s]."""
        road = self.driveline.road_load
        return self.heat.conductance(road.vehicle_speed(speed) / road.final_drive.ratio)


def steady_temperature(
    car: CarAxle,
    *,
    torque: float,
    speed: float,
    air_temperature: float = celsius_to_kelvin(23.0),
    heat: SumpHeat | None = None,
) -> float:
    """Return the steady oil temperature [K] of an axle: the air takes as much heat as it loses.

    Parameters
    ----------
    car
        Axle and vehicle of an axle file; tyre and ratio give the vehicle's speed.
    torque, speed
        Torque and speed of the pinion [N.m], [rad/s].
    air_temperature
        Temperature of the air [K].
    heat
        Conductances; the capacity does not matter. Default: assumed values.

    Notes
    -----
    There is one such temperature as long as the loss falls with temperature. Where asperities carry
    load the loss can rise, and there may be several. Then the lowest is returned, to 1/16 of the
    range: the one that oil reaches if it starts at the temperature of the air.

    Raises
    ------
    ParameterError
        The oil would leave the range of its data, or an input is out of range.

    Examples
    --------
    >>> from drivetrain.axle_file.read_axle import read_axle
    >>> car = read_axle("mohammadpour_2015")
    >>> round(steady_temperature(car, torque=60.0, speed=240.0) - 273.15)  # degC
    59
    """
    oil = car.axle.oil
    oil.check_temperature(air_temperature, "air_temperature")
    check_within("speed", speed, 1e-3, 5e3, "rad/s")
    cooling = Cooling(
        driveline=car.driveline, air_temperature=air_temperature, heat=heat or SumpHeat()
    )
    conductance = cooling.conductance(speed)

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
            f"The steady oil temperature must be below {oil.temperature_high:g} K, the end of the "
            f"data of {oil.name}; got {left:.4g} W more lost there than the air takes, with "
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


def steady_temperatures(
    axle: HypoidAxleParameters,
    cooling: Cooling,
    *,
    torques: Array,
    speeds: Array,
    progress: Progress = no_progress,
) -> tuple[Array, Array]:
    """Return steady oil temperatures [K] and the loss there [W], of shape (speeds, torques).

    Parameters
    ----------
    axle
    cooling
        Air temperature and thermal conductances.
    torques, speeds : ndarray
        Of the pinion [N.m], [rad/s].
    progress
        Called with the share that is done and a sentence.

    Notes
    -----
    As `steady_temperature`, but the loss is interpolated between 33 temperatures, by cubics that
    keep its rise and fall. NaN where the oil would leave the range of its data, or where the
    loss was not found.

    Raises
    ------
    ParameterError
        A number is out of range.
    """
    air, high = cooling.air_temperature, axle.oil.temperature_high
    axle.oil.check_temperature(air, "air_temperature")
    if air >= high:
        raise ParameterError(
            f"The air temperature must be below the upper limit of the oil's data, {high:g} K, got "
            f"{air:g} K. Give a lower air temperature."
        )
    looks = np.linspace(air, high, _LOOKS_OF_MANY + 1)
    lost = axle_losses(
        axle,
        torques=torques,
        speeds=speeds,
        temperatures=looks,
        angles=_ANGLES_OF_MANY,
        extremes=False,
        progress=progress,
    ).total
    found = np.full((2, len(speeds), len(torques)), np.nan)
    for j, speed in enumerate(speeds):
        taken = cooling.conductance(float(speed)) * (looks - air)
        for k in range(len(torques)):
            cooled = np.flatnonzero(lost[:, j, k] <= taken)
            if np.all(np.isfinite(lost[:, j, k])) and cooled.size:
                found[:, j, k] = _crossing(looks, lost[:, j, k], taken, int(cooled[0]))
    return found[0], found[1]


def _crossing(looks: Array, lost: Array, taken: Array, at: int) -> tuple[float, float]:
    """Return temperature and loss where the air takes it, between the looks `at` - 1 and `at`."""
    curve = PchipInterpolator(looks, lost)
    if at == 0:
        return float(looks[0]), float(lost[0])
    slope = (taken[-1] - taken[0]) / (looks[-1] - looks[0])
    temperature = brentq(
        lambda t: float(curve(t)) - slope * (t - looks[0]), looks[at - 1], looks[at]
    )
    return float(temperature), float(curve(temperature))
