"""Rewrite the mesh table that ships: `python -m gearlube_core.hypoid_contact.shipped_table`."""

from __future__ import annotations

from pathlib import Path

import gearlube_core.mesh_table
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.mesh_table.table import MeshTable

NAME = "mohammadpour_2015"


def analysed_table(name: str = NAME) -> MeshTable:
    """Return the mesh table of the shipped gear file `name`, with default settings."""
    file = HypoidGearFile.named(name)
    return contact_table(file, analyse_contact(file, ContactSettings()))


if __name__ == "__main__":
    folder = Path(gearlube_core.mesh_table.__file__).parent / "data"
    write_mesh_table(analysed_table(), folder / f"{NAME}.nc")
