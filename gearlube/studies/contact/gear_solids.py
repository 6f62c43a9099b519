"""Flanks, teeth and gears of a gear file as files for CAD."""

from __future__ import annotations

from pathlib import Path

from gearlube_core.hypoid_contact.mesh_cycle import SIDES
from gearlube_core.hypoid_geometry.flank.export import write_flank_csv, write_solid
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role
from gearlube_core.hypoid_geometry.flank.step_file import tooth_surfaces, write_step
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import gear_solid, tooth_solid
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

ROLES: tuple[Role, Role] = ("pinion", "gear")


def write_gears(file: HypoidGearFile, folder: Path) -> list[Path]:
    """Write each flank as CSV, those of a tooth as STEP, each tooth and gear as STL and GLB."""
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for role in ROLES:
        tooth = Tooth.from_file(file, role)
        files += [
            write_flank_csv(Flank.from_file(file, role, side), folder / f"{role}_{side}.csv")
            for side in SIDES
        ]
        files.append(write_step(tooth_surfaces(tooth), folder / f"{role}_flanks.step"))
        for suffix in ("stl", "glb"):
            files.append(write_solid(tooth_solid(tooth), folder / f"{role}_tooth.{suffix}"))
            files.append(write_solid(gear_solid(tooth), folder / f"{role}.{suffix}"))
    return files
