"""Pressure and film of a point contact: contours and sections."""

from __future__ import annotations

from typing import Any

import xarray as xr

from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube.studies.films.figures.parts import (
    HEADROOM,
    contour_levels,
    dry_outline,
    film_contours,
    legend_of_both,
    pressure_contours,
    shown_range,
    titled,
    two_scales,
)

_SIDE = 1.8  # semi-axes that are shown, at most
_THICK = 1.6  # films over the central one that have contours
_SLENDER = 2.5  # height over width beyond which the plan is stretched
_ARROW = 0.13  # of the axes


def point_contours(dataset: xr.Dataset) -> Any:
    """Return contours of pressure and film, with the outline of the dry contact."""
    with house_style():
        of = dataset.attrs
        figure = new_figure(10.0, 4.9)
        left, right = figure.subplots(1, 2)
        pressure, film = 1e-9 * dataset["pressure"].values.T, 1e6 * dataset["film"].values.T
        places = (1e3 * dataset["x"].values, 1e3 * dataset["y"].values)
        pressure_contours(left, places, pressure)
        left.set_title(f"pressure, up to {1e-9 * of['pressure_max']:.3f} GPa")
        lowest, central = 1e6 * of["minimum_film"], 1e6 * of["central_film"]
        film_contours(right, places, film, (lowest, max(_THICK * central, 1.1 * lowest)), 0.4)
        right.set_title(f"film, central {central:.3f} µm, smallest {lowest:.3f} µm")
        for ax, colour in ((left, GREY), (right, "white")):
            _plan(ax, dataset, colour)
        what = f"dry contact dashed, entrainment as the arrow{_stretch(dataset)}"
        figure.suptitle(titled(dataset, what), fontsize=11.5)
    return figure


def point_sections(dataset: xr.Dataset) -> Any:
    """Return pressure and film along x and along y through the centre of the dry contact."""
    with house_style():
        figure = new_figure(8.6, 7.0)
        for ax, along, across in zip(figure.subplots(2, 1), "xy", "yx", strict=True):
            section = dataset.interp({across: 0.0})
            place = 1e3 * section[along].values
            film = ax.twinx()
            ax.plot(place, 1e-9 * section["pressure"].values, color=BLUE, label="pressure")
            ax.plot(
                place, 1e-9 * section["hertz_pressure"].values, color=BLUE, ls="--", lw=1.0,
                label="dry pressure",
            )  # fmt: skip
            film.plot(place, 1e6 * section["film"].values, color=VERMILLION, label="film")
            top = 1e-9 * max(dataset.attrs["pressure_max"], dataset.attrs["hertz_pressure_max"])
            ax.set(xlim=_shown(dataset, along), ylim=(0.0, 1.12 * top), xlabel=f"{along} [mm]")
            film.set_ylim(0.0, 1e6 * HEADROOM * dataset.attrs["central_film"])
            two_scales(ax, film)
            ax.set_title(f"along {along}, at {across} = 0")
        legend_of_both(ax, film, 3)
        figure.suptitle(titled(dataset, "sections through the centre"), fontsize=11.5)
    return figure


def point_shear(dataset: xr.Dataset) -> Any:
    """Return contours of the shear stress at mid-film along the sliding velocity."""
    with house_style():
        figure = new_figure(6.4, 5.0)
        ax = figure.subplots()
        stress = 1e-6 * dataset["mean_stress"].values.T
        places = (1e3 * dataset["x"].values, 1e3 * dataset["y"].values)
        pressure_contours(ax, places, stress, "shear stress along the sliding [MPa]")
        _plan(ax, dataset, GREY)
        coefficient = dataset.attrs["friction_coefficient"]
        what = f"coefficient of friction {coefficient:.4f}{_stretch(dataset)}"
        figure.suptitle(titled(dataset, what), fontsize=11.5)
    return figure


def point_temperature(dataset: xr.Dataset) -> Any:
    """Return contours of the rise of temperature in the middle of the film and of the surfaces."""
    with house_style():
        figure = new_figure(13.0, 4.6)
        inlet = dataset.attrs["temperature_inlet"]
        places = (1e3 * dataset["x"].values, 1e3 * dataset["y"].values)
        axes = figure.subplots(1, 3)
        titles = ("body 1", "middle of the film", "body 2")
        for ax, name, title in zip(axes, ("1", "middle", "2"), titles, strict=True):
            rise = dataset[f"temperature_{name}"].values.T - inlet
            levels = contour_levels(min(float(rise.min()), 0.0), max(float(rise.max()), 1e-3))
            drawn = ax.contourf(*places, rise, levels=levels, cmap="magma_r")
            figure.colorbar(drawn, ax=ax, label="above the inlet [K]")
            ax.set_title(f"{title}, up to {rise.max():.3g} K")
            _plan(ax, dataset, GREY)
        what = f"temperature, friction {dataset.attrs['friction_coefficient']:.4f}"
        figure.suptitle(titled(dataset, what + _stretch(dataset)), fontsize=11.5)
    return figure


def _plan(ax: Any, dataset: xr.Dataset, colour: str) -> None:
    """Draw the dry contact, the direction of entrainment and the axes.

    Slender contacts are stretched across; the arrow then is as well.
    """
    of = dataset.attrs
    dry_outline(ax, (of["semi_axis_x"], of["semi_axis_y"]), colour, 1.0)
    (x_low, x_high), (y_low, y_high) = _shown(dataset, "x"), _shown(dataset, "y")
    width, height = x_high - x_low, y_high - y_low
    ax.set(xlim=(x_low, x_high), ylim=(y_low, y_high), xlabel="x [mm]", ylabel="y [mm]")
    ax.set_aspect("equal" if 1.0 / _SLENDER < height / width < _SLENDER else "auto")
    ax.grid(visible=False)
    u, v = of["entrainment_x"], of["entrainment_y"]
    scale = _ARROW / max(abs(u) / width, abs(v) / height)
    start = (x_low + 0.15 * width, y_low + 0.15 * height)
    ax.annotate(
        "",
        (start[0] + scale * u, start[1] + scale * v),
        start,
        arrowprops={"arrowstyle": "->", "color": "black", "lw": 1.6},
    )


def _stretch(dataset: xr.Dataset) -> str:
    """Return a note for a plan whose two axes have different scales."""
    (x_low, x_high), (y_low, y_high) = _shown(dataset, "x"), _shown(dataset, "y")
    ratio = (y_high - y_low) / (x_high - x_low)
    return "" if 1.0 / _SLENDER < ratio < _SLENDER else ", scales of x and y differ"


def _shown(dataset: xr.Dataset, axis: str) -> tuple[float, float]:
    return shown_range(dataset, axis, _SIDE * dataset.attrs[f"semi_axis_{axis}"], 0.01)
