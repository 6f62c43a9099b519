"""All points of a sweep as one dataset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text, number_text
from gearlube.output.units import heading
from gearlube.studies.sweep.quantities import GRID, described
from gearlube_core.storage.atomic_file import (
    read_dataset,
    write_compressed_dataset,
    write_text,
)
from gearlube_core.units import kmh_to_ms

_POINT_COORDINATES = ("speed", "speed_kmh", "preload")

Points = Mapping[tuple[float, float], xr.Dataset]


def merge(preloads: Sequence[float], speeds_kmh: Sequence[float], points: Points) -> xr.Dataset:
    """Join points into a dataset over (preload, speed).

    Spectra of different length are padded with NaN along `bin`; what a failed or missing point
    lacks is NaN, and its `status` is 0.

    Parameters
    ----------
    preloads : sequence of float
        [N].
    speeds_kmh : sequence of float
        [km/h].
    points : mapping
        Datasets by (speed_kmh, preload).
    """
    variables: dict[str, xr.DataArray] = {}
    for row, preload in enumerate(preloads):
        for column, speed_kmh in enumerate(speeds_kmh):
            point = points.get((speed_kmh, preload))
            if point is None:
                continue
            for name, variable in point.data_vars.items():
                block = _room(variables, str(name), variable, (len(preloads), len(speeds_kmh)))
                inner = tuple(slice(size) for size in variable.shape)
                block[(row, column, *inner)] = variable.values
    dataset = xr.Dataset(variables)
    shared = {
        str(name): coordinate
        for point in points.values()
        for name, coordinate in point.coords.items()
        if name not in _POINT_COORDINATES
    }
    dataset = dataset.assign_coords(
        {
            **shared,
            "preload": list(map(float, preloads)),
            "speed": [kmh_to_ms(v) for v in speeds_kmh],
            "speed_kmh": ("speed", list(map(float, speeds_kmh))),
        }
    )
    if "status" in dataset:
        dataset["status"] = dataset["status"].fillna(0).astype(np.int64)
    return described(dataset)


def _room(
    variables: dict[str, xr.DataArray],
    name: str,
    variable: xr.DataArray,
    grid: tuple[int, int],
) -> xr.DataArray:
    """Return the array of `name` over the grid, created or grown to hold `variable`."""
    is_text = variable.dtype.kind in "UOS"
    empty: Any = "" if is_text else np.nan
    block = variables.get(name)
    if block is None:
        values = np.full((*grid, *variable.shape), empty, dtype=object if is_text else np.float64)
        block = variables[name] = xr.DataArray(values, dims=(*GRID, *variable.dims))
    shape = tuple(max(a, b) for a, b in zip(block.shape[2:], variable.shape, strict=True))
    if shape != block.shape[2:]:
        grow = {
            dim: (0, new - old)
            for dim, new, old in zip(variable.dims, shape, block.shape[2:], strict=True)
        }
        block = variables[name] = block.pad(grow, constant_values=empty)
    return block


def save(dataset: xr.Dataset, directory: Path) -> Path:
    """Write DIR/sweep.nc and DIR/summary.csv; return the NetCDF path."""
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / "sweep.nc"
    write_compressed_dataset(dataset, path)
    write_text(summary_csv(dataset), directory / "summary.csv")
    return path


def load_sweep(path: Path | str) -> xr.Dataset:
    """Read the results of a sweep: sweep.nc, or the folder it is in.

    `.sel(speed_kmh=60, preload=2500)` works on the dataset.

    Examples
    --------
    >>> load_sweep("gearlube_sweep").sel(speed_kmh=60.0, preload=2500.0)  # doctest: +SKIP
    """
    path = Path(path)
    dataset = read_dataset(path / "sweep.nc" if path.is_dir() else path)
    return dataset.set_xindex("speed_kmh") if "speed_kmh" not in dataset.xindexes else dataset


def summary_table(dataset: xr.Dataset) -> Any:
    """Return the scalars of every point as a pandas table, one row a point."""
    columns = _columns(dataset)
    return columns.to_dataframe().reset_index().drop(columns="speed", errors="ignore")


def summary_csv(dataset: xr.Dataset) -> str:
    """Return this table as text: units in the headings, five significant digits."""
    table, columns = summary_table(dataset), _columns(dataset)
    return csv_text(
        [heading(name, columns[name]) for name in table],
        zip(*([_text(value) for value in table[name]] for name in table), strict=True),
    )


def _text(value: Any) -> str:
    return number_text(value, 5) if isinstance(value, float) else str(value)


def _columns(dataset: xr.Dataset) -> xr.Dataset:
    scalars = {
        name: variable
        for name, variable in dataset.data_vars.items()
        if set(variable.dims) == set(GRID)
    }
    columns = xr.Dataset(scalars, coords={k: dataset[k] for k in ("preload", "speed_kmh")})
    for source in dataset["source"].values if "loss" in dataset else ():
        columns[f"loss_{source}"] = dataset["loss"].sel(source=source, drop=True)
    return columns
