"""Main numbers of a line or point contact, compared with Hertz and film formulas."""

from __future__ import annotations

import math
from typing import NamedTuple

import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.studies.films.film_ratios import film_ratios

SOLUTION = "solution"
_ERRORS = {
    "central film": "central_film",
    "minimum film": "minimum_film",
    "largest pressure": "pressure_max",
    "friction": "friction",
}


class Row(NamedTuple):
    """One number of the summary."""

    quantity: str
    source: str  # "solution", or whose formula
    value: float
    unit: str
    deviation: float  # of the source from the solution [-]; nan for the solution itself


def summary_rows(dataset: xr.Dataset) -> list[Row]:
    """Return the numbers of a line or point contact or of a contact line of a helical pair."""
    of = dataset.attrs
    # formulas for a helical pair's line are those of a line with its mean load
    basis = ", mean load" if of["contact"] == "helical" else ""
    hertz = [(f"Hertz{basis}", of["hertz_pressure_max"])]
    rows = _compared("largest pressure", of["pressure_max"], "Pa", hertz)
    for name in ("central film", "minimum film"):
        value = of[name.replace(" ", "_")]
        rows += _compared(name, value, "m", _formulas(dataset, name, basis))
    rows += [
        _own(f"film ratio λ, {name}", value, "1") for name, value in film_ratios(dataset).items()
    ]
    rows.append(_own("friction coefficient", abs(of["friction_coefficient"]), "1"))
    if of["contact"] == "helical":
        rows += [
            _own("power lost to sliding", of["sliding_power"], "W"),
            _own("load of the line", of["load"], "N"),
            _own("loaded length", 1e3 * of["loaded_length"], "mm"),
            _own("largest pressure at y", 1e3 * of["pressure_max_y"], "mm"),
            _own("minimum film at y", 1e3 * of["minimum_film_y"], "mm"),
        ]
    if of["contact"] == "line":
        rows.append(_own("force of the film on body 1", of["friction_1"], "N/m"))
        rows.append(_own("force of the film on body 2", of["friction_2"], "N/m"))
    if math.isfinite(of.get("temperature_max", math.nan)):
        rise = of["temperature_max"] - of["temperature_inlet"]
        rows.append(_own("highest temperature above the inlet", rise, "K"))
        rows.append(_own("turns of film and energy", of["turns"], "1"))
    rows += [_own(f"group {key}", of[f"group_{key}"], "1") for key in "ML" if f"group_{key}" in of]
    rows += [
        _own(f"estimated error{part}, {name}", 100.0 * of[f"{prefix}error_{key}"], "%")
        for prefix, part in (("", ""), ("domain_", " of the domain"))
        for name, key in _ERRORS.items()
        if math.isfinite(of.get(f"{prefix}error_{key}", math.nan))
    ]
    return [
        *rows,
        _own("unbalanced flow", of["residual"], "1"),
        _own("load error", of["load_error"], "1"),
        _own("iterations", of["iterations"], "1"),
        _own("time", of["seconds"], "s"),
    ]


def summary_csv(rows: list[Row]) -> str:
    """Return rows as text with a head, comma between; no deviation is left empty."""

    def written(row: Row) -> list[str]:
        deviation = f"{row.deviation:.4g}" if math.isfinite(row.deviation) else ""
        return [row.quantity, row.source, f"{row.value:.6g}", row.unit, deviation]

    return csv_text(Row._fields, map(written, rows))


def _own(quantity: str, value: float, unit: str) -> Row:
    return Row(quantity, SOLUTION, float(value), unit, math.nan)


def _compared(quantity: str, value: float, unit: str, others: list[tuple[str, float]]) -> list[Row]:
    return [
        _own(quantity, value, unit),
        *(Row(quantity, who, other, unit, other / value - 1.0) for who, other in others),
    ]


def _formulas(dataset: xr.Dataset, quantity: str, basis: str) -> list[tuple[str, float]]:
    if "formula_film" not in dataset:
        return []
    of_quantity = dataset["formula_quantity"].values == quantity
    sources = dataset["formula_source"].values[of_quantity]
    films = dataset["formula_film"].values[of_quantity]
    return [(f"{who}{basis}", float(film)) for who, film in zip(sources, films, strict=True)]
