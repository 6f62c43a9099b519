"""Time histories and spectra of a dataset, one record for each place of the other dimensions."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import xarray as xr

from gearlube.output.units import is_text, unit_of
from gearlube_core.arrays import Array

Place = tuple[str, int, object, str]  # dimension or variable along it, index, value, unit


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """One time history or spectrum.

    Parameters
    ----------
    name : str
        Name of the recorded variable.
    meaning, unit : str
    axis, axis_unit : str
        Name and unit of the abscissa.
    x, y : array
    places : tuple
        Where it belongs in the other dimensions: name, index, value, unit.
    """

    name: str
    meaning: str
    unit: str
    axis: str
    axis_unit: str
    x: Array
    y: Array
    places: tuple[Place, ...]


def abscissa(dataset: xr.Dataset, name: str) -> tuple[str, str] | None:
    """Return dimension and abscissa of a variable: frequency or order first, then time.

    The abscissa is the dimension itself, the variable `frequency` over it, or `DIM_time`.
    """
    variable = dataset[name]
    found: dict[int, tuple[str, str]] = {}
    for dim in map(str, variable.dims):
        if dim in dataset.coords:
            unit = unit_of(dataset[dim])
            rank = 0 if unit == "Hz" or dim == "order" else 2 if unit == "s" else None
            if rank is not None:
                found.setdefault(rank, (dim, dim))
            continue
        axis = dataset.get("frequency")
        if axis is not None and dim in axis.dims and set(axis.dims) <= set(variable.dims):
            found.setdefault(1, (dim, "frequency"))
        elif f"{dim}_time" in dataset:
            found.setdefault(3, (dim, f"{dim}_time"))
    dim, axis_name = found[min(found)] if found else ("", "")
    return (dim, axis_name) if found and name not in (dim, axis_name) else None


def record_names(dataset: xr.Dataset) -> list[str]:
    """Return the variables that are time histories or spectra."""
    return [
        str(name)
        for name, variable in dataset.data_vars.items()
        if not is_text(variable)
        and not str(name).endswith("_time")
        and abscissa(dataset, str(name)) is not None
    ]


def record_count(dataset: xr.Dataset, name: str) -> int:
    """Return the number of records of a variable."""
    dim, _ = abscissa(dataset, name) or ("", "")
    return math.prod(size for d, size in dataset[name].sizes.items() if d != dim)


def records(dataset: xr.Dataset, name: str) -> Iterator[Record]:
    """Return the records of a variable; those without any value are left out.

    Points without an abscissa are left out, such as those that fill up a shorter spectrum.
    """
    found = abscissa(dataset, name)
    if found is None:
        return
    dim, axis = found
    variable = dataset[name]
    others = [str(d) for d in variable.dims if d != dim]
    for index in itertools.product(*(range(variable.sizes[d]) for d in others)):
        here = dict(zip(others, index, strict=True))
        along = dataset[axis].isel({d: k for d, k in here.items() if d in dataset[axis].dims})
        x = np.asarray(along.values, dtype=np.float64)
        y = np.asarray(variable.isel(here).values, dtype=np.float64)
        there = ~np.isnan(x)
        if np.isnan(y[there]).all():
            continue
        yield Record(
            name=name,
            meaning=str(variable.attrs.get("long_name", "")),
            unit=unit_of(variable) or "",
            axis=axis,
            axis_unit=unit_of(dataset[axis]) or "",
            x=x[there],
            y=y[there],
            places=tuple(p for d, k in here.items() for p in _places(dataset, d, k)),
        )


def _places(dataset: xr.Dataset, dim: str, index: int) -> Iterator[Place]:
    """Return the place along a dimension, and what else is known of it: DIM_time, DIM_speed."""
    if dim in dataset.coords:
        yield dim, index, dataset[dim].values[index], unit_of(dataset[dim]) or ""
    else:
        yield dim, index, index, ""
        for name in (f"{dim}_time", f"{dim}_speed"):
            if name in dataset and dataset[name].dims == (dim,):
                yield name, index, dataset[name].values[index], unit_of(dataset[name]) or ""
