"""Shared parts of the figures of a helical pair: cases, colours, axes over a mesh period."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, GREY, VERMILLION
from gearlube_core.arrays import Array

RPM = np.pi / 30.0  # rad/s
PERIODS = "time [mesh periods]"
_COLOURS = (BLUE, VERMILLION)
NOTHING = 1e-15  # um or N, below rounding
_DECADES = 5.0  # of a logarithmic spectrum that are shown


def cases(response: xr.Dataset) -> list[tuple[str, str, str]]:
    """Return label in the dataset, label to show, and colour of every case."""
    shown = []
    for row, label in enumerate(response["case"].values):
        if label == "film":
            shown.append((str(label), "oil film", GREEN))
        else:
            shown.append((str(label), f"µ = {label}", _COLOURS[row % len(_COLOURS)]))
    return shown


def title(dataset: xr.Dataset, what: str) -> str:
    """Return a heading with the pair and its operating point."""
    at = dataset.attrs
    return (
        f"{what}: {at['name']}, {at['pinion_torque']:.4g} N·m, "
        f"{at['pinion_speed'] / RPM:.5g} rpm, mesh {mesh_description(dataset)}"
    )


def mesh_description(dataset: xr.Dataset) -> str:
    """Return a description of the mesh model."""
    return "of loaded contact" if dataset.attrs["mesh"] == "contact" else "of constant density"


def closed(phase: Array, values: Array, periods: int = 2) -> tuple[Array, Array]:
    """Return phase and values over whole periods, their ends joined."""
    x = np.concatenate([phase + shift for shift in range(periods)] + [[float(periods)]])
    return x, np.concatenate([values] * periods + [values[:1]])


def stems(ax: Any, order: Array, sets: list[tuple[Array, str, str]]) -> None:
    """Draw spectra side by side at each order, on a logarithmic scale.

    Parameters
    ----------
    order : ndarray of shape (n,)
    sets : list of (amplitude, colour, label)
    """
    top = max(float(np.nanmax(amplitude)) for amplitude, _, _ in sets)
    ax.set_xlim(order[0] - 0.7, order[-1] + 0.7)
    ax.set_xticks(order[::2])
    if not top > NOTHING:
        note_no_vibration(ax)
        return
    low = min((float(a[a > 0.0].min()) for a, _, _ in sets if (a > 0.0).any()), default=top)
    floor = max(10.0**-_DECADES * top, 0.3 * low, 1e-30)
    for row, (amplitude, colour, label) in enumerate(sets):
        at = order + 0.22 * (row - 0.5 * (len(sets) - 1))
        seen = amplitude > floor
        ax.vlines(at[seen], floor, amplitude[seen], color=colour, lw=2.0)
        ax.plot(at[seen], amplitude[seen], ".", color=colour, ms=4.5, label=label)
    ax.set_yscale("log")
    ax.set_ylim(floor, 3.0 * max(top, floor))


def note_no_vibration(ax: Any) -> None:
    """Write in a panel that there is no vibration."""
    ax.text(0.5, 0.5, "none", transform=ax.transAxes, ha="center", va="center", color=GREY)


def mark_orders(ax: Any, response: xr.Dataset) -> None:
    """Mark where a natural frequency lies between the mesh orders, with small ticks on top."""
    places = response["natural_frequency"].values / response.attrs["mesh_frequency"]
    low, high = ax.get_xlim()
    for place in places[(places > low) & (places < high)]:
        ax.axvline(place, color=GREY, lw=0.9, ls=":", zorder=0)


def distinct(frequencies: Array, apart: float = 0.01) -> Array:
    """Return frequencies without those too close to the one before, as a share of it."""
    kept: list[float] = []
    for frequency in np.sort(frequencies):
        if not kept or frequency > (1.0 + apart) * kept[-1]:
            kept.append(float(frequency))
    return np.array(kept)
