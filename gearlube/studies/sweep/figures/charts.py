"""Extremes, efficiency and losses of a sweep over speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    GREY,
    HATCHES,
    ORANGE,
    VERMILLION,
    cell_edges,
    house_style,
    new_figure,
    preload_label,
    series,
    speed_limits,
)
from gearlube.plotting.words import SOURCE_WORDS, source_colour
from gearlube_core.arrays import Array

_LEAST_POWER = 1e-3  # W, that the axis reaches
_CLASS_COLOURS = ("#E8E8E8", ORANGE, VERMILLION)
_CLASS_NAMES = ("contact throughout", "single-sided separation", "double-sided impacts")


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


@dataclass(frozen=True, slots=True, kw_only=True)
class ExtremesChannel:
    """A quantity with `name`_min, `name`_max and `name`_mean in the sweep dataset."""

    name: str
    label: str
    title: str
    scale: float
    zero: str = ""


DTE = ExtremesChannel(
    name="dte",
    label="dynamic transmission error [µm]",
    title="Extremes of the dynamic transmission error",
    scale=1e6,
    zero="loss of\ncontact\nbelow 0",
)
RADIAL = ExtremesChannel(
    name="radial",
    label="radial displacement of the pinion [µm]",
    title="Extremes of the radial displacement of the pinion",
    scale=1e6,
)
ROLLER = ExtremesChannel(
    name="roller_load",
    label="load of one roller [N]",
    title="Extremes of the load of one roller, pinion bearing 1",
    scale=1.0,
    zero="unloaded\nat 0",
)


def extremes_against_speed(dataset: xr.Dataset, channel: ExtremesChannel) -> Any:
    """Return the band between minimum and maximum against vehicle speed for every preload.

    For the transmission error a strip below shows at which speeds the teeth separate.
    """
    speed = dataset["speed_kmh"].values
    strip = channel.name == "dte"
    with house_style():
        figure = new_figure(8.0, 5.4 if strip else 4.6)
        if strip:
            ax, below = figure.subplots(
                2, 1, sharex=True, height_ratios=[8, 0.45 * dataset.sizes["preload"]]
            )
        else:
            ax, below = figure.subplots(), None
        for row, preload in enumerate(dataset["preload"].values):
            look = series(row)
            colour = look["color"]
            low, mean, high = (
                dataset[f"{channel.name}_{part}"].values[row] * channel.scale
                for part in ("min", "mean", "max")
            )
            ax.fill_between(speed, low, high, color=colour, alpha=0.13, lw=0)
            ax.plot(speed, high, label=preload_label(preload), **look)
            ax.plot(speed, low, mfc="white", **look)
            ax.plot(speed, mean, color=colour, lw=1.0, ls=(0, (4, 3)))
        _zero_line(ax, channel)
        _line_key(ax)
        ax.set_ylabel(channel.label)
        ax.set_xlim(*speed_limits(dataset))
        (below if below is not None else ax).set_xlabel("vehicle speed [km/h]")
        if below is not None:
            _separation_strip(below, dataset)
        figure.suptitle(channel.title, fontsize=11.5)
    return figure


def _zero_line(ax: Any, channel: ExtremesChannel) -> None:
    if not channel.zero:
        return
    low, high = ax.get_ylim()
    ax.set_ylim(min(low, -0.03 * (high - min(low, 0.0))), high)
    ax.axhline(0.0, color="black", lw=0.9)
    ax.annotate(
        channel.zero,
        (1.0, 0.0),
        xycoords=("axes fraction", "data"),
        xytext=(4, 0),
        textcoords="offset points",
        va="center",
        fontsize=8,
        annotation_clip=False,
    )


def _line_key(ax: Any) -> None:
    from matplotlib.lines import Line2D

    handles, _ = ax.get_legend_handles_labels()
    handles += [
        Line2D([], [], color="#404040", marker="o", lw=1.2, label="maximum"),
        Line2D([], [], color="#404040", marker="o", mfc="white", lw=1.2, label="minimum"),
        Line2D([], [], color="#404040", lw=1.0, ls=(0, (4, 3)), label="mean"),
    ]
    ax.legend(
        handles=handles,
        ncols=len(handles),
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        handlelength=1.8,
        columnspacing=1.3,
    )


def _separation_strip(ax: Any, dataset: xr.Dataset) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    edges = cell_edges(dataset["speed_kmh"].values)
    preloads = dataset["preload"].values
    classes = np.ma.masked_invalid(dataset["separation"].values)
    colours = ListedColormap(_CLASS_COLOURS)
    ax.set_facecolor(GREY)
    ax.pcolormesh(
        edges,
        np.arange(preloads.size + 1),
        classes,
        cmap=colours,
        vmin=-0.5,
        vmax=2.5,
        edgecolor="white",
        lw=0.8,
    )
    ax.grid(visible=False)
    ax.set_yticks(np.arange(preloads.size) + 0.5, [f"{p:g} N" for p in preloads])
    ax.tick_params(axis="y", length=0)
    handles = [
        Patch(color=colour, label=name)
        for colour, name in zip(_CLASS_COLOURS, _CLASS_NAMES, strict=True)
    ]
    ax.figure.legend(handles=handles, ncols=3, loc="outside lower center")
