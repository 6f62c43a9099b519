"""Whether the blanks of a gear file fit each other: teeth, cones, spiral angles and heights."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.misfit import Misfit
from gearlube_core.units import DEGREE, MILLIMETRE

# limits between what sound and wrong pairs show: sound ones stay below 0.3 %, 0.01 mm, 0.1 deg;
# one tooth more or less is 2 to 14 %, an offset of 31.75 for 24 mm is 1.4 mm and 0.9 deg
PITCH_LIMIT = 0.015
CONE_LIMIT = 0.05 * MILLIMETRE
NORMAL_LIMIT = 0.2 * DEGREE
SPIRAL_LIMIT = 0.5 * DEGREE
# heights in normal modules: 2 is the usual working depth [iso_23509 annex C]
DEPTH = 2.0
DEPTH_LIMIT = 0.3
DEPTH_REFUSED = 1.0

_CONE = ("teeth", "face_width_mm", "outer_cone_distance_mm", "pitch_angle_deg", "spiral_angle_deg")
_HEIGHT = ("pitch_apex_mm", "face_apex_mm")
_ROLES = ("pinion", "gear")
BLANK_FIELDS = (
    "pair.offset_mm",
    *(f"{role}.{name}" for role in _ROLES for name in (*_CONE, *_HEIGHT)),
)


def blank_misfits(file: HypoidGearFile) -> list[Misfit]:
    """Return the checks of the blanks; the pitch cones must touch at the mean point.

    References
    ----------
    [iso_23509 (90)] (one normal pitch), [iso_23509 (94)] (offset angle).
    """
    blank = file.blank()
    pinion, gear = blank.pinion, blank.gear
    pitches = [m.mean_pitch_radius * math.cos(m.spiral_angle) / m.teeth for m in (pinion, gear)]
    depth = blank.working_depth / blank.mean_normal_module
    misfits = [
        _blank(
            "The difference of the tooth pitches at the mean point (pinion less gear: mean pitch "
            "radius, spiral angle and teeth)",
            pitches[0] / pitches[1] - 1.0,
            PITCH_LIMIT,
            "%",
        ),
        Misfit(
            what=f"The working depth (apexes and pitch angles) less {DEPTH:g} normal modules, in "
            "normal modules,",
            value=depth - DEPTH,
            limit=DEPTH_LIMIT,
            refused=DEPTH_REFUSED,
            unit="",
            fields=BLANK_FIELDS,
        ),
    ]
    try:
        mean, normal = blank.mean_point(), blank.pitch_normal()
    except ParameterError as reason:
        return [*misfits, _blank("", math.nan, 1.0, "", str(reason))]
    line = mean - blank.pinion_apex
    sine, cosine = math.sin(pinion.pitch_angle), math.cos(pinion.pitch_angle)
    radius = math.hypot(line[1], line[2])
    generator = line / np.linalg.norm(line)
    across = np.array([0.0, line[1], line[2]]) / radius
    cone_normal = cosine * across - sine * np.array([1.0, 0.0, 0.0])
    turned = math.acos(min(1.0, abs(float(cone_normal @ normal))))
    between = math.acos(min(1.0, max(-1.0, float(generator @ blank.gear_generator()))))
    return [
        *misfits,
        _blank(
            "The distance of the mean point from the pinion's pitch cone",
            radius * cosine - line[0] * sine,
            CONE_LIMIT,
            "mm",
        ),
        _blank(
            "The distance of the mean point from mid-face of the pinion",
            radius * sine + line[0] * cosine - pinion.mean_cone_distance,
            0.02 * pinion.mean_cone_distance,
            "mm",
        ),
        _blank("The angle between the pitch cones at the mean point", turned, NORMAL_LIMIT, "deg"),
        _blank(
            "The difference of the spiral angles (pinion less gear) less the offset angle of the "
            "cones",
            pinion.spiral_angle - gear.spiral_angle - between,
            SPIRAL_LIMIT,
            "deg",
        ),
    ]


def _blank(what: str, value: float, limit: float, unit: str, reason: str = "") -> Misfit:
    return Misfit(
        what=what,
        value=value,
        limit=limit,
        refused=limit,
        unit=unit,
        fields=BLANK_FIELDS,
        reason=reason,
    )
