"""Bevel and hypoid pairs as a bevel stage of REXS: blanks, without machine settings."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.designed_blank import SHAFT_ANGLE, DesignedBlank
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.rexs.document import Document
from gearlube_core.units import DEGREE, MILLIMETRE

_OTHER = {"right": "left", "left": "right"}
_CONE = (
    "teeth", "face_width_mm", "outer_cone_distance_mm", "pitch_angle_deg", "spiral_angle_deg",
    "pitch_apex_mm", "face_apex_mm",
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class _Cutter:
    radius: float  # m
    blade_groups: int
    kind: str  # of the pressure angles
    drive: float  # rad
    coast: float  # rad


def write_blank(file: BlankFile, document: Document) -> set[str]:
    """Add the pair of a blank file to a document; return the dotted fields that it took."""
    cutter = _Cutter(
        radius=file.cutter.radius_mm * MILLIMETRE,
        blade_groups=file.cutter.blade_groups,
        kind="effective",
        drive=file.cutter.drive_pressure_angle_deg * DEGREE,
        coast=file.cutter.coast_pressure_angle_deg * DEGREE,
    )
    _write(DesignedBlank.from_file(file).blank, cutter, file.pair.pinion_hand, document)
    return {"name", "method"} | {
        f"{section}.{key}"
        for section in ("pair", "cutter", "depth")
        for key in type(getattr(file, section)).model_fields
    }


def write_hypoid(file: HypoidGearFile, document: Document) -> set[str]:
    """Add the blank of a gear file to a document; return the dotted fields that it took."""
    blades = file.gear.cutter
    cutter = _Cutter(
        radius=blades.point_radius_mm * MILLIMETRE,
        blade_groups=blades.blade_groups,
        kind="generated",
        drive=(blades.convex_flank_blade_angle_deg + blades.convex_flank_angle_correction_deg)
        * DEGREE,
        coast=(blades.concave_flank_blade_angle_deg + blades.concave_flank_angle_correction_deg)
        * DEGREE,
    )
    _write(file.blank(), cutter, file.pair.pinion_hand, document)
    members = {f"{role}.{key}" for role in ("pinion", "gear") for key in _CONE}
    flanks = ("convex", "concave")
    blade = {
        "gear.cutter.point_radius_mm",
        "gear.cutter.blade_groups",
        *(f"gear.cutter.{curve}_flank_blade_angle_deg" for curve in flanks),
        *(f"gear.cutter.{curve}_flank_angle_correction_deg" for curve in flanks),
    }
    return {"name", "pair.offset_mm", "pair.pinion_hand", "pair.clearance_mm", *members, *blade}


def _write(blank: HypoidBlank, cutter: _Cutter, hand: str, document: Document) -> None:
    stage = document.component("bevel_stage", blank.name)
    document.value(stage, "shaft_angle", "deg", SHAFT_ANGLE / DEGREE)
    document.value(stage, "hypoid_offset", "mm", blank.offset / MILLIMETRE)
    document.value(stage, "cutter_radius", "mm", cutter.radius / MILLIMETRE)
    document.value(stage, "number_of_blade_groups", "none", cutter.blade_groups)
    for side in ("drive", "coast"):
        name = f"{cutter.kind}_pressure_angle_{side}"
        document.value(stage, name, "deg", getattr(cutter, side) / DEGREE)
    gears = []
    for role, own in (("pinion", hand), ("gear", _OTHER[hand])):
        gear = document.component("bevel_gear", role)
        document.value(gear, "number_of_teeth", "none", getattr(blank, role).teeth)
        for name, (unit, value) in member_attributes(blank, role).items():
            document.value(gear, name, unit, value)
        document.value(gear, "spiral_angle_pitch_direction", "none", own)
        gears.append(gear)
    document.stage(stage, *gears)


def member_attributes(blank: HypoidBlank, role: str) -> dict[str, tuple[str, float]]:
    """Return unit and value of each attribute of a bevel_gear that a blank determines.

    Parameters
    ----------
    blank : HypoidBlank
    role : str
        "pinion" or "gear".
    """
    member = getattr(blank, role)
    dedendum = blank.pinion_dedendum if role == "pinion" else blank.gear_dedendum
    sine, outer = math.sin(member.pitch_angle), member.outer_cone_distance
    lengths = {
        "face_width": member.face_width,
        "outer_pitch_diameter": 2.0 * outer * sine,
        "mean_pitch_diameter": 2.0 * member.mean_pitch_radius,
        "outer_cone_distance": outer,
        "mean_cone_distance": member.mean_cone_distance,
        "inner_cone_distance": outer - member.face_width,
        "pitch_apex_beyond_crossing_point": member.pitch_apex,
        "face_apex_beyond_crossing_point": member.face_apex,
        "root_apex_beyond_crossing_point": member.pitch_apex - dedendum / sine,
        "mean_addendum": member.addendum,
        "mean_dedendum": dedendum,
        "mean_normal_module": blank.mean_normal_module,
    }
    angles = {  # teeth are equally deep
        "pitch_angle": member.pitch_angle,
        "face_angle": member.pitch_angle,
        "root_angle": member.pitch_angle,
        "mean_spiral_angle": member.spiral_angle,
    }
    return {name: ("mm", value / MILLIMETRE) for name, value in lengths.items()} | {
        name: ("deg", value / DEGREE) for name, value in angles.items()
    }
