"""Pressure and film of a hypoid flank at a few instants of its engagement."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import house_style, new_figure
from gearlube.studies.films.figures.parts import (
    dry_outline,
    film_contours,
    pressure_contours,
)

_SIDE = 1.45  # semi-axes of the largest contact that are shown
_THICK = 1.8  # central films that have contours


def hypoid_contours(dataset: xr.Dataset) -> Any:
    """Return contours of pressure and film at the stored instants, with the dry contact dashed.

    The minor axis is drawn upwards and stretched; arrows show entrainment in that stretching.
    """
    with house_style():
        count = dataset.sizes["instant"]
        figure = new_figure(10.4, 2.3 * count + 0.4)
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
            for ax, colour in ((left, "black"), (right, "white")):
                _plan(ax, one, reach, colour)
            _arrow(left, reach, psi)
            left.set_ylabel("minor axis [mm]")
        for ax in axes[-1]:
            ax.set_xlabel("major axis [mm]")
        figure.suptitle(
            f"{dataset.attrs['name']}: steady films along the engagement. Angles are from the "
            "minor axis, arrows entrainment",
            fontsize=11.5,
        )
    return figure


def _plan(ax: Any, one: xr.Dataset, reach: list[float], colour: str) -> None:
    dry_outline(ax, (float(one["semi_axis_y"]), float(one["semi_axis_x"])), colour, 0.9)
    low, high = (1e3 * float(one["y"][end]) for end in (0, -1))
    ax.set(xlim=(max(low, -reach[0]), min(high, reach[0])), ylim=(-1.6 * reach[1], reach[1]))
    ax.grid(visible=False)


def _arrow(ax: Any, reach: list[float], psi: float) -> None:
    """Draw the entrainment direction in the stretched axes of the figure."""
    start = (-0.85 * reach[0], -1.35 * reach[1])
    across = 0.5 * reach[1]
    along = across * np.tan(psi)
    shortened = min(1.0, 0.3 * reach[0] / max(along, 1e-12))
    ax.annotate(
        "",
        (start[0] + shortened * along, start[1] + shortened * across),
        start,
        arrowprops={"arrowstyle": "->", "color": "black", "lw": 1.4},
    )
