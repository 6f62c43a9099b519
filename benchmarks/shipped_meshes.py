"""Rewrite the mesh table and the line mesh that ship: `python -m benchmarks.shipped_meshes`."""

from __future__ import annotations

from pathlib import Path

import gearlube_core.mesh_table
from gearlube_core.helical_contact import contact_dataset as helical
from gearlube_core.helical_contact.mesh_cycle import CycleSettings
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.hypoid_contact import contact_dataset as hypoid
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.line_mesh_file import SHIPPED_PREFIX, write_line_mesh
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.mesh_table.table import MeshTable

AXLE, PAIR = "mohammadpour_2015", "he_2007"
# 2000 lbf in of He et al. 2007 is 226 N.m
SETTINGS = CycleSettings(torques=(25.0, 50.0, 100.0, 160.0, 226.0, 300.0, 450.0), stations=12)


def analysed_table() -> MeshTable:
    """Return the mesh table of the shipped axle's gear file, with default settings."""
    file = HypoidGearFile.named(AXLE)
    return contact_table(file, hypoid.analyse_contact(file, hypoid.ContactSettings()))


def analysed_line_mesh(jobs: int | None = None, cache: Path | None = None) -> LineMesh:
    """Return the line mesh of the shipped pair with plain flanks and default bodies."""
    modified = ModifiedPair(pair=HelicalGearFile.named(PAIR).helical_pair())
    settings = helical.ContactSettings(cycle=SETTINGS)
    return helical.analyse_contact(modified, settings, cache=cache, jobs=jobs).line_mesh


if __name__ == "__main__":
    folder = Path(gearlube_core.mesh_table.__file__).parent / "data"
    write_mesh_table(analysed_table(), folder / f"{AXLE}.nc")
    write_line_mesh(analysed_line_mesh(), folder / f"{SHIPPED_PREFIX}{PAIR}.nc")
