"""What the source leaves open about the gear pair, as variants of its gear file."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.flank.machine_frames import gear_cut, pinion_cut
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.units import DEGREE

BASE = "mohammadpour_2015"
_GROUPS = ("pinion.cutter.blade_groups", "gear.cutter.blade_groups")
_EDGES = ("pinion.cutter.blade_edge_radius_mm", "gear.cutter.blade_edge_radius_mm")
# the flank of a side on the pinion: concave drives
_CORRECTIONS: dict[Side, str] = {
    "drive": "pinion.cutter.concave_flank_angle_correction_deg",
    "coast": "pinion.cutter.convex_flank_angle_correction_deg",
}
_OFFSETS = {
    "gear": "gear.cutter.blade_offset_angle_deg",
    "pinion": "pinion.cutter.blade_offset_angle_deg",
}
_SWIVEL = "pinion.machine.basic_swivel_angle_deg"
_SWIVEL_CHANGE = -0.56  # deg, closes the pressure-angle error of the printed settings
_RANGE = 1.5  # deg, of a correction, to both sides
_TRIALS = 31
_REACH = 1.5  # pitches to either side of the reference point
_POSITIONS = 97


@dataclass(frozen=True, slots=True)
class Variant:
    """A gear file that agrees with the source as well as the shipped one, or shows a limit."""

    name: str
    label: str
    file: HypoidGearFile


def variants() -> list[Variant]:
    """Return the shipped file first, then one variant for each choice that it had to make."""
    file = HypoidGearFile.named(BASE)

    def made(name: str, label: str, changes: dict[str, Any], *, anew: bool = False) -> Variant:
        varied = file.varied(changes)
        if anew:
            varied, label = completed_anew(varied), label + ", blade angles completed again"
            name += "_anew"
        return Variant(name, label, varied)

    zero = dict.fromkeys(_CORRECTIONS.values(), 0.0)
    offset = {role: round(angle, 2) for role, angle in blade_offsets_deg(file).items()}
    ten = dict.fromkeys(_GROUPS, 10)
    flat = dict.fromkeys(_OFFSETS.values(), 0.0)
    result = [
        Variant("shipped", "shipped: 11 blade groups, edge radius 762 mm", file),
        made("groups_10", "10 blade groups", ten),
        made("groups_10", "10 blade groups", ten, anew=True),
    ]
    for role, field in _OFFSETS.items():
        for change in (5.0, -5.0):
            result.append(
                made(
                    f"{role}_hook{change:+.0f}",
                    f"{role} blade offset angle {change:+.0f} deg (of {offset[role]:+.2f})",
                    {field: offset[role] + change},
                )
            )
        result.append(
            made(f"{role}_hook_0", f"{role} blade offset angle 0", {field: 0.0}, anew=True)
        )
    result += [
        made("hook_0", "both blade offset angles 0", flat),
        made("hook_0", "both blade offset angles 0", flat, anew=True),
        made("edge_500", "blade edge radius 500 mm", dict.fromkeys(_EDGES, 500.0)),
        made("edge_1000", "blade edge radius 1000 mm", dict.fromkeys(_EDGES, 1000.0)),
        made("straight", "straight blade edges", dict.fromkeys(_EDGES)),
        made(
            "swivel",
            f"printed blade angles, pinion swivel {_SWIVEL_CHANGE:+.2f} deg",
            {**zero, _SWIVEL: file.pinion.machine.basic_swivel_angle_deg + _SWIVEL_CHANGE},
        ),
        made(
            "printed",
            "printed settings alone: straight blades, no correction",
            {**zero, **dict.fromkeys(_EDGES)},
        ),
    ]
    return result


def blade_offsets_deg(file: HypoidGearFile) -> dict[str, float]:
    """Return the blade offset angles [deg] that stand in a file or follow from its motion."""
    return {
        role: math.atan2(motion.sin_offset, motion.cos_offset) / DEGREE
        for role, motion in (
            ("gear", gear_cut(file, "convex").motion),
            ("pinion", pinion_cut(file, "concave").motion),
        )
    }


def completed_anew(file: HypoidGearFile) -> HypoidGearFile:
    """Return the file with pinion blade angles that put both error extremes at mid-depth.

    The rule by which the corrections of the shipped file were found.

    Raises
    ------
    ParameterError
        When no correction within 1.5 deg does so.
    """
    for side, field in _CORRECTIONS.items():
        file = file.varied({field: round(_correction(file, side, field), 4)})
    return file


def _correction(file: HypoidGearFile, side: Side, field: str) -> float:
    def slope(correction: float) -> float:
        return _error_slope(FlankPair.from_file(file.varied({field: correction}), side))

    trials = np.linspace(-_RANGE, _RANGE, _TRIALS)
    slopes = np.array([slope(float(c)) for c in trials])
    found = np.flatnonzero(slopes[1:] * slopes[:-1] < 0.0)
    if found.size == 0:
        raise ParameterError(
            f"No correction of {field} within {_RANGE:g} deg puts the {side} flanks' error extreme "
            "at mid-depth. Check the cutter and machine settings."
        )
    k = found[np.argmin(np.abs(trials[found]))]
    return float(brentq(slope, trials[k], trials[k + 1], xtol=1e-4))


def _error_slope(pair: FlankPair) -> float:
    """Return R_g less ratio times R_p [m] where the path crosses mid-depth; NaN if nowhere.

    Zero where the error is extreme.
    """
    try:
        path = contact_path(pair, np.linspace(-_REACH, _REACH, _POSITIONS) * pair.gear_pitch)
    except ParameterError:
        return math.nan
    k = path_kinematics(path)
    height, slope = path.gear_parameters[:, 0], k.R_g - pair.ratio * k.R_p
    crossing = np.flatnonzero(height[1:] * height[:-1] <= 0.0)
    if crossing.size == 0:
        return math.nan
    i = crossing[np.argmin(np.abs(path.gear_angle[crossing]))]
    weight = height[i] / (height[i] - height[i + 1])
    return float(slope[i] + weight * (slope[i + 1] - slope[i]))
