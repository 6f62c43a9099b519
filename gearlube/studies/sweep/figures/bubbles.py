"""Spectra of a sweep as bubbles over speed and frequency, one panel a preload."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    GREEN,
    ORANGE,
    house_style,
    name_levels,
    new_figure,
    outlined,
    preload_label,
    speed_limits,
)
from gearlube.studies.sweep.figures.orders import MapChannel, default_top
from gearlube_core.arrays import Array

RANGE = 60.0  # dB from the smallest to the largest bubble
_ROUNDING = 0.01  # of 5 dB, by which a level may exceed the largest bubble
_LARGEST = 130.0  # its area [pt^2]
_LOWEST = 0.012  # of the frequency axis; lines below do not set the scale
_ONE_ROW = 8.0  # width of a figure from which its key has one row [in]
_ENGINE = tuple(range(2, 25, 2))  # orders of a four-stroke engine with four cylinders
KINDS = ("mesh orders", "engine orders", "others: sidebands, rollers, free vibration")
COLOURS = (GREEN, ORANGE, "#8C8C8C")
_MESH_LINES = (1, 2, 3)


@dataclass(frozen=True, slots=True, kw_only=True)
class Lines:
    """Spectral lines of one point: frequency [Hz], level [dB], kind (place in `KINDS`)."""

    frequency: Array
    level: Array
    kind: Array


def spectrum_bubbles(
    dataset: xr.Dataset, channel: MapChannel, highest_frequency: float | None = None
) -> Any:
    """Return the lines of a spectrum over vehicle speed and frequency.

    Parameters
    ----------
    dataset : xarray.Dataset
        Merged sweep.
    channel : MapChannel
        Which spectrum.
    highest_frequency : float
        End of the frequency axis [Hz]; by default just above the highest bearing mode.

    Returns
    -------
    matplotlib.figure.Figure
        One panel for each preload. Every line of every steady point is a bubble, the larger the
        higher its level; colours say what it comes from. Mesh orders and the cage frequency are
        drawn, natural frequencies dotted.
    """
    top = highest_frequency or default_top(dataset)
    speeds = dataset["speed_kmh"].values
    count = dataset.sizes["preload"]
    points = all_lines(dataset, channel, top)
    peak = highest(points, top)
    with house_style():
        figure = new_figure(max(4.4 * count + 1.4, 6.4), 5.6)
        axes = np.atleast_1d(figure.subplots(1, count, sharey=True))
        for row, ax in enumerate(axes):
            ax.set_xlim(*speed_limits(dataset))
            _guides(ax, dataset.isel(preload=row), top)
            for column, speed in enumerate(speeds):
                _bubbles(ax, float(speed), points[row, column], peak)
            ax.set_ylim(0.0, top)
            _mode_lines(ax, dataset.isel(preload=row), top, named=row == count - 1)
            ax.set_title(preload_label(float(dataset["preload"][row])))
            ax.set_xlabel("vehicle speed [km/h]")
        axes[0].set_ylabel("frequency [Hz]")
        used = {
            int(kind)
            for one in points.values()
            for kind in one.kind[one.level > peak - 0.9 * RANGE]
        }
        _key(figure, channel, peak, used)
        figure.suptitle(f"{channel.title}: spectra of steady speeds", fontsize=11.5)
    return figure


def all_lines(dataset: xr.Dataset, channel: MapChannel, top: float) -> dict[tuple[int, int], Lines]:
    """Return the lines of every point by the places of its preload and speed."""
    return {
        (row, column): lines_of(dataset.isel(preload=row, speed=column), channel, top)
        for row in range(dataset.sizes["preload"])
        for column in range(dataset.sizes["speed"])
    }


def lines_of(point: xr.Dataset, channel: MapChannel, top: float) -> Lines:
    """Return the crests of a point's spectrum below `top` [Hz]; none for a failed point."""
    frequency = point["frequency"].values
    usable = np.flatnonzero(np.isfinite(frequency) & (frequency > 0.0))
    if usable.size < 3:
        return Lines(frequency=np.empty(0), level=np.empty(0), kind=np.empty(0, dtype=int))
    at, amplitude = frequency[usable], point[channel.variable].values[usable]
    beside = np.concatenate([[-np.inf], amplitude, [-np.inf]])
    crest = (amplitude >= beside[:-2]) & (amplitude > beside[2:]) & (amplitude > 0.0) & (at < top)
    return Lines(
        frequency=at[crest],
        level=20.0 * np.log10(amplitude[crest] / channel.reference),
        kind=_kinds(point, at[crest], float(at[1] - at[0])),
    )


def _kinds(point: xr.Dataset, frequency: Array, bin_width: float) -> Array:
    """Return what each line comes from: within a bin of a mesh order or of an engine order."""
    mesh = float(point["mesh_frequency"])
    kind = np.full(frequency.size, 2)
    if "crank_frequency" in point:
        orders = float(point["crank_frequency"]) * np.array(_ENGINE)
        distance = np.abs(frequency[:, None] - orders)
        kind[distance.min(axis=1) <= 1.5 * bin_width] = 1
    cycles = np.round(frequency / mesh)
    kind[(cycles >= 1) & (np.abs(frequency - cycles * mesh) <= bin_width)] = 0
    return kind


def highest(points: dict[tuple[int, int], Lines], top: float) -> float:
    """Return the level of the largest bubble [dB], a multiple of 5.

    The lowest frequencies, where the cage turns, do not count.
    """
    levels = [
        float(one.level[one.frequency > _LOWEST * top].max())
        for one in points.values()
        if np.any(one.frequency > _LOWEST * top)
    ]
    return 5.0 * float(np.ceil(max(levels, default=0.0) / 5.0 - _ROUNDING))


def _area(level: Array, peak: float) -> Array:
    share = np.clip((level - peak + RANGE) / RANGE, 0.0, 1.0)
    return np.asarray(_LARGEST * share**2)


def _bubbles(ax: Any, speed: float, lines: Lines, peak: float) -> None:
    for kind in (2, 1, 0):
        seen = (lines.kind == kind) & (lines.level > peak - RANGE)
        ax.scatter(
            np.full(int(seen.sum()), speed),
            lines.frequency[seen],
            s=_area(lines.level[seen], peak),
            color=COLOURS[kind],
            alpha=0.85,
            lw=0.4,
            edgecolor="white",
            zorder=4 - kind,
        )


def _guides(ax: Any, row: xr.Dataset, top: float) -> None:
    """Draw mesh orders and the cage frequency as thin lines, named where they leave the panel."""
    speed = row["speed_kmh"].values
    guides = [(m * row["mesh_frequency"].values, f"H{m}") for m in _MESH_LINES]
    guides.append((row["pinion_cage_frequency"].values, "cage"))
    for values, name in guides:
        known = np.isfinite(values)
        if not np.any(known) or np.nanmax(values) < 0.02 * top:
            continue
        ax.plot(speed[known], values[known], color="#8FC7B4", lw=0.9, zorder=1)
        inside = np.flatnonzero(known & (values < 0.97 * top))
        if inside.size:
            text = ax.annotate(
                name,
                (speed[inside[-1]], values[inside[-1]]),
                xytext=(-3, 8),
                textcoords="offset points",
                ha="right",
                va="bottom",
                fontsize=8.5,
            )
            outlined(text, "white")


def modes_below(row: xr.Dataset, top: float) -> dict[str, float]:
    """Return the natural frequencies of a preload below `top` [Hz] by name."""
    if "mode_frequency" not in row:
        return {}
    return {
        str(name): float(frequency)
        for name, frequency in zip(row["mode"].values, row["mode_frequency"].values, strict=True)
        if frequency <= top
    }


def _mode_lines(ax: Any, row: xr.Dataset, top: float, *, named: bool) -> None:
    found = modes_below(row, top)
    for frequency in found.values():
        ax.axhline(frequency, color="#404040", lw=0.8, ls=":", zorder=1)
    if named:
        name_levels(ax, found)


def _key(figure: Any, channel: MapChannel, peak: float, used: set[int]) -> None:
    """Say what sizes and colours mean, below the panels."""
    from matplotlib.lines import Line2D

    kinds = [
        Line2D([], [], ls="", marker="o", ms=8, color=COLOURS[k], label=KINDS[k])
        for k in sorted(used)
    ]
    sizes = [
        Line2D(
            [], [], ls="", marker="o", color="#404040",
            label=f"{level:.0f} dB".replace("-", "−"),
            ms=float(np.sqrt(_area(np.array(level), peak))),
        )
        for level in (peak, peak - 20.0, peak - 40.0)
    ]  # fmt: skip
    sizes[0].set_label(f"{sizes[0].get_label()} re {channel.reference_text}")
    handles = [*sizes, *kinds]
    figure.legend(
        handles=handles,
        ncols=len(handles) if figure.get_figwidth() > _ONE_ROW else len(sizes),
        loc="outside lower center",
        columnspacing=1.2,
        handletextpad=0.4,
    )
