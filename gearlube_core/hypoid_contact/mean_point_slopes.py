"""Slopes of the ease-off at the mean point: whether pinion and gear flank are parallel there."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.hypoid_contact.flank_intersection import HIT, intersect_rotation
from gearlube_core.hypoid_contact.placement import ALIGNED, pinion_placement
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.cutting_motion import cut_state, unit_normal
from gearlube_core.hypoid_geometry.flank.machine_check import turn_to
from gearlube_core.hypoid_geometry.flank.machine_frames import ReferenceCut
from gearlube_core.hypoid_geometry.flank.vectors import Vector


def mean_point_slopes(
    gear: ReferenceCut, pinion: ReferenceCut, blank: HypoidBlank
) -> tuple[float, float]:
    """Return the slopes of the gap to the conjugate flank at the mean point, (2,) [rad].

    The gear's point is turned to where it would touch a conjugate pinion: there the velocities of
    both members along the normal are equal. The pinion is turned until its flank passes through
    the point; the slopes are the components of the difference of both normals.

    Parameters
    ----------
    gear, pinion : ReferenceCut
        Of mating flanks.
    blank : HypoidBlank

    Returns
    -------
    along, across : float
        Slope along the tooth and over its height [rad]; NaN where a conjugate pinion would not
        touch the point, or the pinion's flank does not reach it.

    References
    ----------
    [litvin_fuentes_2004 ch. 6] (equation of meshing).
    """
    state = cut_state(gear.motion, 0.0, gear.cutter_angle, gear.cradle_angle)
    axis, origin = blank.gear_axis, np.zeros(3)
    start = turn_to(axis, np.array(state.r), blank, origin)
    turn = Rotation.from_rotvec(start * axis)
    r, n = turn.apply(np.array(state.r)), turn.apply(np.array(unit_normal(state)))
    lengthwise = turn.apply(np.array(state.r_th))

    # normal velocity per gear rotation less the pinion's: C - A cos(phi) - B sin(phi)
    axis_p = blank.ratio * blank.pinion_axis
    arm = np.array([0.0, blank.offset, 0.0])
    own = float(n @ np.cross(axis, r))

    def pinion_part(angle: float) -> float:
        turned = Rotation.from_rotvec(angle * axis)
        return float(turned.apply(n) @ np.cross(axis_p, turned.apply(r) - arm))

    # the part without rotation is the mean of two opposite angles
    at = [pinion_part(k * 0.5 * math.pi) for k in range(4)]
    mean, a, b = 0.5 * (at[0] + at[2]), 0.5 * (at[0] - at[2]), 0.5 * (at[1] - at[3])
    size = math.hypot(a, b)
    if not abs(own - mean) <= size:
        return math.nan, math.nan
    direction, reach = math.atan2(b, a), math.acos((own - mean) / size)
    angles = [math.remainder(direction + s * reach, 2.0 * math.pi) for s in (1.0, -1.0)]
    turn = Rotation.from_rotvec(min(angles, key=abs) * axis)
    r, n, lengthwise = turn.apply(r), turn.apply(n), turn.apply(lengthwise)

    work = np.array(pinion.motion.work_axis)
    point = np.array(pinion.motion.work_point)
    cut = cut_state(pinion.motion, 0.0, pinion.cutter_angle, pinion.cradle_angle)
    unknowns = np.array(
        [
            0.0,
            pinion.cutter_angle,
            pinion.cradle_angle,
            turn_to(work, np.array(cut.r) - point, blank, point),
        ]
    )
    target = Vector(float(r[0]), float(r[1]), float(r[2]))
    base = pinion_placement(pinion.motion, ALIGNED)
    if intersect_rotation(pinion.motion, base, target, unknowns) != HIT:
        return math.nan, math.nan
    mate = unit_normal(cut_state(pinion.motion, *unknowns[:3]))
    facing = Rotation.from_rotvec(unknowns[3] * work).apply(np.array(mate))
    difference = math.copysign(1.0, float(facing @ n)) * facing - n
    lengthwise /= np.linalg.norm(lengthwise)
    return float(difference @ lengthwise), float(difference @ np.cross(n, lengthwise))
