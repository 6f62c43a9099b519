"""Crank speed of the coupled car at each speed of a sweep."""

from __future__ import annotations

import math
from collections.abc import Sequence

from drivetrain.driveline.parameters import DrivelineParameters
from gearlube_core.units import kmh_to_ms


def crank_frequencies(driveline: DrivelineParameters, speeds_kmh: Sequence[float]) -> list[float]:
    """Return the rotation frequency of the crankshaft [Hz] in the gear of each speed [km/h].

    Examples
    --------
    >>> from drivetrain.axle_file.read_axle import read_axle
    >>> car = read_axle("mohammadpour_2015").driveline
    >>> [round(one, 1) for one in crank_frequencies(car, [40.0, 80.0])]  # gears 3 and 5
    [21.4, 24.5]
    """
    box, road = driveline.gearbox, driveline.road_load
    shaft = [road.pinion_speed(kmh_to_ms(one)) for one in speeds_kmh]
    gears = [box.gear_for(one, driveline.engine) for one in shaft]
    return [
        box.ratios[gear - 1] * one / (2.0 * math.pi) for gear, one in zip(gears, shaft, strict=True)
    ]
