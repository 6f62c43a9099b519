"""The film on one contact line of a helical pair as a labelled dataset."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr

from gearlube.studies.films.datasets.variables import error_attributes, formula_variables, noted
from gearlube.studies.films.film_formulas import line_film_formulas
from gearlube.studies.films.helical_case import line_of_step
from gearlube_core.arrays import Array
from gearlube_core.ehl.gears.helical_film import HelicalFilm
from gearlube_core.ehl.grid_error import estimated_error
from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.ehl.line.traction import fill_mean_stress
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.oil.film_oil import fill_properties


def helical_dataset(
    film: HelicalFilm,
    step: float,
    solution: FilmSolution,
    *,
    name: str = "helical pair",
    source: str = "",
) -> xr.Dataset:
    """Return pressure, film, gap and shear of a contact line, each with units.

    Parameters
    ----------
    film
        The line through its cycle.
    step
        Where the line is looked at [-].
    solution
        Its film there.
    name, source
        What figures call the pair, and where its numbers are from.

    Returns
    -------
    xr.Dataset
        On `x`, across the line, and `y`, along it [m]. Films of formulas are those of a line
        with the middle's radius and the mean load of the loaded length. Attributes hold scalars
        in SI and the outcome; the coefficient of friction counts shear of both signs alike.
    """
    x, y = solution.x, solution.y
    position, X = line_of_step(film.steps, step)
    speed_1, speed_2 = film.surface_speeds(y, X)
    stress = _mean_stress(film, solution, speed_2 - speed_1)
    across = np.trapezoid(stress, x, axis=0)  # N/m; changes sign at the pitch line
    frictions = [_friction(film, one, speed_1, speed_2, y) for one in (solution, *solution.coarser)]
    load = film.load(X)
    middle = _middle_line(film, X, load, solution.loaded_length)
    pressure_x, pressure_y = solution.maximum_pressure_place
    film_x, film_y = solution.minimum_film_place
    plane = ("x", "y")
    return xr.Dataset(
        {
            "pressure": noted(plane, solution.pressure, "Pa", "pressure"),
            "film": noted(plane, solution.film, "m", "film thickness"),
            "gap": noted(plane, film.gap(x, y, X), "m", "gap of the bare flanks"),
            "mean_stress": noted(plane, stress, "Pa", "shear stress at mid-film"),
            "speed_1": noted("y", speed_1, "m/s", "surface speed of the pinion"),
            "speed_2": noted("y", speed_2, "m/s", "surface speed of the gear"),
            **formula_variables(line_film_formulas(middle)),
        },
        coords={
            "x": noted("x", x, "m", "place across the line"),
            "y": noted("y", y, "m", "place along the line"),
        },
        attrs={
            "contact": "helical",
            "name": name,
            "source": source,
            "step": step,
            "position": position,
            "line": X,
            "torque": film.torque,
            "pinion_speed": film.pinion_speed,
            "load_convention": film.convention,
            "load": load,
            "reduced_modulus": 2.0 * film.contact_modulus,
            "half_width": middle.half_width,
            "hertz_pressure_max": middle.hertz_pressure,
            "pressure_max": solution.maximum_pressure,
            "pressure_max_x": pressure_x,
            "pressure_max_y": pressure_y,
            "central_film": float(solution.film[np.abs(x).argmin(), _mid(solution)]),
            "minimum_film": solution.minimum_film,
            "minimum_film_x": film_x,
            "minimum_film_y": film_y,
            "loaded_length": solution.loaded_length,
            "friction_coefficient": frictions[0] / load,
            **error_attributes(
                replace(
                    solution.error,
                    friction=estimated_error(frictions, formal=solution.formal_order),
                )
            ),
            "friction_force": float(np.trapezoid(across, y)),
            "sliding_power": float(np.trapezoid(across * (speed_2 - speed_1), y)),
            "residual": float(solution.residual),
            "load_error": float(solution.load_error),
            "iterations": solution.newton_steps,
            "krylov_steps": solution.krylov_steps,
            "seconds": solution.seconds,
            "converged": int(solution.converged),
            "outcome": solution.outcome,
        },
    )


def _friction(
    film: HelicalFilm, solution: FilmSolution, speed_1: Array, speed_2: Array, y: Array
) -> float:
    """Return the shear force of both signs counted alike [N]; the speeds hold at `y`."""
    sliding = np.interp(solution.y, y, speed_2 - speed_1)
    across = np.trapezoid(_mean_stress(film, solution, sliding), solution.x, axis=0)
    return float(np.trapezoid(np.abs(across), solution.y))


def _mid(solution: FilmSolution) -> int:
    """Return the row in the middle of the loaded length."""
    rows = np.flatnonzero((solution.pressure > 1.0e6).any(axis=0))
    return int(rows[rows.size // 2]) if rows.size else solution.y.size // 2


def _middle_line(film: HelicalFilm, X: float, load: float, length: float) -> LineProblem:
    """Return the line contact of the same mean load, with radius and speeds of the middle."""
    plane = film.modified.pair.plane
    s = X - 0.5 * plane.W * plane.sin_b / plane.cos_b
    speed_1, speed_2 = (float(u[0]) for u in film.surface_speeds(np.zeros(1), X))
    return LineProblem(
        lubricant=film.lubricant,
        radius=s * (plane.x_g - s) / (plane.x_g * plane.cos_b),
        line_load=load / (length if length > 0.0 else film.line_length),
        reduced_modulus=2.0 * film.contact_modulus,
        speed_1=speed_1,
        speed_2=speed_2,
    )


def _mean_stress(film: HelicalFilm, solution: FilmSolution, sliding: Array) -> Array:
    """Return the shear stress at mid-film across the line [Pa], rows of other sliding."""
    slope = np.gradient(solution.pressure, solution.x, axis=0)
    oil, n = film.lubricant, solution.x.size
    stress = np.empty_like(solution.pressure)
    eta, eta_slope, rho, rho_slope, tau = (np.empty(n) for _ in range(5))
    void = np.zeros(n)
    for j, slide in enumerate(sliding):
        p, h, dp = (
            np.ascontiguousarray(a[:, j]) for a in (solution.pressure, solution.film, slope)
        )
        fill_properties(oil, p, eta, eta_slope, rho, rho_slope)
        fill_mean_stress(p, dp, h, void, eta, float(slide), oil, tau)
        stress[:, j] = tau
    return stress
