"""A dataset as tables with units: one CSV file for each set of dimensions."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text, number_text
from gearlube.output.units import heading, is_text, unit_of
from gearlube_core.errors import ParameterError
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.storage.file_names import file_stem, told_apart

ROW_LIMIT = 1_000_000  # a spreadsheet holds 1 048 576
_CHUNK = 10_000  # rows that are text at one time
INDEX, SINGLE = "tables.csv", "values.csv"


@dataclass(frozen=True, slots=True)
class Column:
    """A heading and the values, broadcast over the dimensions of its table."""

    heading: str
    values: np.ndarray[Any, Any]
    digits: int


def write_tables(dataset: xr.Dataset, folder: Path) -> list[Path]:
    """Write the tables and `tables.csv`, which says what each variable is; return the paths.

    A dimension whose values are names, such as the bearings, becomes columns. Numbers without
    dimension and the attributes are in `values.csv`.

    Raises
    ------
    ParameterError
        A table would have more than a million rows. Nothing is written.
    """
    groups = _groups(dataset)
    for dims, names in groups.items():
        rows = math.prod(dataset.sizes[dim] for dim in dims)
        if rows > ROW_LIMIT:
            raise ParameterError(
                f"A table must have at most {ROW_LIMIT} rows, got {rows} over {', '.join(dims)} "
                f"({', '.join(names)}). Choose variables with --variable, or a part of them with "
                "--span."
            )
    folder.mkdir(parents=True, exist_ok=True)
    files = _file_names(groups)
    paths = []
    for dims, names in groups.items():
        path = folder / files[dims]
        if dims:
            columns = [*_places(dataset, dims), *_columns(dataset, dims, names)]
            text = csv_text([c.heading for c in columns], _rows(columns))
        else:
            text = csv_text(("name", "value", "unit"), _single(dataset, names))
        write_text(text, path)
        paths.append(path)
    head = ("variable", "unit", "meaning", "dimensions", "table")
    write_text(csv_text(head, _described(dataset, groups, files)), folder / INDEX)
    return [folder / INDEX, *paths]


def _file_names(groups: Iterable[tuple[str, ...]]) -> dict[tuple[str, ...], str]:
    """Return the file of each table, never that of another one or of the list of tables."""
    named = [dims for dims in groups if dims]
    own = [INDEX.removesuffix(".csv"), SINGLE.removesuffix(".csv")]
    stems = told_apart([*own, *(file_stem("_".join(dims), "table") for dims in named)])
    files = zip(named, stems[len(own) :], strict=True)
    return {(): SINGLE, **{dims: f"{stem}.csv" for dims, stem in files}}


def _named_dims(dataset: xr.Dataset) -> set[str]:
    return {str(d) for d in dataset.dims if d in dataset.coords and is_text(dataset[d])}


def _groups(dataset: xr.Dataset) -> dict[tuple[str, ...], list[str]]:
    """Return the variables by the dimensions that are rows, () for single values."""
    order, named = [str(d) for d in dataset.dims], _named_dims(dataset)
    groups: dict[tuple[str, ...], list[str]] = {(): []}
    for name, variable in dataset.variables.items():
        if name in dataset.dims:
            continue
        dims = tuple(d for d in order if d in variable.dims and d not in named)
        groups.setdefault(dims, []).append(str(name))
    return groups


def _places(dataset: xr.Dataset, dims: tuple[str, ...]) -> Iterator[Column]:
    for k, dim in enumerate(dims):
        shape = [1] * len(dims)
        shape[k] = dataset.sizes[dim]
        if dim in dataset.coords:
            head, values = heading(dim, dataset[dim]), dataset[dim].values
        else:
            head, values = f"{dim} [index from 0]", np.arange(dataset.sizes[dim])
        whole = tuple(dataset.sizes[d] for d in dims)
        yield Column(head, np.broadcast_to(values.reshape(shape), whole), 10)


def _columns(dataset: xr.Dataset, dims: tuple[str, ...], names: list[str]) -> Iterator[Column]:
    for name in names:
        variable = dataset[name]
        for labels, one in _split(variable, [str(d) for d in variable.dims if d not in dims]):
            head = heading(".".join([name, *labels]), variable)
            digits = 10 if name in dataset.coords else 7
            yield Column(head, one.transpose(*dims).values, digits)


def _split(array: xr.DataArray, dims: list[str]) -> Iterator[tuple[list[str], xr.DataArray]]:
    """Return the array of each name along dimensions of names."""
    for places in itertools.product(*(range(array.sizes[d]) for d in dims)):
        chosen = dict(zip(dims, places, strict=True))
        yield [str(array[d].values[k]) for d, k in chosen.items()], array.isel(chosen)


def _rows(columns: list[Column]) -> Iterator[tuple[str, ...]]:
    flat = [(c.values.reshape(-1), c.digits) for c in columns]
    for start in range(0, flat[0][0].size, _CHUNK):
        yield from zip(
            *(_texts(values[start : start + _CHUNK], digits) for values, digits in flat),
            strict=True,
        )


def _texts(values: np.ndarray[Any, Any], digits: int) -> list[str]:
    if values.dtype.kind == "f":
        return [number_text(value, digits) for value in values.tolist()]
    return [str(value) for value in values.tolist()]


def _single(dataset: xr.Dataset, names: list[str]) -> Iterator[tuple[str, str, str]]:
    for name in names:
        variable = dataset[name]
        for labels, one in _split(variable, [str(d) for d in variable.dims]):
            text = _texts(np.atleast_1d(one.values), 10)[0]
            yield ".".join([name, *labels]), text, unit_of(variable) or ""
    for key, value in dataset.attrs.items():
        yield str(key), str(value), ""


def _described(
    dataset: xr.Dataset, groups: dict[tuple[str, ...], list[str]], files: dict[tuple[str, ...], str]
) -> Iterator[tuple[str, ...]]:
    for dims, names in groups.items():
        for name in (*dims, *names):
            if name not in dataset.variables:
                continue
            variable = dataset[name]
            unit, words = unit_of(variable), str(variable.attrs.get("long_name", ""))
            over = " ".join(map(str, variable.dims))
            unit = "not stated" if unit is None else unit
            yield name, unit, words, over, files[dims]
