"""Pictures for each frame: contacts on the drawn gear tooth, and rings of rollers."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.plotting.drawn_tooth import DrawnTooth, ellipse
from gearlube.plotting.figure_files import save_animation
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
HUB = 0.5  # radius of the drawn cage, over the largest bar
WIDTH = 0.6  # of a bar over the pitch of the rollers
REACH = 1.08  # of the largest bar
_STEEL = "#606060"


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


def flank_film_scale(dataset: xr.Dataset) -> tuple[float, float]:
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

    scale, colours = Normalize(*flank_film_scale(dataset)), colormaps[FILM_COLOURS]
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


class Ring(NamedTuple):
    """The rollers of a bearing in a frame; arrays over those that it has."""

    number: int
    angle: Array  # rad
    load: Array  # N
    film: Array  # um; NaN without
    top: float  # largest load of all frames [N]
    zone: tuple[Array, Array]  # ends of the arcs where rollers carry load in any frame [rad]


def has_rollers(dataset: xr.Dataset) -> bool:
    """Whether an animation has rollers."""
    return "roller_load" in dataset


def ring_at(dataset: xr.Dataset, ring: int, frame: int) -> Ring:
    """Return the rollers of ring number `ring`, from 0, in a frame."""
    known = np.isfinite(dataset["roller_load"].values[0, ring])
    load = dataset["roller_load"].values[:, ring][:, known]
    angle = dataset["roller_angle"].values[:, ring][:, known]
    film = np.full(load.shape[1], np.nan)
    if "roller_film" in dataset:
        film = 1e6 * dataset["roller_film"].values[frame, ring][known]
    top = float(load.max())
    return Ring(
        int(dataset["ring"][ring]), angle[frame], load[frame], film, top, _arcs(angle, load)
    )


def _arcs(angle: Array, load: Array) -> tuple[Array, Array]:
    """Return begin and end of the arcs [rad] in which every roller that passes carries load."""
    bins = 72
    place = np.minimum((angle / (2.0 * np.pi) * bins).astype(int), bins - 1)
    passed = np.bincount(place.ravel(), minlength=bins)
    idle = np.bincount(place[load <= 0.0].ravel(), minlength=bins)
    # a place that no roller passes counts as its neighbour before
    loaded = np.zeros(bins, dtype=bool)
    state = bool((idle == 0)[np.flatnonzero(passed)[-1]]) if passed.any() else False
    for k in range(bins):
        state = bool(idle[k] == 0) if passed[k] else state
        loaded[k] = state
    if loaded.all():
        return np.array([0.0]), np.array([2.0 * np.pi])
    starts = np.flatnonzero(loaded & ~np.roll(loaded, 1))
    lengths = [int(np.argmin(np.roll(loaded, -int(k)))) for k in starts]
    first = 2.0 * np.pi / bins * starts.astype(np.float64)
    return first, first + 2.0 * np.pi / bins * np.array(lengths, dtype=np.float64)


def roller_film_scale(dataset: xr.Dataset) -> tuple[float, float] | None:
    """Return the ends of the colours of films [µm], one for all bearings; None without films."""
    if "roller_film" not in dataset or not np.isfinite(dataset["roller_film"].values).any():
        return None
    film = 1e6 * dataset["roller_film"].values
    low, high = float(np.nanmin(film)), float(np.nanmax(film))
    return (low, high) if high > 1.001 * low else (0.99 * low, 1.01 * high)


def ring_title(dataset: xr.Dataset, ring: int) -> tuple[str, str, str]:
    """Return name, load and film of a bearing over all frames."""
    load = dataset["roller_load"].values[:, ring]
    name = words.RINGS[int(dataset["ring"][ring])]
    zone = words.zone_words(float(words.loaded_zones(dataset)[ring]))
    if zone == "none":
        return name, "no load", ""
    second = ""
    if roller_film_scale(dataset) is not None:
        second = f"film {words.span(1e6 * dataset['roller_film'].values[:, ring], 'µm')}"
    where = zone if zone == "all around" else f"over {zone}"
    return name, f"{words.span(load, 'N')}, {where}", second


def roller_frame(dataset: xr.Dataset, frame: int) -> Any:
    """Return loads and films of the rollers of all bearings in a frame."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    ends = roller_film_scale(dataset)
    scale, colours = Normalize(*(ends or (0.0, 1.0))), colormaps[FILM_COLOURS]
    with house_style():
        figure = new_figure(11.4, 3.75)
        axes = figure.subplots(1, dataset.sizes["ring"], subplot_kw={"projection": "polar"})
        for place, ax in enumerate(axes):
            ring = ring_at(dataset, place, frame)
            fill = [BLUE if np.isnan(film) else colours(scale(film)) for film in ring.film]
            _draw(ax, ring, fill)
            ax.set_title("\n".join(ring_title(dataset, place)), fontsize=9.0)
        if ends is not None:
            law = dataset.attrs["roller_film_law"]
            figure.colorbar(
                ScalarMappable(scale, colours),
                ax=axes,
                label=f"film [µm], {law}",
                shrink=0.75,
            )
        figure.suptitle(
            f"Rollers at {words.heading(dataset)}, mesh phase {words.instant(dataset, frame)}\n"
            "bars: load; thick arc: where rollers carry load; black: roller 1 on the cage",
            fontsize=10.0,
        )
    return figure


def _draw(ax: Any, ring: Ring, fill: list[Any]) -> None:
    """Draw the cage with its rollers, and their loads as bars outwards."""
    top = ring.top or 1.0
    hub, width = HUB * top, WIDTH * 2.0 * np.pi / ring.angle.size
    for begin, end in zip(*ring.zone, strict=True):
        arc = np.linspace(begin, end, 121)
        ax.plot(arc, np.full(arc.size, 0.82 * hub), color="black", lw=2.4)
    ax.bar(ring.angle, ring.load, width, bottom=hub, color=fill, edgecolor=_STEEL, lw=0.4)
    ax.plot(ring.angle, np.full(ring.angle.size, hub), "o", ms=3.6, mfc="white", mec=_STEEL)
    ax.plot(ring.angle[:1], [hub], "o", ms=4.6, color="black")
    ax.set_ylim(0.0, hub + REACH * top)
    ax.set_yticks([])
    ax.set_xticks([0.0, 0.5 * np.pi], words.AXES[ring.number])
    ax.tick_params(axis="x", labelsize=8.5, pad=-1)


def animate_rollers(dataset: xr.Dataset, path: Path, progress: Progress = no_progress) -> Path:
    """Write the rollers of all frames as an animated GIF; return the file.

    Examples
    --------
    >>> animate_rollers(load_animation("animation/runup.nc"), Path("rollers.gif"))  # doctest: +SKIP
    """
    return save_animation(
        lambda frame: roller_frame(dataset, frame),
        dataset.sizes["frame"],
        path,
        per_second=10,
        dots_per_inch=75,
        progress=progress,
    )
