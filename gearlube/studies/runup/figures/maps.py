"""Colour maps of a run-up: speed against frequency, and speed against order."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import house_style, largest_in_cells, name_levels, new_figure, outlined
from gearlube.studies.runup import levels
from gearlube_core.arrays import Array

DYNAMIC_RANGE = 70.0  # dB of the colour scale
_MOST_ORDERS = 3.6  # mesh orders on the order axis
_MOST = 260  # slices of a map
_COLOURS = "viridis"
_LIGHT = "white"
_LOWEST = 3.5  # bins above 0 Hz, where the change of the mean leaks


def _force_cells(dataset: xr.Dataset) -> tuple[Array, Array, Array]:
    """Return pinion speeds [rpm], frequencies [Hz] and levels of all bearing forces [dB].

    Shapes (slices,), (rows,), (slices, rows); slices by ascending speed.
    """
    force = levels.level(
        levels.total_force(dataset, "bearing_force_waterfall").values, levels.FORCE
    )
    frequency = dataset["frequency"].values
    keep = (frequency <= _top_frequency(dataset)) & (frequency > _LOWEST * frequency[1])
    speed = levels.rpm(dataset, "slice_speed")
    along = np.argsort(speed)[:: max(1, speed.size // _MOST)]
    return speed[along], *largest_in_cells(frequency[keep], force[along][:, keep])


def frequency_map(dataset: xr.Dataset) -> Any:
    """Return the level of all bearing forces over pinion speed and frequency, with order lines."""
    top = _top_frequency(dataset)
    speed, rows, cells = _force_cells(dataset)
    floor = cells.max() - DYNAMIC_RANGE
    with house_style():
        figure = new_figure(9.4, 5.8)
        ax = figure.subplots()
        _picture(figure, ax, speed, rows, cells, pad=0.03)
        ends = np.array(ax.get_xlim())
        per_rpm = levels.teeth(dataset) / 60.0
        for order in range(1, 8):
            place = min(ends[1] - 0.012 * np.ptp(ends), 0.94 * top / (order * per_rpm))
            inside = place > ends[0] + 0.1 * np.ptp(ends)
            near = int(np.abs(speed - place).argmin())
            if inside and _is_seen(order * per_rpm * speed[near], rows, cells[near], floor):
                _name(ax, f"H{order}", place, order * per_rpm * place, ha="right")
        ax.set_ylim(0.0, top)
        _modes_beside(ax, dataset, top)
        levels.speed_axis(ax, dataset)
        ax.set_ylabel("frequency [Hz]")
        figure.suptitle(f"Bearing forces, all directions together: {levels.heading(dataset)}")
    return figure


def order_map(dataset: xr.Dataset) -> Any:
    """Return the level of all bearing forces over pinion speed and order, with natural modes."""
    force = levels.level(levels.total_force(dataset, "bearing_force_orders").values, levels.FORCE)
    order = dataset["order"].values
    teeth = levels.teeth(dataset)
    top = _MOST_ORDERS * teeth
    keep = (order <= top) & (order > 0.0)
    speed = levels.rpm(dataset)
    with house_style():
        figure = new_figure(9.4, 5.8)
        ax = figure.subplots()
        _picture(figure, ax, speed, order[keep], force[:, keep], pad=0.08)
        ends = ax.get_xlim()
        fine = np.linspace(float(ends[0]), float(ends[1]), 200)
        _mode_curves(ax, dataset, fine, top)
        ax.set_ylim(0.0, top)
        levels.speed_axis(ax, dataset)
        ax.set_xlim(*ends)
        ax.set_ylabel("order: cycles per pinion revolution [-]")
        name_levels(ax, {f"H{m}": m * teeth for m in range(1, int(top / teeth) + 1)})
        figure.suptitle(f"Orders of the bearing forces: {levels.heading(dataset)}")
    return figure


def _top_frequency(dataset: xr.Dataset) -> float:
    """Return the end of the frequency axis [Hz]: the highest mode, or H3 at full speed."""
    highest = float(dataset["mode_frequency"].max())
    third = 3.0 * levels.teeth(dataset) * float(levels.rpm(dataset).max()) / 60.0
    top = 100.0 * np.ceil(1.1 * max(highest, third) / 100.0)
    return min(top, float(dataset["frequency"].max()))


def _is_seen(frequency: float, rows: Array, cells: Array, floor: float) -> bool:
    """Whether a slice, its cells over `rows`, reaches above `floor` at a frequency [Hz]."""
    place = int(np.searchsorted(rows, frequency))
    return bool(float(cells[max(place - 1, 0) : place + 2].max()) > floor)


def _picture(figure: Any, ax: Any, speed: Array, rows: Array, force: Array, *, pad: float) -> None:
    along = np.argsort(speed)
    peak = 5.0 * np.ceil(float(np.max(force)) / 5.0)
    mesh = ax.pcolormesh(
        speed[along],
        rows,
        force[along].T,
        cmap=_COLOURS,
        vmin=peak - DYNAMIC_RANGE,
        vmax=peak,
        shading="nearest",
        rasterized=True,
    )
    ax.grid(visible=False)
    ax.set_xlim(float(speed.min()), float(speed.max()))
    ax.set_facecolor(mesh.cmap(0.0))
    bar = figure.colorbar(mesh, ax=ax, pad=pad, extend="min", shrink=0.95)
    bar.set_label(f"level [{levels.FORCE_TEXT}]")


def _name(ax: Any, words: str, x: float, y: float, **more: Any) -> None:
    text = ax.annotate(
        words, (x, y), xytext=(-2, 3), textcoords="offset points", color="white", fontsize=9, **more
    )
    outlined(text)


def _modes_beside(ax: Any, dataset: xr.Dataset, top: float) -> None:
    speed = levels.rpm(dataset, "mode_speed")
    last = {}
    for mode in dataset["mode"].values:
        values = dataset["mode_frequency"].sel(mode=mode).values
        if values[-1] > top:
            continue
        (line,) = ax.plot(speed, values, color=_LIGHT, lw=1.0, ls=":")
        outlined(line, width=1.5)
        last[str(mode)] = float(values[-1])
    name_levels(ax, last)


def _mode_curves(ax: Any, dataset: xr.Dataset, speed: Array, top: float) -> None:
    """Draw natural frequencies as curves of order = 60 f / n, with names one below the other."""
    known = levels.rpm(dataset, "mode_speed")
    height = 0.97
    for mode in dataset["mode"].values:
        values = 60.0 * np.interp(speed, known, dataset["mode_frequency"].sel(mode=mode)) / speed
        (line,) = ax.plot(speed, values, color=_LIGHT, lw=1.0, ls=":")
        outlined(line, width=1.5)
        inside = np.flatnonzero(values <= height * top)
        if inside.size == 0:
            continue
        place = inside[0]
        late = place > 0.85 * speed.size  # the name would cross the end of the axis
        text = ax.annotate(
            str(mode),
            (speed[place], values[place]),
            xytext=(-4 if late else 4, 0),
            textcoords="offset points",
            color=_LIGHT,
            fontsize=7.5,
            va="center",
            ha="right" if late else "left",
        )
        outlined(text)
        height -= 0.045 if place > 0 else 0.0
