"""The New European Driving Cycle, built from its definition."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array

# Seconds and the speed at their end [km/h]; between the ends the speed is a straight line.
# [unece_2012 Annex 4a, tables 1 and 2]; while gears are changed the speed is held.
URBAN = (
    (11, 0), (4, 15), (8, 15), (2, 10), (3, 0),
    (21, 0), (5, 15), (2, 15), (5, 32), (24, 32), (8, 10), (3, 0),
    (21, 0), (5, 15), (2, 15), (9, 35), (2, 35), (8, 50), (12, 50), (8, 35), (13, 35), (2, 35),
    (7, 10), (3, 0), (7, 0),
)  # fmt: skip
EXTRA_URBAN = (
    (20, 0), (5, 15), (2, 15), (9, 35), (2, 35), (8, 50), (2, 50), (13, 70), (50, 70),
    (8, 50), (69, 50), (13, 70), (50, 70), (35, 100), (30, 100), (20, 120), (10, 120),
    (16, 80), (8, 50), (10, 0), (20, 0),
)  # fmt: skip


def nedc() -> tuple[Array, Array]:
    """Return time [s] and speed [m/s] at 1 Hz: four urban cycles and one extra-urban.

    Notes
    -----
    1180 s, up to 120 km/h [unece_2012 Annex 4a]. Straight lines between the ends make 11.028 km;
    the regulation states 4.052 and 6.955 km, 0.2 % less.

    Examples
    --------
    >>> time, speed = nedc()
    >>> time[-1], round(float(np.trapezoid(speed, time)))  # s, m
    (np.float64(1180.0), 11028)
    """
    seconds, ends = np.array((*URBAN,) * 4 + EXTRA_URBAN, dtype=float).T
    corners = np.concatenate([[0.0], np.cumsum(seconds)])
    time = np.arange(corners[-1] + 1.0)
    return time, np.interp(time, corners, np.concatenate([[0.0], ends])) / 3.6
