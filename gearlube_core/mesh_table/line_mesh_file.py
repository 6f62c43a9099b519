"""Line meshes on disk: NetCDF 3 with units and provenance, like mesh tables."""

from __future__ import annotations

from importlib.resources import files
from os.path import isfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from gearlube_core.checks import read_content
from gearlube_core.errors import TableError
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.netcdf import dataset_from_bytes
from gearlube_core.storage.atomic_file import write_dataset

if TYPE_CHECKING:
    import xarray as xr

FORMAT = 1
SHIPPED_PREFIX = "line_mesh_"  # of the shipped files' names
_MARK = "gearlube_line_mesh"
_DIMS = ("torque", "phase", "line", "station")
_UNITS = {
    "torque": ("N.m", "pinion torque"),
    "phase": ("1", "mesh phase"),
    "station": ("1", "along a line, from z_low 0 to z_high 1"),
    "density": ("N/m2", "tangent stiffness of the line load, normal to the flanks"),
    "offset": ("m", "compression at which the tangent spring carries nothing"),
}
_ATTRIBUTES = ("name", "source", "pinion_teeth", "gear_teeth", "base_pitch")


def write_line_mesh(mesh: LineMesh, path: str | Path) -> Path:
    """Write `mesh` to a NetCDF file, atomically; return the path."""
    import xarray as xr

    dims = {"torque": ("torque",), "phase": ("phase",), "station": ("station",)}
    dataset = xr.Dataset(
        {
            name: (
                dims.get(name, _DIMS),
                getattr(mesh, name),
                {"units": unit, "long_name": text, "provenance": mesh.provenance.get(name, "")},
            )
            for name, (unit, text) in _UNITS.items()
        },
        attrs={_MARK: FORMAT, **{name: getattr(mesh, name) for name in _ATTRIBUTES}},
    )
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    write_dataset(dataset, target)
    return target


def read_line_mesh(path: str | Path) -> LineMesh:
    """Read a mesh written by `write_line_mesh`; raise TableError for any other file."""
    return line_mesh_from_bytes(read_line_mesh_content(path), str(path))


def read_line_mesh_content(path: str | Path) -> bytes:
    """Return the bytes of a line mesh's file; raise TableError when there is none."""
    cure = "Give the file that write_line_mesh wrote."
    return read_content(path, "line mesh", TableError, cure)


def named_line_mesh(name: str) -> LineMesh:
    """Return a shipped line mesh by name: he_2007."""
    resource = files("gearlube_core.mesh_table") / "data" / f"{SHIPPED_PREFIX}{name}.nc"
    if not isfile(str(resource)):  # false for a name that no file can have
        raise TableError(f"No line mesh of the name {name!r} is shipped. Known: he_2007.")
    return line_mesh_from_bytes(resource.read_bytes(), resource.name)


def line_mesh_from_bytes(content: bytes, name: str) -> LineMesh:
    """Return the line mesh in the content of a file; errors call the file `name`."""
    dataset = dataset_from_bytes(content, name, "write_line_mesh")
    _check_format(dataset, name)
    missing = [key for key in _UNITS if key not in dataset.variables]
    missing += [key for key in _ATTRIBUTES if key not in dataset.attrs]
    if missing:
        raise TableError(f"{name} lacks {', '.join(missing)}. Write it with write_line_mesh.")
    for key, (unit, _) in _UNITS.items():
        found = str(dataset[key].attrs.get("units", unit))
        if found != unit:
            raise TableError(f"{name}: {key} must be in {unit}, got {found}. Convert it.")
    for key in ("density", "offset"):
        if dataset[key].dims != _DIMS:
            raise TableError(
                f"{name}: {key} must have the dimensions {_DIMS}, got {dataset[key].dims}. "
                "Transpose it."
            )
    arrays = {key: np.ascontiguousarray(dataset[key].values, dtype=np.float64) for key in _UNITS}
    return LineMesh(
        name=str(dataset.attrs["name"]),
        source=str(dataset.attrs["source"]),
        pinion_teeth=int(dataset.attrs["pinion_teeth"]),
        gear_teeth=int(dataset.attrs["gear_teeth"]),
        base_pitch=float(dataset.attrs["base_pitch"]),
        provenance={
            key: str(dataset[key].attrs["provenance"])
            for key in _UNITS
            if dataset[key].attrs.get("provenance")
        },
        **arrays,
    )


def _check_format(dataset: xr.Dataset, name: str) -> None:
    found = dataset.attrs.get(_MARK)
    if not isinstance(found, int | np.integer):
        raise TableError(
            f"{name} is not a gearlube line mesh. Give the file that write_line_mesh wrote."
        )
    if found != FORMAT:
        age = "an older" if found < FORMAT else "a newer"
        raise TableError(
            f"{name} was written by {age} gearlube: a line mesh of format {found}, this one reads "
            f"format {FORMAT}. Write it again with this version."
        )
