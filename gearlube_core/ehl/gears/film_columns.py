"""Columns of the curves of films, by the name that tables and files give them."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gearlube_core.ehl.transient.solution import FilmSolution


def central_film(solution: FilmSolution) -> float:
    """Return the film in the centre of the dry contact, by linear interpolation [m]."""
    column = np.array([np.interp(0.0, solution.y, row) for row in solution.film])
    return float(np.interp(0.0, solution.x, column))


def _thinnest(solution: FilmSolution) -> tuple[float, float]:
    # place of the smallest film [m]
    i, j = np.unravel_index(int(solution.film.argmin()), solution.film.shape)
    return float(solution.x[i]), float(solution.y[j])


def _most_pressed(solution: FilmSolution) -> tuple[float, float]:
    # place of the largest pressure [m]
    i, j = np.unravel_index(int(solution.pressure.argmax()), solution.pressure.shape)
    return float(solution.x[i]), float(solution.y[j])


_COLUMNS: dict[str, Callable[[FilmSolution], float]] = {
    "time": lambda film: film.time,
    "load": lambda film: film.load,
    "pressure_max": lambda film: film.maximum_pressure,
    "pressure_max_y": lambda film: _most_pressed(film)[1],
    "central_film": central_film,
    "minimum_film": lambda film: film.minimum_film,
    "minimum_film_x": lambda film: _thinnest(film)[0],
    "minimum_film_y": lambda film: _thinnest(film)[1],
    "loaded_length": lambda film: film.loaded_length,
    "load_error": lambda film: film.load_error,
    "residual": lambda film: film.residual,
    "converged": lambda film: float(film.converged),
    "newton_steps": lambda film: float(film.newton_steps),
    "krylov_steps": lambda film: float(film.krylov_steps),
    "seconds": lambda film: film.seconds,
    "solid_share": lambda film: film.touch.share,
    "touching_area": lambda film: film.touch.area,
    "solid_pressure": lambda film: film.touch.largest,
    "grid_error": lambda film: film.error.film,
    "time_error": lambda film: film.time_error,
    # of a march that is repeated, see `with_time_errors`
    "time_error_pressure": lambda _: math.nan,
}


def film_row(columns: tuple[str, ...], solution: FilmSolution, **more: float) -> list[float]:
    """Return the numbers of a film in named columns, SI.

    Parameters
    ----------
    columns
        Names.
    solution
        Film.
    more
        Columns that do not follow from the film alone.
    """
    return [more[name] if name in more else _COLUMNS[name](solution) for name in columns]
