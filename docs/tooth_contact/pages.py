"""Rows of the tables of docs/tooth_contact.md."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from docs.tooth_contact.measures import (
    highest_pressure,
    loaded_span,
    mean,
    pairs,
    unloaded_mean,
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


def variant_row(dataset: xr.Dataset, sweep: xr.Dataset) -> list[str]:
    """Return what a variant of the gear file does to contact at 50 N.m and to the axle."""
    contact = zip(*(_contact(dataset, s) for s in SIDES), strict=True)
    return [
        *(f"{a} / {b}" for a, b in contact),
        _both(1e6 * sweep["dte_pp"].values, "{:.2f}"),
        _both(100.0 * sweep["efficiency_axle"].values, "{:.2f}"),
        _both(1e6 * sweep["film_thickness_min"].values, "{:.2f}"),
    ]


def _contact(dataset: xr.Dataset, side: str) -> list[str]:
    return [
        f"{1e-6 * mean(dataset, 'k_m', side):.0f}",
        f"{1e-6 * mean(dataset, 'k_t', side):.0f}",
        f"{1e6 * unloaded_mean(dataset, side):.2f}",
        f"{1e6 * loaded_span(dataset, side):.2f}",
        f"{100.0 * variation(dataset, 'R_p', side):.1f}",
        f"{1e-9 * highest_pressure(dataset, side):.1f}",
    ]


def _both(values: np.ndarray, form: str) -> str:
    return " / ".join(form.format(v) for v in values)


def refinement_words(datasets: Sequence[xr.Dataset]) -> tuple[str, str, str]:
    """Return by how much cells, elements and hats change the mean stiffness, and the body's size.

    The default first, three finer ones, then other bodies [%].
    """
    reference = datasets[0]
    changes = [
        [
            100.0 * (mean(d, name, "drive", t) / mean(reference, name, "drive", t) - 1.0)
            for t in reference["torque"].values
            for name in ("k_m", "k_t")
        ]
        for d in datasets[1:]
    ]
    bodies = np.array(changes[3:])
    finer = np.abs(changes[:3]).max()
    return f"{finer:.2f}", f"{bodies.min():+.2f}", f"{bodies.max():+.2f}"
