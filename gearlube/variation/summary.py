"""Statistics of a variation: distributions, shares beyond limits, and what they follow."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from scipy.stats import rankdata

from gearlube.output.csv_text import csv_text
from gearlube.variation.point_study import FINISHED
from gearlube.variation.store import open_variation, read_points
from gearlube_core.arrays import Array
from gearlube_core.storage.atomic_file import atomic_write, write_compressed_dataset, write_text

PERCENTILES = (2.5, 25.0, 50.0, 75.0, 97.5)
STATISTICS = ("mean", "deviation", "low", *(f"p{p:g}" for p in PERCENTILES), "high")
_ROUNDINGS = 1e-9
_LEAST = 8  # points of a rank correlation
_AT_ONCE = 1 << 25  # numbers in memory
_ROWS = 1000  # of a table, likewise


def inputs_of(results: xr.Dataset) -> list[dict[str, Any]]:
    """Return name, unit and meaning of each varied parameter, and whether it is sampled."""
    found: list[dict[str, Any]] = json.loads(results.attrs["inputs"])
    return found


def quantities_of(results: xr.Dataset) -> list[str]:
    """Return the names of the quantities of results."""
    return [str(name) for name in results.data_vars if name not in ("status", "message")]


def summarised(folder: Path, limits: Mapping[str, float] | None = None) -> xr.Dataset:
    """Return the statistics of all quantities.

    Parameters
    ----------
    folder : Path
        Of the results.
    limits : mapping, optional
        Limit of a quantity in its unit.

    Returns
    -------
    xarray.Dataset
        Over the axes of the design: `statistics` of the samples along quantity and statistic,
        `rank_correlation` (Spearman) of quantity and sampled input, the number of `failed` points,
        and `share_above` for each quantity with a limit. NaN where fewer than 8 points finished
        or nothing varies.
    """
    limits = dict(limits or {})
    results = open_variation(folder)
    axes = [one["key"] for one in inputs_of(results) if not one["sampled"]]
    sampled = [one["key"] for one in inputs_of(results) if one["sampled"]]
    names = quantities_of(results)
    *shape, samples = (int(n) for n in results.attrs["shape"])
    status = results["status"].values.reshape(*shape, samples)
    statistics = np.full((*shape, len(names), len(STATISTICS)), np.nan)
    ranks = np.full((*shape, len(names), len(sampled)), np.nan)
    shares = np.full((*shape, len(limits)), np.nan)
    inputs = [results[key].values.reshape(*shape, samples) for key in sampled]
    batch = max(1, _AT_ONCE // status.size)
    for first in range(0, len(names), batch):
        some = read_points(folder, slice(None), slice(first, first + batch))["results"]
        for i, name in enumerate(names[first : first + batch]):
            column = some[:, i].reshape(*shape, samples)
            for cell in np.ndindex(*shape):
                good = np.isfinite(column[cell])
                if not good.any():
                    continue
                values = column[cell][good]
                statistics[(*cell, first + i)] = _statistics(values)
                for j, one in enumerate(inputs):
                    ranks[(*cell, first + i, j)] = rank_correlation(one[cell][good], values)
                if name in limits:
                    shares[(*cell, list(limits).index(name))] = np.mean(values > limits[name])
    found = xr.Dataset(
        {
            "statistics": ((*axes, "quantity", "statistic"), statistics),
            "rank_correlation": ((*axes, "quantity", "input"), ranks),
            "failed": (tuple(axes), (status != FINISHED).sum(axis=-1)),
        },
        coords={
            **{axis: _values_along(results, axis, axes, shape) for axis in axes},
            "quantity": names,
            "statistic": list(STATISTICS),
            "input": sampled,
            "unit": ("quantity", [str(results[name].attrs["units"]) for name in names]),
        },
        attrs={"title": results.attrs["title"], "study": results.attrs["study"]},
    )
    if limits:
        found["share_above"] = ((*axes, "limited"), shares)
        found = found.assign_coords(limited=list(limits), limit=("limited", list(limits.values())))
    return found


def _values_along(
    results: xr.Dataset, axis: str, axes: list[str], shape: list[int]
) -> tuple[str, Array, dict[str, Any]]:
    """Return the coordinate of an axis: the values at the first place of all others."""
    first: list[Any] = [0] * (len(shape) + 1)
    first[axes.index(axis)] = slice(None)
    return axis, results[axis].values.reshape(*shape, -1)[tuple(first)], results[axis].attrs


def rank_correlation(a: Array, b: Array) -> float:
    """Return Spearman's rank correlation of two columns; NaN where one varies by roundings only.

    Examples
    --------
    >>> round(rank_correlation(np.arange(9.0), np.arange(9.0) ** 3), 12)
    1.0
    """
    if a.size < _LEAST or not (varies(a) and varies(b)):
        return float("nan")
    return float(np.corrcoef(rankdata(a), rankdata(b))[0, 1])


def varies(values: Array) -> bool:
    """Return whether numbers differ by more than roundings."""
    return bool(np.ptp(values) > _ROUNDINGS * np.abs(values).max())


def _statistics(values: Array) -> list[float]:
    deviation = float(values.std(ddof=1)) if values.size > 1 else float("nan")
    percentiles = [float(one) for one in np.percentile(values, PERCENTILES)]
    return [float(values.mean()), deviation, float(values.min()), *percentiles, float(values.max())]


def write_summary(
    folder: Path, limits: Mapping[str, float] | None = None
) -> tuple[xr.Dataset, xr.Dataset]:
    """Write summary.nc, summary.csv, sensitivity.csv and points.csv; return results and summary."""
    results = open_variation(folder)
    summary = summarised(folder, limits)
    write_compressed_dataset(summary, folder / "summary.nc")
    write_text(csv_text(*_summary_rows(summary)), folder / "summary.csv")
    if summary.sizes["input"]:
        write_text(csv_text(*_rank_rows(summary)), folder / "sensitivity.csv")
    _write_points(results, folder)
    return results, summary


def cells(summary: xr.Dataset) -> Iterator[tuple[dict[str, Any], xr.Dataset]]:
    """Yield the values of the axes and the statistics there, for each combination of them."""
    axes = list(summary["failed"].dims)
    sizes = [summary.sizes[axis] for axis in axes]
    for cell in np.ndindex(*sizes):
        where = dict(zip(axes, cell, strict=True))
        values = {str(axis): summary[axis].values[at] for axis, at in where.items()}
        yield values, summary.isel(where)


def _summary_rows(summary: xr.Dataset) -> tuple[list[str], list[list[object]]]:
    axes = [str(axis) for axis in summary["failed"].dims]
    limited = list(summary["limited"].values) if "limited" in summary.coords else []
    head = [*axes, "quantity", "unit", "failed", *STATISTICS]
    head += ["limit", "share_above"] if limited else []
    rows: list[list[object]] = []
    for values, cell in cells(summary):
        for i, name in enumerate(summary["quantity"].values):
            row: list[object] = [*values.values(), name, summary["unit"].values[i]]
            row += [int(cell["failed"]), *map(float, cell["statistics"].values[i])]
            if limited:
                at = limited.index(name) if name in limited else None
                row += (
                    ["", ""]
                    if at is None
                    else [float(summary["limit"][at]), float(cell["share_above"][at])]
                )
            rows.append(row)
    return head, rows


def _rank_rows(summary: xr.Dataset) -> tuple[list[str], list[list[object]]]:
    axes = [str(axis) for axis in summary["failed"].dims]
    inputs = [str(one) for one in summary["input"].values]
    rows: list[list[object]] = [
        [*values.values(), name, *map(float, cell["rank_correlation"].values[i])]
        for values, cell in cells(summary)
        for i, name in enumerate(summary["quantity"].values)
    ]
    return [*axes, "quantity", *inputs], rows


def _write_points(results: xr.Dataset, folder: Path) -> None:
    """Write a row for each point, some blocks at a time, so that memory does not grow."""
    keys = [one["key"] for one in inputs_of(results)]
    texts = {key: results[key].values for key in keys if results[key].dtype.kind in "UO"}
    head = [*keys, "status", *quantities_of(results), "message"]
    block = int(results.attrs["block"])
    together = block * max(1, _ROWS // block)
    path = folder / "points.csv"
    with atomic_write(path) as partial, partial.open("w", encoding="utf-8", newline="") as stream:
        stream.write(csv_text(head, []))
        for first in range(0, results.sizes["point"], together):
            points = slice(first, first + together)
            found = read_points(folder, points)
            inputs = [(texts[key][points] if key in texts else found[key]).tolist() for key in keys]
            messages = [one.decode(errors="replace") for one in found["message"]]
            columns = zip(
                *inputs, found["status"], found["results"].tolist(), messages, strict=True
            )
            rows = [[*row[:-2], *row[-2], row[-1]] for row in columns]
            stream.write(csv_text(head, rows).partition("\n")[2])
