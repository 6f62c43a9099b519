"""A lubricated point contact as a labelled dataset."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.films.formulas import point_film_formulas
from gearlube.studies.films.variables import formula_variables, unit_note
from gearlube_core.ehl.case.contact_case import PointCase
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.thermal.solver import ThermalPointSolution
from gearlube_core.ehl.point.traction import PointTraction, point_traction
from gearlube_core.film.groups import point_contact_groups
from gearlube_core.oil.film_oil import pressure_viscosity


def point_dataset(case: PointCase, given: PointSolution | ThermalPointSolution) -> xr.Dataset:
    """Return pressure, film, shear and history of a point contact, each with units.

    Parameters
    ----------
    case
        What was solved.
    given
        Its film, isothermal or thermal.

    Returns
    -------
    xr.Dataset
        On `x` and `y` [m]; temperatures, where there are any, also on the share of the film's
        height. Films of published formulas lie along `formula`. Attributes hold
        scalars in SI and the outcome.
    """
    warm = given if isinstance(given, ThermalPointSolution) else None
    solution = given.film if isinstance(given, ThermalPointSolution) else given
    problem, outcome = solution.problem, solution.outcome
    u, v = problem.entrainment
    a_x, a_y, largest = problem.hertz_contact
    x, y = problem.x, problem.y
    dry = largest * np.sqrt(
        np.maximum(1.0 - (x[:, None] / a_x) ** 2 - (y[None, :] / a_y) ** 2, 0.0)
    )
    shear = (
        point_traction(
            x, y, solution.pressure, solution.film, case.sliding, problem.lubricant, solution.fill
        )
        if warm is None
        else PointTraction(warm.viscosity, warm.density, warm.mean_stress, warm.friction_force)
    )
    modulus = 2.0 * problem.contact_modulus
    variables: dict[str, Any] = {
        "pressure": (("x", "y"), solution.pressure, unit_note("Pa", "pressure")),
        "film": (("x", "y"), solution.film, unit_note("m", "film thickness")),
        "fill": (("x", "y"), solution.fill, unit_note("1", "share of the gap that holds oil")),
        "viscosity": (("x", "y"), shear.viscosity, unit_note("Pa s", "viscosity")),
        "density": (("x", "y"), shear.density, unit_note("kg/m3", "density")),
        "mean_stress": (
            ("x", "y"),
            shear.mean_stress,
            unit_note("Pa", "shear stress at mid-film along the sliding velocity"),
        ),
        "hertz_pressure": (("x", "y"), dry, unit_note("Pa", "pressure of the dry contact")),
        "residual_history": (
            "iteration",
            np.array(solution.residuals, dtype=float),
            unit_note("1", "unbalanced flow over flow, all grids in turn"),
        ),
    }
    coordinates = {
        "x": ("x", x, unit_note("m", "place along x")),
        "y": ("y", y, unit_note("m", "place along y")),
    }
    if warm is not None:
        heights = np.linspace(0.0, 1.0, warm.temperature.shape[-1])
        coordinates["height"] = ("height", heights, unit_note("1", "height over film, body 1 to 2"))
        variables |= _temperatures(warm)
    groups = {}
    if pressure_viscosity(problem.lubricant) > 0.0:
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
            "name": case.name,
            "source": case.source,
            "radius_x": problem.hertz.R_x,
            "radius_y": problem.hertz.R_y,
            "load": problem.load,
            "reduced_modulus": modulus,
            "entrainment_x": u,
            "entrainment_y": v,
            "sliding_x": case.sliding[0],
            "sliding_y": case.sliding[1],
            "semi_axis_x": a_x,
            "semi_axis_y": a_y,
            "hertz_pressure_max": largest,
            **{f"group_{key}": value for key, value in groups.items()},
            "pressure_max": solution.maximum_pressure,
            "central_film": solution.central_film,
            "minimum_film": solution.minimum_film,
            "friction_coefficient": shear.force / problem.load,
            "friction_force": shear.force,
            "temperature_max": float("nan") if warm is None else warm.max_temperature,
            "temperature_inlet": problem.lubricant.temperature,
            "turns": 0 if warm is None else len(warm.balances) - 1,
            "heat_balance": float("nan") if warm is None else warm.balances[-1],
            "residual": float(outcome.residual),
            "load_error": float(outcome.load_error),
            "iterations": len(solution.residuals),
            "krylov_steps": solution.krylov_steps,
            "seconds": solution.seconds,
            "wedge": outcome.wedge,
            "converged": int(outcome.converged if warm is None else warm.converged),
            "outcome": outcome.sentence if warm is None else warm.outcome,
        },
    )


def _temperatures(warm: ThermalPointSolution) -> dict[str, Any]:
    dims = ("x", "y")
    return {
        "temperature": ((*dims, "height"), warm.temperature, unit_note("K", "temperature")),
        "temperature_1": (
            dims,
            warm.surface_temperature[0],
            unit_note("K", "temperature of body 1 at the film"),
        ),
        "temperature_middle": (
            dims,
            warm.middle_temperature,
            unit_note("K", "temperature in the middle of the film"),
        ),
        "temperature_2": (
            dims,
            warm.surface_temperature[1],
            unit_note("K", "temperature of body 2 at the film"),
        ),
        "heat_flux_1": (dims, warm.flux[0], unit_note("W/m2", "heat into body 1")),
        "heat_flux_2": (dims, warm.flux[1], unit_note("W/m2", "heat into body 2")),
        "heating": (dims, warm.heating, unit_note("W/m2", "heat of shear over the film")),
        "heat_balance_history": (
            "turn",
            np.array(warm.balances),
            unit_note("1", "heat that is not balanced over that of shear"),
        ),
    }
