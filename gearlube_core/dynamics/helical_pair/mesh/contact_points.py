"""Quadrature points along all contact lines at one mesh phase: kernels."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays
from gearlube_core.helical_geometry.contact_line import (
    ContactPlane,
    clip_line,
    line_count,
    line_position,
    pitch_crossing,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.places import place_below

# columns of a table of points
X, Z, LENGTH, DENSITY, OFFSET, SLIDING, LINE, LOAD, MU = range(9)
N_COLUMNS = 9
_GAUSS = 1.0 / math.sqrt(3.0)


def point_capacity(mesh: MeshArrays) -> int:
    """Return the most points that `contact_points` may write: two per part, each line split once.

    A line has one part between neighbouring stations.
    """
    return 2 * mesh.station.size * mesh.density.shape[1]


@kernel
def contact_points(
    phase: float, pinion_speed: float, plane: ContactPlane, mesh: MeshArrays, points: Array
) -> int:
    """Fill `points` and return how many there are.

    Two Gauss points between neighbouring stations, split at the pitch line too: exact for cubics,
    which is what k delta times a lever arm is for linear k and delta.

    Parameters
    ----------
    phase
        Mesh phase [mesh periods].
    pinion_speed
        Signed [rad/s].
    plane, mesh
        Geometry, and density and offset along the lines.
    points : ndarray of shape (at least `point_capacity`, N_COLUMNS)
        Written: X, Z [m]; LENGTH of line that the point stands for [m]; DENSITY k [N/m2]; OFFSET
        e [m]; SLIDING v_s of the pinion over the gear along y [m/s]; LINE by age. LOAD and MU are
        left to a law of contact and one of friction.

    Notes
    -----
    v_s = -x Omega_p + (x_g - x) Omega_g, the difference of both surface velocities along y.
    Between phases of the mesh k and e are linear; at the period's end line i has become line i + 1.
    Source: [he_2007 (5a)] [he_2007 (5b)] [he_2007 (6)]
    """
    phases, lines, stations = mesh.density.shape
    place = (phase - np.floor(phase)) * phases
    row = place_below(place, phases)
    weight = place - row
    tan_b = plane.sin_b / plane.cos_b
    gear_speed = pinion_speed * plane.r_bp / plane.r_bg
    n = 0
    for line in range(line_count(plane)):
        position = line_position(phase, line, plane)
        segment = clip_line(position, plane)
        span = segment.z_high - segment.z_low
        if span <= 0.0:
            continue
        crossing = (pitch_crossing(position, segment, plane) - segment.z_low) / span
        next_row, next_line = row + 1, line
        if next_row == phases:
            next_row, next_line = 0, line + 1
            if next_line == lines:
                next_row, next_line = row, line
        for station in range(stations - 1):
            low, high = mesh.station[station], mesh.station[station + 1]
            k_low = _blend(mesh.density, row, line, next_row, next_line, station, weight)
            k_high = _blend(mesh.density, row, line, next_row, next_line, station + 1, weight)
            e_low = _blend(mesh.offset, row, line, next_row, next_line, station, weight)
            e_high = _blend(mesh.offset, row, line, next_row, next_line, station + 1, weight)
            middle = min(max(crossing, low), high)
            for part in range(2):
                start = low if part == 0 else middle
                end = middle if part == 0 else high
                if end <= start:
                    continue
                for side in range(2):
                    at = 0.5 * (start + end) + (side - 0.5) * (end - start) * _GAUSS
                    share = (at - low) / (high - low)
                    z = segment.z_low + at * span
                    x = position - (0.5 * plane.W - z) * tan_b
                    points[n, X] = x
                    points[n, Z] = z
                    points[n, LENGTH] = 0.5 * (end - start) * span / plane.cos_b
                    points[n, DENSITY] = (1.0 - share) * k_low + share * k_high
                    points[n, OFFSET] = (1.0 - share) * e_low + share * e_high
                    points[n, SLIDING] = -x * pinion_speed + (plane.x_g - x) * gear_speed
                    points[n, LINE] = line
                    n += 1
    return n


@kernel
def _blend(
    values: Array, row: int, line: int, next_row: int, next_line: int, station: int, weight: float
) -> float:
    here, there = values[row, line, station], values[next_row, next_line, station]
    return (1.0 - weight) * here + weight * there


@kernel
def constant_friction(mu: float, points: Array, n: int) -> None:
    """Give the first `n` points one friction coefficient [-]: Coulomb's law, [he_2007 sec. 2]."""
    for i in range(n):
        points[i, MU] = mu
