"""Units of stored variables."""

import xarray as xr


def without_units(dataset: xr.Dataset) -> list[str]:
    """Return the names of variables of numbers that have no unit."""
    return [
        str(name)
        for name, one in dataset.variables.items()
        if one.dtype.kind in "iufcb" and not one.attrs.get("units")
    ]
