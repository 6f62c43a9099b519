"""Shared parts of film figures: contours, two scales, outlines, titles."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, VERMILLION
from gearlube_core.arrays import Array

HEADROOM = 3.0  # films over the central one that sections show
_LINES = 14
_BEYOND = "0.9"  # grey of films thicker than the scale

Places = tuple[Array, Array]  # along the axes of the figure [mm]


def contour_levels(low: float, high: float) -> Any:
    """Return round numbers from the one below `low` to the one above `high`."""
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(_LINES).tick_values(low, high)


def pressure_contours(
    ax: Any, places: Places, pressure: Array, label: str = "pressure [GPa]"
) -> None:
    """Draw contours of a pressure or a stress from zero on, with their colours explained."""
    levels = contour_levels(0.0, float(np.nanmax(pressure)))[1:]
    drawn = ax.contourf(*places, pressure, levels=levels, cmap="magma_r")
    ax.figure.colorbar(drawn, ax=ax, label=label)


def film_contours(
    ax: Any, places: Places, film: Array, limits: tuple[float, float], line_width: float = 0.0
) -> None:
    """Draw contours of a film [µm] within limits, with their colours explained.

    `line_width` is that of white lines between the colours; 0: none.
    """
    levels = contour_levels(*limits)
    drawn = ax.contourf(*places, film, levels=levels, cmap=film_colours(), extend="max")
    if line_width:
        ax.contour(*places, film, levels=levels, colors="white", linewidths=line_width)
    ax.figure.colorbar(drawn, ax=ax, label="film [µm], grey: thicker")


def film_colours() -> Any:
    """Return the colours of films, with grey for those beyond the scale."""
    import matplotlib

    return matplotlib.colormaps["viridis"].with_extremes(over=_BEYOND)


def dry_outline(ax: Any, semi_axes: tuple[float, float], colour: str, line_width: float) -> None:
    """Draw the ellipse of the dry contact, its semi-axes [m] along the axes of the figure.

    An infinite one up the figure: both edges of a line.
    """
    if math.isinf(semi_axes[1]):
        for edge in (-1e3 * semi_axes[0], 1e3 * semi_axes[0]):
            ax.axvline(edge, color=colour, lw=line_width, ls="--")
        return
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    across, up = (1e3 * one for one in semi_axes)
    ax.plot(across * np.cos(turn), up * np.sin(turn), color=colour, lw=line_width, ls="--")


def two_scales(left: Any, right: Any) -> None:
    """Label the axes of a figure of pressure, on the left, and film."""
    left.set_ylabel("pressure [GPa]", color=BLUE)
    right.set_ylabel("film [µm]", color=VERMILLION)
    right.spines["right"].set_visible(True)
    right.grid(visible=False)


def legend_of_both(left: Any, right: Any, columns: int) -> None:
    """Draw one legend for the lines of both scales below the figure."""
    handles, labels = left.get_legend_handles_labels()
    more, names = right.get_legend_handles_labels()
    left.figure.legend(handles + more, labels + names, ncols=columns, loc="outside lower center")


def titled(dataset: xr.Dataset, what: str) -> str:
    """Return the title of a figure: the name, whether the film did not converge, `what`."""
    state = "" if dataset.attrs["converged"] else "NOT CONVERGED, "
    return f"{dataset.attrs['name']}: {state}{what}"


def shown_range(
    dataset: xr.Dataset, axis: str, side: float, loaded_share: float
) -> tuple[float, float]:
    """Return the limits of an axis [mm] that enclose the loaded zone, inside the domain.

    At least `side` [m] to both sides, and as far as the pressure is above `loaded_share` of the
    largest.
    """
    place = dataset[axis].values
    carried = dataset["pressure"].max([d for d in dataset["pressure"].dims if d != axis]).values
    loaded = place[carried > loaded_share * carried.max()]
    low, high = min(-side, float(loaded[0])), max(side, float(loaded[-1]))
    return 1e3 * max(low, float(place[0])), 1e3 * min(high, float(place[-1]))
