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
from gearlube.variation.store import FINISHED, gridded, open_variation
from gearlube_core.arrays import Array
from gearlube_core.storage.atomic_file import write_compressed_dataset, write_text

PERCENTILES = (2.5, 25.0, 50.0, 75.0, 97.5)
STATISTICS = ("mean", "deviation", "low", *(f"p{p:g}" for p in PERCENTILES), "high")
_LEAST = 8  # points of a rank correlation
_AT_ONCE = 1 << 25  # numbers in memory


def inputs_of(results: xr.Dataset) -> list[dict[str, Any]]:
    """Return name, unit and meaning of each varied parameter, and whether it is sampled."""
    found: list[dict[str, Any]] = json.loads(results.attrs["inputs"])
    return found


def quantities_of(results: xr.Dataset) -> list[str]:
    """Return the names of the quantities of results."""
    return [str(name) for name in results.data_vars if name not in ("status", "message")]


def summarised(results: xr.Dataset, limits: Mapping[str, float] | None = None) -> xr.Dataset:
    """Return the statistics of all quantities.

    Parameters
    ----------
    results : xarray.Dataset
        Of `open_variation`.
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
    over = gridded(results)
    axes = [one["key"] for one in inputs_of(results) if not one["sampled"]]
    sampled = [one["key"] for one in inputs_of(results) if one["sampled"]]
    names = quantities_of(results)
    shape = tuple(over.sizes[axis] for axis in axes)
    status = over["status"].values
    statistics = np.full((*shape, len(names), len(STATISTICS)), np.nan)
    ranks = np.full((*shape, len(names), len(sampled)), np.nan)
    shares = np.full((*shape, len(limits)), np.nan)
    inputs = np.array([over[key].values for key in sampled])
    batch = max(1, _AT_ONCE // max(status.size, 1))
    for first in range(0, len(names), batch):
        some = names[first : first + batch]
        values = over[some].load()
        for i, name in enumerate(some, first):
            column = values[name].values
            for cell in np.ndindex(*shape):
                good = np.isfinite(column[cell])
                if not good.any():
                    continue
                statistics[(*cell, i)] = _statistics(column[cell][good])
                for j in range(len(sampled)):
                    ranks[(*cell, i, j)] = rank_correlation(
                        inputs[(j, *cell)][good], column[cell][good]
                    )
                if name in limits:
                    at = list(limits).index(name)
                    shares[(*cell, at)] = np.mean(column[cell][good] > limits[name])
    found = xr.Dataset(
        {
            "statistics": ((*axes, "quantity", "statistic"), statistics),
            "rank_correlation": ((*axes, "quantity", "input"), ranks),
            "failed": (tuple(axes), (status != FINISHED).sum(axis=-1)),
            "points": ((), status.shape[-1]),
        },
        coords={
            **{axis: over[axis] for axis in axes},
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


def rank_correlation(a: Array, b: Array) -> float:
    """Return Spearman's rank correlation of two columns; NaN where one does not vary.

    Examples
    --------
    >>> round(rank_correlation(np.arange(9.0), np.arange(9.0) ** 3), 12)
    1.0
    """
    if a.size < _LEAST or np.ptp(a) == 0.0 or np.ptp(b) == 0.0:
        return float("nan")
    return float(np.corrcoef(rankdata(a), rankdata(b))[0, 1])


def _statistics(values: Array) -> list[float]:
    deviation = float(values.std(ddof=1)) if values.size > 1 else float("nan")
    percentiles = [float(one) for one in np.percentile(values, PERCENTILES)]
    return [float(values.mean()), deviation, float(values.min()), *percentiles, float(values.max())]


def write_summary(
    folder: Path, limits: Mapping[str, float] | None = None
) -> tuple[xr.Dataset, xr.Dataset]:
    """Write summary.nc, summary.csv, sensitivity.csv and points.csv; return results and summary."""
    results = open_variation(folder)
    summary = summarised(results, limits)
    write_compressed_dataset(summary, folder / "summary.nc")
    write_text(csv_text(*_summary_rows(summary)), folder / "summary.csv")
    if summary.sizes["input"]:
        write_text(csv_text(*_rank_rows(summary)), folder / "sensitivity.csv")
    _write_points(results, folder / "points.csv")
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


def _write_points(results: xr.Dataset, path: Path) -> None:
    """Write a row for each point, block by block, so that memory does not grow."""
    keys = [one["key"] for one in inputs_of(results)]
    columns = [*keys, "status", *quantities_of(results), "message"]
    block = max(int(results.attrs["block"]), 1000)
    partial = path.with_name(f"{path.name}.part")
    with partial.open("w", encoding="utf-8", newline="") as stream:
        for first in range(0, results.sizes["point"], block):
            part = results.isel(point=slice(first, first + block)).load()
            part["message"] = (
                "point",
                [one.decode(errors="replace") for one in part["message"].values],
            )
            rows = zip(*(part[name].values.tolist() for name in columns), strict=True)
            text = csv_text(columns, [list(row) for row in rows])
            stream.write(text if first == 0 else text.partition("\n")[2])
    partial.replace(path)
