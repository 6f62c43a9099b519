"""Quantities of a variation as reports show them, and their tables."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.numbers import unit_words
from gearlube.report.parts import Cell, Column, Table
from gearlube.variation.summary import cells, inputs_of, quantities_of

MOST = 6  # series of a chart, charts of ranks, and tables
_EVERYDAY = {"m": (1e6, "µm"), "1": (1.0, ""), "degC": (1.0, "°C"), "K": (1.0, "K")}
_FEW = 24  # rows of a table that is shown at once
_MOST_ROWS = 200
_STATISTICS = (
    ("mean", "mean"),
    ("deviation", "standard deviation"),
    ("low", "least"),
    ("p2.5", "2.5 %"),
    ("p50", "median"),
    ("p97.5", "97.5 %"),
    ("high", "largest"),
)


class Shown(NamedTuple):
    """A quantity that the reports show: name, meaning, and the unit they show it in."""

    name: str
    meaning: str
    factor: float
    unit: str


def shown_quantities(results: xr.Dataset) -> list[Shown]:
    """Return the quantities that figures and reports show."""
    found = []
    for name in results.attrs["shown"]:
        words = str(results[name].attrs["long_name"])
        found.append(Shown(str(name), words, *_scale(results, str(name))))
    return found


def conditions(summary: xr.Dataset) -> list[tuple[str, xr.Dataset]]:
    """Return words and statistics of each combination of the axes."""
    return [
        (
            ", ".join(
                f"{name} {value:g}" if isinstance(value, float | np.floating) else f"{name} {value}"
                for name, value in values.items()
            ),
            cell,
        )
        for values, cell in cells(summary)
    ]


def units_of(results: xr.Dataset) -> dict[str, str]:
    """Return the unit of each varied parameter."""
    return {one["key"]: str(one["unit"]) for one in inputs_of(results)}


def tables(results: xr.Dataset, summary: xr.Dataset) -> list[Table]:
    """Return the values of grids, or the statistics of samples; others than shown are folded."""
    shown = [one.name for one in shown_quantities(results)]
    others = [name for name in quantities_of(results) if name not in shown]
    words = {name: str(results[name].attrs["long_name"]) for name in [*shown, *others]}
    tables: list[tuple[str, list[tuple[str, str, str]]]]  # title; quantity, statistic, words
    if summary.sizes["input"]:
        named = [*shown, *others][:MOST]
        tables = [(words[name], [(name, *one) for one in _STATISTICS]) for name in named]
    else:
        groups = {"Values": shown, "Other quantities": others[:MOST]}
        tables = [
            (title, [(name, "mean", words[name]) for name in names])
            for title, names in groups.items()
            if names
        ]
    found = [_table(results, summary, title, columns) for title, columns in tables]
    return [one for one in found if one.rows]


def _scale(results: xr.Dataset, name: str) -> tuple[float, str]:
    """Return factor and unit in which a quantity is shown."""
    unit = str(results[name].attrs["units"])
    return _EVERYDAY.get(unit, (1.0, unit.replace("N m", "N·m")))


def _table(
    results: xr.Dataset, summary: xr.Dataset, title: str, columns: list[tuple[str, str, str]]
) -> Table:
    axes = [str(axis) for axis in summary["failed"].dims]
    scales = {name: _scale(results, name) for name, *_ in columns}
    rows: list[list[Cell]] = []
    for _, cell in conditions(summary)[:_MOST_ROWS]:
        values = cell["statistics"]
        rows.append(
            [
                *(cell[axis].values.item() for axis in axes),
                *(scales[q][0] * float(values.sel(quantity=q, statistic=p)) for q, p, _ in columns),
            ]
        )
    units = units_of(results)
    return Table(
        title=title,
        columns=[
            *(Column(axis, unit_words(units[axis]), 4) for axis in axes),
            *(Column(words, scales[name][1], 4) for name, _, words in columns),
        ],
        rows=rows,
        caption="summary.csv has all quantities.",
        folded=columns[0][0] not in results.attrs["shown"] or len(rows) > _FEW,
    )
