"""Start of a design: a form-cut gear on the blank, and the pinion that is its exact image."""

from __future__ import annotations

import math
from typing import Any

from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.hypoid_geometry.blank.hypoid_blank import MemberBlank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.units import DEGREE, MILLIMETRE


def image_pair(designed: DesignedBlank) -> HypoidGearFile:
    """Return the gear file of a form-cut gear and of the pinion that the gear itself would cut.

    The gear's cutter stands where its blade passes the calculation point at the spiral angle of
    the blank, its reference plane at the middle of the working depth. The pinion's cradle turns
    as the gear does in the mesh, with a cutter that fills the gear's slot: the flanks are
    conjugate (face milling) or nearly so (face hobbing), without crowning.

    References
    ----------
    [iso_23509 7.6] (lead angle); [karagiannis_2012 Table 1] (names of the settings).
    """
    cones, blank, cutter = designed.cones, designed.blank, designed.trace.cutter
    delta, radius = cones.gear_pitch_angle, cutter.radius
    height = blank.gear.addendum - 0.5 * blank.working_depth
    to_back = cones.gear_apex + height / math.sin(delta)
    along = cones.gear_mean_cone_distance + height / math.tan(delta)
    slope = cones.gear_spiral_angle - designed.trace.lead_angle
    horizontal = along - radius * math.sin(slope)
    vertical = radius * math.cos(slope)
    across = horizontal * math.sin(delta)
    cradle = math.atan2(vertical, across)
    blades: dict[str, Any] = {
        "point_radius_mm": radius / MILLIMETRE,
        "blade_groups": cutter.blade_groups,
    }
    drive, coast = designed.drive_blade_angle / DEGREE, designed.coast_blade_angle / DEGREE
    data: dict[str, Any] = {
        "name": blank.name,
        "source": f"{blank.source}; machine settings chosen by gearlube",
        "pair": {
            "offset_mm": blank.offset / MILLIMETRE,
            "clearance_mm": blank.root_clearance / MILLIMETRE,
        },
        "pinion": _member(blank.pinion)
        | {
            "cutter": blades
            | {"concave_flank_blade_angle_deg": drive, "convex_flank_blade_angle_deg": coast},
            "machine": {
                "machine_root_angle_deg": 0.0,
                "machine_center_to_back_mm": 0.0,
                "sliding_base_mm": (horizontal * math.cos(delta) - to_back) / MILLIMETRE,
                "blank_offset_mm": blank.offset / MILLIMETRE,
                "radial_setting_mm": math.hypot(vertical, across) / MILLIMETRE,
                "basic_cradle_angle_deg": cradle / DEGREE,
                "basic_swivel_angle_deg": cradle / DEGREE - 90.0,
                "tilt_angle_deg": 90.0 - delta / DEGREE,
                "ratio_of_roll": blank.ratio,
            },
        },
        "gear": _member(blank.gear)
        | {
            "cutter": blades
            | {"convex_flank_blade_angle_deg": drive, "concave_flank_blade_angle_deg": coast},
            "machine": {
                "machine_root_angle_deg": delta / DEGREE,
                "machine_center_to_back_mm": to_back / MILLIMETRE,
                "horizontal_setting_mm": horizontal / MILLIMETRE,
                "vertical_setting_mm": vertical / MILLIMETRE,
            },
        },
    }
    return HypoidGearFile.from_data(data, f"The design of {blank.name}")


def _member(member: MemberBlank) -> dict[str, Any]:
    return {
        "teeth": member.teeth,
        "face_width_mm": member.face_width / MILLIMETRE,
        "outer_cone_distance_mm": member.outer_cone_distance / MILLIMETRE,
        "pitch_angle_deg": member.pitch_angle / DEGREE,
        "spiral_angle_deg": member.spiral_angle / DEGREE,
        "pitch_apex_mm": member.pitch_apex / MILLIMETRE,
        "face_apex_mm": member.face_apex / MILLIMETRE,
    }
