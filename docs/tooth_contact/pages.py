"""Tables of docs/tooth_contact.md."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

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
from docs.validation.claims import Claim
from gearlube_core.hypoid_contact.mesh_cycle import SIDES


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table of the page."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines)


def claims_table(claims: Sequence[Claim], dataset: xr.Dataset) -> str:
    """Return the verdicts on the papers' statements."""
    rows = []
    for claim in claims:
        found = claim.evaluate(dataset)
        rows.append(
            [
                str(claim.number),
                claim.statement,
                claim.source,
                claim.tolerance,
                found.value,
                f"**{found.verdict}**",
                found.reason,
            ]
        )
    heads = ["#", "What the paper says", "Printed in", "Tolerance", "Found", "Verdict", "Reason"]
    return table(heads, rows)


def torque_table(dataset: xr.Dataset) -> str:
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
    heads = [
        "Pinion torque [N.m] (each cell: drive / coast)",
        "secant k [N/um]",
        "tangent k [N/um]",
        "tangent k, p-p [%]",
        "loaded TE, p-p [um]",
        "pairs, mean",
        "highest pressure [GPa]",
    ]
    return table(heads, rows)


def variant_table(rows: Sequence[tuple[str, xr.Dataset, xr.Dataset]]) -> str:
    """Return what each variant of the gear file does to contact at 50 N.m."""
    contact = [
        [label, *(f"{a} / {b}" for a, b in zip(*(_contact(d, s) for s in SIDES), strict=True))]
        for label, d, _ in rows
    ]
    heads = [
        "Variant (each cell: drive / coast)",
        "secant k [N/um]",
        "tangent k [N/um]",
        "unloaded e, p-p [um]",
        "e0 [um]",
        "loaded TE, p-p [um]",
        "R_p, p-p [%]",
        "pairs, mean",
        "path [pitches]",
        "extreme at s",
        "highest pressure [GPa]",
    ]
    return table(heads, contact)


def axle_table(rows: Sequence[tuple[str, xr.Dataset, xr.Dataset]]) -> str:
    """Return what each variant of the gear file does to the axle."""
    axle = [[label, *_axle(sweep)] for label, _, sweep in rows]
    heads = [
        "Variant (each cell: 60 / 100 km/h)",
        "DTE, p-p [um]",
        "mesh efficiency [%]",
        "axle efficiency [%]",
        "least film [um]",
    ]
    return table(heads, axle)


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


def _axle(sweep: xr.Dataset) -> list[str]:
    return [
        _both(1e6 * sweep["dte_pp"].values, "{:.2f}"),
        _both(100.0 * sweep["efficiency_mesh"].values, "{:.2f}"),
        _both(100.0 * sweep["efficiency_axle"].values, "{:.2f}"),
        _both(1e6 * sweep["film_thickness_min"].values, "{:.2f}"),
    ]


def _both(values: np.ndarray, form: str) -> str:
    return " / ".join(form.format(v) for v in values)


def refinement_table(rows: Sequence[tuple[str, xr.Dataset]]) -> str:
    """Return the change of the mean stiffness with cells, elements, hats and the body's size."""
    reference = rows[0][1]
    lines = []
    for label, dataset in rows:
        cells = [label]
        for torque in reference["torque"].values:
            for name in ("k_m", "k_t"):
                now, then = (mean(d, name, "drive", torque) for d in (dataset, reference))
                change = "" if dataset is reference else f" ({100.0 * (now / then - 1.0):+.2f} %)"
                cells.append(f"{1e-6 * now:.1f}{change}")
            cells.append(f"{1e-9 * highest_pressure(dataset, 'drive', torque):.2f}")
        lines.append(cells)
    heads = ["Drive side"]
    for torque in reference["torque"].values:
        heads += [
            f"secant k at {torque:g} N.m [N/um]",
            "tangent k [N/um]",
            "highest pressure [GPa]",
        ]
    return table(heads, lines)
