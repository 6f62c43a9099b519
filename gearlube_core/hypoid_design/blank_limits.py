"""Whether teeth can stand on a blank: reach of the cutter, pointed tops, undercut.

The tooth in the normal section is taken as that of a spur gear of the pitch radius
R_m tan(delta) / cos^2(beta) (Tredgold's approximation). That is an estimate for the choice of a
blank; the teeth as cut are examined when the machine settings are known.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.tooth_limits import (
    check_clearance,
    check_tip,
    tip_thickness,
    undercut_depth,
)
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.units import DEGREE, MILLIMETRE

Role = Literal["pinion", "gear"]

STEEPEST = 65.0 * DEGREE  # spiral angle anywhere on the face; gear files go no further
LEAST_BLADE, LARGEST_BLADE = 5.0 * DEGREE, 40.0 * DEGREE
USUAL_WIDTH = 0.35  # face width over outer cone distance; a third is customary


class SectionTooth(NamedTuple):
    """A tooth in its normal section at one cone distance.

    Parameters
    ----------
    topland : float
        Normal width at the tip [m]; zero or less: pointed.
    undercut : float
        By how much the mate's tip reaches below the undercut limit [m]; negative: it does not.
    """

    topland: float
    undercut: float


def section_tooth(designed: DesignedBlank, role: Role) -> SectionTooth:
    """Return the tooth of a member in the normal section at its mean point.

    Involute of the virtual spur gear; undercut where the mate's straight-sided tooth would reach
    below r sin^2(alpha) under the pitch line.
    """
    cones, blank = designed.cones, designed.blank
    if role == "pinion":
        distance, angle = cones.pinion_mean_cone_distance, cones.pinion_pitch_angle
        spiral, thickness = cones.pinion_spiral_angle, designed.pinion_thickness
        addendum, mate = blank.pinion.addendum, blank.gear.addendum
    else:
        distance, angle = cones.gear_mean_cone_distance, cones.gear_pitch_angle
        spiral, thickness = cones.gear_spiral_angle, designed.gear_thickness
        addendum, mate = blank.gear.addendum, blank.pinion.addendum
    alpha = designed.pressure_angle
    radius = distance * math.tan(angle) / math.cos(spiral) ** 2
    topland = tip_thickness(radius, thickness, radius + addendum, alpha)
    return SectionTooth(topland, undercut_depth(radius, alpha, mate))


def check_blank(designed: DesignedBlank) -> list[str]:
    """Return warnings about a blank, one sentence each.

    Raises
    ------
    ParameterError
        When no teeth can stand on it: the cutter does not reach over the face, the tops are
        pointed or the pinion is undercut at mid-face. The message names the fields.
    """
    _angles(designed)
    return [*_face(designed), *_trace(designed), *_teeth(designed)]


def _angles(designed: DesignedBlank) -> None:
    cones = designed.cones
    if cones.gear_spiral_angle < 0.0:
        raise ParameterError(
            "The pinion's spiral angle must be at least the offset angle, got "
            f"{cones.pinion_spiral_angle / DEGREE:.1f} and {cones.offset_angle / DEGREE:.1f} deg: "
            "none is left for the gear. Increase the spiral angle or reduce pair.offset_mm."
        )
    for flank, angle in (
        ("drive", designed.drive_blade_angle),
        ("coast", designed.coast_blade_angle),
    ):
        if not LEAST_BLADE <= angle <= LARGEST_BLADE:
            raise ParameterError(
                f"The blade angle of the {flank} flank must be within {LEAST_BLADE / DEGREE:g} to "
                f"{LARGEST_BLADE / DEGREE:g} deg, got {angle / DEGREE:.1f} deg with a limit "
                f"pressure angle of {cones.limit_pressure_angle / DEGREE:.1f} deg. Change "
                f"cutter.{flank}_pressure_angle_deg or reduce pair.offset_mm."
            )


def _face(designed: DesignedBlank) -> list[str]:
    width = designed.gear_face.total
    if designed.gear_face.outer <= 0.0 or designed.gear_face.inner <= 0.0:
        raise ParameterError(
            "The calculation point must lie on the face of the gear, got "
            f"{designed.gear_face.outer / MILLIMETRE:.3g} mm from the heel of a face of "
            f"{width / MILLIMETRE:.3g} mm. Increase pair.face_width_mm or reduce pair.offset_mm."
        )
    share = width / designed.blank.gear.outer_cone_distance
    if share > USUAL_WIDTH:
        return [
            f"The face width is {share:.2f} of the outer cone distance; {USUAL_WIDTH:g} is usual."
        ]
    return []


def _trace(designed: DesignedBlank) -> list[str]:
    cutter, warnings = designed.file.cutter, []
    gear = designed.blank.gear
    ends = (("heel", gear.outer_cone_distance), ("toe", gear.outer_cone_distance - gear.face_width))
    for name, distance in ends:
        try:
            spiral = designed.trace.spiral_angle(distance)
        except ParameterError as reason:
            raise ParameterError(
                f"A cutter of cutter.radius_mm {cutter.radius_mm:g} mm does not cut the gear from "
                f"toe to heel at this spiral angle. {reason} Enlarge the cutter, or reduce the "
                "spiral angle or pair.face_width_mm."
            ) from None
        if abs(spiral) > STEEPEST:
            raise ParameterError(
                f"The gear's spiral angle at the {name} must be below {STEEPEST / DEGREE:g} deg, "
                f"got {spiral / DEGREE:.1f} deg. Enlarge cutter.radius_mm, or reduce the spiral "
                "angle or pair.face_width_mm."
            )
        if spiral < 0.0 < designed.cones.gear_spiral_angle:
            warnings.append(
                f"The gear's spiral angle turns to the other hand at the {name}, "
                f"{spiral / DEGREE:.1f} deg. A larger cutter or spiral angle avoids it."
            )
    groups = cutter.blade_groups
    if groups:
        for role, teeth in (
            ("pinion", designed.file.pair.pinion_teeth),
            ("gear", designed.file.pair.gear_teeth),
        ):
            shared = math.gcd(groups, teeth)
            if shared > 1:
                raise ParameterError(
                    f"cutter.blade_groups must share no factor with pair.{role}_teeth, got "
                    f"{groups} and {teeth}, which share {shared}. Change the blade groups."
                )
    return warnings


def _teeth(designed: DesignedBlank) -> list[str]:
    module = designed.normal_module
    warnings = check_clearance(
        "gear", designed.blank.root_clearance, module, "Increase depth.clearance_factor."
    )
    roles: tuple[Role, Role] = ("pinion", "gear")
    for role in roles:
        tooth = section_tooth(designed, role)
        warnings += check_tip(
            role, tooth.topland, module,
            "Reduce depth.depth_factor or the pressure angles of [cutter], or move addendum to the "
            "mate (depth.gear_addendum_factor).",
        )  # fmt: skip
        if tooth.undercut > 0.0:
            raise ParameterError(
                f"The {role} is undercut on its working flank: at mid-face the tip of the mate "
                f"reaches {tooth.undercut / MILLIMETRE:.2f} mm below the limit. Take more "
                f"{role} teeth or a larger spiral angle or pressure angle, a smaller "
                "depth.depth_factor, or move addendum to the pinion (a smaller "
                "depth.gear_addendum_factor)."
            )
    return warnings
