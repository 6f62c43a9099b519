"""Speed-frequency colour maps of spectra, one panel a preload."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    cell_edges,
    house_style,
    name_levels,
    new_figure,
    outlined,
    preload_label,
)
from gearlube_core.arrays import Array

DYNAMIC_RANGE = 70.0  # dB between the top and the bottom of the colour scale
_LOWEST_LINE = 0.02  # lines that stay below this share of the axis are left out
_ROWS = 160  # frequency cells of a map; a cell shows the largest line inside it


@dataclass(frozen=True, slots=True, kw_only=True)
class MapChannel:
    """Quantity of a colour map.

    Parameters
    ----------
    variable : str
        Spectrum in the sweep dataset.
    title : str
        Name of the quantity.
    reference : float
        Amplitude of 0 dB, in the unit of the variable.
    reference_text : str
        The same, to be printed.
    """

    variable: str
    title: str
    reference: float
    reference_text: str


DTE = MapChannel(
    variable="dte_spectrum",
    title="Dynamic transmission error",
    reference=1e-9,
    reference_text="1 nm",
)
RADIAL = MapChannel(
    variable="radial_spectrum",
    title="Radial displacement of the pinion",
    reference=1e-9,
    reference_text="1 nm",
)
ROLLER_LOW = MapChannel(
    variable="roller_load_spectrum",
    title="Load of one roller, pinion bearing 1, low frequencies",
    reference=1.0,
    reference_text="1 N",
)
ROLLER = MapChannel(
    variable="roller_load_spectrum",
    title="Load of one roller, pinion bearing 1",
    reference=1.0,
    reference_text="1 N",
)


def spectrum_map(
    dataset: xr.Dataset, channel: MapChannel, highest_frequency: float | None = None
) -> Any:
    """Return the colour map of a spectrum over vehicle speed and frequency.

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
        One panel for each preload with a common colour scale in dB, mesh and cage lines dashed,
        natural frequencies dotted. Speeds without a result are grey.
    """
    top = highest_frequency or default_top(dataset)
    speeds = dataset["speed_kmh"].values
    edges, levels, peak = spectrum_levels(dataset, channel, top)
    cells = _columns(speeds)
    with house_style():
        count = len(levels)
        figure = new_figure(max(4.4 * count + 1.2, 6.0), 5.0)
        axes = np.atleast_1d(figure.subplots(1, count, sharey=True))
        for row, (ax, level) in enumerate(zip(axes, levels, strict=True)):
            ax.set_facecolor("#9A9A9A")
            ax.grid(visible=False)
            for column, (left, right) in enumerate(cells):
                mesh = ax.pcolormesh(
                    [left, right],
                    edges,
                    level[:, column : column + 1],
                    cmap="magma",
                    vmin=peak - DYNAMIC_RANGE,
                    vmax=peak,
                    rasterized=True,
                )
            ax.set_xlim(cells[0][0], cells[-1][1])
            _mesh_lines(ax, dataset.isel(preload=row), top)
            ax.set_ylim(0.0, top)
            _mode_lines(ax, dataset.isel(preload=row), top, named=row == count - 1)
            ax.set_title(preload_label(float(dataset["preload"][row])))
            ax.set_xlabel("vehicle speed [km/h]")
        axes[0].set_ylabel("frequency [Hz]")
        bar = figure.colorbar(mesh, ax=list(axes), pad=0.02, shrink=0.95, extend="min")
        bar.set_label(f"amplitude [dB re {channel.reference_text}]")
        figure.suptitle(f"{channel.title}: spectra during the speed sweep", fontsize=11.5)
    return figure


def spectrum_levels(
    dataset: xr.Dataset, channel: MapChannel, top: float
) -> tuple[Array, list[Array], float]:
    """Return the edges of frequency cells [Hz], levels [dB] for each preload, and the scale's end.

    Levels are of shape (cells, speeds); the end is the largest level, rounded up to 5 dB.
    """
    edges = np.linspace(0.0, top, _ROWS + 1)
    levels = [
        _decibels(dataset.isel(preload=row), channel, edges)
        for row in range(dataset.sizes["preload"])
    ]
    peak = max((float(np.nanmax(x)) for x in levels if np.any(np.isfinite(x))), default=0.0)
    return edges, levels, 5.0 * float(np.ceil(peak / 5.0))


def _columns(speeds: Array) -> list[tuple[float, float]]:
    """Return the edges of the column of every speed; columns touch unless speeds are far apart."""
    edges = cell_edges(speeds)
    widest = max(0.07 * float(speeds[-1] - speeds[0]), 2.0)
    return [
        (max(left, speed - 0.5 * widest), min(right, speed + 0.5 * widest))
        for left, speed, right in zip(edges[:-1], speeds, edges[1:], strict=True)
    ]


def default_top(dataset: xr.Dataset) -> float:
    """Return the end of the frequency axis [Hz]: above the highest mode, within the spectra."""
    highest = float(np.nanmax(dataset["frequency"])) if "frequency" in dataset else 2500.0
    if "mode_frequency" not in dataset:
        return min(highest, 2500.0)
    modes = dataset["mode_frequency"].values
    modes = modes[np.isfinite(modes)]
    top = 1.15 * float(modes.max()) if modes.size else 2500.0
    return min(highest, 100.0 * np.ceil(top / 100.0))


def _decibels(point_row: xr.Dataset, channel: MapChannel, edges: Array) -> Array:
    """Return levels [dB] of shape (frequency cells, speeds); NaN where there is no result."""
    speeds = point_row.sizes["speed"]
    level = np.full((edges.size - 1, speeds), np.nan)
    for column in range(speeds):
        frequency = point_row["frequency"].values[column]
        amplitude = point_row[channel.variable].values[column]
        usable = np.isfinite(frequency) & (frequency > 0.0) & (frequency < edges[-1])
        if not np.any(usable):
            continue
        peak = _largest_in_cells(frequency[usable], amplitude[usable], edges)
        level[:, column] = 20.0 * np.log10(np.maximum(peak / channel.reference, 1e-12))
    return level


def _largest_in_cells(frequency: Array, amplitude: Array, edges: Array) -> Array:
    """Return the largest amplitude in every cell; empty cells take the nearest line."""
    cells = edges.size - 1
    peak = np.full(cells, -np.inf)
    position = np.clip(np.searchsorted(edges, frequency, side="right") - 1, 0, cells - 1)
    np.maximum.at(peak, position, amplitude)
    empty = np.isneginf(peak)
    if np.any(empty):
        centres = 0.5 * (edges[1:] + edges[:-1])
        peak[empty] = np.interp(centres[empty], frequency, amplitude)
    return peak


def _mesh_lines(ax: Any, row: xr.Dataset, top: float) -> None:
    """Draw f_m, 2 f_m, 3 f_m and the cage frequency, named where they leave the panel."""
    speed = row["speed_kmh"].values
    lines = [
        (row["mesh_frequency"], 1.0, "$f_m$"),
        (row["mesh_frequency"], 2.0, "$2f_m$"),
        (row["mesh_frequency"], 3.0, "$3f_m$"),
        (row["pinion_cage_frequency"], 1.0, "$f_c$"),
    ]
    for frequency, multiple, name in lines:
        values = multiple * frequency.values
        known = np.isfinite(values)
        if not np.any(known) or np.nanmax(values) < _LOWEST_LINE * top:
            continue
        (line,) = ax.plot(
            speed[known], values[known], color="white", lw=0.9, ls=(0, (6, 6)), alpha=0.75
        )
        inside = np.flatnonzero(known & (values < 0.97 * top))
        if inside.size == 0:
            continue
        last = inside[-1]
        text = ax.annotate(
            name,
            (speed[last], values[last]),
            xytext=(-3, 3),
            textcoords="offset points",
            color="white",
            ha="right",
            va="bottom",
            fontsize=9,
        )
        outlined(line, width=1.6)
        outlined(text)


def _mode_lines(ax: Any, row: xr.Dataset, top: float, *, named: bool) -> None:
    if "mode_frequency" not in row:
        return
    levels = {
        str(name): float(frequency)
        for name, frequency in zip(row["mode"].values, row["mode_frequency"].values, strict=True)
        if frequency <= top
    }
    for frequency in levels.values():
        line = ax.axhline(frequency, color="#7FFFD4", lw=0.9, ls=":", alpha=0.9)
        outlined(line, width=1.4)
    if named:
        name_levels(ax, levels)
