"""A lubricated line contact as a labelled dataset."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.films.datasets.variables import (
    Variable,
    error_attributes,
    film_heights,
    formula_variables,
    heat_fluxes,
    noted,
)
from gearlube.studies.films.film_formulas import line_film_formulas
from gearlube_core.arrays import Array
from gearlube_core.ehl.line.solution import LineSolution
from gearlube_core.ehl.line.thermal import ThermalLineSolution


def line_dataset(
    solution: LineSolution | ThermalLineSolution,
    *,
    name: str = "line",
    source: str = "",
    seconds: float = math.nan,
) -> xr.Dataset:
    """Return pressure, film, shear and history of a line contact, each with units.

    Parameters
    ----------
    solution
        Isothermal or thermal.
    name, source
        What figures call the contact, and where its numbers are from.
    seconds
        Time that the solution took [s].

    Returns
    -------
    xr.Dataset
        On `x` [m]; temperatures, where there are any, on `x` and the share of the film's height.
        Films of published formulas lie along `formula`. Attributes hold scalars in SI and the
        outcome.
    """
    thermal = solution if isinstance(solution, ThermalLineSolution) else None
    film = solution.film if isinstance(solution, ThermalLineSolution) else solution
    problem = film.problem
    dry_pressure, dry_gap = hertz_line(film.x, problem.half_width, problem.hertz_pressure,
                                       problem.radius)  # fmt: skip
    variables: dict[str, Any] = {
        "pressure": noted("x", film.pressure, "Pa", "pressure"),
        "film": noted("x", film.film, "m", "film thickness"),
        "void": noted("x", film.void, "1", "share of the gap without oil"),
        "viscosity": noted("x", film.viscosity, "Pa s", "viscosity"),
        "density": noted("x", film.density, "kg/m3", "density"),
        "mean_stress": noted("x", film.mean_stress, "Pa", "shear stress at mid-film"),
        "stress_1": noted("x", film.stress_1, "Pa", "shear stress on body 1"),
        "stress_2": noted("x", film.stress_2, "Pa", "shear stress on body 2"),
        "mass_flow": noted("x_face", film.mass_flow, "kg/(m s)", "mass flow"),
        "hertz_pressure": noted("x", dry_pressure, "Pa", "pressure of the dry contact"),
        "hertz_gap": noted("x", dry_gap, "m", "gap beside the dry contact"),
    }
    between = 0.5 * (film.x[1:] + film.x[:-1])
    coordinates = {
        "x": noted("x", film.x, "m", "place along the motion"),
        "x_face": noted("x_face", between, "m", "place between two nodes"),
    }
    if thermal is not None:
        coordinates["height"] = film_heights(thermal.temperature)
        variables |= {
            "temperature": noted(("x", "height"), thermal.temperature, "K", "temperature"),
            **heat_fluxes("x", thermal.flux[:, 0], thermal.flux[:, 1]),
            "temperature_change": noted(
                "turn", np.array(thermal.changes), "K", "largest change of temperature"
            ),
        }
    return xr.Dataset(
        variables | _history(film) | formula_variables(line_film_formulas(problem)),
        coords=coordinates,
        attrs={
            "contact": "line",
            "name": name,
            "source": source,
            "radius": problem.radius,
            "line_load": problem.line_load,
            "reduced_modulus": problem.reduced_modulus,
            "speed_1": problem.speed_1,
            "speed_2": problem.speed_2,
            "half_width": problem.half_width,
            "hertz_pressure_max": problem.hertz_pressure,
            **{f"group_{key}": value for key, value in problem.groups()._asdict().items()},
            "pressure_max": film.maximum_pressure,
            "central_film": film.central_film,
            "minimum_film": film.minimum_film,
            "friction_coefficient": film.friction_coefficient,
            **error_attributes(solution.error),
            "friction_1": film.friction[0],
            "friction_2": film.friction[1],
            "temperature_max": math.nan if thermal is None else thermal.max_temperature,
            "temperature_inlet": problem.lubricant.temperature,
            "turns": 0 if thermal is None else len(thermal.changes),
            "residual": film.residual,
            "load_error": film.load_error,
            "load_beyond": film.beyond.load / problem.line_load,
            "iterations": sum(len(record.residual) for _, record in film.records),
            "seconds": seconds,
            "converged": int(solution.converged),
            "outcome": solution.outcome,
        },
    )


def hertz_line(x: Array, half_width: float, largest: float, radius: float) -> tuple[Array, Array]:
    """Return pressure [Pa] and gap [m] of the dry line contact of two cylinders at x [m].

    h = b^2/(2 R) [X (X^2 - 1)^(1/2) - acosh X],  X = |x|/b above 1
    """
    X = np.abs(x) / half_width
    pressure = largest * np.sqrt(np.maximum(1.0 - X * X, 0.0))
    outside = np.maximum(X, 1.0)
    gap = outside * np.sqrt(outside * outside - 1.0) - np.arccosh(outside)
    return pressure, half_width**2 / (2.0 * radius) * gap


def _history(film: LineSolution) -> dict[str, Variable]:
    records = [(nodes, one) for nodes, one in film.records if one.residual]
    nodes = np.concatenate([np.full(len(one.residual), float(n)) for n, one in records])
    residual = np.concatenate([one.residual for _, one in records])
    load_error = np.concatenate([one.load_error for _, one in records])
    return {
        "residual_history": noted("iteration", residual, "1", "unbalanced flow over flow"),
        "load_error_history": noted("iteration", load_error, "1", "error of the load"),
        "nodes_history": noted("iteration", nodes, "1", "nodes of the grid"),
    }
