"""The figures of films by the kind of contact, in reading order."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube.report.pictures import Picture
from gearlube.studies.films.figures.helical_cycle import cycle_curves, cycle_map
from gearlube.studies.films.figures.helical_line import (
    helical_along,
    helical_contours,
    helical_sections,
)
from gearlube.studies.films.figures.helical_step import step_contours, step_sections
from gearlube.studies.films.figures.hypoid_contours import hypoid_contours
from gearlube.studies.films.figures.hypoid_cycle import hypoid_curves, hypoid_ratios
from gearlube.studies.films.figures.line_contact import (
    line_profile,
    line_profile_hertz,
    line_shear,
    line_temperature,
)
from gearlube.studies.films.figures.point_contact import (
    point_contours,
    point_sections,
    point_shear,
    point_temperature,
)

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


_RESIDUALS = Picture(
    residual_history,
    "Residuals",
    "Unbalanced flow over the iterations. It falls, with jumps where the grid becomes finer.",
)
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
            step_contours,
            "Pressure and film from above",
            "At one step of the march, with squeeze. Stretched across the line. Grey: thicker than "
            "the scale.",
        ),
        "sections": Picture(
            step_sections,
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
    catalogue = CATALOGUES[dataset.attrs["contact"]]
    files = []
    for name in drawn_figures(dataset):
        path = directory / f"{prefix}{name}.png"
        catalogue[name].draw(dataset).savefig(path, dpi=150)
        files.append(path)
    return files


def drawn_figures(dataset: xr.Dataset) -> list[str]:
    """Return the names of the figures for which a dataset holds data."""
    of = dataset.attrs
    left_out = set()
    if of["contact"] in ("line", "point") and "temperature" not in dataset:
        left_out.add("temperature")
    if of["contact"] == "point" and of["sliding_x"] == of["sliding_y"] == 0.0:
        left_out.add("shear")
    if of["contact"] == "helical_cycle" and dataset.sizes["step"] < 2:
        left_out.add("cycle_map")
    return [name for name in CATALOGUES[of["contact"]] if name not in left_out]


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
