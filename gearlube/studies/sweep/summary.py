"""The scalars of a sweep as a table."""

from __future__ import annotations

from typing import Any

import xarray as xr

from gearlube.output.csv_text import csv_text, number_text
from gearlube.output.units import heading
from gearlube.studies.sweep.quantities import GRID


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
