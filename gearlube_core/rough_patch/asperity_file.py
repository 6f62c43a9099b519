"""The file of computed asperities, and the surface of Greenwood and Tripp that stands for it."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.mesh_table.netcdf import dataset_from_bytes
from gearlube_core.rough_patch.table import GreenwoodTrippFit, greenwood_tripp_fit

FILE_IN_FMU = "asperity_table.nc"  # name among the resources of an FMU with asperities of its own
_WRITER = "gearlube roughness flow-factors"


def read_asperity_content(path: str | Path) -> bytes:
    """Return the bytes of an asperity table's file; raise TableError when there is none."""
    cure = f"Give flow_factors.nc, which `{_WRITER}` wrote."
    return read_content(path, "asperity table", TableError, cure)


def asperities_from_bytes(content: bytes, name: str) -> GreenwoodTrippFit:
    """Return the fit of Greenwood and Tripp's law to the table in the content of a file.

    Parameters
    ----------
    content
        Of flow_factors.nc; it needs film_ratio, asperity_pressure and asperity_area, and the
        attribute roughness [m].
    name
        What errors call the file.

    Raises
    ------
    TableError
        The content is damaged, or no table with asperities.
    """
    table = dataset_from_bytes(content, name, f"`{_WRITER}`")
    needed = ("film_ratio", "asperity_pressure", "asperity_area")
    missing = [key for key in needed if key not in table]
    missing += [] if "roughness" in table.attrs else ["the attribute roughness"]
    if missing:
        raise TableError(
            f"{name} must have computed asperities, but it lacks {', '.join(missing)}. Write it "
            f"with `{_WRITER}`, without --no-contact."
        )
    for key in needed:
        values = np.asarray(table[key].values, dtype=float)
        known = values[np.isfinite(values)]
        if known.size and not known.min() > 0.0:
            raise TableError(f"{name}: {key} must be above 0, got {known.min():g}.")
    roughness = float(table.attrs["roughness"])
    if not (math.isfinite(roughness) and roughness > 0.0):
        raise TableError(f"{name}: roughness must be above 0 m, got {roughness:g} m.")
    try:
        return greenwood_tripp_fit(table)
    except ParameterError as reason:
        raise TableError(f"{name}: {reason}") from None
