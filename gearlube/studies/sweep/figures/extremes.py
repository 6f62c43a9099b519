"""Smallest and largest value of a quantity against vehicle speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    GREY,
    ORANGE,
    VERMILLION,
    cell_edges,
    house_style,
    new_figure,
    preload_label,
    series,
    speed_limits,
)

_CLASS_COLOURS = ("#E8E8E8", ORANGE, VERMILLION)
_CLASS_NAMES = ("contact throughout", "single-sided separation", "double-sided impacts")


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
