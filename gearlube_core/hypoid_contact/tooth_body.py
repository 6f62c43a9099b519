"""The teeth of a gear file as finite-element bodies."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from gearlube_core.contact.solid import contact_modulus
from gearlube_core.hypoid_geometry.flank.flank import Role, Side, tooth_region
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_grids
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.tooth_compliance.flank_compliance import FlankCompliance
from gearlube_core.tooth_compliance.tooth_body import (
    FLANK_GRID,
    ToothBodySettings,
    members_compliance,
)
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry
from gearlube_core.tooth_contact.coupled_strips import PairStiffness


def lowest_profile_position(file: HypoidGearFile, role: Role) -> float:
    """Return the profile position [-] where flank becomes fillet: a clearance over the root."""
    blank = file.blank()
    return blank.root_clearance / blank.whole_depth


def tooth_body(
    file: HypoidGearFile, role: Role, settings: ToothBodySettings
) -> tuple[ToothGeometry, Side]:
    """Return the geometry of a member's tooth and which of its flanks is the left one."""
    blank = file.blank()
    member = blank.pinion if role == "pinion" else blank.gear
    region = tooth_region(blank, role)
    low = lowest_profile_position(file, role)
    drive, coast = tooth_grids(file, role, *FLANK_GRID, s_low=low)
    axis = np.array([1.0, 0.0, 0.0]) if role == "pinion" else np.array([0.0, 0.0, 1.0])
    point = np.array([0.0, blank.offset if role == "pinion" else 0.0, 0.0])
    middle = 0.5 * (drive[0] + coast[0])
    radial = middle - point - ((middle - point) @ axis)[:, None] * axis
    radial /= np.linalg.norm(radial, axis=1)[:, None]
    inward = math.sin(region.pitch_angle) * axis - math.cos(region.pitch_angle) * radial
    ahead = middle[-1] - middle[0]
    rightwards = np.cross(ahead, -inward[len(inward) // 2])
    drive_is_left = float((drive - coast).mean(axis=(0, 1)) @ rightwards) < 0.0
    module = blank.mean_normal_module
    geometry = ToothGeometry(
        left=drive if drive_is_left else coast,
        right=coast if drive_is_left else drive,
        inward=inward,
        axis_point=point,
        axis_direction=axis,
        teeth=member.teeth,
        slot_depth=blank.root_clearance,
        base_depth=settings.base_depth_modules * module,
        neighbour_pitches=settings.neighbour_pitches,
    )
    return geometry, "drive" if drive_is_left else "coast"


def _by_side(
    file: HypoidGearFile, role: Role, flanks: tuple[FlankCompliance, FlankCompliance], left: Side
) -> dict[Side, FlankCompliance]:
    low = lowest_profile_position(file, role)
    on_whole = [replace(flank, s=low + (1.0 - low) * flank.s) for flank in flanks]
    right: Side = "coast" if left == "drive" else "drive"
    return {left: on_whole[0], right: on_whole[1]}


def pair_stiffness(
    file: HypoidGearFile,
    settings: ToothBodySettings,
    *,
    cache: Path | None = None,
    jobs: int | None = None,
    keep: bool = True,
) -> dict[Side, PairStiffness]:
    """Return the elastic data of the drive and the coast flanks; members in parallel.

    The hats' profile positions are those of the whole flank, root 0 to tip 1.
    `keep`: whether new compliances go into the cache.
    """
    roles: tuple[Role, Role] = ("pinion", "gear")
    bodies = {role: tooth_body(file, role, settings) for role in roles}
    flanks = members_compliance(
        {role: geometry for role, (geometry, _) in bodies.items()}, settings, cache, jobs, keep
    )
    pinion, gear = (_by_side(file, role, flanks[role], bodies[role][1]) for role in roles)
    modulus = contact_modulus(settings.solid, settings.solid)
    return {
        side: PairStiffness(pinion=pinion[side], gear=gear[side], contact_modulus=modulus)
        for side in ("drive", "coast")
    }
