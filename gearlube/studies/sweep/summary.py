"""The scalars of a sweep as a table."""

from __future__ import annotations

from typing import Any

import xarray as xr

from gearlube.studies.sweep.quantities import GRID


def summary_table(dataset: xr.Dataset) -> Any:
    """Return the scalars of every point as a pandas table, one row a point."""
    scalars = {
        name: variable
        for name, variable in dataset.data_vars.items()
        if set(variable.dims) == set(GRID)
    }
    columns = xr.Dataset(scalars, coords={k: dataset[k] for k in ("preload", "speed_kmh")})
    for source in dataset["source"].values if "loss" in dataset else ():
        columns[f"loss_{source}"] = dataset["loss"].sel(source=source, drop=True)
    return columns.to_dataframe().reset_index().drop(columns="speed", errors="ignore")
