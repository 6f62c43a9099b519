"""Steady thermal films along a flank's engagement."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import Solid
from gearlube_core.ehl.gears.hypoid_film import HypoidFilm
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.thermal.solver import solve_thermal_point
from gearlube_core.ehl.transient.curves import FilmCurves
from gearlube_core.ehl.transient.march import MARCH_SETTINGS

COLUMNS = (
    "time",
    "central_film",
    "minimum_film",
    "cold_central_film",
    "cold_minimum_film",
    "pressure_max",
    "traction",
    "rise_max",
    "rise_surface",
    "heat_balance",
    "turns",
    "converged",
    "seconds",
)


def thermal_films(
    film: HypoidFilm,
    times: Array,
    solids: tuple[Solid, Solid],
    temperature_exponent: float,
    *,
    settings: PointSolverSettings = MARCH_SETTINGS,
    progress: Callable[[int, int, float], None] | None = None,
    throw: bool = True,
) -> FilmCurves:
    """Return the steady films of a flank with their heat, columns as in `COLUMNS`.

    Parameters
    ----------
    film
        Contact through the engagement.
    times : ndarray, shape (N,)
        [s].
    solids
        Of both members: bulk at the oil's temperature.
    temperature_exponent
        S0 of Houpert's law; the viscosity at the oil's temperature stays that of the film.
    settings
        Stencil and tolerances of the flow.
    progress
        Called with the row, the last row and the smallest film [m].
    throw
        Raise where a film does not converge; else say so in the table.

    Raises
    ------
    ConvergenceError

    Notes
    -----
    Each on its own domain, beside the cold film of the same grid. Friction is integrated where
    there is pressure, as in `flank_traction`.
    """
    rows = []
    for n, time in enumerate(times):
        problem = film.problem(film.cycle.at(float(time)))
        cold_law = problem.lubricant.viscosity
        oil = problem.lubricant._replace(viscosity=cold_law._replace(S0=temperature_exponent))
        cold = solve_point_contact(problem, settings, throw=throw)
        warm = solve_thermal_point(replace(problem, lubricant=oil), *solids, settings, throw=throw)
        inlet = oil.temperature
        loaded = warm.film.pressure > 0.0
        cell = (problem.x[1] - problem.x[0]) * (problem.y[1] - problem.y[0])
        surfaces = max(float(one.max()) for one in warm.surface_temperature)
        rows.append(
            [
                float(time),
                warm.film.central_film,
                warm.film.minimum_film,
                cold.central_film,
                cold.minimum_film,
                warm.film.maximum_pressure,
                float(warm.mean_stress[loaded].sum()) * cell / problem.load,
                warm.max_temperature - inlet,
                surfaces - inlet,
                warm.balances[-1] if warm.balances else np.inf,
                float(max(len(warm.balances) - 1, 0)),
                float(warm.converged and cold.outcome.converged),
                cold.seconds + warm.seconds,
            ]
        )
        if progress is not None:
            progress(n, len(times) - 1, warm.film.minimum_film)
    return FilmCurves(COLUMNS, np.array(rows), {})
