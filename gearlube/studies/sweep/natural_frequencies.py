"""Natural frequencies of the axle for the preloads of a sweep."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import numpy as np
import xarray as xr

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.driveline.model import Driveline, driveline_modes
from gearlube.studies.sweep.axle_in_fmu import car_axle_at
from gearlube.studies.sweep.oil_at_rest import oil_at_rest
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.errors import GearLubeError
from gearlube_core.units import kmh_to_ms

logger = logging.getLogger(__name__)

_LOWEST_DRIVELINE_MODE = 100.0  # Hz, lower ones lie below the mesh frequencies of a sweep


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
