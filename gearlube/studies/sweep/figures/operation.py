"""Operating points of the axle: torques, and excitation frequencies beside bearing modes."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    ORANGE,
    VERMILLION,
    house_style,
    name_levels,
    new_figure,
    speed_limits,
)

_FIRING = 2  # engine order of a four-stroke engine with four cylinders that is drawn


def operating_points(dataset: xr.Dataset) -> Any:
    """Return mean torques against speed, beside the Campbell diagram of the sweep."""
    with house_style():
        figure = new_figure(10.0, 4.6)
        left, right = figure.subplots(1, 2)
        _torques(left, dataset.isel(preload=0))
        _campbell(right, dataset)
        for ax in (left, right):
            ax.set_xlabel("vehicle speed [km/h]")
        figure.suptitle("Operating points", fontsize=11.5)
    return figure


def _torques(ax: Any, row: xr.Dataset) -> None:
    speed = row["speed_kmh"].values
    ax.set_xlim(*speed_limits(row))
    ax.plot(speed, row["wheel_torque"], color=VERMILLION, marker="s", label="wheel gear, load")
    ax.plot(speed, row["pinion_torque"], color=BLUE, marker="o", label="pinion, drive")
    ax.set_ylabel("mean torque [N·m]")
    ax.set_ylim(bottom=0.0)
    ax.legend(loc="upper left")
    ax.set_title("torques from the road load")


def _campbell(ax: Any, dataset: xr.Dataset) -> None:
    row = dataset.isel(preload=0)
    speed = row["speed_kmh"].values
    ax.set_xlim(*speed_limits(dataset))
    for multiple, style in ((1, "-"), (2, (0, (5, 2))), (3, (0, (1, 1.2)))):
        ax.plot(
            speed, multiple * row["mesh_frequency"], color=BLUE, ls=style, label=f"mesh H{multiple}"
        )
    if "crank_frequency" in dataset:
        ax.plot(
            speed,
            _FIRING * row["crank_frequency"],
            color=ORANGE,
            marker="o",
            ms=3.0,
            lw=0.9,
            label=f"engine order {_FIRING}, gear by speed",
        )
    _modes(ax, dataset)
    ax.set_ylabel("frequency [Hz]")
    ax.set_title("excitation and natural frequencies")
    ax.figure.legend(*ax.get_legend_handles_labels(), loc="outside lower right", ncols=5)


def _modes(ax: Any, dataset: xr.Dataset) -> None:
    """Shade each natural frequency from its value at the lowest to that at the highest preload."""
    if "mode_frequency" not in dataset:
        return
    middles = {}
    for name, values in zip(
        dataset["mode"].values, dataset["mode_frequency"].values.T, strict=True
    ):
        if not np.any(np.isfinite(values)):
            continue
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        middle = 0.5 * (low + high)
        ax.axhspan(low, high, color="#404040", alpha=0.3, lw=0)
        ax.axhline(middle, color="#404040", lw=0.8)
        middles[str(name)] = middle
    ax.set_ylim(0.0, max([ax.get_ylim()[1], *(1.05 * one for one in middles.values())]))
    name_levels(ax, middles, size=7.5)
