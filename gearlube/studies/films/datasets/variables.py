"""Dataset variables with units and long names, and variables that several datasets share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from gearlube.studies.films.film_formulas import FilmFormula
from gearlube_core.arrays import Array
from gearlube_core.ehl.grid_error import FilmError
from gearlube_core.ehl.transient.curves import FilmCurves
from gearlube_core.units import labelled

Dimensions = str | tuple[str, ...]
Variable = tuple[Dimensions, Any, dict[str, str]]


def noted_curves(
    notes: Mapping[str, tuple[str, str]], curves: FilmCurves, dimension: str, prefix: str = ""
) -> dict[str, Variable]:
    """Return the columns `notes` of `curves`, names after `prefix`, with their units and names."""
    return {
        prefix + column: labelled(dimension, curves[column], *note)
        for column, note in notes.items()
    }


def film_heights(temperature: Array) -> Variable:
    """Return the coordinate along the last axis of a film's temperature, from body 1 to 2."""
    heights = np.linspace(0.0, 1.0, temperature.shape[-1])
    return labelled("height", heights, "1", "height over film, body 1 to 2")


def heat_fluxes(dimensions: Dimensions, flux_1: Array, flux_2: Array) -> dict[str, Variable]:
    """Return the heat that flows into both bodies [W/m2]."""
    return {
        "heat_flux_1": labelled(dimensions, flux_1, "W/m2", "heat into body 1"),
        "heat_flux_2": labelled(dimensions, flux_2, "W/m2", "heat into body 2"),
    }


def error_attributes(error: FilmError) -> dict[str, float | str]:
    """Return the estimated relative errors of grid and domain, and the grids compared."""
    names = ("central_film", "minimum_film", "pressure_max", "friction")
    return {
        "error_central_film": error.central_film,
        "error_minimum_film": error.minimum_film,
        "error_pressure_max": error.maximum_pressure,
        "error_friction": error.friction,
        **{f"domain_error_{name}": one for name, one in zip(names, error.domain, strict=True)},
        "error_grids": ", ".join("x".join(map(str, nodes)) for nodes in error.nodes),
    }


def formula_variables(formulas: list[FilmFormula]) -> dict[str, Variable]:
    """Return films of formulas, their names and what they stand for, along `formula`."""
    if not formulas:
        return {}
    return {
        "formula_film": labelled(
            "formula",
            np.array([one.film for one in formulas]),
            "m",
            "film of a published formula",
        ),
        "formula_film_over_radius": labelled(
            "formula",
            np.array([one.film / one.radius for one in formulas]),
            "1",
            "that film over the relative radius; thin films are below 0.01",
        ),
        "formula_quantity": ("formula", np.array([one.quantity for one in formulas]), {}),
        "formula_source": ("formula", np.array([one.source for one in formulas]), {}),
    }
