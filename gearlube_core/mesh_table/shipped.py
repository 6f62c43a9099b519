"""Mesh tables that ship with the package."""

from __future__ import annotations

from importlib.resources import as_file, files

from gearlube_core.errors import TableError
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.mesh_table.table import MeshTable


def shipped_mesh_table(name: str) -> MeshTable:
    """Return a mesh table that ships with the package, by its name, e.g. "mohammadpour_2015".

    Raises
    ------
    TableError
        No table has that name.

    Examples
    --------
    >>> round(shipped_mesh_table("mohammadpour_2015").ratio, 3)
    2.769
    """
    resource = files("gearlube_core.mesh_table") / "data" / f"{name}.nc"
    if not resource.is_file():
        raise TableError(
            f"No mesh table is called {name!r}. Shipped: mohammadpour_2015. "
            "A file's name ends in .nc."
        )
    with as_file(resource) as path:
        return read_mesh_table(path)
