"""Flanks, teeth and gears of a gear file as files for CAD."""

from __future__ import annotations

from pathlib import Path

from gearlube_core.hypoid_contact.mesh_cycle import SIDES
from gearlube_core.hypoid_geometry.flank import step_file
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import (
    FORMATS,
    gear_solid,
    mirror_image,
    tooth_solid,
    write_flank_csv,
    write_solid,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

ROLES: tuple[Role, Role] = ("pinion", "gear")


def write_gears(file: HypoidGearFile, folder: Path) -> list[Path]:
    """Write each flank as CSV, those of a tooth as STEP, each tooth and gear as STL and GLB.

    All are of the hand of the file: with a left-handed pinion they are mirrored, y -> -y.
    """
    folder.mkdir(parents=True, exist_ok=True)
    mirrored, files = file.pair.pinion_hand == "left", []
    for role in ROLES:
        tooth = Tooth.from_file(file, role)
        for side in SIDES:
            flank, path = Flank.from_file(file, role, side), folder / f"{role}_{side}.csv"
            files.append(write_flank_csv(flank, path, mirrored=mirrored))
        surfaces = step_file.tooth_surfaces(tooth)
        if mirrored:
            surfaces = {name: step_file.mirror_image(one) for name, one in surfaces.items()}
        files.append(step_file.write_step(surfaces, folder / f"{role}_flanks.step"))
        for name, solid in ((f"{role}_tooth", tooth_solid(tooth)), (role, gear_solid(tooth))):
            one = mirror_image(solid) if mirrored else solid
            files += [write_solid(one, folder / f"{name}.{kind}") for kind in FORMATS]
    return files
