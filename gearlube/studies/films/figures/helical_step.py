"""A contact line at one step of a march, beside the steady film of the same line."""

from __future__ import annotations

from typing import Any

import xarray as xr

from gearlube.plotting.style import BLUE, VERMILLION, house_style, new_figure
from gearlube.studies.films.figures.helical_line import across_limits, line_title, loaded_rows
from gearlube.studies.films.figures.parts import (
    HEADROOM,
    contour_levels,
    film_colours,
    legend_of_both,
    two_scales,
)

_THICK = 2.0  # films over the central one that have contours
_SHARES = (0.05, 0.15, 0.35, 0.65, 0.85, 0.95)  # of the loaded length


def step_contours(dataset: xr.Dataset) -> Any:
    """Return contours of film and pressure: in time above, steady below."""
    with house_style():
        figure = new_figure(12.0, 6.4)
        axes = figure.subplots(2, 2, sharex=True, sharey=True)
        places = (1e3 * dataset["y"].values, 1e3 * dataset["x"].values)
        films = [1e6 * dataset[name].values for name in ("film", "steady_film")]
        pressures = [1e-9 * dataset[name].values for name in ("pressure", "steady_pressure")]
        lowest = min(float(one.min()) for one in films)
        levels = contour_levels(lowest, max(_THICK * 1e6 * dataset.attrs["central_film"], lowest))
        for ax, film, state in zip(axes[:, 0], films, ("marching", "at rest"), strict=True):
            drawn = ax.contourf(*places, film, levels=levels, cmap=film_colours(), extend="max")
            ax.set_title(f"film, {state}, smallest {film.min():.3f} µm")
        figure.colorbar(
            drawn, ax=axes[:, 0], label="film [µm], grey: thicker", location="bottom", aspect=40
        )
        levels = contour_levels(0.0, max(float(one.max()) for one in pressures))[1:]
        for ax, pressure, state in zip(axes[:, 1], pressures, ("marching", "at rest"), strict=True):
            drawn = ax.contourf(*places, pressure, levels=levels, cmap="magma_r")
            ax.set_title(f"pressure, {state}, up to {pressure.max():.3f} GPa")
        figure.colorbar(drawn, ax=axes[:, 1], label="pressure [GPa]", location="bottom", aspect=40)
        for ax in axes.ravel():
            ax.set_ylim(across_limits(dataset))
            ax.grid(visible=False)
        for ax in axes[:, 0]:
            ax.set_ylabel("across the line, x [mm]")
        for ax in axes[1]:
            ax.set_xlabel("along the line, y [mm]")
        figure.suptitle(_title(dataset), fontsize=11.5)
    return figure


def step_sections(dataset: xr.Dataset) -> Any:
    """Return sections of film and pressure across the line, in time and steady."""
    with house_style():
        figure = new_figure(11.0, 8.4)
        of, x = dataset.attrs, 1e3 * dataset["x"].values
        rows = loaded_rows(dataset)
        axes = figure.subplots(3, 2, sharex=True).ravel()
        for ax in axes[-2:]:
            ax.set_xlabel("across the line, x [mm]")
        top = 1.12e-9 * max(of["pressure_max"], float(dataset["steady_pressure"].max()))
        for ax, share in zip(axes, _SHARES, strict=True):
            section, film = dataset.isel(y=int(rows[round(share * (rows.size - 1))])), ax.twinx()
            for prefix, dash, state in (("steady_", "-", "at rest"), ("", "--", "marching")):
                ax.plot(
                    x, 1e-9 * section[f"{prefix}pressure"].values, dash, color=BLUE, lw=1.3,
                    label=f"pressure, {state}",
                )  # fmt: skip
                film.plot(
                    x, 1e6 * section[f"{prefix}film"].values, dash, color=VERMILLION, lw=1.3,
                    label=f"film, {state}",
                )  # fmt: skip
            ax.set(xlim=across_limits(dataset), ylim=(0.0, top))
            film.set_ylim(0.0, 1e6 * HEADROOM * of["central_film"])
            two_scales(ax, film)
            ax.set_title(f"y = {1e3 * float(section['y']):.2f} mm")
        legend_of_both(axes[0], film, 4)
        figure.suptitle(_title(dataset), fontsize=11.5)
    return figure


def _title(dataset: xr.Dataset) -> str:
    state = "" if dataset.attrs["steady_converged"] else ", at rest NOT CONVERGED"
    return f"{line_title(dataset)}{state}"
