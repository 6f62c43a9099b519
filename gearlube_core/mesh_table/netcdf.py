"""Mesh tables on disk: NetCDF with a unit and a provenance on every datum.

Written as NetCDF 3, which is read in Python alone: the HDF5 library under NetCDF 4 must not be
entered by two threads, and a co-simulation host may start two axles at once.
"""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import cast

import numpy as np
import xarray as xr

from gearlube_core.errors import TableError
from gearlube_core.mesh_table.table import (
    SERIES_UNITS,
    WINDOW_UNITS,
    Kind,
    MeshTable,
    Provenance,
)

FORMAT = 1
_ATTRIBUTES = ("name", "pinion_teeth", "gear_teeth", "contact_ratio")


def write_mesh_table(table: MeshTable, path: str | Path) -> Path:
    """Write `table` to a NetCDF file, atomically; return the path."""
    data: dict[str, tuple[tuple[str, ...], np.ndarray, dict[str, str]]] = {}
    for group, units, dims in (
        (table.series, SERIES_UNITS, ("torque", "order", "part")),
        (table.windows, WINDOW_UNITS, ("torque", "node")),
    ):
        for key, unit in units.items():
            origin = table.provenance[key]
            attributes = {"units": unit, "provenance": origin.kind, "derivation": origin.derivation}
            data[key] = (dims, group[key], attributes)
    dataset = xr.Dataset(
        data,
        coords={
            "torque": ("torque", table.torque, {"units": "N.m", "long_name": "pinion torque"}),
            "part": ("part", ["cos", "sin"]),
        },
        attrs={
            "gearlube_mesh_table": FORMAT,
            "name": table.name,
            "pinion_teeth": table.pinion_teeth,
            "gear_teeth": table.gear_teeth,
            "contact_ratio": table.contact_ratio,
        },
    )
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    partial = target.with_suffix(".part")
    dataset.to_netcdf(partial, engine="scipy", format="NETCDF3_64BIT")
    os.replace(partial, target)
    return target


def read_mesh_table(path: str | Path) -> MeshTable:
    """Read a table written by `write_mesh_table`; raise TableError when it is none."""
    try:
        with Path(path).open("rb") as file:
            dataset = xr.load_dataset(io.BytesIO(file.read()), engine="scipy")
    except (OSError, ValueError, TypeError) as reason:
        why = str(reason).strip().splitlines()[0]
        raise TableError(
            f"{path} is not a readable NetCDF 3 file: {why}. Write it with write_mesh_table, or "
            "from xarray with to_netcdf(path, engine='scipy')."
        ) from None
    if dataset.attrs.get("gearlube_mesh_table") != FORMAT:
        raise TableError(f"{path} is not a gearlube mesh table of format {FORMAT}.")
    missing = [key for key in ("torque", *SERIES_UNITS, *WINDOW_UNITS) if key not in dataset]
    missing += [key for key in _ATTRIBUTES if key not in dataset.attrs]
    if missing:
        raise TableError(f"{path} lacks {', '.join(missing)}.")
    return MeshTable(
        name=str(dataset.attrs["name"]),
        pinion_teeth=int(dataset.attrs["pinion_teeth"]),
        gear_teeth=int(dataset.attrs["gear_teeth"]),
        torque=np.ascontiguousarray(dataset["torque"].values, dtype=np.float64),
        contact_ratio=float(dataset.attrs["contact_ratio"]),
        series={key: np.ascontiguousarray(dataset[key].values) for key in SERIES_UNITS},
        windows={key: np.ascontiguousarray(dataset[key].values) for key in WINDOW_UNITS},
        provenance={
            key: Provenance(
                cast(Kind, str(dataset[key].attrs.get("provenance", ""))),
                str(dataset[key].attrs.get("derivation", "")),
            )
            for key in (*SERIES_UNITS, *WINDOW_UNITS)
        },
    )
