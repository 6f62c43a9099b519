"""Datasets of steady line and point contacts."""

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
)
from gearlube.studies.films.film_formulas import line_film_formulas, point_film_formulas
from gearlube_core.arrays import Array
from gearlube_core.ehl.line.solution import LineSolution
from gearlube_core.ehl.line.thermal import ThermalLineSolution
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.thermal.solver import ThermalPointSolution
from gearlube_core.ehl.point.traction import PointTraction, point_traction
from gearlube_core.film.groups import point_contact_groups
from gearlube_core.oil.film_oil import pressure_viscosity
from gearlube_core.units import labelled


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
        Isothermal or thermal line film.
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
        "pressure": labelled("x", film.pressure, "Pa", "pressure"),
        "film": labelled("x", film.film, "m", "film thickness"),
        "void": labelled("x", film.void, "1", "share of the gap without oil"),
        "viscosity": labelled("x", film.viscosity, "Pa s", "viscosity"),
        "density": labelled("x", film.density, "kg/m3", "density"),
        "mean_stress": labelled("x", film.mean_stress, "Pa", "shear stress at mid-film"),
        "stress_1": labelled("x", film.stress_1, "Pa", "shear stress on body 1"),
        "stress_2": labelled("x", film.stress_2, "Pa", "shear stress on body 2"),
        "mass_flow": labelled("x_face", film.mass_flow, "kg/(m s)", "mass flow"),
        "hertz_pressure": labelled("x", dry_pressure, "Pa", "pressure of the dry contact"),
        "hertz_gap": labelled("x", dry_gap, "m", "gap beside the dry contact"),
    }
    between = 0.5 * (film.x[1:] + film.x[:-1])
    coordinates = {
        "x": labelled("x", film.x, "m", "place along the motion"),
        "x_face": labelled("x_face", between, "m", "place between two nodes"),
    }
    if thermal is not None:
        coordinates["height"] = film_heights(thermal.temperature)
        variables |= {
            "temperature": labelled(("x", "height"), thermal.temperature, "K", "temperature"),
            **heat_fluxes("x", thermal.flux[:, 0], thermal.flux[:, 1]),
            "temperature_change": labelled(
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
        "residual_history": labelled("iteration", residual, "1", "unbalanced flow over flow"),
        "load_error_history": labelled("iteration", load_error, "1", "error of the load"),
        "nodes_history": labelled("iteration", nodes, "1", "nodes of the grid"),
    }


def point_dataset(
    given: PointSolution | ThermalPointSolution,
    *,
    sliding: tuple[float, float] | None = None,
    name: str = "point",
    source: str = "",
) -> xr.Dataset:
    """Return pressure, film, shear and history of a point contact, each with units.

    Parameters
    ----------
    given
        Its film, isothermal or thermal.
    sliding
        Velocity of body 2 against body 1 along x and y [m/s]; None: that of the problem, or pure
        rolling where it has none. A film that flows as a Newtonian one is solved without it.
    name, source
        What figures call the contact, and where its numbers are from.

    Returns
    -------
    xr.Dataset
        On `x` and `y` [m]; temperatures, where there are any, also on the share of the film's
        height. Films of published formulas lie along `formula`. Attributes hold
        scalars in SI and the outcome.
    """
    thermal = given if isinstance(given, ThermalPointSolution) else None
    solution = given.film if isinstance(given, ThermalPointSolution) else given
    problem, outcome = solution.problem, solution.outcome
    sliding = sliding or problem.sliding or (0.0, 0.0)
    u, v = problem.entrainment
    a_x, a_y, largest = problem.hertz_contact
    x, y, plane = problem.x, problem.y, ("x", "y")
    closed = problem.sides != "ambient"
    if closed:  # as wide at all places along y
        a_y = math.inf
    dry = largest * np.sqrt(
        np.maximum(1.0 - (x[:, None] / a_x) ** 2 - (y[None, :] / a_y) ** 2, 0.0)
    )
    shear = (
        point_traction(
            x,
            y,
            solution.pressure,
            solution.film,
            sliding,
            problem.lubricant,
            solution.fill,
            closed=closed,
        )
        if thermal is None
        else PointTraction(
            thermal.viscosity, thermal.density, thermal.mean_stress, thermal.friction_force
        )
    )
    modulus = 2.0 * problem.contact_modulus
    residuals = np.array(solution.residuals, dtype=float)
    variables: dict[str, Any] = {
        "pressure": labelled(plane, solution.pressure, "Pa", "pressure"),
        "film": labelled(plane, solution.film, "m", "film thickness"),
        "fill": labelled(plane, solution.fill, "1", "share of the gap that holds oil"),
        "viscosity": labelled(plane, shear.viscosity, "Pa s", "viscosity"),
        "density": labelled(plane, shear.density, "kg/m3", "density"),
        "mean_stress": labelled(
            plane, shear.mean_stress, "Pa", "shear stress at mid-film along the sliding velocity"
        ),
        "hertz_pressure": labelled(plane, dry, "Pa", "pressure of the dry contact"),
        "residual_history": labelled(
            "iteration", residuals, "1", "unbalanced flow over flow, all grids in turn"
        ),
    }
    coordinates = {
        "x": labelled("x", x, "m", "place along x"),
        "y": labelled("y", y, "m", "place along y"),
    }
    if thermal is not None:
        coordinates["height"] = film_heights(thermal.temperature)
        variables |= _temperatures(thermal)
    groups = {}
    if pressure_viscosity(problem.lubricant) > 0.0 and not closed:
        groups = point_contact_groups(
            viscosity=problem.lubricant.eta0,
            pressure_viscosity=pressure_viscosity(problem.lubricant),
            entrainment_speed=math.hypot(u, v),
            load=problem.load,
            radius=problem.hertz.R_x,
            reduced_modulus=modulus,
        )._asdict()
    return xr.Dataset(
        variables | formula_variables(point_film_formulas(problem)),
        coords=coordinates,
        attrs={
            "contact": "point",
            "name": name,
            "source": source,
            "radius_x": problem.hertz.R_x,
            "radius_y": math.inf if closed else problem.hertz.R_y,
            "side_conditions": problem.sides,
            "load": problem.load,
            "reduced_modulus": modulus,
            "entrainment_x": u,
            "entrainment_y": v,
            "sliding_x": sliding[0],
            "sliding_y": sliding[1],
            "semi_axis_x": a_x,
            "semi_axis_y": a_y,
            "hertz_pressure_max": largest,
            **{f"group_{key}": value for key, value in groups.items()},
            "pressure_max": solution.maximum_pressure,
            "central_film": solution.central_film,
            "minimum_film": solution.minimum_film,
            "friction_coefficient": shear.force / problem.load,
            **error_attributes(given.error),
            "friction_force": shear.force,
            "temperature_max": math.nan if thermal is None else thermal.max_temperature,
            "temperature_inlet": problem.lubricant.temperature,
            "turns": 0 if thermal is None else len(thermal.balances) - 1,
            "heat_balance": math.nan if thermal is None else thermal.balances[-1],
            "residual": float(outcome.residual),
            "load_error": float(outcome.load_error),
            "load_beyond": float(outcome.beyond),
            "iterations": len(solution.residuals),
            "krylov_steps": solution.krylov_steps,
            "seconds": solution.seconds,
            "wedge": outcome.wedge,
            "converged": int(outcome.converged if thermal is None else thermal.converged),
            "outcome": outcome.sentence if thermal is None else thermal.outcome,
        },
    )


def _temperatures(thermal: ThermalPointSolution) -> dict[str, Variable]:
    plane = ("x", "y")
    surface_1, surface_2 = thermal.surface_temperature
    middle = thermal.middle_temperature
    return {
        "temperature": labelled((*plane, "height"), thermal.temperature, "K", "temperature"),
        "temperature_1": labelled(plane, surface_1, "K", "temperature of body 1 at the film"),
        "temperature_middle": labelled(plane, middle, "K", "temperature in the middle of the film"),
        "temperature_2": labelled(plane, surface_2, "K", "temperature of body 2 at the film"),
        **heat_fluxes(plane, *thermal.flux),
        "heating": labelled(plane, thermal.heating, "W/m2", "heat of shear over the film"),
        "heat_balance_history": labelled(
            "turn",
            np.array(thermal.balances),
            "1",
            "heat that is not balanced over that of shear",
        ),
    }
