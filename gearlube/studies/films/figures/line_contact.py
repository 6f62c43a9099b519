"""Pressure, film, shear and temperature across a line contact."""

from __future__ import annotations

from typing import Any

import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, GREY, VERMILLION, house_style, new_figure
from gearlube.studies.films.figures.parts import HEADROOM, shown_range, titled, two_scales

_ALONG = "x [mm], oil enters on the left"
_SIDE = 2.0  # half widths that are shown, at most


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
