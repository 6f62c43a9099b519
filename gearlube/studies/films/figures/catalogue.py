"""The figures of films by the kind of contact, in reading order."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import xarray as xr

from gearlube.studies.films.figures.helical_cycle import cycle_curves, cycle_map
from gearlube.studies.films.figures.helical_line import (
    helical_along,
    helical_contours,
    helical_sections,
)
from gearlube.studies.films.figures.helical_step import step_contours, step_sections
from gearlube.studies.films.figures.history import residual_history
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

Draw = Callable[[xr.Dataset], Any]
# by the attribute `contact` of a dataset
CATALOGUES: dict[str, dict[str, Draw]] = {
    "line": {
        "profile": line_profile,
        "profile_hertz": line_profile_hertz,
        "shear": line_shear,
        "temperature": line_temperature,
        "residuals": residual_history,
    },
    "point": {
        "contours": point_contours,
        "sections": point_sections,
        "shear": point_shear,
        "temperature": point_temperature,
        "residuals": residual_history,
    },
    "helical": {
        "contours": helical_contours,
        "along": helical_along,
        "sections": helical_sections,
    },
    "helical_cycle": {"cycle": cycle_curves, "cycle_map": cycle_map},
    "helical_step": {"contours": step_contours, "sections": step_sections},
    "hypoid": {
        "curves": hypoid_curves,
        "ratios": hypoid_ratios,
        "contours": hypoid_contours,
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
        catalogue[name](dataset).savefig(path, dpi=150)
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
