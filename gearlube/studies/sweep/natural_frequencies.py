"""Natural frequencies of the axle for the preloads of a sweep, and its oil at rest."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import xarray as xr

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.model import Driveline, driveline_modes
from drivetrain.steady_temperature import steady_temperature
from drivetrain.sump_heat import SumpHeat
from gearlube.studies.sweep.axle_in_fmu import car_axle_at
from gearlube.studies.sweep.settings import STEADY, SweepSettings
from gearlube_core.errors import ConvergenceError, GearLubeError
from gearlube_core.units import kmh_to_ms

_ROUNDS, _SETTLED = 20, 1e-4  # K; a round leaves some per cent of the last one's change
logger = logging.getLogger(__name__)

_LOWEST_DRIVELINE_MODE = 100.0  # Hz, lower ones lie below the mesh frequencies of a sweep


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
) -> xr.DataArray:
    """Return undamped natural frequencies [Hz] over (preload, mode).

    The axle is linearised about its static state under the road load at `speed_kmh`, with the
    mean mesh stiffness; its modes are named after the coordinate with most of the kinetic energy.
    With the coupled vehicle, the driveline's modes above 100 Hz (rigid axle) follow.

    Notes
    -----
    Modes are matched between preloads by their order, since two modes that share their energy may
    swap names; all take the names that they have at the first preload.
    """
    found = [_modes(preload, speed_kmh, settings, car_axle) for preload in preloads]
    first = next((row for row in found if row), {})
    driveline = _driveline_modes(speed_kmh, settings, car_axle)
    names = [*first, *driveline]
    values = np.full((len(found), len(names)), np.nan)
    for row, frequencies in zip(values, found, strict=True):
        if len(frequencies) == len(first):
            row[: len(first)] = sorted(frequencies.values())
        row[len(first) :] = list(driveline.values())
    return xr.DataArray(values, dims=("preload", "mode"), coords={"mode": names})


def _driveline_modes(
    speed_kmh: float, settings: SweepSettings, car_axle: CarAxle
) -> dict[str, float]:
    if settings.driver != "vehicle":
        return {}
    found = driveline_modes(Driveline(car_axle.driveline, kmh_to_ms(speed_kmh)))
    return {m.name: m.frequency for m in found if m.frequency > _LOWEST_DRIVELINE_MODE}


def _modes(
    preload: float, speed_kmh: float, settings: SweepSettings, car_axle: CarAxle
) -> dict[str, float]:
    # Imported here because it compiles kernels when the machine has none yet.
    from gearlube_core.dynamics.hypoid_axle import HypoidAxle, modes

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
        found = modes(axle, oil_temperature, torque)
    except GearLubeError as error:
        logger.warning("No natural frequencies at %g N: %s", preload, error)
        return {}
    return dict(sorted(found.items(), key=lambda item: item[1]))
