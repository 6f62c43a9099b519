"""Crank speed of the coupled car at each speed of a sweep."""

from __future__ import annotations

import math
from collections.abc import Sequence

from drivetrain.driveline.parameters import DrivelineParameters
from gearlube_core.errors import ParameterError
from gearlube_core.units import kmh_to_ms


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
    return [_crank(driveline, road.pinion_speed(kmh_to_ms(one))) for one in speeds_kmh]


def _crank(driveline: DrivelineParameters, shaft: float) -> float:
    """Return the crank frequency [Hz] at a propshaft speed [rad/s]; NaN where no gear suits."""
    try:
        gear = driveline.gearbox.gear_for(shaft, driveline.engine)
    except ParameterError:
        return math.nan
    return driveline.gearbox.ratios[gear - 1] * shaft / (2.0 * math.pi)
