"""Rows of the tables of docs/tooth_contact.md."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from docs.tooth_contact.measures import (
    extreme_height,
    highest_pressure,
    loaded_span,
    mean,
    pairs,
    unloaded_mean,
    unloaded_span,
    variation,
)
from gearlube_core.hypoid_contact.mesh_cycle import SIDES


def torque_rows(dataset: xr.Dataset) -> list[list[str]]:
    """Return what load does to the shipped pair."""
    rows = []
    for torque in dataset["torque"].values:
        cells = [f"{torque:g}"]
        for scale, form, read in (
            (1e-6, "{:.0f}", lambda s, t: mean(dataset, "k_m", s, t)),
            (1e-6, "{:.0f}", lambda s, t: mean(dataset, "k_t", s, t)),
            (100.0, "{:.0f}", lambda s, t: variation(dataset, "k_t", s, t)),
            (1e6, "{:.2f}", lambda s, t: loaded_span(dataset, s, t)),
            (1.0, "{:.2f}", lambda s, t: pairs(dataset, s, t)[0]),
            (1e-9, "{:.1f}", lambda s, t: highest_pressure(dataset, s, t)),
        ):
            cells.append(" / ".join(form.format(scale * read(s, torque)) for s in SIDES))
        rows.append(cells)
    return rows


def variant_row(dataset: xr.Dataset) -> list[str]:
    """Return what a variant of the gear file does to contact at 50 N.m."""
    return [f"{a} / {b}" for a, b in zip(*(_contact(dataset, s) for s in SIDES), strict=True)]


def _contact(dataset: xr.Dataset, side: str) -> list[str]:
    height = extreme_height(dataset, side)
    return [
        f"{1e-6 * mean(dataset, 'k_m', side):.0f}",
        f"{1e-6 * mean(dataset, 'k_t', side):.0f}",
        f"{1e6 * unloaded_span(dataset, side):.2f}",
        f"{1e6 * unloaded_mean(dataset, side):.2f}",
        f"{1e6 * loaded_span(dataset, side):.2f}",
        f"{100.0 * variation(dataset, 'R_p', side):.1f}",
        f"{pairs(dataset, side)[0]:.2f}",
        f"{float(dataset['path_contact_ratio'].sel(side=side)):.2f}",
        "edge" if height is None else f"{height:.2f}",
        f"{1e-9 * highest_pressure(dataset, side):.1f}",
    ]


def axle_row(sweep: xr.Dataset) -> list[str]:
    """Return what a variant of the gear file does to the axle."""
    return [
        _both(1e6 * sweep["dte_pp"].values, "{:.2f}"),
        _both(100.0 * sweep["efficiency_mesh"].values, "{:.2f}"),
        _both(100.0 * sweep["efficiency_axle"].values, "{:.2f}"),
        _both(1e6 * sweep["film_thickness_min"].values, "{:.2f}"),
    ]


def _both(values: np.ndarray, form: str) -> str:
    return " / ".join(form.format(v) for v in values)


def refinement_rows(datasets: Sequence[xr.Dataset]) -> list[list[str]]:
    """Return the change of the mean stiffness with cells, elements, hats and the body's size."""
    reference = datasets[0]
    lines = []
    for dataset in datasets:
        cells = []
        for torque in reference["torque"].values:
            for name in ("k_m", "k_t"):
                now, then = (mean(d, name, "drive", torque) for d in (dataset, reference))
                change = "" if dataset is reference else f" ({100.0 * (now / then - 1.0):+.2f} %)"
                cells.append(f"{1e-6 * now:.1f}{change}")
            cells.append(f"{1e-9 * highest_pressure(dataset, 'drive', torque):.2f}")
        lines.append(cells)
    return lines
