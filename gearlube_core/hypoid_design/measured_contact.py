"""What the unloaded contact analysis finds of the numbers that a design asks for."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.contact_pattern import MARKING_COMPOUND
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.unloaded_error import contact_ratio, unloaded_error
from gearlube_core.hypoid_design.flank_target import flank_steps
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

_POSITIONS = 33
_STEP = 0.02  # of a pitch, for the direction of the path


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredContact:
    """Unloaded contact of one side, at the extreme of its transmission error.

    Parameters
    ----------
    s, t : float
        Profile and face position on the gear [-].
    error : float
        Peak to peak of the transmission error at the pinion [rad].
    length : float
        Of the contact ellipse at a gap of 6.35 um [m].
    path_angle : float
        Of the path of contact on the gear flank, as targets count it [rad].
    contact_ratio : float
        Pitches over which the path lies on both teeth [-].
    """

    s: float
    t: float
    error: float
    length: float
    path_angle: float
    contact_ratio: float


def measured_contact(file: HypoidGearFile, side: Side) -> MeasuredContact | str:
    """Return the contact of one side of a gear file, or why it has no parabolic error."""
    try:
        pair = FlankPair.from_file(file, side)
        error = unloaded_error(pair, _POSITIONS)
        angles = error.extreme_angle + np.array([-_STEP, 0.0, _STEP]) * pair.gear_pitch
        path = contact_path(pair, angles)
        ratio = contact_ratio(pair).path
    except ParameterError as reason:
        return str(reason)
    s, t = float(path.gear_s[1]), float(path.gear_t[1])
    middle = int(np.argmin(np.abs(error.gear_angle - error.extreme_angle)))
    radius = float(error.kinematics.R_y[middle])
    heel, tip = flank_steps(pair.gear, s, t)
    own = pair.gear.sample(path.gear_s, path.gear_t).r
    way = own[2] - own[0]
    return MeasuredContact(
        s=s,
        t=t,
        error=float(np.ptp(error.angular)),
        length=2.0 * math.sqrt(2.0 * MARKING_COMPOUND * radius) if radius > 0.0 else math.inf,
        path_angle=math.atan2(float(way @ tip), float(way @ heel)) % math.pi,
        contact_ratio=ratio,
    )
