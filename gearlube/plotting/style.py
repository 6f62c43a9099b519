"""The style of all figures: legible, colour-blind safe, without pyplot's global state."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array

# [okabe_ito_2008], colours that people with colour vision deficiency distinguish.
BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#E69F00",
    "#CC79A7",
    "#56B4E9",
)
SERIES = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
# Earlier series are drawn wider, so that they show behind later ones that coincide.
WIDTHS = (2.4, 1.3, 1.2, 1.0, 0.9, 0.8)
SIZES = (6.5, 3.8, 3.6, 3.2, 3.0, 2.8)
MARKERS = ("o", "s", "^", "D", "v", "P")
HATCHES = ("", "////", "....", "xxxx", "\\\\\\\\", "++++")
GREY, INK = "#B0B0B0", "#5C5C5C"
YELLOW = "#F0E442"
SAND, OLIVE, WINE = "#DDCC77", "#999933", "#882255"  # [tol_2021]
PARTS = (*SERIES, YELLOW, GREY)  # of parts that add up, in their order: the same in all figures

_LABEL_ROOM = 0.06  # of a panel, beside the middle of a label
_LABEL_SIZE = 0.15, 0.05  # of the panel, of a level on a contour line
_ROWS = 170  # cells of the frequency axis; a cell shows the largest line inside it

_STYLE = {
    "font.size": 9.5,
    "axes.titlesize": 10.5,
    "axes.labelsize": 10,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#E3E3E3",
    "grid.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.6,
    "lines.markersize": 4.5,
    "savefig.dpi": 150,
    "figure.dpi": 100,
}


@contextmanager
def house_style() -> Iterator[None]:
    """Apply the style while a figure is drawn."""
    import matplotlib

    with matplotlib.rc_context(_STYLE):  # type: ignore[arg-type]
        yield


def new_figure(width: float = 8.0, height: float = 4.8) -> Any:
    """Return an empty figure [inch] that lays itself out."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def preload_label(preload: float) -> str:
    """Return "preload 2500 N"."""
    return f"preload {preload:g} N"


def series(row: int) -> dict[str, Any]:
    """Return colour, marker and widths of the lines of preload number `row`."""
    return {
        "color": SERIES[row % len(SERIES)],
        "marker": MARKERS[row % len(MARKERS)],
        "lw": WIDTHS[row % len(WIDTHS)],
        "ms": SIZES[row % len(SIZES)],
    }


def label_contours(ax: Any, lines: Any, text: str) -> None:
    """Write the level on each contour line, where it is farthest from the edges of the panel.

    A line whose level would stand on another one has none.
    """
    low, high = np.transpose([ax.get_xlim(), ax.get_ylim()])
    places: list[Array] = []
    for points in (one for parts in lines.allsegs for one in parts if len(one)):
        share = (points - low) / (high - low)
        room = np.minimum(share, 1.0 - share).min(axis=1)
        found = points[room.argmax()]
        apart = (np.abs((found - one) / (high - low) / _LABEL_SIZE).max() > 1.0 for one in places)
        if room.max() > _LABEL_ROOM and all(apart):
            places.append(found)
    ax.clabel(lines, fmt=text, fontsize=7, manual=places)


def speed_limits(dataset: xr.Dataset) -> tuple[float, float]:
    """Return limits of the speed axis [km/h], a little wider than the data."""
    speeds = dataset["speed_kmh"].values
    pad = max(0.03 * float(speeds[-1] - speeds[0]), 1.0)
    return float(speeds[0]) - pad, float(speeds[-1]) + pad


def cell_edges(centres: Array) -> Array:
    """Return the edges of cells around `centres`; a lone cell is 2 wide."""
    if centres.size == 1:
        return np.array([centres[0] - 1.0, centres[0] + 1.0])
    middle = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate(
        [[2.0 * centres[0] - middle[0]], middle, [2.0 * centres[-1] - middle[-1]]]
    )


def largest_in_cells(rows: Array, values: Array) -> tuple[Array, Array]:
    """Return middles of at most 170 cells of equal rows, and the largest value in each."""
    width = max(1, rows.size // _ROWS)
    count = rows.size // width
    cells = values[:, : count * width].reshape(values.shape[0], count, width)
    return rows[: count * width].reshape(count, width).mean(axis=1), cells.max(axis=2)


def typical_speeds(dataset: xr.Dataset) -> list[int]:
    """Return positions of up to three finished speeds spread from the lowest to the highest."""
    finished = np.flatnonzero((dataset["status"] == 1).any("preload").values)
    if finished.size == 0:
        return []
    chosen = finished[np.linspace(0, finished.size - 1, min(3, finished.size)).astype(int)]
    return [int(i) for i in chosen]


def name_levels(ax: Any, levels: dict[str, float], size: float = 8.0) -> None:
    """Write names at their heights beside the right edge of `ax`, moved apart where they touch.

    A thin leader joins a moved name to its level.
    """
    ax.figure.canvas.draw_idle()
    to_axes = ax.transAxes.inverted()
    heights = {
        name: float(to_axes.transform(ax.transData.transform((ax.get_xlim()[0], level)))[1])
        for name, level in levels.items()
    }
    box = ax.get_position()
    line = 1.35 * size / 72.0 / (0.8 * ax.figure.get_figheight() * max(box.height, 0.1))
    names = sorted(heights, key=heights.__getitem__)
    places = _spread_out([heights[name] for name in names], line)
    for name, place in zip(names, places, strict=True):
        ax.annotate(
            name,
            (1.0, heights[name]),
            xytext=(1.035, place),
            xycoords="axes fraction",
            textcoords="axes fraction",
            va="center",
            fontsize=size,
            annotation_clip=False,
            arrowprops={
                "arrowstyle": "-",
                "lw": 0.5,
                "color": "#606060",
                "shrinkA": 0.5,
                "relpos": (0.0, 0.5),  # ends at the name, not inside the next one
            },
        )


def _spread_out(heights: list[float], gap: float) -> list[float]:
    """Return ascending places at least `gap` apart, near `heights` and not above the axes."""
    places: list[float] = []
    for height in heights:
        places.append(max(height, places[-1] + gap) if places else height)
    ceiling = 1.0
    for i in reversed(range(len(places))):
        places[i] = min(places[i], ceiling)
        ceiling = places[i] - gap
    return places


def outlined(text: Any, colour: str = "black", width: float = 2.0) -> Any:
    """Give text or a line a thin outline, so that it is legible on any background."""
    from matplotlib import patheffects

    text.set_path_effects([patheffects.withStroke(linewidth=width, foreground=colour)])
    return text
