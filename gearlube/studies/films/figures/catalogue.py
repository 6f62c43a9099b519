"""The figures of films by the kind of contact, in reading order."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube.report.pictures import Picture, save_picture
from gearlube.studies.films.figures.contacts import (
    across_limits,
    helical_along,
    helical_contours,
    helical_sections,
    line_profile,
    line_profile_hertz,
    line_shear,
    line_temperature,
    line_title,
    loaded_rows,
    point_contours,
    point_sections,
    point_shear,
    point_temperature,
)
from gearlube.studies.films.figures.helical_cycle import cycle_curves, cycle_map
from gearlube.studies.films.figures.hypoid import hypoid_contours, hypoid_curves, hypoid_ratios
from gearlube.studies.films.figures.parts import (
    HEADROOM,
    contour_levels,
    film_colours,
    legend_of_both,
    two_scales,
)

_THICK = 2.0  # films over the central one that have contours
_SHARES = (0.05, 0.15, 0.35, 0.65, 0.85, 0.95)  # of the loaded length
_FLOOR = 1e-17  # drawn in place of an exact zero


def residual_history(dataset: xr.Dataset) -> Any:
    """Return the residuals of all Newton steps, from the coarsest to the finest grid.

    For a thermal film the changes of temperature from turn to turn.
    """
    with house_style():
        figure = new_figure(8.0, 4.2)
        ax = figure.subplots()
        if "temperature_change" in dataset:
            _turns(ax, dataset)
        else:
            _newton_steps(ax, dataset)
        ax.xaxis.get_major_locator().set_params(integer=True)
        figure.legend(ncols=2, loc="outside lower center")
        verdict = "converged" if dataset.attrs["converged"] else "NOT CONVERGED"
        figure.suptitle(f"{dataset.attrs['name']}: {verdict}", fontsize=11.5)
    return figure


def _turns(ax: Any, dataset: xr.Dataset) -> None:
    changes = dataset["temperature_change"].values
    turns = np.arange(1, changes.size + 1)
    ax.semilogy(turns, changes, "o-", color=BLUE, ms=3.5, lw=1.0, label="change of temperature")
    ax.set(xlabel="turn of film and energy", ylabel="largest change [K]")


def _newton_steps(ax: Any, dataset: xr.Dataset) -> None:
    steps = np.arange(1, dataset.sizes["iteration"] + 1)
    residual = np.maximum(dataset["residual_history"].values, _FLOOR)
    ax.semilogy(steps, residual, "o-", color=BLUE, ms=3.5, lw=1.0, label="unbalanced flow")
    words = "Newton step"
    if "load_error_history" in dataset:
        load = np.maximum(dataset["load_error_history"].values, _FLOOR)
        ax.semilogy(steps, load, "s", color=VERMILLION, ms=3.0, label="load error")
        nodes = dataset["nodes_history"].values
        for turn in np.flatnonzero(np.diff(nodes) != 0.0):
            ax.axvline(turn + 1.5, color=GREY, lw=0.8, ls=":")
        words += "; dotted: next finer grid; a load error of 1e-17 stands for zero"
    ax.set(xlabel=words, ylabel="relative error [-]")


_RESIDUALS = Picture(
    residual_history,
    "Residuals",
    "Unbalanced flow over the iterations. It falls, with jumps where the grid becomes finer.",
)


def _title(dataset: xr.Dataset) -> str:
    state = "" if dataset.attrs["steady_converged"] else ", at rest NOT CONVERGED"
    return f"{line_title(dataset)}{state}"


def _step_contours(dataset: xr.Dataset) -> Any:
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


def _step_sections(dataset: xr.Dataset) -> Any:
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


# by the attribute `contact` of a dataset
CATALOGUES: dict[str, dict[str, Picture]] = {
    "line": {
        "profile": Picture(
            line_profile,
            "Pressure and film",
            "The oil enters on the left. Near the outlet the pressure has a spike and the film is "
            "thinnest. Dashed or dotted: the dry contact of Hertz.",
        ),
        "profile_hertz": Picture(
            line_profile_hertz,
            "Comparison with the dry contact",
            "Dashed: dry contact of Hertz, its gap plus the central film.",
        ),
        "shear": Picture(
            line_shear,
            "Shear stress",
            "Shear stress on both bodies and at mid-film. In the middle of the film most of it "
            "comes from sliding.",
        ),
        "temperature": Picture(
            line_temperature, "Temperature", "Of the film and of both surfaces above the inlet."
        ),
        "residuals": _RESIDUALS,
    },
    "point": {
        "contours": Picture(
            point_contours,
            "Pressure and film from above",
            "The film is thinnest in two lobes at the sides and has a bar at the outlet. Grey: "
            "thicker than the scale.",
        ),
        "sections": Picture(
            point_sections,
            "Sections through the centre",
            "Along and across the motion. Outside the contact the gap leaves the axis.",
        ),
        "shear": Picture(
            point_shear, "Shear stress", "Shear stress at mid-film, along the sliding velocity."
        ),
        "temperature": Picture(
            point_temperature, "Temperature", "Of the film and of both surfaces above the inlet."
        ),
        "residuals": _RESIDUALS,
    },
    "helical": {
        "along": Picture(
            helical_along,
            "Pressure and film along the line",
            "Largest pressure and smallest film of each section across the line.",
        ),
        "contours": Picture(
            helical_contours,
            "Pressure and film from above",
            "Stretched across the line. Grey: thicker than the scale.",
        ),
        "sections": Picture(
            helical_sections,
            "Sections across the line",
            "The oil enters on the left; the film is thinnest near the outlet.",
        ),
    },
    "helical_cycle": {
        "cycle": Picture(
            cycle_curves,
            "The line through its cycle",
            "With squeeze. Where the load changes fast, the film lags behind the steady film.",
        ),
        "cycle_map": Picture(
            cycle_map,
            "Pressure and film along the line, over the cycle",
            "Each column is one step: the largest pressure and smallest film of each section.",
        ),
    },
    "helical_step": {
        "contours": Picture(
            _step_contours,
            "Pressure and film from above",
            "At one step of the march, with squeeze. Stretched across the line. Grey: thicker than "
            "the scale.",
        ),
        "sections": Picture(
            _step_sections,
            "Sections across the line",
            "At one step of the march, with squeeze. The oil enters on the left.",
        ),
    },
    "hypoid": {
        "curves": Picture(
            hypoid_curves,
            "Film and friction through the engagement",
            "Solved films, and the formulas that the axle model uses.",
        ),
        "ratios": Picture(
            hypoid_ratios,
            "Formulas divided by the solution",
            "1: the formula gives the solved value. The formulas are least accurate if "
            "entrainment is at an angle to the axes.",
        ),
        "contours": Picture(
            hypoid_contours,
            "Pressure and film from above",
            "The minor axis is stretched. The inset with equal scales has the true directions.",
        ),
    },
}


def save_film_figures(dataset: xr.Dataset, directory: Path, prefix: str = "") -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files.

    `prefix` begins the names of the files.
    """
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, one in drawn_figures(dataset).items():
        path = directory / f"{prefix}{name}.png"
        save_picture(one.draw(dataset), path)
        files.append(path)
    return files


def drawn_figures(dataset: xr.Dataset) -> dict[str, Picture]:
    """Return the figures for which a dataset holds data, by name."""
    of = dataset.attrs
    left_out = set()
    if of["contact"] in ("line", "point") and "temperature" not in dataset:
        left_out.add("temperature")
    if of["contact"] == "point" and of["sliding_x"] == of["sliding_y"] == 0.0:
        left_out.add("shear")
    if of["contact"] == "helical_cycle" and dataset.sizes["step"] < 2:
        left_out.add("cycle_map")
    return {name: one for name, one in CATALOGUES[of["contact"]].items() if name not in left_out}
