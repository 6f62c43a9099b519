"""A dataset as a file for MATLAB."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.output.mat_file import write_mat
from gearlube.output.units import unit_of

_STRUCTS = ("units", "meanings", "dimensions", "attributes")


def write_dataset_mat(dataset: xr.Dataset, path: Path) -> None:
    """Write every variable as an array, and the structs units, meanings, dimensions, attributes.

    `units.NAME` is the unit of NAME, "not stated" where the dataset has none; `dimensions.NAME`
    the names of its dimensions in order.
    """
    content: dict[str, Any] = {str(name): v.values for name, v in dataset.variables.items()}
    units = {name: unit_of(dataset[name]) for name in content}
    structs = (
        {name: "not stated" if unit is None else unit for name, unit in units.items()},
        {name: str(dataset[name].attrs.get("long_name", "")) for name in content},
        {name: " ".join(map(str, dataset[name].dims)) for name in content},
        {str(key): value for key, value in dataset.attrs.items()},
    )
    write_mat({**content, **dict(zip(_STRUCTS, structs, strict=True))}, path)
