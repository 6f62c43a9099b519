"""Mode shapes of the axle, and its motion where the bearing forces are largest."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, ORANGE, VERMILLION, house_style, new_figure
from gearlube.studies.runup import levels
from gearlube_core.arrays import Array
from gearlube_core.units import rads_to_rpm

_COLUMNS = 4


def mode_shapes(dataset: xr.Dataset) -> Any:
    """Return the displacements of each natural mode as bars, the largest 1."""
    modes = dataset["mode"].values
    rows = -(-len(modes) // _COLUMNS)
    middle = dataset.sizes["mode_speed"] // 2
    with house_style():
        figure = new_figure(11.0, 2.9 * rows + 0.5)
        axes = figure.subplots(rows, _COLUMNS, sharex=True, sharey=True)
        for ax in axes.flat[len(modes) :]:
            ax.set_visible(False)
        for ax, mode in zip(axes.flat, modes, strict=False):
            shape = dataset["mode_shape"].sel(mode=mode).values
            _bars(ax, shape / shape[int(np.argmax(np.abs(shape)))], dataset)
            frequency = float(dataset["mode_frequency"].sel(mode=mode)[middle])
            ax.set_title(f"{mode}, {frequency:.0f} Hz", fontsize=10)
            ax.set_xlim(-1.08, 1.08)
        for ax in axes[-1]:
            ax.set_xlabel("displacement [-]")
        speed = levels.rpm(dataset, "mode_speed")[middle]
        figure.suptitle(f"Natural modes of the axle at {speed:.0f} rpm, {levels.heading(dataset)}")
    return figure


def operating_shape(dataset: xr.Dataset) -> Any:
    """Return the motion at the loudest mesh order and speed, and the modes in it."""
    amplitude, phase = dataset["shape_amplitude"].values, dataset["shape_phase"].values
    from matplotlib.patches import Patch

    # the instant at which the largest coordinate is at its crest
    largest = phase[int(np.argmax(amplitude))]
    at_once = 1e6 * amplitude * np.cos(phase - largest)
    later = 1e6 * amplitude * np.sin(phase - largest)
    speed = rads_to_rpm(float(dataset["shape_speed"]))
    order = int(dataset["shape_mesh_order"])
    frequency = order * levels.teeth(dataset) * speed / 60.0
    with house_style():
        figure = new_figure(10.4, 4.4)
        left, right = figure.subplots(1, 2, width_ratios=[3, 2])
        _bars(left, at_once, dataset, height=0.42, up=0.21)
        _bars(
            left,
            later,
            dataset,
            height=0.42,
            up=-0.21,
            colour="#A0A0A0",
        )
        left.set_xlabel("displacement [µm]")
        left.legend(
            handles=[
                Patch(color="#404040", label="blue, red: when the largest is at its crest"),
                Patch(color="#A0A0A0", label="grey: a quarter of a period later"),
            ],
            loc="best",
            fontsize=8,
        )
        shares = 100.0 * dataset["shape_share"].values
        names = [str(mode) for mode in dataset["mode"].values]
        places = np.arange(len(names))[::-1]
        right.barh(places, shares, color=ORANGE, height=0.6)
        for place, share in zip(places, shares, strict=True):
            right.annotate(
                f"{share:.0f} %",
                (share, place),
                xytext=(3, 0),
                textcoords="offset points",
                va="center",
                fontsize=8.5,
            )
        right.set_yticks(places, names)
        right.grid(visible=False, axis="y")
        right.set_xlim(0.0, 115.0)
        right.set_xlabel("share of the kinetic energy [%]")
        right.set_title("natural modes in this motion")
        left.set_title(f"mesh H{order} at {speed:.0f} rpm, {frequency:.0f} Hz")
        figure.suptitle(
            f"Operating shape where the bearing forces are largest: {levels.heading(dataset)}"
        )
    return figure


def _bars(
    ax: Any,
    values: Array,
    dataset: xr.Dataset,
    *,
    height: float = 0.66,
    up: float = 0.0,
    colour: str | None = None,
) -> None:
    names = [str(name) for name in dataset["coordinate"].values]
    places = np.arange(len(names))[::-1]
    colours = [colour or (BLUE if name.startswith("pinion") else VERMILLION) for name in names]
    ax.barh(places + up, values, height, color=colours)
    ax.axvline(0.0, color="black", lw=0.8)
    ax.set_yticks(places, names)
    ax.grid(visible=False, axis="y")
