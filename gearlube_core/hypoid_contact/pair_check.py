"""Checks of a gear file in order of their cost: blanks, machines, slopes, unloaded contact."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.ease_off import mean_point_slopes
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_contact.unloaded_error import unloaded_error
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Role, Side
from gearlube_core.hypoid_geometry.flank.machine_check import (
    GEAR_FIELDS,
    PINION_FIELDS,
    edge_misfits,
    gear_misfits,
    pinion_misfits,
    roll_misfits,
    unreachable,
)
from gearlube_core.hypoid_geometry.flank.machine_frames import (
    ReferenceCut,
    gear_cut,
    other_flank,
    pinion_cut,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile, Misfit
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
# sound pairs stay below 3 mrad; blade angles of the wrong flanks give 74, an offset of 31.75 for
# 24 mm 92, 41 for 36 teeth 202
SLOPE_LIMIT = 0.01
ERROR_LIMIT = 1e-3  # rad, peak to peak at the pinion; sound pairs stay below 0.4 mrad
_ERROR_POSITIONS = 17

SIDES: tuple[Side, ...] = ("drive", "coast")
_EDGE = ("flank_blade_angle_deg", "flank_angle_correction_deg")
EDGE_FIELDS = tuple(
    f"{role}.cutter.{curve}_{name}"
    for role in ("pinion", "gear")
    for curve in ("convex", "concave")
    for name in _EDGE
)
# what decides the flanks but no check of blanks or machines
FLANK_FIELDS = (
    *EDGE_FIELDS,
    *(
        f"{role}.cutter.{name}"
        for role in ("pinion", "gear")
        for name in (
            "blade_edge_radius_mm",
            "convex_flank_edge_radius_mm",
            "concave_flank_edge_radius_mm",
            "blade_offset_angle_deg",
        )
    ),
)
_ALL = (*PINION_FIELDS, "pinion.machine.ratio_of_roll", *GEAR_FIELDS, *FLANK_FIELDS)

Cuts = dict[Role, ReferenceCut | ParameterError]


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


def reference_cuts(file: HypoidGearFile, known: Cuts | None = None) -> Cuts:
    """Return the motion that cuts one flank of each member, or why there is none.

    `known` holds those that need not be found again.
    """
    cuts: Cuts = dict(known or {})
    for role, cut, curve in (("gear", gear_cut, "convex"), ("pinion", pinion_cut, "concave")):
        if role not in cuts:
            try:
                cuts[role] = cut(file, curve)  # type: ignore[index,arg-type]
            except ParameterError as reason:
                cuts[role] = reason  # type: ignore[index]
    return cuts


def misfits_by_cost(file: HypoidGearFile, known: Cuts | None = None) -> Iterator[list[Misfit]]:
    """Return the checks of a gear file, one group after the other, the cheapest first.

    Each group takes for granted that those before are sound.
    """
    yield blank_misfits(file)
    yield [*roll_misfits(file), *edge_misfits(file)]
    cuts = reference_cuts(file, known)
    for role, check in (("gear", gear_misfits), ("pinion", pinion_misfits)):
        cut = cuts[role]  # type: ignore[index]
        if isinstance(cut, ParameterError):
            yield [unreachable(role, cut)]  # type: ignore[arg-type]
        else:
            yield check(file, cut)
    yield _slopes(file, cuts)


def first_misfits(file: HypoidGearFile) -> list[Misfit]:
    """Return the misfits of the first group that a file must be refused for; empty if none."""
    for group in misfits_by_cost(file):
        refused = [one for one in group if one.is_refused]
        if refused:
            return refused
    return []


def _slopes(file: HypoidGearFile, cuts: Cuts) -> list[Misfit]:
    gear, pinion = cuts["gear"], cuts["pinion"]
    if isinstance(gear, ParameterError) or isinstance(pinion, ParameterError):
        return []
    found = []
    for side in SIDES:
        slopes = mean_point_slopes(
            other_flank(gear, file.gear, CURVES["gear", side]),
            other_flank(pinion, file.pinion, CURVES["pinion", side]),
            file.blank(),
        )
        for name, slope in zip(("along", "over the height of"), slopes, strict=True):
            found.append(
                Misfit(
                    what=f"The slope between the {side} flanks at the mean point, {name} the "
                    "tooth,",
                    value=slope,
                    limit=SLOPE_LIMIT,
                    refused=SLOPE_LIMIT,
                    unit="mrad",
                    fields=_ALL,
                    reason=f"The {side} flanks do not meet at the mean point at any position.",
                )
            )
    return found


def unloaded_refusal(file: HypoidGearFile, misalignment: Misalignment = ALIGNED) -> str | None:
    """Return why the unloaded flanks touch in no point of both teeth; None if both sides do.

    As they are cut, without corrections.
    """
    for side in SIDES:
        try:
            contact_path(FlankPair.from_file(file, side, misalignment).uncorrected(), np.zeros(1))
        except ParameterError as reason:
            return str(reason)
    return None


def unloaded_warnings(file: HypoidGearFile) -> list[str]:
    """Return warnings about the unloaded mesh of a file that meets, one sentence each.

    As the flanks are cut, without corrections.
    """
    found = []
    for side in SIDES:
        try:
            error = unloaded_error(FlankPair.from_file(file, side).uncorrected(), _ERROR_POSITIONS)
        except ParameterError as reason:
            field = f"pinion.cutter.{CURVES['pinion', side]}_flank_angle_correction_deg"
            found.append(f"{reason} {field} moves the extreme most.")
            continue
        size = float(np.ptp(error.angular))
        if not size <= ERROR_LIMIT or math.isnan(size):
            found.append(
                f"The unloaded transmission error of the {side} flanks should be below "
                f"{1e6 * ERROR_LIMIT:g} urad peak to peak, got {1e6 * size:.0f} urad. Check the "
                "blade edge radii and the cutter radii: they decide the crowning."
            )
    return found
