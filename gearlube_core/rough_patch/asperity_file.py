"""The file of computed asperities, and the surface of Greenwood and Tripp that stands for it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlube_core.checks import read_content
from gearlube_core.contact.greenwood_tripp_1971 import (
    SurfaceParameters,
    asperity_area_factor,
    asperity_integrals,
    asperity_load_factor,
)
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.mesh_table.netcdf import dataset_from_bytes

if TYPE_CHECKING:  # takes half a second, and whoever has a table has it
    import xarray as xr

FILE_IN_FMU = "asperity_table.nc"  # name among the resources of an FMU with asperities of its own
_WRITER = "gearlube roughness flow-factors"


class GreenwoodTrippFit(NamedTuple):
    """Greenwood and Tripp's surface that stands for computed asperities."""

    surface: SurfaceParameters
    load_misfit: float  # largest factor between load of the law and of the table, at least 1 [-]
    area_misfit: float  # the same of the areas


def greenwood_tripp_fit(
    table: xr.Dataset, low: float = 0.5, high: float = 3.0
) -> GreenwoodTrippFit:
    """Return the parameters with which Greenwood and Tripp's law fits a table of computed patches.

    The two products of the law are chosen so that the mean logarithms of load and area between two
    film ratios agree. The misfits show how much the shape of the law differs.

    Parameters
    ----------
    table
        Table from `patch_table` with contact.
    low, high
        Film ratios between which the law is fitted [-].

    Raises
    ------
    ParameterError
        Fewer than two film ratios with contact lie between the limits.

    Examples
    --------
    >>> import xarray as xr
    >>> ratios, load, area = [1.0, 2.0], [2.2e-3, 2.7e-4], [0.11, 0.012]
    >>> columns = {"asperity_pressure": load, "asperity_area": area}
    >>> data = {name: ("film_ratio", one) for name, one in columns.items()}
    >>> table = xr.Dataset(data, {"film_ratio": ratios}, {"roughness": 4e-7})
    >>> round(greenwood_tripp_fit(table).surface.xi_beta_sigma, 2)
    0.42
    """
    ratios = table.film_ratio.values
    if "asperity_pressure" not in table:
        raise ParameterError("table must hold asperity_pressure. Make it with contact=True.")
    load, area = table.asperity_pressure.values, table.asperity_area.values
    used = (ratios >= low) & (ratios <= high) & np.isfinite(load)
    if used.sum() < 2:
        raise ParameterError(
            f"table must hold asperities at two film ratios within {low:g} to {high:g}, got "
            f"{int(used.sum())}. Give more film ratios to patch_table."
        )
    integrals = np.array([asperity_integrals(float(one)) for one in ratios[used]])
    area_rest = np.log(area[used] / integrals[:, 0])
    load_rest = np.log(load[used] / integrals[:, 1])
    unit = SurfaceParameters(1.0, 1.0, 1.0)
    squared = math.exp(float(area_rest.mean())) / asperity_area_factor(unit)
    root = math.exp(float(load_rest.mean())) / asperity_load_factor(unit) / squared
    return GreenwoodTrippFit(
        SurfaceParameters(float(table.attrs["roughness"]), math.sqrt(squared), root**2),
        math.exp(float(np.abs(load_rest - load_rest.mean()).max())),
        math.exp(float(np.abs(area_rest - area_rest.mean()).max())),
    )


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
