"""Order tracks of a run-up and shapes of its modes."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    GREEN,
    INK,
    OLIVE,
    PURPLE,
    VERMILLION,
    WINE,
    house_style,
    new_figure,
)
from gearlube.studies.runup import levels
from gearlube_core.arrays import Array
from gearlube_core.units import rads_to_rpm

ORDER_LOOKS = (
    {"color": BLUE, "lw": 2.0, "ls": "-"},
    {"color": VERMILLION, "lw": 1.6, "ls": (0, (5, 1.5))},
    {"color": GREEN, "lw": 1.6, "ls": (0, (1.5, 1.0))},
    {"color": PURPLE, "lw": 1.2, "ls": (0, (6, 1.5, 1.5, 1.5))},
)
_NAMES = 0.36  # of the axis, free of curves for the names of critical speeds
_MARKED = 3  # mesh orders whose critical speeds are marked
_OVERALL = {"color": "black", "lw": 1.0, "ls": "-"}
_SHOWN = 60.0  # dB below the overall level's peak
_COLUMNS = 4


def order_tracks(dataset: xr.Dataset) -> Any:
    """Return levels of mesh orders 1 to 3 and of everything, of bearing forces and DTE."""
    with house_style():
        figure = new_figure(9.4, 7.6)
        above, below = figure.subplots(2, 1, sharex=True)
        _tracks(
            above,
            dataset,
            levels.total_force(dataset, "bearing_force_track").values,
            levels.total_force(dataset, "bearing_force_overall").values,
            levels.FORCE,
        )
        above.set_ylabel(f"bearing forces [{levels.FORCE_TEXT}]")
        _tracks(
            below,
            dataset,
            levels.track_rms(dataset, "dte_track").values,
            dataset["dte_overall"].values,
            levels.LENGTH,
        )
        below.set_ylabel(f"transmission error [{levels.LENGTH_TEXT}]")
        low, high = above.get_ylim()
        above.set_ylim(low - _NAMES * (high - low), high)  # room for the names of the marks
        _mark_critical(above, dataset, named=True)
        _mark_critical(below, dataset, named=False)
        levels.speed_axis(above, dataset, label=False)
        levels.speed_axis(below, dataset, top=False)
        handles, labels = above.get_legend_handles_labels()
        figure.legend(handles, labels, ncols=5, loc="outside lower center", handlelength=3.0)
        figure.suptitle(f"Order tracks: {levels.heading(dataset)}")
    return figure


def bearing_tracks(dataset: xr.Dataset) -> Any:
    """Return the mesh orders of the force on each shaft in each direction."""
    bearings, directions = dataset["bearing"].values, dataset["direction"].values
    with house_style():
        figure = new_figure(11.0, 6.4)
        axes = figure.subplots(len(bearings), len(directions), sharex=True, sharey=True)
        top = -np.inf
        for i, bearing in enumerate(bearings):
            for j, direction in enumerate(directions):
                ax, where = axes[i, j], {"bearing": bearing, "direction": direction}
                _tracks(
                    ax,
                    dataset,
                    levels.track_rms(dataset, "bearing_force_track").sel(where).values,
                    dataset["bearing_force_overall"].sel(where).values,
                    levels.FORCE,
                )
                top = max(top, float(ax.get_ylim()[1]))  # of this panel; the next one sets its own
                axis = str(dataset["axis"].sel(where).values)
                ax.set_title(f"{bearing}, {direction} ({axis})", fontsize=9.5)
                levels.speed_axis(ax, dataset, label=i == len(bearings) - 1, top=False)
        for ax in axes[:, 0]:
            ax.set_ylabel(f"force [{levels.FORCE_TEXT}]")
        axes[0, 0].set_ylim(top - _SHOWN, top)
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=5, loc="outside lower center", handlelength=3.0)
        figure.suptitle(f"Bearing forces by direction: {levels.heading(dataset)}")
    return figure


def _tracks(ax: Any, dataset: xr.Dataset, tracks: Array, overall: Array, reference: float) -> None:
    """Draw the levels of `tracks`, (blocks, orders), and of `overall`, (blocks,), rms."""
    speed = levels.rpm(dataset)
    everything = levels.level(overall, reference)
    ax.plot(speed, everything, label="all frequencies", zorder=3, **_OVERALL)
    for i, (order, look) in enumerate(zip(dataset["mesh_order"].values, ORDER_LOOKS, strict=False)):
        name = f"H{order} (order {order * levels.teeth(dataset)})"
        ax.plot(speed, levels.level(tracks[:, i], reference), label=f"mesh {name}", **look)
    top = 5.0 * np.ceil((float(everything.max()) + 3.0) / 5.0)
    low = 5.0 * np.floor(float(levels.level(tracks, reference).min()) / 5.0)
    ax.set_ylim(max(low, top - _SHOWN), top)


def critical_marks(dataset: xr.Dataset) -> list[tuple[float, str, int]]:
    """Return the critical speeds within the ramp [rpm], what meets there, and the mesh order."""
    speeds = levels.rpm(dataset, "mode_speed")
    critical = levels.rpm(dataset, "critical_speed")
    return sorted(
        (float(critical[k, i]), f"{mode}, H{order}", int(order))
        for i, order in enumerate(dataset["mesh_order"].values[:_MARKED])
        for k, mode in enumerate(dataset["mode"].values)
        if speeds[0] <= critical[k, i] <= speeds[-1]
    )


def _mark_critical(ax: Any, dataset: xr.Dataset, *, named: bool) -> None:
    """Mark where mesh orders meet natural modes, with the order's look."""
    marks = critical_marks(dataset)
    looks = dict(zip(dataset["mesh_order"].values.tolist(), ORDER_LOOKS, strict=False))
    lines = [(speed, words, str(looks[order]["color"])) for speed, words, order in marks]
    for speed, _, colour in lines:
        ax.axvline(speed, color=colour, lw=0.8, ls=":", zorder=0)
    if named:
        low, high = levels.rpm(dataset, "mode_speed")[[0, -1]]
        _names(ax, lines, 0.021 * (high - low))


def _names(ax: Any, lines: list[tuple[float, str, str]], gap: float) -> None:
    """Write names upright at the foot of their lines, moved apart where they touch."""
    place = -np.inf
    for speed, words, colour in lines:
        place = max(speed, place + gap)
        ax.annotate(
            words,
            (place, 0.015),
            xycoords=("data", "axes fraction"),
            rotation=90,
            fontsize=7.0,
            color=colour,
            ha="center",
            va="bottom",
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.4},
        )


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
        _bars(left, later, dataset, height=0.42, up=-0.21, colour="#A0A0A0")
        left.set_xlabel("displacement [µm]")
        left.legend(
            handles=[
                Patch(color=WINE, label="red, olive: when the largest is at its crest"),
                Patch(color="#A0A0A0", label="grey: a quarter of a period later"),
            ],
            loc="best",
            fontsize=8,
        )
        shares = 100.0 * dataset["shape_share"].values
        names = [str(mode) for mode in dataset["mode"].values]
        places = np.arange(len(names))[::-1]
        right.barh(places, shares, color=INK, height=0.6)
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
    colours = [colour or (WINE if name.startswith("pinion") else OLIVE) for name in names]
    ax.barh(places + up, values, height, color=colours)
    ax.axvline(0.0, color="black", lw=0.8)
    ax.set_yticks(places, names)
    ax.grid(visible=False, axis="y")
