"""Formulas over solved films of a hypoid flank: mean, least and largest ratio along the cycle."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.studies.films.film_formulas import ROUGHNESS

# quantity, what it is compared with, and the solved variable
_CENTRAL, _MINIMUM, _FRICTION = (
    "steady_central_film",
    "steady_minimum_film",
    "steady_traction_heated",
)
_RATIOS = (
    ("central film", "Chittenden et al. 1985", "chittenden_central", _CENTRAL),
    ("central film", "Chittenden, minor-axis component", "component_central", _CENTRAL),
    ("central film", "Grubin 1949", "grubin", _CENTRAL),
    ("minimum film", "Chittenden et al. 1985", "chittenden_minimum", _MINIMUM),
    ("minimum film", "Chittenden, minor-axis component", "component_minimum", _MINIMUM),
    ("largest pressure", "Hertz", "hertz_pressure", "steady_pressure_max"),
    ("friction", "Evans and Johnson 1986", "evans_johnson", _FRICTION),
    ("friction", "Evans and Johnson, solved film", "evans_johnson_solved", _FRICTION),
    ("friction", "Evans and Johnson, film and Roelands", "evans_johnson_roelands", _FRICTION),
    ("friction", "axle, with asperities", "axle_friction", _FRICTION),
    ("friction", "Eyring, isothermal", "steady_traction_eyring", _FRICTION),
)
# of thermal films, if there are any
_THERMAL = (
    ("central film", "thermal, over isothermal", "warm_central_film", "warm_cold_central_film"),
    ("minimum film", "thermal, over isothermal", "warm_minimum_film", "warm_cold_minimum_film"),
    ("friction", "thermal, over heated Eyring", "warm_traction", _FRICTION),
    ("friction", "thermal, over isothermal Eyring", "warm_traction", "steady_traction_eyring"),
    ("friction", "Evans and Johnson 1986, over thermal", "evans_johnson", "warm_traction"),
    ("friction", "Evans and Johnson, solved film, over thermal", "evans_johnson_solved",
     "warm_traction"),
    ("friction", "Evans and Johnson, film and Roelands, over thermal", "evans_johnson_roelands",
     "warm_traction"),
    ("friction", "axle, with asperities, over thermal", "axle_friction", "warm_traction"),
)  # fmt: skip
_SQUEEZE = (
    ("central film", "squeeze_central_film"),
    ("minimum film", "squeeze_minimum_film"),
    ("largest pressure", "squeeze_pressure_max"),
    ("friction", "squeeze_traction_heated"),
)


class RatioRow(NamedTuple):
    """One quantity over the cycle: its range in SI units, or another source over the solution."""

    quantity: str
    source: str
    least: float  # of the solution, or of the source over the solution [-]
    largest: float
    load_weighted_mean: float
    unit: str


def ratio_rows(dataset: xr.Dataset) -> list[RatioRow]:
    """Return the solved ranges, and ratios of formulas and of the film in time to steady ones.

    Means are weighted with the load, so that the ends of the engagement count little.
    """
    roughness = float(dataset.attrs.get(ROUGHNESS, 0.0))
    weight = dataset["steady_load"].values
    weight = weight / weight.sum()

    def row(quantity: str, source: str, values: np.ndarray, unit: str) -> RatioRow:
        mean = float((weight * values).sum())
        return RatioRow(quantity, source, float(values.min()), float(values.max()), mean, unit)

    rows = [
        row("load", "solution", dataset["steady_load"].values, "N"),
        row("central film", "solution", dataset["steady_central_film"].values, "m"),
        row("minimum film", "solution", dataset["steady_minimum_film"].values, "m"),
        *(
            row(f"film ratio λ, {name}", "over roughness", dataset[film].values / roughness, "1")
            for name, film in (("central film", _CENTRAL), ("minimum film", _MINIMUM))
            if roughness
        ),
        row("largest pressure", "solution", dataset["steady_pressure_max"].values, "Pa"),
        row("friction", "solution, heated Eyring", dataset["steady_traction_heated"].values, "1"),
        row("entrainment angle", "given", np.degrees(dataset["steady_psi"].values), "deg"),
        row("sliding angle", "given", np.degrees(dataset["steady_chi"].values), "deg"),
        row("R_y/R_x", "given", (dataset["steady_R_y"] / dataset["steady_R_x"]).values, "1"),
    ]
    rows += [
        row(quantity, source, (dataset[formula] / dataset[solved]).values, "over solution")
        for quantity, source, formula, solved in _RATIOS
    ]
    if "warm_traction" in dataset:
        rows += [
            row("friction", "solution, thermal", dataset["warm_traction"].values, "1"),
            row("rise in the film", "solution, thermal", dataset["warm_rise_max"].values, "K"),
            row("rise of a surface", "solution, thermal", dataset["warm_rise_surface"].values, "K"),
        ]
        rows += [
            row(quantity, source, (dataset[one] / dataset[other]).values, "ratio")
            for quantity, source, one, other in _THERMAL
        ]
    rows += [
        row(quantity, "in time", dataset[name].values, "over steady")
        for quantity, name in _SQUEEZE
        if name in dataset
    ]
    return rows


def ratio_csv(rows: list[RatioRow]) -> str:
    """Return rows as text with a head, comma between."""

    def written(row: RatioRow) -> list[str]:
        numbers = (row.least, row.largest, row.load_weighted_mean)
        texts = [f"{value:.5g}" if math.isfinite(value) else "" for value in numbers]
        return [row.quantity, row.source, *texts, row.unit]

    return csv_text(RatioRow._fields, map(written, rows))
