"""The teeth of a gear file as finite-element bodies."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gearlube_core.checks import check_within
from gearlube_core.flank_surface.flank import Role, Side, tooth_region
from gearlube_core.flank_surface.gear_file import HypoidGearFile
from gearlube_core.flank_surface.tooth_form import tooth_grids
from gearlube_core.materials.solid import STEEL_MOHAMMADPOUR_2015, Solid, contact_modulus
from gearlube_core.tooth_compliance.cache import cached_tooth_compliance, stored_tooth_compliance
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings, FlankCompliance
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry
from gearlube_core.tooth_contact.loaded_contact import PairStiffness
from gearlube_core.worker_pool import worker_pool

Array = NDArray[np.float64]

_GRID = (13, 33)  # flank points handed to the mesher, root to tip and toe to heel


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothBodySettings:
    """The elastic body around a flank.

    Parameters
    ----------
    base_depth_modules : float
        Depth of the base block under the slot [normal modules].
    neighbour_pitches : float
        Plain rim beside the tooth's own pitch, on each side [pitches].
    solid : Solid
    condensation : CondensationSettings
    """

    base_depth_modules: float = 3.0
    neighbour_pitches: float = 1.0
    solid: Solid = STEEL_MOHAMMADPOUR_2015
    condensation: CondensationSettings = field(default_factory=CondensationSettings)

    def __post_init__(self) -> None:
        check_within("base_depth_modules", self.base_depth_modules, 0.5, 10.0, "modules")
        check_within("neighbour_pitches", self.neighbour_pitches, 0.0, 3.0, "pitches")


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
    drive, coast = tooth_grids(file, role, *_GRID, s_low=low)
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


def member_compliance(
    file: HypoidGearFile, role: Role, settings: ToothBodySettings, cache: Path | None = None
) -> dict[Side, FlankCompliance]:
    """Return the compliance of both flanks of a member's tooth, from the cache where known.

    The hats' profile positions are those of the whole flank, root 0 to tip 1.
    """
    geometry, left = tooth_body(file, role, settings)
    flanks = cached_tooth_compliance(geometry, settings.solid, settings.condensation, cache)
    return _by_side(file, role, flanks, left)


def stored_member_compliance(
    file: HypoidGearFile, role: Role, settings: ToothBodySettings, cache: Path | None = None
) -> dict[Side, FlankCompliance] | None:
    """Return `member_compliance` if it is in the cache, else None."""
    geometry, left = tooth_body(file, role, settings)
    flanks = stored_tooth_compliance(geometry, settings.solid, settings.condensation, cache)
    return None if flanks is None else _by_side(file, role, flanks, left)


def _by_side(
    file: HypoidGearFile,
    role: Role,
    flanks: tuple[FlankCompliance, FlankCompliance],
    left: Side,
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
) -> dict[Side, PairStiffness]:
    """Return the elastic data of the drive and the coast flanks; members in parallel."""
    roles: tuple[Role, Role] = ("pinion", "gear")
    members = {}
    for role in roles:
        known = stored_member_compliance(file, role, settings, cache)
        if known is not None:
            members[role] = known
    missing = [role for role in roles if role not in members]
    if jobs == 1 or len(missing) == 1:
        members |= {role: member_compliance(file, role, settings, cache) for role in missing}
    elif missing:
        with worker_pool(len(missing)) as pool:
            waiting = {
                role: pool.submit(member_compliance, file, role, settings, cache)
                for role in missing
            }
            members |= {role: future.result() for role, future in waiting.items()}
    pinion, gear = members["pinion"], members["gear"]
    modulus = contact_modulus(settings.solid, settings.solid)
    return {
        side: PairStiffness(pinion=pinion[side], gear=gear[side], contact_modulus=modulus)
        for side in ("drive", "coast")
    }
