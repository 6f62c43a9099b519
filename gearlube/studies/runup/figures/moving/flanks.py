"""Contacts of all tooth pairs on the drawn gear tooth, as a picture for each frame."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.animation import save_animation
from gearlube.plotting.drawn_tooth import DrawnTooth, ellipse
from gearlube.plotting.style import BLUE, GREEN, VERMILLION, house_style, new_figure
from gearlube.report.numbers import quantity_text
from gearlube.studies.runup.figures.moving import words
from gearlube_core.arrays import Array
from gearlube_core.progress import Progress, no_progress

PAIR_COLOURS = (BLUE, VERMILLION, GREEN)
FILM_COLOURS = "viridis"
# variable, factor, name, unit
COURSES = (
    ("flank_load", 1e-3, "load", "kN"),
    ("flank_film", 1e6, "film", "µm"),
    ("flank_friction", 1.0, "friction coefficient", ""),
)


def has_places(dataset: xr.Dataset) -> bool:
    """Whether an animation knows where the contacts are on the tooth."""
    return "flank_centre" in dataset


def drawn_tooth(dataset: xr.Dataset) -> DrawnTooth:
    """Return the gear tooth of an animation."""
    return DrawnTooth(
        1e3 * float(dataset.attrs["tooth_width"]), 1e3 * float(dataset.attrs["tooth_height"])
    )


def outline(dataset: xr.Dataset, frame: int, pair: int) -> tuple[Array, Array]:
    """Return the outline of a contact on the drawn tooth [mm]; NaN without load."""
    parts = (
        1e3 * dataset[f"flank_{name}"].values[frame, pair] for name in ("centre", "minor", "major")
    )
    return ellipse(*parts)


def label_side(dataset: xr.Dataset, frame: int, pair: int) -> int:
    """Return 1 where the ellipse leaves room above and right of its middle, -1: above and left."""
    along, up = dataset["flank_major"].values[frame, pair]
    return 1 if along * up < 0.0 else -1


def film_scale(dataset: xr.Dataset) -> tuple[float, float]:
    """Return the ends of the colours of films [µm], the same in all frames."""
    film = 1e6 * dataset["flank_film"].values
    if not np.isfinite(film).any():
        return 0.0, 1.0
    low, high = float(np.nanmin(film)), float(np.nanmax(film))
    return (low, high) if high > 1.001 * low else (0.99 * low, 1.01 * high)


def course_limit(dataset: xr.Dataset, name: str, factor: float) -> float:
    """Return the upper end of the axis of a course; it begins at zero."""
    top = factor * float(np.nanmax(np.nan_to_num(dataset[name].values)))
    return 1.1 * top if top > 0.0 else 1.0


def flank_frame(dataset: xr.Dataset, frame: int) -> Any:
    """Return the contacts on the tooth in a frame, above the courses of load, film and friction."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    scale, colours = Normalize(*film_scale(dataset)), colormaps[FILM_COLOURS]
    placed = has_places(dataset)
    with house_style():
        figure = new_figure(9.2, 5.6 if placed else 3.2)
        below = figure
        if placed:
            above, below = figure.subfigures(2, 1, height_ratios=(1.25, 1.0))
            ax = above.subplots()
            drawn_tooth(dataset).draw(ax)
            above.colorbar(
                ScalarMappable(scale, colours), ax=ax, label="central film [µm]", shrink=0.9
            )
            _contacts(ax, dataset, frame, lambda film: colours(scale(film)))
        for ax, (name, factor, label, unit) in zip(below.subplots(1, 3), COURSES, strict=True):
            _course(ax, dataset, frame, name, factor)
            ax.set_ylabel(f"{label} [{unit}]" if unit else label)
        figure.suptitle(
            f"Flanks at {words.heading(dataset)}\nmesh phase {words.instant(dataset, frame)}, "
            f"{words.flank_of(dataset, frame)}",
            fontsize=10.5,
        )
    return figure


def _contacts(ax: Any, dataset: xr.Dataset, frame: int, colour_of: Any) -> None:
    """Draw the contacts of a frame, filled in the colour of the film, with their loads."""
    load = dataset["flank_load"].values[frame]
    for pair in np.flatnonzero(np.isfinite(load)):
        x, y = outline(dataset, frame, int(pair))
        film = 1e6 * float(dataset["flank_film"][frame, pair])
        ax.fill(x, y, facecolor=colour_of(film), edgecolor=PAIR_COLOURS[pair], lw=2.2)
        ax.annotate(
            quantity_text(float(load[pair]), "N"),
            tuple(1e3 * dataset["flank_centre"].values[frame, pair]),
            xytext=(12 * label_side(dataset, frame, int(pair)), 9),
            textcoords="offset points",
            ha="left" if label_side(dataset, frame, int(pair)) > 0 else "right",
            fontsize=8.5,
            color=PAIR_COLOURS[pair],
            fontweight="bold",
        )
    if not np.isfinite(load).any():
        ax.text(0.5, 0.5, "teeth apart", transform=ax.transAxes, ha="center", va="center")


def _course(ax: Any, dataset: xr.Dataset, frame: int, name: str, factor: float) -> None:
    """Draw a quantity of every tooth pair over the mesh phase, with the frame."""
    phase = dataset["mesh_phase"].values
    for pair, colour in enumerate(PAIR_COLOURS):
        values = factor * dataset[name].values[:, pair]
        ax.plot(phase, values, color=colour)
        ax.plot(phase[frame], values[frame], "o", color=colour, ms=6)
    ax.axvline(phase[frame], color="#808080", lw=0.8)
    ax.set(xlabel="mesh phase", xlim=(phase[0], phase[-1]))
    ax.set_ylim(0.0, course_limit(dataset, name, factor))


def animate_flanks(dataset: xr.Dataset, path: Path, progress: Progress = no_progress) -> Path:
    """Write the contacts of all frames as an animated GIF; return the file.

    Examples
    --------
    >>> animate_flanks(load_animation("animation/runup.nc"), Path("flanks.gif"))  # doctest: +SKIP
    """
    carried = np.isfinite(dataset["flank_load"].values).sum(axis=1)
    return save_animation(
        lambda frame: flank_frame(dataset, frame),
        dataset.sizes["frame"],
        path,
        first=int(np.argmax(carried)),
        per_second=10,
        dots_per_inch=75,
        progress=progress,
    )
