"""Natural frequencies of the axle for the preloads of a sweep."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import numpy as np
import xarray as xr

from drivetrain.road_load import mohammadpour_2015_road_load
from drivetrain.sweep.settings import FMU_PARAMETERS, SweepSettings
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, modes, mohammadpour_2015_axle
from gearlube_core.errors import GearLubeError
from gearlube_core.units import kmh_to_ms

logger = logging.getLogger(__name__)


def natural_frequencies(
    preloads: Sequence[float], speed_kmh: float, settings: SweepSettings
) -> xr.DataArray:
    """Return undamped natural frequencies [Hz] over (preload, mode).

    The axle is linearised about its static state under the road load at `speed_kmh`, with the
    mean mesh stiffness. Modes are named after the coordinate with most of the kinetic energy; a
    name that a preload lacks is NaN there.
    """
    found = [_modes(preload, speed_kmh, settings) for preload in preloads]
    names = sorted({name for row in found for name in row})
    values = [[row.get(name, np.nan) for name in names] for row in found]
    order = np.argsort([min(row.get(name, np.inf) for row in found) for name in names])
    return xr.DataArray(
        np.array(values).reshape(len(found), len(names))[:, order],
        dims=("preload", "mode"),
        coords={"mode": [names[i] for i in order]},
    )


def _modes(preload: float, speed_kmh: float, settings: SweepSettings) -> dict[str, float]:
    road = mohammadpour_2015_road_load()
    speed = kmh_to_ms(speed_kmh)
    options = {name: getattr(settings, name) for name in FMU_PARAMETERS}
    torque = road.pinion_torque(speed)
    try:
        axle = HypoidAxle(mohammadpour_2015_axle(bearing_preload=preload, **options))
        axle.initialise(
            pinion_speed=road.pinion_speed(speed),
            pinion_torque=torque,
            wheel_torque=road.ring_gear_torque(speed),
            oil_temperature=settings.oil_temperature,
        )
        return modes(axle, settings.oil_temperature, torque)
    except GearLubeError as error:
        logger.warning("No natural frequencies at %g N: %s", preload, error)
        return {}
