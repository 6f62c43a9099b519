"""Tables of docs/helical.md on film friction and on parametric instability."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from docs.helical.film import Along, MeanFriction, Moved
from docs.helical.pages import table

NM, UM = 1e9, 1e6
_ZERO_CELSIUS = 273.15


def along_table(found: Sequence[Along]) -> str:
    """Return friction over a mesh period for two kinds of loads."""
    rows = [
        [
            a.words,
            f"{a.mean:.4f}",
            f"{a.lowest:.4f} to {a.highest:.4f}",
            f"{a.loss:.1f}",
            f"{a.loss_factor:.4f}",
            f"{a.force:.1f}",
            f"{a.force_constant:.1f}",
            f"{a.rise:.0f}",
        ]
        for a in found
    ]
    heads = ["Line loads", "mean mu", "local mu, 1 mm off the pitch line", "loss, W", "H_V"]
    heads += ["friction force, p-p, N", "with the mean mu, N"]
    return table([*heads, "highest rise, K"], rows)


def formula_table(found: Sequence[MeanFriction]) -> str:
    """Return mean coefficients beside those of gear practice."""
    rows = [
        [
            f"{m.rpm:.0f}",
            f"{m.temperature - _ZERO_CELSIUS:.0f}",
            f"{m.here:.4f}",
            f"{m.schlenk:.4f}",
            f"{m.xu_kahraman:.4f}",
            f"{m.benedict_kelley:.4f}",
            f"{UM * m.smallest_film:.2f}",
            f"{m.least_ratio:.2f}",
            f"{m.loss:.0f}",
            f"{100.0 * m.efficiency:.2f}",
        ]
        for m in found
    ]
    heads = ["rpm", "oil, degC", "here", "Schlenk", "Xu and Kahraman", "Benedict and Kelley"]
    heads += ["smallest film, um", "least film ratio", "loss, W"]
    return table([*heads, "efficiency, %"], rows)


def agreement_sentence(found: Sequence[MeanFriction]) -> str:
    """Return the range of our mean coefficients over those of two formulas, in words."""
    schlenk = [m.here / m.schlenk for m in found]
    ehl = [m.here / m.xu_kahraman for m in found]
    return (
        f"Here over Schlenk {min(schlenk):.2f} to {max(schlenk):.2f}, over Xu and Kahraman "
        f"{min(ehl):.2f} to {max(ehl):.2f}."
    )


def moved_table(mu: float, found: Sequence[Moved]) -> str:
    """Return mesh orders with the film over those with a constant coefficient."""
    rows = [
        [
            m.signal,
            *(f"{NM * c:.2f} / {NM * f:.2f}" for c, f in zip(m.constant, m.film, strict=True)),
        ]
        for m in found
    ]
    heads = [f"nm, constant mu = {mu:.4f} / film"]
    heads += [f"n = {n + 1}" for n in range(found[0].film.size)]
    return table(heads, rows)


def instability_table(stability: xr.Dataset) -> str:
    """Return where the mesh's variation alone makes the pair unstable."""
    rows = []
    for name, axis, words in (
        ("growth_variation", "variation", "the pair's damping"),
        ("growth_variation_light", "variation", "light damping"),
        ("growth_damping", "damping_ratio", "mesh as it is"),
    ):
        growth, values = stability[name].values, stability[axis].values
        unstable = growth > 0.0
        some = unstable.any(axis=1)
        if not some.any():
            rows.append([words, axis.replace("_", " "), "stable throughout", "-", "-"])
            continue
        at = int(np.flatnonzero(some)[0 if axis == "variation" else -1])
        column = int(growth[at].argmax())
        frequency = float(stability["mesh_frequency"][column])
        word = "least factor" if axis == "variation" else "largest ratio"
        rows.append(
            [
                words,
                axis.replace("_", " "),
                f"{word} {values[at]:.3g}; {100.0 * unstable.mean():.1f} % of the map",
                f"{frequency:.0f}",
                _nearest(frequency, stability["natural_frequency"].values),
            ]
        )
    heads = ["Map", "axis", "unstable", "mesh frequency there, Hz", "nearest combination"]
    return table(heads, rows)


def _nearest(frequency: float, modes: np.ndarray) -> str:
    """Return the nearest (f_i + f_j)/k in words, with its distance."""
    best = min(
        (
            (abs((modes[i] + modes[j]) / k / frequency - 1.0), i, j, k)
            for k in (1, 2)
            for i in range(modes.size)
            for j in range(i, modes.size)
        ),
        key=lambda found: found[0],
    )
    off, i, j, k = best
    sum_of = f"2 f_{i + 1}" if i == j else f"f_{i + 1} + f_{j + 1}"
    return f"{sum_of if k == 1 else f'({sum_of})/{k}'}, {100.0 * off:.1f} % off"
