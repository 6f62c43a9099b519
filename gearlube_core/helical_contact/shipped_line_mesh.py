"""Rewrite the shipped line mesh: `python -m gearlube_core.helical_contact.shipped_line_mesh`."""

from __future__ import annotations

from pathlib import Path

import gearlube_core.mesh_table
from gearlube_core.helical_contact.contact_dataset import ContactSettings, analyse_contact
from gearlube_core.helical_contact.mesh_cycle import CycleSettings
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.sample_pairs import named_pair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.line_mesh_file import SHIPPED_PREFIX, write_line_mesh

NAME = "he_2007"
# 2000 lbf in of He et al. 2007 is 226 N.m
SETTINGS = CycleSettings(torques=(25.0, 50.0, 100.0, 160.0, 226.0, 300.0, 450.0), stations=12)


def analysed_line_mesh(jobs: int | None = None, cache: Path | None = None) -> LineMesh:
    """Return the line mesh of the shipped pair with plain flanks and default bodies."""
    modified = ModifiedPair(pair=named_pair(NAME))
    return analyse_contact(
        modified, ContactSettings(cycle=SETTINGS), cache=cache, jobs=jobs
    ).line_mesh


if __name__ == "__main__":
    folder = Path(gearlube_core.mesh_table.__file__).parent / "data"
    write_line_mesh(analysed_line_mesh(), folder / f"{SHIPPED_PREFIX}{NAME}.nc")
