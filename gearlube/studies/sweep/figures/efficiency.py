"""Efficiency against speed with the losses behind it."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.loss_words import SOURCE_WORDS, source_colour
from gearlube.plotting.style import HATCHES, house_style, new_figure, preload_label, series
from gearlube_core.arrays import Array

_LEAST_POWER = 1e-3  # W, that the axis reaches


def efficiency(dataset: xr.Dataset) -> Any:
    """Return efficiency of mesh and axle against speed above the stacked losses."""
    with house_style():
        figure = new_figure(8.4, 7.0)
        ax, below = figure.subplots(2, 1, sharex=True, height_ratios=[1.0, 1.0])
        _efficiencies(ax, dataset)
        _losses(below, dataset, _bar_group(dataset["speed_kmh"].values))
        below.set_xlabel("vehicle speed [km/h]")
        figure.suptitle("Transmission efficiency and losses", fontsize=11.5)
        missing = [words for source, words in SOURCE_WORDS.items() if not modelled(dataset, source)]
        if missing:
            figure.supxlabel(f"Not modelled: {', '.join(missing)}.", fontsize=8.5, color="#555555")
    return figure


def _efficiencies(ax: Any, dataset: xr.Dataset) -> None:
    speed = dataset["speed_kmh"].values
    for row, preload in enumerate(dataset["preload"].values):
        look = series(row)
        ax.plot(
            speed,
            100.0 * dataset["efficiency_mesh"].values[row],
            label=f"gear mesh, {preload_label(preload)}",
            **look,
        )
        ax.plot(
            speed,
            100.0 * dataset["efficiency_axle"].values[row],
            label=f"axle, {preload_label(preload)}",
            mfc="white",
            ls=(0, (5, 2)),
            **look,
        )
        if "efficiency_axle_low" in dataset:
            low, high = (100.0 * dataset[f"efficiency_axle_{one}"][row] for one in ("low", "high"))
            words = "95 % of the draws of uncertain data" if row == 0 else None
            ax.fill_between(speed, low, high, color=look["color"], alpha=0.15, lw=0.0, label=words)
    ax.set_ylabel("efficiency [%]")
    ax.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0), handlelength=2.6)


def _bar_group(speed: Array) -> float:
    """Return the width of the bars at one speed [km/h], not wider than 8 % of the axis."""
    if speed.size == 1:
        return 4.0
    return 0.8 * min(float(np.min(np.diff(speed))), 0.1 * float(speed[-1] - speed[0]))


def _losses(ax: Any, dataset: xr.Dataset, group: float) -> None:
    from matplotlib.patches import Patch

    speed = dataset["speed_kmh"].values
    preloads = dataset["preload"].values
    width = group / preloads.size
    ax.set_xlim(speed[0] - 0.8 * group, speed[-1] + 0.8 * group)
    ax.grid(visible=False, axis="x")
    tallest = 0.0
    for row in range(preloads.size):
        shift = (row - 0.5 * (preloads.size - 1)) * width
        bottom = np.zeros(speed.size)
        for source in SOURCE_WORDS:
            if not modelled(dataset, source):
                continue
            loss = np.nan_to_num(dataset["loss"].sel(source=source).values[row])
            ax.bar(
                speed + shift,
                loss,
                0.94 * width,
                bottom=bottom,
                color=source_colour(source),
                hatch=HATCHES[row % len(HATCHES)],
                edgecolor="white",
                lw=0.3,
            )
            bottom += loss
        tallest = max(tallest, float(bottom.max()))
    handles = [
        Patch(color=source_colour(source), label=f"{words}, up to {_largest(dataset, source)} W")
        for source, words in SOURCE_WORDS.items()
        if modelled(dataset, source)
    ]
    handles += [
        Patch(
            facecolor="#808080",
            edgecolor="white",
            hatch=HATCHES[row % len(HATCHES)],
            label=preload_label(preload),
        )
        for row, preload in enumerate(preloads)
    ]
    ax.legend(handles=handles, loc="upper left")
    ax.set_ylim(0.0, 1.06 * max(tallest, _LEAST_POWER))
    ax.set_ylabel("power lost [W]")


def modelled(dataset: xr.Dataset, source: str) -> bool:
    """Whether a source loses anything; results of older versions lack some."""
    if source not in dataset["source"].values:
        return False
    return bool(np.any(np.nan_to_num(dataset["loss"].sel(source=source).values) != 0.0))


def _largest(dataset: xr.Dataset, source: str) -> str:
    """Return the largest loss of a source to three digits; some are too small to see as bars."""
    values = dataset["loss"].sel(source=source).values
    return f"{np.nanmax(values):.3g}" if np.any(np.isfinite(values)) else "-"
