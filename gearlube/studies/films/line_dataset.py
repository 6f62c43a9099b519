"""A lubricated line contact as a labelled dataset."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.films.formulas import line_film_formulas
from gearlube.studies.films.variables import formula_variables, unit_note
from gearlube_core.arrays import Array
from gearlube_core.ehl.case.contact_case import LineCase
from gearlube_core.ehl.line.solution import LineSolution
from gearlube_core.ehl.line.thermal import ThermalLineSolution


def line_dataset(
    case: LineCase, solution: LineSolution | ThermalLineSolution, seconds: float
) -> xr.Dataset:
    """Return pressure, film, shear and history of a line contact, each with units.

    Parameters
    ----------
    case
        What was solved.
    solution
        Isothermal or thermal.
    seconds
        What the solution took.

    Returns
    -------
    xr.Dataset
        On `x` [m]; temperatures, where there are any, on `x` and the share of the film's height.
        Films of published formulas lie along `formula`. Attributes hold scalars in SI and the
        outcome.
    """
    warm = solution if isinstance(solution, ThermalLineSolution) else None
    film = solution.film if isinstance(solution, ThermalLineSolution) else solution
    problem = film.problem
    dry_pressure, dry_gap = hertz_line(film.x, problem.half_width, problem.hertz_pressure,
                                       problem.radius)  # fmt: skip
    variables: dict[str, Any] = {
        "pressure": ("x", film.pressure, unit_note("Pa", "pressure")),
        "film": ("x", film.film, unit_note("m", "film thickness")),
        "void": ("x", film.void, unit_note("1", "share of the gap without oil")),
        "viscosity": ("x", film.viscosity, unit_note("Pa s", "viscosity")),
        "density": ("x", film.density, unit_note("kg/m3", "density")),
        "mean_stress": ("x", film.mean_stress, unit_note("Pa", "shear stress at mid-film")),
        "stress_1": ("x", film.stress_1, unit_note("Pa", "shear stress on body 1")),
        "stress_2": ("x", film.stress_2, unit_note("Pa", "shear stress on body 2")),
        "mass_flow": (
            "x_face",
            film.mass_flow,
            unit_note("kg/(m s)", "mass flow"),
        ),
        "hertz_pressure": ("x", dry_pressure, unit_note("Pa", "pressure of the dry contact")),
        "hertz_gap": ("x", dry_gap, unit_note("m", "gap beside the dry contact")),
    }
    coordinates = {
        "x": ("x", film.x, unit_note("m", "place along the motion")),
        "x_face": (
            "x_face", 0.5 * (film.x[1:] + film.x[:-1]), unit_note("m", "place between two nodes"),
        ),
    }  # fmt: skip
    if warm is not None:
        heights = np.linspace(0.0, 1.0, warm.temperature.shape[1])
        coordinates["height"] = ("height", heights, unit_note("1", "height over film, body 1 to 2"))
        variables |= {
            "temperature": (("x", "height"), warm.temperature, unit_note("K", "temperature")),
            "heat_flux_1": ("x", warm.flux[:, 0], unit_note("W/m2", "heat into body 1")),
            "heat_flux_2": ("x", warm.flux[:, 1], unit_note("W/m2", "heat into body 2")),
            "temperature_change": (
                "turn", np.array(warm.changes), unit_note("K", "largest change of temperature"),
            ),
        }  # fmt: skip
    return xr.Dataset(
        variables | _history(film) | formula_variables(line_film_formulas(problem)),
        coords=coordinates,
        attrs={
            "contact": "line",
            "name": case.name,
            "source": case.source,
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
            "friction_1": film.friction[0],
            "friction_2": film.friction[1],
            "temperature_max": float("nan") if warm is None else warm.max_temperature,
            "temperature_inlet": problem.lubricant.temperature,
            "turns": 0 if warm is None else len(warm.changes),
            "residual": film.residual,
            "load_error": film.load_error,
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


def _history(film: LineSolution) -> dict[str, tuple[str, Array, dict[str, str]]]:
    records = [(nodes, one) for nodes, one in film.records if one.residual]
    nodes = np.concatenate([np.full(len(one.residual), float(n)) for n, one in records])
    residual = np.concatenate([one.residual for _, one in records])
    load_error = np.concatenate([one.load_error for _, one in records])
    return {
        "residual_history": ("iteration", residual, unit_note("1", "unbalanced flow over flow")),
        "load_error_history": ("iteration", load_error, unit_note("1", "error of the load")),
        "nodes_history": ("iteration", nodes, unit_note("1", "nodes of the grid")),
    }
