"""Pressure and film of a hypoid flank at a few instants of its engagement."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, VERMILLION, house_style, new_figure
from gearlube.studies.films.figures.parts import (
    dry_outline,
    film_contours,
    pressure_contours,
)

_SIDE = 1.45  # semi-axes of the largest contact that are shown
_INSET = (0.0, 0.0, 0.3, 0.42)  # of a panel: left, bottom, width, height
_THICK = 1.8  # central films that have contours


def hypoid_contours(dataset: xr.Dataset) -> Any:
    """Return contours of pressure and film at the stored instants, with the dry contact dashed.

    The minor axis is drawn upwards and stretched; an inset with equal scales has the directions of
    entrainment and sliding.
    """
    with house_style():
        count = dataset.sizes["instant"]
        figure = new_figure(10.4, 2.5 * count + 0.8)
        axes = figure.subplots(count, 2, sharex=True, sharey=True, squeeze=False)
        place = (1e3 * dataset["y"].values, 1e3 * dataset["x"].values)
        reach = [_SIDE * 1e3 * float(dataset[f"semi_axis_{axis}"].max()) for axis in ("y", "x")]
        for row, (left, right) in enumerate(axes):
            one = dataset.isel(instant=row)
            position = int(one["instant_position"])
            pressure, film = 1e-9 * one["pressure"].values, 1e6 * one["film"].values
            central = 1e6 * float(dataset["steady_central_film"][position])
            pressure_contours(left, place, pressure)
            film_contours(right, place, film, (float(film.min()), _THICK * central), 0.3)
            phase = float(dataset["steady_phase"][position])
            load = float(dataset["steady_load"][position])
            psi, chi = (float(dataset[f"steady_{name}"][position]) for name in ("psi", "chi"))
            left.set_title(
                f"phase {phase:.2f}, {load:.0f} N, entrainment {np.degrees(psi):.0f}°, "
                f"sliding {np.degrees(chi):.0f}°"
            )
            right.set_title(f"central {central:.3f} µm, smallest {film.min():.3f} µm")
            for ax in (left, right):
                _plan(ax, one, reach)
            _directions(left, psi, chi)
            left.set_ylabel("minor axis [mm]")
        for ax in axes[-1]:
            ax.set_xlabel("major axis [mm]")
        stretch = _stretch(axes[0, 0], figure)
        figure.suptitle(
            f"{dataset.attrs['name']}: steady films along the engagement, dry contact dashed\n"
            f"the minor axis is stretched {stretch:.0f} times; arrows have equal "
            "scales: black entrainment, orange sliding",
            fontsize=10.5,
        )
    return figure


def _stretch(ax: Any, figure: Any) -> float:
    """Return how many times longer a millimetre is drawn upwards than sideways."""
    figure.draw_without_rendering()
    box = ax.get_window_extent()
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    return float(box.height / (high - low) / (box.width / (right - left)))


def _plan(ax: Any, one: xr.Dataset, reach: list[float]) -> None:
    dry_outline(ax, (float(one["semi_axis_y"]), float(one["semi_axis_x"])), "black", 0.9)
    low, high = (1e3 * float(one["y"][end]) for end in (0, -1))
    ax.set(xlim=(max(low, -reach[0]), min(high, reach[0])), ylim=(-1.9 * reach[1], reach[1]))
    ax.grid(visible=False)


def _directions(ax: Any, psi: float, chi: float) -> None:
    """Draw the directions of entrainment and sliding in an inset with equal scales.

    Angles are from the minor axis, which points up, to the major axis.
    """
    inset = ax.inset_axes(_INSET)
    inset.set(xlim=(-1.15, 1.15), ylim=(-1.15, 1.15), aspect="equal")
    inset.axis("off")
    inset.axhline(0.0, color=GREY, lw=0.7)
    inset.axvline(0.0, color=GREY, lw=0.7)
    for angle, colour in ((psi, "black"), (chi, VERMILLION)):
        inset.annotate(
            "",
            (np.sin(angle), np.cos(angle)),
            (0.0, 0.0),
            arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.4, "shrinkA": 0, "shrinkB": 0},
        )
