"""Whether cutter and machine settings cut the teeth that the blank describes."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank, MemberBlank
from gearlube_core.hypoid_geometry.flank.cutting_motion import cut_state
from gearlube_core.hypoid_geometry.flank.flank import Role
from gearlube_core.hypoid_geometry.flank.machine_frames import (
    ReferenceCut,
    gear_cut,
    pinion_cut,
    reference_plane_distance,
    reference_point,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile, Misfit
from gearlube_core.units import DEGREE, MILLIMETRE

# a tenth of a millimetre is 60 times the misfit of the shipped pair; a whole one shifts the contact
# off the teeth
REFERENCE_LIMIT = 0.1 * MILLIMETRE
REFERENCE_REFUSED = 1.0 * MILLIMETRE
# sound pairs stay below 0.9 (gear) and 3 deg (pinion), whose tilted blades cut no pitch point;
# 5 blade groups for 11 give 7.8 deg, no tilt 12 deg
SPIRAL_LIMIT = {"gear": 2.0 * DEGREE, "pinion": 5.0 * DEGREE}
ROLL_LIMIT = 0.05  # sound pairs stay below 3 %
IMAGE_ROOT_ANGLE = 2.0  # deg; below it the cradle stands in for the gear and rolls like it

# removed at the tips of a blade of that radius; sound pairs stay below 0.015 mm
EDGE_LIMIT = 0.04 * MILLIMETRE

_CUTTER = ("point_radius_mm", "blade_groups")
GEAR_FIELDS = (
    *(f"gear.cutter.{name}" for name in _CUTTER),
    "gear.machine.machine_root_angle_deg",
    "gear.machine.machine_center_to_back_mm",
    "gear.machine.horizontal_setting_mm",
    "gear.machine.vertical_setting_mm",
    "gear.machine.ratio_of_roll",
)
PINION_FIELDS = (
    *(f"pinion.cutter.{name}" for name in _CUTTER),
    "pinion.machine.machine_root_angle_deg",
    "pinion.machine.machine_center_to_back_mm",
    "pinion.machine.sliding_base_mm",
    "pinion.machine.blank_offset_mm",
    "pinion.machine.radial_setting_mm",
    "pinion.machine.basic_cradle_angle_deg",
    "pinion.machine.basic_swivel_angle_deg",
    "pinion.machine.tilt_angle_deg",
)
_TIPS = ("pinion.face_apex_mm", "gear.face_apex_mm")  # the middle of the working depth
_TEETH = ("pinion.teeth", "gear.teeth")
_GROUPS = ("pinion.cutter.blade_groups", "gear.cutter.blade_groups")


def reference_misfit(file: HypoidGearFile, role: Role) -> float:
    """Return the distance of a cutter's reference plane from the middle of the working depth [m].

    For the pinion: height of the mean reference point over the plane, at the cradle angle that
    brings it to the point radius. For the gear: height of the cutter's path over the middle of the
    working depth where it crosses the mean cone distance. Positive towards the blade tips.
    """
    cut = pinion_cut(file, "concave") if role == "pinion" else gear_cut(file, "convex")
    return _plane(cut, file.blank(), role)


def spiral_angle_as_cut(cut: ReferenceCut, blank: HypoidBlank, role: Role) -> float:
    """Return the spiral angle of the blades' path at the mean reference point [rad].

    In the pitch plane, from the member's cone generator; positive with the hand of the pair.
    """
    motion = cut.motion
    axis, point = np.array(motion.work_axis), np.array(motion.work_point)
    state = cut_state(motion, 0.0, cut.cutter_angle, cut.cradle_angle)
    turn = Rotation.from_rotvec(turn_to(axis, np.array(state.r) - point, blank, point) * axis)
    along = turn.apply(np.array(state.r_th))
    normal, mean = blank.pitch_normal(), blank.mean_point()
    apex = blank.pinion_apex if role == "pinion" else blank.gear_apex
    generator = (mean - apex) / np.linalg.norm(mean - apex)
    across = np.cross(generator, normal)
    return math.atan(float(along @ across) / float(along @ generator))


def turn_to(axis: Array, r: Array, blank: HypoidBlank, point: Array) -> float:
    """Return the rotation about `axis` [rad] that brings `r` [m] before the mean reference point.

    `r`, shape (3,), counts from `point` on the axis.
    """
    mean = reference_point(blank) - point
    return math.atan2(float(axis @ np.cross(r, mean)), float(r @ mean - (axis @ r) * (axis @ mean)))


def gear_misfits(file: HypoidGearFile, cut: ReferenceCut) -> list[Misfit]:
    """Return the checks of the gear's cutter and machine; `cut` is that of the file."""
    return _cut_misfits(cut, file.blank(), "gear", GEAR_FIELDS)


def pinion_misfits(file: HypoidGearFile, cut: ReferenceCut) -> list[Misfit]:
    """Return the checks of the pinion's cutter and machine; `cut` is that of the file."""
    return _cut_misfits(cut, file.blank(), "pinion", PINION_FIELDS)


def edge_misfits(file: HypoidGearFile) -> list[Misfit]:
    """Return the checks of the blade edge radii: the profile crowning that they give.

    Half the working depth h/2 over and under the middle, a radius R removes (h/2)^2/(2 R).
    """
    depth = file.blank().working_depth
    found = []
    for role, member in (("pinion", file.pinion), ("gear", file.gear)):
        radii: dict[str, float | None] = {"blade": member.cutter.blade_edge_radius_mm}
        radii["convex_flank"] = member.cutter.convex_flank_edge_radius_mm
        radii["concave_flank"] = member.cutter.concave_flank_edge_radius_mm
        for blade, radius in radii.items():
            if radius is None:
                continue
            found.append(
                Misfit(
                    what=f"The crowning by {role}.cutter.{blade}_edge_radius_mm, at tip and root,",
                    value=depth**2 / (8.0 * radius * MILLIMETRE),
                    limit=EDGE_LIMIT,
                    refused=math.inf,
                    unit="mm",
                    fields=(f"{role}.cutter.{blade}_edge_radius_mm",),
                )
            )
    return found


def unreachable(role: Role, reason: ParameterError) -> Misfit:
    """Return the misfit of a cutter that does not even reach the tooth."""
    fields = GEAR_FIELDS if role == "gear" else PINION_FIELDS
    return Misfit(
        what="", value=math.nan, limit=1.0, refused=1.0, unit="", fields=fields, reason=str(reason)
    )


def roll_misfits(file: HypoidGearFile) -> list[Misfit]:
    """Return the checks of the numbers that need no geometry: ratio of roll and blade groups.

    The ratio of roll is checked where the cradle stands in for the gear: machine root angle below
    2 deg, the same ratio over the whole cut.
    """
    machine, pinion, gear = file.pinion.machine, file.pinion, file.gear
    found = []
    constant = machine.modified_roll_2c == machine.modified_roll_6d == 0.0
    if abs(machine.machine_root_angle_deg) <= IMAGE_ROOT_ANGLE and constant:
        found.append(
            _grave(
                "The difference of the ratio of roll from the teeth ratio gear / pinion",
                machine.ratio_of_roll * pinion.teeth / gear.teeth - 1.0,
                ROLL_LIMIT,
                "%",
                ("pinion.machine.ratio_of_roll", *_TEETH),
            )
        )
    rolls = gear.machine.ratio_of_roll
    if rolls is not None:
        found.append(
            _grave(
                "The difference of the gear's ratio of roll from that of its pitch cone",
                rolls * math.sin(gear.pitch_angle_deg * DEGREE) - 1.0,
                ROLL_LIMIT,
                "%",
                ("gear.machine.ratio_of_roll", "gear.pitch_angle_deg"),
            )
        )
    groups = pinion.cutter.blade_groups
    if groups:
        found.append(
            _grave(
                "The difference of the blade groups (pinion less gear)",
                float(groups - gear.cutter.blade_groups),
                0.5,
                "",
                _GROUPS,
            )
        )
    for role, member in (("pinion", pinion), ("gear", gear)):
        if member.cutter.blade_groups:
            shared = math.gcd(member.cutter.blade_groups, member.teeth)
            found.append(
                _grave(
                    f"The common factor of the {role}'s blade groups and teeth, less one,",
                    shared - 1.0,
                    0.5,
                    "",
                    (f"{role}.cutter.blade_groups", f"{role}.teeth"),
                )
            )
    return found


def _cut_misfits(
    cut: ReferenceCut, blank: HypoidBlank, role: Role, fields: tuple[str, ...]
) -> list[Misfit]:
    member: MemberBlank = blank.pinion if role == "pinion" else blank.gear
    spiral = spiral_angle_as_cut(cut, blank, role)
    hand = " (the other hand)" if spiral * member.spiral_angle < 0.0 else ""
    return [
        Misfit(
            what=f"The distance of the {role} cutter's reference plane from the middle of the "
            "working depth",
            value=_plane(cut, blank, role),
            limit=REFERENCE_LIMIT,
            refused=REFERENCE_REFUSED,
            unit="mm",
            fields=(*fields, *_TIPS),
        ),
        _grave(
            f"The spiral angle that the {role}'s cutter cuts at the mean point{hand}, less "
            f"{role}.spiral_angle_deg,",
            spiral - member.spiral_angle,
            SPIRAL_LIMIT[role],
            "deg",
            (*fields, f"{role}.teeth"),
        ),
    ]


def _grave(what: str, value: float, limit: float, unit: str, fields: tuple[str, ...]) -> Misfit:
    return Misfit(what=what, value=value, limit=limit, refused=limit, unit=unit, fields=fields)


def _plane(cut: ReferenceCut, blank: HypoidBlank, role: Role) -> float:
    if role == "pinion":
        return reference_plane_distance(cut, blank)
    r = np.array(cut_state(cut.motion, 0.0, cut.cutter_angle, 0.0).r) - blank.gear_apex
    delta = blank.gear.pitch_angle
    height = math.hypot(r[0], r[1]) * math.cos(delta) - r[2] * math.sin(delta)
    return height - (blank.gear.addendum - 0.5 * blank.working_depth)
