"""Natural modes of the axle and car of a sweep, its crank frequencies and its oil at rest."""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import xarray as xr

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.modes import LOWEST, DrivelineMode, coupled_modes, numbered
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.steady_temperature import steady_temperature
from drivetrain.sump_heat import SumpHeat
from gearlube.studies.sweep.axle_in_fmu import car_axle_at
from gearlube.studies.sweep.settings import STEADY, SweepSettings
from gearlube_core.errors import ConvergenceError, GearLubeError, ParameterError
from gearlube_core.units import kmh_to_ms

_ROUNDS, _SETTLED = 20, 1e-4  # K; a round leaves some per cent of the last one's change
logger = logging.getLogger(__name__)


def oil_at_rest(car: CarAxle, speed_kmh: float, settings: SweepSettings) -> SweepSettings:
    """Return the settings with the oil temperature at which the air takes what the axle loses.

    Parameters
    ----------
    car : CarAxle
        Axle and car of the point, with its preload and oil.
    speed_kmh : float
        Vehicle speed [km/h].
    settings : SweepSettings
        Unless its `oil_state` is "steady" it comes back as it is.

    Raises
    ------
    ParameterError
        The oil would leave the range of its data.

    Notes
    -----
    The pinion's torque is that of the road and that of the loss, which is hA (T - T_air) at rest.
    The loss is that of `axle_losses`, within 1 % of the march that follows.
    """
    if settings.oil_state != STEADY:
        return settings
    road = car.driveline.road_load
    speed = kmh_to_ms(speed_kmh)
    heat = SumpHeat(
        conductance_at_rest=settings.conductance_at_rest,
        conductance_at_100_kmh=settings.conductance_at_100_kmh,
    )
    found = settings.air_temperature
    for _ in range(_ROUNDS):
        lost = heat.conductance(speed) * (found - settings.air_temperature)
        before = found
        found = steady_temperature(
            car,
            torque=road.pinion_torque(speed, lost),
            speed=road.pinion_speed(speed),
            air_temperature=settings.air_temperature,
            heat=heat,
        )
        if abs(found - before) < _SETTLED:
            return replace(settings, oil_temperature=found)
    raise ConvergenceError(
        f"The oil temperature at {speed_kmh:g} km/h must settle within {_ROUNDS} rounds, but it "
        f"changed by {abs(found - before):.3g} K in the last one. Change the speed a little."
    )


def natural_frequencies(
    preloads: Sequence[float], speed_kmh: float, settings: SweepSettings, car_axle: CarAxle
) -> xr.Dataset:
    """Return the natural modes of what the sweep simulates, above 100 Hz.

    The axle is linearised about its static state under the road load at `speed_kmh`, with the
    mean mesh stiffness. With the driver "vehicle" the car is coupled to it.

    Returns
    -------
    xarray.Dataset
        `mode_frequency` [Hz] and `mode_damping` [-] over (preload, mode); `mode_strain` over
        (mode, spring), share of each spring in the potential energy at the first preload [-].

    Notes
    -----
    A mode is named after the part that moves most. Modes are matched between preloads by their
    order, since two modes that share their energy may swap names; all take the names that they
    have at the first preload that can be linearised.
    """
    found = [_modes(preload, speed_kmh, settings, car_axle) for preload in preloads]
    first = next((modes for modes in found if modes), ())
    springs = list(first[0].strain) if first else []
    frequency = np.full((len(found), len(first)), np.nan)
    damping = frequency.copy()
    for row, modes in enumerate(found):
        if len(modes) == len(first):
            frequency[row] = [one.frequency for one in modes]
            damping[row] = [one.damping_ratio for one in modes]
    strain = np.array([list(one.strain.values()) for one in first]).reshape(-1, len(springs))
    return xr.Dataset(
        {
            "mode_frequency": (("preload", "mode"), frequency),
            "mode_damping": (("preload", "mode"), damping),
            "mode_strain": (("mode", "spring"), strain),
        },
        coords={"mode": numbered([one.name for one in first]), "spring": springs},
    )


def _modes(
    preload: float, speed_kmh: float, settings: SweepSettings, car_axle: CarAxle
) -> tuple[DrivelineMode, ...]:
    # Imported here because it compiles kernels when the machine has none yet.
    from gearlube_core.dynamics.hypoid_axle import HypoidAxle
    from gearlube_core.dynamics.hypoid_axle.linearise import linearise

    speed = kmh_to_ms(speed_kmh)
    road = car_axle.driveline.road_load
    torque = road.pinion_torque(speed)
    try:
        car = car_axle_at(car_axle, settings, preload)
        oil_temperature = oil_at_rest(car, speed_kmh, settings).oil_temperature
        axle = HypoidAxle(car.axle)
        axle.initialise(
            pinion_speed=road.pinion_speed(speed),
            pinion_torque=torque,
            wheel_torque=road.ring_gear_torque(speed),
            oil_temperature=oil_temperature,
        )
        linear = linearise(axle, oil_temperature, torque)
        coupled = settings.driver == "vehicle"
        driveline = Driveline(car_axle.driveline, speed) if coupled else None
        found = coupled_modes(linear, driveline)
    except GearLubeError as error:
        logger.warning("No natural frequencies at %g N: %s", preload, error)
        return ()
    return tuple(one for one in found if one.frequency > LOWEST)


def crank_frequencies(driveline: DrivelineParameters, speeds_kmh: Sequence[float]) -> list[float]:
    """Return the rotation frequency of the crankshaft [Hz] in the gear of each speed [km/h].

    Examples
    --------
    >>> from drivetrain.axle_file.read_axle import read_axle
    >>> car = read_axle("mohammadpour_2015").driveline
    >>> [round(one, 1) for one in crank_frequencies(car, [40.0, 80.0])]  # gears 2 and 5
    [32.1, 24.5]
    """
    road = driveline.road_load
    return [_crank_frequency(driveline, road.pinion_speed(kmh_to_ms(one))) for one in speeds_kmh]


def _crank_frequency(driveline: DrivelineParameters, shaft: float) -> float:
    """Return the crank frequency [Hz] at a propshaft speed [rad/s]; NaN where no gear suits."""
    try:
        gear = driveline.gearbox.gear_for(shaft, driveline.engine)
    except ParameterError:
        return math.nan
    return driveline.gearbox.ratios[gear - 1] * shaft / (2.0 * math.pi)
