"""Steps of a march through a helical mesh: where they end, how they follow the load."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.dynamics.helical_pair.march.flanks import (
    FlankConstants,
    PairMotion,
    coast_near,
    drive_view,
    touches,
)
from gearlube_core.kernels.jit import kernel

STATIONS = 14.0  # along a line in the line mesh of he_2007: a step with as many costs 1
REFRESH_COST, SOLVED_REFRESH_COST = 1.0, 4.0  # of friction by the formulas and by solved films
# Relative change of the load level that the line mesh follows at once
LOAD_REACH = 1e-3
# Of a mesh period: vibration moves the phase in a step by less than the first, in a step as long as
# the first by less than the second
NEAR_JUMP, AT_JUMP = 2e-5, 1e-7
LOAD_FILTER_TIME = 0.02  # s, the load level follows the torque below the shafts' own motions


@kernel
def _gap(phase: float, at: float, forward: bool) -> float:
    """Return how far a phase is before `at` in the direction of rotation, 0 to 1."""
    gap = at - phase if forward else phase - at
    return gap - np.floor(gap)


@kernel
def time_to_jump(m: PairMotion, least_offset: float, p: FlankConstants) -> float:
    """Return after what time [s] a step must end because stiffness or friction jump there.

    Lines of spur gears enter, leave and pass the pitch point over their whole length at once. A
    step ends NEAR_JUMP before, a short one AT_JUMP before, and a third one AT_JUMP behind, so that
    all others are smooth. Infinite for helical gears, whose lines come and go by and by.
    """
    plane = p.plane
    if plane.sin_b > 0.0 or m.w_p == 0.0:
        return math.inf
    forward = m.w_p > 0.0
    phase = plane.r_bp * m.phi_p / plane.pitch
    leaving, pitch_point = (plane.D - plane.A) / plane.pitch, (plane.P - plane.A) / plane.pitch
    drives = touches(drive_view(m, p), least_offset, p)
    coasts = coast_near(m, least_offset, p)
    nearest = math.inf
    for at in (0.0, leaving, pitch_point):
        if drives:
            nearest = min(nearest, _gap(phase, at, forward))
        if coasts:
            nearest = min(nearest, _gap(phase, p.coast_phase - at, forward))
    way = nearest + AT_JUMP
    if nearest > 2.0 * NEAR_JUMP:
        way = nearest - NEAR_JUMP
    elif nearest > 2.0 * AT_JUMP:
        way = nearest - AT_JUMP
    return way * plane.pitch / (plane.r_bp * abs(m.w_p))
