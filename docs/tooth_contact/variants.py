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
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

BASE = "mohammadpour_2015"
_GROUPS = ("pinion.cutter.blade_groups", "gear.cutter.blade_groups")
_EDGES = ("pinion.cutter.blade_edge_radius_mm", "gear.cutter.blade_edge_radius_mm")
# the flank of a side on the pinion: concave drives
_CORRECTIONS: dict[Side, str] = {
    "drive": "pinion.cutter.concave_flank_angle_correction_deg",
    "coast": "pinion.cutter.convex_flank_angle_correction_deg",
}
_GEAR_HOOK = "gear.cutter.blade_offset_angle_deg"
_PINION_HOOK = "pinion.cutter.blade_offset_angle_deg"
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

    def made(name: str, label: str, changes: dict[str, Any], *, again: bool = False) -> Variant:
        varied = file.varied(changes)
        if again:
            varied, label = completed_again(varied), label + ", blade angles completed again"
        return Variant(name, label, varied)

    zero = dict.fromkeys(_CORRECTIONS.values(), 0.0)
    return [
        Variant("shipped", "shipped: 11 blade groups, edge radius 762 mm", file),
        made("groups_10", "10 blade groups", dict.fromkeys(_GROUPS, 10), again=True),
        made("gear_hook_0", "gear blade offset angle 0", {_GEAR_HOOK: 0.0}, again=True),
        made("pinion_hook_0", "pinion blade offset angle 0", {_PINION_HOOK: 0.0}, again=True),
        made("edge_500", "blade edge radius 500 mm", dict.fromkeys(_EDGES, 500.0)),
        made("edge_1000", "blade edge radius 1000 mm", dict.fromkeys(_EDGES, 1000.0)),
        made("straight", "straight blade edges", dict.fromkeys(_EDGES)),
        made(
            "printed",
            "printed settings alone: straight blades, no correction",
            {**zero, **dict.fromkeys(_EDGES)},
        ),
    ]


def completed_again(file: HypoidGearFile) -> HypoidGearFile:
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
