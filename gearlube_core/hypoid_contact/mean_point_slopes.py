"""Slopes of the ease-off at the mean point: whether pinion and gear flank are parallel there."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.flank_intersection import HIT, intersect_rotation
from gearlube_core.hypoid_contact.placement import ALIGNED, pinion_placement
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.cutting_motion import CutState, cut_state, unit_normal
from gearlube_core.hypoid_geometry.flank.machine_check import turn_to
from gearlube_core.hypoid_geometry.flank.machine_frames import ReferenceCut, reference_point
from gearlube_core.hypoid_geometry.flank.surface_point import CONVERGED, locate
from gearlube_core.hypoid_geometry.flank.vectors import Vector

_ITERATIONS = 12
_STEP = 1e-3  # rad of the gear
_LONGEST = 0.1
_CLOSED = 1e-5  # changes the slopes by less than a hundredth of a milliradian


def mean_point_slopes(
    gear: ReferenceCut, pinion: ReferenceCut, blank: HypoidBlank
) -> tuple[float, float]:
    """Return the slopes of the gap to the conjugate flank at the mean point, (2,) [rad].

    The gear's mean point turns through the mesh, and the pinion with it so that its flank passes
    through the point. Where the velocities of both members along the pinion's normal are equal,
    the point comes nearest to the conjugate flank; the slopes are the components of the
    difference of both normals there.

    Parameters
    ----------
    gear, pinion : ReferenceCut
        Of mating flanks.
    blank : HypoidBlank

    Returns
    -------
    along, across : float
        Slope along the tooth and over its height [rad]; NaN where there is no such position.

    References
    ----------
    [litvin_fuentes_2004 ch. 6] (equation of meshing).
    """
    axis = blank.gear_axis
    state = _gear_state(gear, blank)
    start = turn_to(axis, np.array(state.r), blank, np.zeros(3))
    own = np.array([state.r, unit_normal(state), state.r_th])
    work, point = np.array(pinion.motion.work_axis), np.array(pinion.motion.work_point)
    base = pinion_placement(pinion.motion, ALIGNED)
    cut = cut_state(pinion.motion, 0.0, pinion.cutter_angle, pinion.cradle_angle)
    turn = turn_to(work, np.array(cut.r) - point, blank, point)
    unknowns = np.array([0.0, pinion.cutter_angle, pinion.cradle_angle, turn])

    def meet(angle: float) -> tuple[float, Array, Array]:
        """Return the difference of the normal velocities, the pinion's normal, the gear's data."""
        placed = Rotation.from_rotvec((start + angle) * axis).apply(own)
        r, n = placed[0], placed[1]
        if intersect_rotation(pinion.motion, base, Vector(*r.tolist()), unknowns) != HIT:
            return math.nan, n, placed
        mate = np.array(unit_normal(cut_state(pinion.motion, *unknowns[:3])))
        facing = Rotation.from_rotvec(unknowns[3] * work).apply(mate)
        facing *= math.copysign(1.0, float(facing @ n))
        velocity = np.cross(axis, r) - np.cross(blank.ratio * blank.pinion_axis, r - point)
        return float(facing @ velocity), facing, placed

    angles = [0.0, _STEP]
    speeds = [meet(angle)[0] for angle in angles]
    for _ in range(_ITERATIONS):
        if not (math.isfinite(speeds[1]) and speeds[1] != speeds[0]):
            return math.nan, math.nan
        step = speeds[1] * (angles[1] - angles[0]) / (speeds[0] - speeds[1])
        angles = [angles[1], angles[1] + max(-_LONGEST, min(_LONGEST, step))]
        speed, facing, (_, n, lengthwise) = meet(angles[1])
        speeds = [speeds[1], speed]
        if abs(step) < _CLOSED:
            lengthwise /= np.linalg.norm(lengthwise)
            across = np.cross(n, lengthwise)
            return float((facing - n) @ lengthwise), float((facing - n) @ across)
    return math.nan, math.nan


def _gear_state(gear: ReferenceCut, blank: HypoidBlank) -> CutState:
    """Return the gear's flank at the mean point's radius and axial position.

    A form-cut flank passes the blades' mean point, a generated one runs a little below it.
    """
    place = np.array([0.0, gear.cutter_angle, gear.cradle_angle])
    if gear.motion.generated:
        mean, axis = reference_point(blank), blank.gear_axis
        axial = float(mean @ axis)
        radius = float(np.linalg.norm(mean - axial * axis))
        if locate(gear.motion, radius, axial, place) != CONVERGED:
            place[:] = math.nan
    return cut_state(gear.motion, *place)
