"""Operating points of the axle: torques, and excitation frequencies beside bearing modes."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    GREEN,
    PURPLE,
    VERMILLION,
    house_style,
    name_levels,
    new_figure,
    speed_limits,
)


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
    ax.set_ylabel("mean torque [N m]")
    ax.set_ylim(bottom=0.0)
    ax.legend(loc="upper left")
    ax.set_title("torques from the road load")


def _campbell(ax: Any, dataset: xr.Dataset) -> None:
    row = dataset.isel(preload=0)
    speed = row["speed_kmh"].values
    ax.set_xlim(*speed_limits(dataset))
    for multiple, style in ((1, "-"), (2, (0, (5, 2))), (3, (0, (1, 1.2)))):
        name = "mesh $f_m$" if multiple == 1 else f"${multiple}f_m$"
        ax.semilogy(speed, multiple * row["mesh_frequency"], color=BLUE, ls=style, label=name)
    for name, colour, label in (
        ("pinion_frequency", GREEN, "pinion rotation"),
        ("pinion_cage_frequency", PURPLE, "pinion cage $f_c$"),
    ):
        ax.semilogy(speed, row[name], color=colour, label=label)
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
        ax.axhspan(low, high * 1.002, color="#404040", alpha=0.35, lw=0)
        middles[str(name)] = (low * high) ** 0.5
    if middles:
        ax.set_ylim(top=max(ax.get_ylim()[1], 1.5 * max(middles.values())))
    name_levels(ax, middles, size=7.5)
