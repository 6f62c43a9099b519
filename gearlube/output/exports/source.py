"""The dataset that is exported, and the part of it that is wanted."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.output.units import is_text, unit_of
from gearlube_core.errors import FileError, ParameterError

Span = tuple[str, str]  # first and last value as text; an empty text is no limit


def dataset_file(run: Path) -> Path:
    """Return the NetCDF file that `run` is, or the only one in the folder `run`.

    Raises
    ------
    FileError
        There is no such file.
    ParameterError
        The folder holds several.
    """
    if run.is_file():
        return run
    if not run.is_dir():
        raise FileError(
            f"RUN must be a folder of results or a NetCDF file, but {run} does not exist."
        )
    found = sorted(run.glob("*.nc"))
    if not found:
        raise FileError(
            f"The folder {run} must hold a NetCDF file (.nc), got none. Name the folder where a "
            "study wrote its results."
        )
    if len(found) > 1:
        names = ", ".join(path.name for path in found)
        raise ParameterError(
            f"One dataset can be exported at a time, but {run} has {len(found)}: {names}. Give one "
            f"of them, for example {found[0]}."
        )
    return found[0]


def chosen(
    dataset: xr.Dataset, variables: Iterable[str] = (), spans: Mapping[str, Span] | None = None
) -> xr.Dataset:
    """Return the wanted variables within the wanted spans.

    Parameters
    ----------
    dataset : Dataset
    variables : iterable of str
        Names; empty: all.
    spans : mapping
        First and last value, both inside, by the name of a dimension or of a variable over one
        dimension. In the unit of the dataset; a dimension without values counts from 0.

    Raises
    ------
    ParameterError
        An unknown name, or a span in which nothing lies.
    """
    wanted = list(variables)
    for name in wanted:
        if name not in dataset.variables:
            known = ", ".join(map(str, dataset.data_vars))
            raise ParameterError(f"The dataset has no variable {name}. It has: {known}.")
    for name, span in (spans or {}).items():
        dataset = _within(dataset, name, span)
    return dataset[wanted] if wanted else dataset


def _within(dataset: xr.Dataset, name: str, span: Span) -> xr.Dataset:
    known = [str(n) for n, v in dataset.variables.items() if v.ndim == 1]
    known += [str(dim) for dim in dataset.dims if dim not in known]
    if name not in known:
        raise ParameterError(
            f"--span must name a dimension or a variable over one dimension, got {name}. "
            f"Known: {', '.join(known)}."
        )
    values = np.asarray(dataset[name].values)
    inside = np.ones(values.shape, dtype=bool)
    if is_text(dataset[name]):
        inside = np.isin(values.astype(str), [span[0], span[1]])
    else:
        first, last = (_number(name, text) for text in span)
        if first is not None:
            inside &= values >= first
        if last is not None:
            inside &= values <= last
    if not inside.any():
        has = f"{values.min()} to {values.max()}" if values.dtype.kind in "fiu" else list(values)
        raise ParameterError(
            f"--span {name} must hold a value of the dataset, got {' to '.join(span)}; the dataset "
            f"has {has} {unit_of(dataset[name]) or ''}".rstrip()
            + "."
        )
    return dataset.isel({dataset[name].dims[0]: np.flatnonzero(inside)})


def _number(name: str, text: str) -> float | None:
    if not text:
        return None
    try:
        return float(text)
    except ValueError:
        raise ParameterError(f"--span {name} must have numbers, got {text!r}.") from None


def without_unit(dataset: xr.Dataset) -> list[str]:
    """Return the names of all numbers whose unit is not stated."""
    return [str(name) for name, v in dataset.variables.items() if unit_of(v) is None]
