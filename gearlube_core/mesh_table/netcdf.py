"""Mesh tables on disk: NetCDF with a unit and a provenance on every datum.

Written as NetCDF 3, which is read in Python alone: the HDF5 library under NetCDF 4 must not be
entered by two threads, and a co-simulation host may start two axles at once.
"""

from __future__ import annotations

import io
import logging
import warnings
from copy import deepcopy
from functools import cache
from importlib.resources import as_file, files
from pathlib import Path
from typing import TYPE_CHECKING, cast

import numpy as np

from gearlube_core.checks import read_content
from gearlube_core.errors import FileError, TableError
from gearlube_core.mesh_table.table import (
    MEMBERS,
    SERIES_UNITS,
    TOOTH_UNITS,
    WINDOW_UNITS,
    Kind,
    MeshTable,
    Provenance,
)
from gearlube_core.storage.atomic_file import DAMAGED, check_seal, write_dataset
from gearlube_core.units import labelled

if TYPE_CHECKING:
    import xarray as xr

logger = logging.getLogger(__name__)
FORMAT = 2  # 1 had one sign of torque, no tangent stiffness, sliding angle or highest pressure
SHAFT_FORMAT = 3  # with errors that repeat with a shaft
FILE_IN_FMU = "mesh_table.nc"  # name among the resources of an FMU with a table of its own
_ATTRIBUTES = ("name", "pinion_teeth", "gear_teeth", "contact_ratio")
_SETTING = "setting_"
_SHAFT = "e_"  # and the member
_TOOTH = ("gear_face_width", "gear_tooth_height")  # m


def dataset_from_bytes(content: bytes, name: str, writer: str) -> xr.Dataset:
    """Return the dataset in the content of a file.

    Parameters
    ----------
    content : bytes
    name : str
        What errors call the file.
    writer : str
        The function that writes such files.

    Raises
    ------
    TableError
        The content is cut off, damaged or of another format, or has a wrong checksum. One without
        a checksum is read with a warning.
    """
    import xarray as xr

    try:
        if not check_seal(io.BytesIO(content), name):
            logger.warning(
                "%s has no checksum, so damage to it would not be seen. %s writes one.",
                name,
                writer,
            )
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            return xr.load_dataset(io.BytesIO(content), engine="scipy")
    except FileError as reason:
        raise TableError(str(reason)) from None
    except (*DAMAGED, RuntimeWarning) as reason:
        lines = str(reason).strip().splitlines() or [type(reason).__name__]
        raise TableError(
            f"{name} is not a readable NetCDF 3 file: {lines[0].rstrip('.')}. It may be cut off. "
            f"Write it with {writer}, or from xarray with to_netcdf(path, engine='scipy')."
        ) from None


def write_mesh_table(table: MeshTable, path: str | Path) -> Path:
    """Write `table` to a NetCDF file, atomically; return the path."""
    import xarray as xr

    data: dict[str, tuple[tuple[str, ...], np.ndarray, dict[str, str]]] = {}
    for group, units, dims in (
        (table.series, SERIES_UNITS, ("torque", "order", "part")),
        (table.windows, {**WINDOW_UNITS, **TOOTH_UNITS}, ("torque", "node")),
    ):
        for key, unit in units.items():
            if key not in group:
                continue
            origin = table.provenance[key]
            attributes = {"units": unit, "provenance": origin.kind, "derivation": origin.derivation}
            data[key] = (dims, group[key], attributes)
    for member, values in table.shaft_error.items():
        note = f"transmission error by orders 1, 2, ... in turns of the {member}"
        dims = ("torque", f"{member}_order", "part")
        data[_SHAFT + member] = (dims, values, {"units": "m", "long_name": note})
    dataset = xr.Dataset(
        data,
        coords={
            "torque": labelled(
                "torque", table.torque, "N.m", "pinion torque, negative on the coast flanks"
            ),
            "part": ("part", ["cos", "sin"]),
        },
        attrs={
            "gearlube_mesh_table": SHAFT_FORMAT if table.shaft_error else FORMAT,
            "name": table.name,
            "pinion_teeth": table.pinion_teeth,
            "gear_teeth": table.gear_teeth,
            "contact_ratio": table.contact_ratio,
            "source": table.source,
            **dict(zip(_TOOTH, table.tooth_size or (), strict=False)),
            **{
                _SETTING + key: value if isinstance(value, str) else float(value)
                for key, value in table.settings.items()
            },
        },
    )
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    write_dataset(dataset, target)
    return target


def read_mesh_table(path: str | Path) -> MeshTable:
    """Read a mesh table from a file that `gearlube contact` or `write_mesh_table` wrote.

    Raises
    ------
    TableError
        The file is missing or no mesh table.

    Examples
    --------
    >>> from importlib.resources import files
    >>> table = read_mesh_table(files("gearlube_core.mesh_table") / "data" / "mohammadpour_2015.nc")
    >>> table.gear_teeth
    36
    """
    return mesh_table_from_bytes(read_table_content(path), str(path))


def read_table_content(path: str | Path) -> bytes:
    """Return the bytes of a mesh table's file; raise TableError when there is none."""
    cure = "Give the file that `gearlube contact` or write_mesh_table wrote."
    return read_content(path, "mesh table", TableError, cure)


def mesh_table_from_bytes(content: bytes, name: str) -> MeshTable:
    """Return the table in the content of a file; errors call the file `name`."""
    dataset = dataset_from_bytes(content, name, "write_mesh_table")
    _check_format(dataset, name)
    missing = [key for key in ("torque", *SERIES_UNITS, *WINDOW_UNITS) if key not in dataset]
    missing += [key for key in _ATTRIBUTES if key not in dataset.attrs]
    if missing:
        raise TableError(f"{name} lacks {', '.join(missing)}. Write it with write_mesh_table.")
    windows = [key for key in (*WINDOW_UNITS, *TOOTH_UNITS) if key in dataset]
    size = [float(dataset.attrs[key]) for key in _TOOTH if key in dataset.attrs]
    return MeshTable(
        name=str(dataset.attrs["name"]),
        pinion_teeth=int(dataset.attrs["pinion_teeth"]),
        gear_teeth=int(dataset.attrs["gear_teeth"]),
        torque=np.ascontiguousarray(dataset["torque"].values, dtype=np.float64),
        contact_ratio=float(dataset.attrs["contact_ratio"]),
        series={key: np.ascontiguousarray(dataset[key].values) for key in SERIES_UNITS},
        windows={key: np.ascontiguousarray(dataset[key].values) for key in windows},
        provenance={
            key: Provenance(
                cast(Kind, str(dataset[key].attrs.get("provenance", ""))),
                str(dataset[key].attrs.get("derivation", "")),
            )
            for key in (*SERIES_UNITS, *windows)
        },
        source=str(dataset.attrs.get("source", "")),
        settings={
            key.removeprefix(_SETTING): value if isinstance(value, str) else float(value)
            for key, value in dataset.attrs.items()
            if isinstance(key, str) and key.startswith(_SETTING)
        },
        shaft_error={
            member: np.ascontiguousarray(dataset[_SHAFT + member].values)
            for member in MEMBERS
            if _SHAFT + member in dataset
        },
        tooth_size=(size[0], size[1]) if len(size) == len(_TOOTH) else None,
    )


def _check_format(dataset: xr.Dataset, name: str) -> None:
    found = dataset.attrs.get("gearlube_mesh_table")
    if not isinstance(found, int | np.integer):
        raise TableError(
            f"{name} is not a gearlube mesh table. Give the file that `gearlube contact` wrote."
        )
    if found < FORMAT:
        raise TableError(
            f"{name} was written by an older gearlube: a mesh table of format {found}, this one "
            f"reads formats {FORMAT} and {SHAFT_FORMAT}. Run `gearlube contact` again."
        )
    if found > SHAFT_FORMAT:
        raise TableError(
            f"{name} was written by a newer gearlube: a mesh table of format {found}, this one "
            f"reads formats {FORMAT} and {SHAFT_FORMAT}. Install that version, or run `gearlube "
            "contact` of this one."
        )


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
    return deepcopy(_shipped(name))  # its arrays can be written


@cache
def _shipped(name: str) -> MeshTable:
    resource = files("gearlube_core.mesh_table") / "data" / f"{name}.nc"
    if not resource.is_file():
        raise TableError(
            f"No mesh table is called {name!r}. Shipped: mohammadpour_2015. "
            "A file's name ends in .nc."
        )
    with as_file(resource) as path:
        return read_mesh_table(path)
