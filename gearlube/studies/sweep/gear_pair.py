"""The gear pair inside an axle FMU."""

from __future__ import annotations

from pathlib import Path

from drivetrain.road_load import FinalDrive
from gearlube_core.mesh_table.netcdf import FILE_IN_FMU, read_mesh_table
from gearlube_core.mesh_table.shipped import shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable

SHIPPED = "mohammadpour_2015"  # the table of an FMU without one of its own


def mesh_table_of(directory: Path) -> MeshTable:
    """Return the mesh table of the FMU unzipped at `directory`."""
    own = directory / "resources" / FILE_IN_FMU
    return read_mesh_table(own) if own.is_file() else shipped_mesh_table(SHIPPED)


def final_drive_of(mesh: MeshTable) -> FinalDrive:
    """Return the tooth numbers of a gear pair."""
    return FinalDrive(pinion_teeth=mesh.pinion_teeth, gear_teeth=mesh.gear_teeth)
