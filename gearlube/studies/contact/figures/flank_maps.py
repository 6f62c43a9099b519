"""Maps on the drawn gear tooth: ease-off, path and pattern, pressure."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.drawn_tooth import DrawnTooth, ease_off_levels
from gearlube.plotting.style import SKY, house_style, new_figure
from gearlube_core.arrays import Array
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE

_SIDES = {"drive": "drive side", "coast": "coast side"}
_INSIDE = 97.0  # percent of the loaded cells that the colours of the pressure span
_TORQUES = 4  # that are drawn, at most; each has one colour in all figures


def ease_off_map(dataset: xr.Dataset) -> Any:
    """Return ease-off, path of contact and marked pattern on the drawn gear tooth, both sides."""
    tooth, levels = DrawnTooth.of_dataset(dataset), ease_off_levels(dataset)
    with house_style():
        figure = new_figure(9.6, 6.4)
        axes = figure.subplots(2, 1)
        for ax, side in zip(axes, _SIDES, strict=True):
            part = dataset.sel(side=side)
            filled = tooth.draw_ease_off(ax, part, levels, 2.0)
            ratio = float(part["path_contact_ratio"])
            tooth.draw(ax, f"{_SIDES[side]}: the path lasts {ratio:.2f} mesh periods")
        axes[0].set_xlabel("")
        figure.colorbar(filled, ax=axes, label="ease-off [µm]", ticks=levels[::2], format="%.0f")
        figure.suptitle(
            "Gear tooth without load: gap to the conjugate flank (colours), path of contact "
            "(black),\npattern that 6.35 µm of marking compound shows (red). White: the pinion "
            "does not reach it",
            fontsize=10.5,
        )
    return figure


def pressure_maps(dataset: xr.Dataset) -> Any:
    """Return the highest pressure at each point of the drawn gear tooth, per side and torque.

    Colours span the pressures inside the flanks. Those of sharp edges are far above: they have one
    colour of their own.
    """
    import matplotlib

    tooth = DrawnTooth.of_dataset(dataset)
    torques = _spread(dataset["torque"].values)
    top = inside_pressure(dataset)
    colours = matplotlib.colormaps["magma_r"].with_extremes(over=SKY)
    with house_style():
        figure = new_figure(10.5, 1.1 + 1.5 * len(torques))
        axes = figure.subplots(len(torques), 2, squeeze=False)
        for row, torque in zip(axes, torques, strict=True):
            for ax, side in zip(row, _SIDES, strict=True):
                part = dataset.sel(side=side, torque=torque)
                values = 1e-9 * part["pressure_map"].values
                image = ax.pcolormesh(
                    tooth.along(part["map_t"]),
                    tooth.up(part["map_s"]),
                    np.where(values > 0.0, values, np.nan),
                    vmin=0.0,
                    vmax=top,
                    cmap=colours,
                )
                tooth.draw(ax, f"{_SIDES[side]}, {torque:g} N·m: {_highest(values, top)}")
        for ax in axes[:-1].ravel():
            ax.set_xlabel("")
        for ax in axes[:, 1]:
            ax.set_ylabel("")
        figure.colorbar(
            image, ax=axes, label="highest pressure over the mesh [GPa]", extend="max", shrink=0.7
        )
        figure.suptitle(
            "Gear tooth under load: contact pattern and pressure. Blue: above the scale, "
            "pressed by the edge of a tip",
            fontsize=10.5,
        )
    return figure


def inside_pressure(dataset: xr.Dataset) -> float:
    """Return the pressure [GPa] up to which the colours of a map go: that inside the flanks."""
    values = dataset["pressure_map"].values
    inside = values[(values > 0.0) & (values < EDGE_PRESSURE)]
    return float(np.ceil(1e-8 * np.percentile(inside, _INSIDE))) / 10.0 if inside.size else 1.0


def _highest(values: Array, top: float) -> str:
    """Return "up to 0.87 GPa"; without the number where it has none, at a sharp edge."""
    highest = float(np.nanmax(values, initial=0.0))
    if highest > 1e-9 * EDGE_PRESSURE:
        return "a sharp edge presses"
    return f"up to {highest:.2f} GPa" + (" at an edge" if highest > top else "")


def _spread(values: Any) -> list[float]:
    chosen = np.unique(np.linspace(0, len(values) - 1, min(_TORQUES, len(values))).astype(int))
    return [float(values[i]) for i in chosen]


def loaded_error(state: xr.Dataset) -> Array:
    """Return the transmission error of a side at a torque along the line of action [µm]."""
    error = 1e6 * float(state["R_p"].mean()) * state["rotation"].values
    return np.asarray(error - error.mean())
