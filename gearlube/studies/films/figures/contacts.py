"""Pressure and film of a point contact and of a line contact, along a contact line too."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, GREY, VERMILLION, house_style, new_figure
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

_SIDE = 2.0  # half widths that are shown
_THICK = 2.0  # films over the central one that have contours
_ALONG = "x [mm], oil enters on the left"
_POINT_SIDE = 1.8  # semi-axes that are shown, at most
_POINT_THICK = 1.6  # films over the central one that have contours
_SLENDER = 2.5  # height over width beyond which the plan is stretched
_ARROW = 0.13  # of the axes


def helical_contours(dataset: xr.Dataset) -> Any:
    """Return contours of pressure and film over the line, stretched across."""
    with house_style():
        figure = new_figure(10.0, 6.4)
        top, bottom = figure.subplots(2, 1, sharex=True, sharey=True)
        of = dataset.attrs
        pressure, film = 1e-9 * dataset["pressure"].values, 1e6 * dataset["film"].values
        places = (1e3 * dataset["y"].values, 1e3 * dataset["x"].values)
        pressure_contours(top, places, pressure)
        top.plot(1e3 * of["pressure_max_y"], 1e3 * of["pressure_max_x"], "+", color=BLUE)
        top.set_title(f"pressure, up to {1e-9 * of['pressure_max']:.3f} GPa (cross)")
        lowest, central = 1e6 * of["minimum_film"], 1e6 * of["central_film"]
        film_contours(bottom, places, film, (lowest, max(_THICK * central, 1.1 * lowest)))
        bottom.plot(1e3 * of["minimum_film_y"], 1e3 * of["minimum_film_x"], "+", color=VERMILLION)
        bottom.set_title(f"film, smallest {lowest:.3f} µm (cross)")
        for ax in (top, bottom):
            ax.set_ylabel("across the line, x [mm]")
            ax.set_ylim(across_limits(dataset))
            ax.grid(visible=False)
        bottom.set_xlabel("along the line, y [mm]")
        figure.suptitle(line_title(dataset), fontsize=11.5)
    return figure


def helical_along(dataset: xr.Dataset) -> Any:
    """Return the largest pressure and the smallest film of each section along the line."""
    with house_style():
        figure = new_figure(8.6, 4.8)
        left = figure.subplots()
        y = 1e3 * dataset["y"].values
        left.plot(
            y, 1e-9 * dataset["pressure"].max("x").values, color=BLUE, label="largest pressure"
        )
        right = left.twinx()
        smallest = 1e6 * dataset["film"].min("x").values
        right.plot(y, smallest, color=VERMILLION, label="smallest film")
        right.set_ylim(0.0, 1e6 * HEADROOM * dataset.attrs["central_film"])
        two_scales(left, right)
        at = int(np.argmin(smallest))
        right.plot(y[at], smallest[at], "v", color=VERMILLION, label=f"least {smallest[at]:.3f} µm")
        dry = 1e-9 * dataset.attrs["hertz_pressure_max"]
        left.axhline(dry, color=BLUE, ls=":", lw=1.2, label="Hertz, mean load")
        for end in y[loaded_rows(dataset)][[0, -1]]:
            left.axvline(end, color=GREY, ls="--", lw=0.9)
        left.set_title("dashed: ends of the loaded length", fontsize=9)
        left.set(xlim=(y[0], y[-1]), ylim=(0.0, None), xlabel="along the line, y [mm]")
        figure.legend(ncols=4, loc="outside lower center")
        figure.suptitle(line_title(dataset), fontsize=11.5)
    return figure


def helical_sections(dataset: xr.Dataset) -> Any:
    """Return pressure and film across the line in its middle and near both ends."""
    with house_style():
        figure = new_figure(8.6, 9.0)
        of = dataset.attrs
        rows = loaded_rows(dataset)
        places = {
            f"{what} of the loaded length": int(rows[round(share * (rows.size - 1))])
            for share, what in ((0.1, "first tenth"), (0.5, "middle"), (0.9, "last tenth"))
        }
        x, top = 1e3 * dataset["x"].values, 1.12e-9 * of["pressure_max"]
        for ax, (what, row) in zip(figure.subplots(3, 1, sharex=True), places.items(), strict=True):
            section, film = dataset.isel(y=row), ax.twinx()
            ax.plot(x, 1e-9 * section["pressure"].values, color=BLUE, label="pressure")
            gap = 1e6 * section["film"].values
            film.plot(x, gap, color=VERMILLION, label="film")
            at = int(np.argmin(gap))
            film.plot(x[at], gap[at], "v", color=VERMILLION, label="smallest film of the section")
            ax.axvline(0.0, color=GREY, lw=0.8, ls=":")
            ax.set(xlim=across_limits(dataset), ylim=(0.0, top))
            film.set_ylim(0.0, 1e6 * HEADROOM * of["central_film"])
            two_scales(ax, film)
            ax.set_title(
                f"{what}, y = {1e3 * float(section['y']):.2f} mm, smallest film {gap[at]:.3f} µm"
            )
        ax.set_xlabel("across the line, x [mm]")
        legend_of_both(ax, film, 3)
        figure.suptitle(line_title(dataset), fontsize=11.5)
    return figure


def across_limits(dataset: xr.Dataset) -> tuple[float, float]:
    """Return the limits across the line that are shown [mm]."""
    x, side = dataset["x"].values, _SIDE * dataset.attrs["half_width"]
    carried = dataset["pressure"].max("y").values
    loaded = x[carried > 0.02 * carried.max()]
    low, high = min(-side, 1.1 * float(loaded[0])), max(side, 1.1 * float(loaded[-1]))
    return 1e3 * max(low, float(x[0])), 1e3 * min(high, float(x[-1]))


def loaded_rows(dataset: xr.Dataset) -> Any:
    """Return the indices along y of sections that carry a fiftieth of the largest pressure."""
    along = dataset["pressure"].max("x").values
    return np.flatnonzero(along > 0.02 * along.max())


def line_title(dataset: xr.Dataset) -> str:
    """Return pair, position and load of a line."""
    of = dataset.attrs
    place = f"line at $s_i$ = {1e3 * of['position']:.2f} mm (step {of['step']:.4g})"
    return titled(dataset, f"{place}, {1e-3 * of['load']:.2f} kN")


def line_profile(dataset: xr.Dataset) -> Any:
    """Return pressure and film against x."""
    return _profile(dataset, dry=False)


def line_profile_hertz(dataset: xr.Dataset) -> Any:
    """Return pressure and film against x, with those of the dry contact after Hertz."""
    return _profile(dataset, dry=True)


def line_shear(dataset: xr.Dataset) -> Any:
    """Return shear stress at mid-film and on both bodies against x."""
    with house_style():
        figure = new_figure(8.0, 4.4)
        ax = figure.subplots()
        x = _milli(dataset)
        for name, colour, label, width in (
            ("mean_stress", GREY, "mid-film", 2.6),
            ("stress_1", BLUE, "on body 1", 1.4),
            ("stress_2", VERMILLION, "on body 2", 1.4),
        ):
            ax.plot(x, 1e-6 * dataset[name].values, color=colour, lw=width, label=label)
        ax.set(xlim=_shown(dataset), xlabel=_ALONG, ylabel="shear stress [MPa]")
        figure.legend(ncols=3, loc="outside lower center")
        coefficient = dataset.attrs["friction_coefficient"]
        figure.suptitle(
            titled(dataset, f"shear, coefficient of friction {abs(coefficient):.4f}"), fontsize=11.5
        )
    return figure


def line_temperature(dataset: xr.Dataset) -> Any:
    """Return the rise of temperature at both surfaces, at mid-film and at its highest."""
    with house_style():
        figure = new_figure(8.0, 4.4)
        ax = figure.subplots()
        rise = dataset["temperature"].values - dataset.attrs["temperature_inlet"]
        middle = rise[:, rise.shape[1] // 2]
        for values, colour, label in (
            (rise[:, 0], BLUE, "body 1"),
            (rise[:, -1], VERMILLION, "body 2"),
            (middle, GREEN, "mid-film"),
        ):
            ax.plot(_milli(dataset), values, color=colour, label=label)
        ax.plot(_milli(dataset), rise.max(axis=1), color=GREY, ls=":", label="highest")
        ax.set(xlim=_shown(dataset), xlabel=_ALONG, ylabel="temperature above the inlet [K]")
        figure.legend(ncols=4, loc="outside lower center")
        figure.suptitle(titled(dataset, "temperature"), fontsize=11.5)
    return figure


def _profile(dataset: xr.Dataset, dry: bool) -> Any:
    with house_style():
        figure = new_figure(8.0, 4.8)
        left = figure.subplots()
        right = left.twinx()
        x, low_high = _milli(dataset), _shown(dataset)
        left.plot(x, 1e-9 * dataset["pressure"].values, color=BLUE, label="pressure")
        right.plot(x, 1e6 * dataset["film"].values, color=VERMILLION, label="film")
        void = dataset["void"].values
        if void.any():
            oil = 1e6 * dataset["film"].values * (1.0 - void)
            right.plot(x[:-1], oil[:-1], color=GREEN, ls=":",
                       label="oil in the gap")  # fmt: skip
        if dry:
            left.plot(
                x, 1e-9 * dataset["hertz_pressure"].values, color=BLUE, ls="--", lw=1.1,
                label="dry pressure",
            )  # fmt: skip
            lifted = 1e6 * (dataset["hertz_gap"].values + dataset.attrs["central_film"])
            right.plot(
                x, lifted, color=VERMILLION, ls="--", lw=1.1,
                label="dry gap + central film",
            )  # fmt: skip
        top = 1e-9 * max(dataset.attrs["pressure_max"], dataset.attrs["hertz_pressure_max"])
        left.set(xlim=low_high, ylim=(0.0, 1.12 * top), xlabel=_ALONG)
        highest = 1e6 * HEADROOM * dataset.attrs["central_film"]
        right.set(ylim=(0.0, highest))
        two_scales(left, right)
        figure.legend(ncols=4, loc="outside lower center")
        of = dataset.attrs
        figure.suptitle(
            titled(
                dataset,
                f"{1e-9 * of['pressure_max']:.3f} GPa, central film {1e6 * of['central_film']:.3f}"
                f" µm, smallest {1e6 * of['minimum_film']:.3f} µm",
            ),
            fontsize=11.5,
        )
    return figure


def _milli(dataset: xr.Dataset) -> Any:
    return 1e3 * dataset["x"].values


def _shown(dataset: xr.Dataset) -> tuple[float, float]:
    return shown_range(dataset, "x", _SIDE * dataset.attrs["half_width"], 0.01)


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
        film_contours(right, places, film, (lowest, max(_POINT_THICK * central, 1.1 * lowest)), 0.4)
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
            ax.set(
                xlim=_shown_square(dataset, along), ylim=(0.0, 1.12 * top), xlabel=f"{along} [mm]"
            )
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
    (x_low, x_high), (y_low, y_high) = _shown_square(dataset, "x"), _shown_square(dataset, "y")
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
    (x_low, x_high), (y_low, y_high) = _shown_square(dataset, "x"), _shown_square(dataset, "y")
    ratio = (y_high - y_low) / (x_high - x_low)
    return "" if 1.0 / _SLENDER < ratio < _SLENDER else ", scales of x and y differ"


def _shown_square(dataset: xr.Dataset, axis: str) -> tuple[float, float]:
    return shown_range(dataset, axis, _POINT_SIDE * dataset.attrs[f"semi_axis_{axis}"], 0.01)
