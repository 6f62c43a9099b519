"""Films that are written down: numbers by name, known errors, an oil of one viscosity."""

import numpy as np

from gearlube_core.ehl.grid_error import FilmError, FilmNumbers
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.known_answers import made_up

ERROR = FilmError(0.01, 0.02, 0.03, 0.04, ((9, 5), (5, 3)), FilmNumbers(0.05, 0.06, 0.07, 0.08))
NUMBERS = FilmNumbers(3e-7, 2e-7, 1e9, 0.04)
ERRORS = {
    "error_central_film": 0.01, "error_minimum_film": 0.02, "error_pressure_max": 0.03,
    "error_friction": 0.04, "domain_error_central_film": 0.05, "domain_error_minimum_film": 0.06,
    "domain_error_pressure_max": 0.07, "domain_error_friction": 0.08, "error_grids": "9x5, 5x3",
}  # fmt: skip
THIN = film_oil(eta0=0.01, alpha=0.0, law="barus")  # 10 mPa s at any pressure, Newtonian


def fields(units, *shape):
    """Return made-up numbers and units by name, and what holds the numbers."""
    values = {name: made_up(name, *shape) for name in units}
    return values, {name: (units[name], values[name]) for name in units}


def a_film(time=0.0):
    """Return a film of 3 by 4 nodes: largest pressure at (0, 2), smallest film at (2, 1)."""
    pressure = 1e8 * made_up("pressure", 3, 4)
    film = 1e-7 * made_up("film", 3, 4)
    pressure[0, 2], film[2, 1] = 3e8, 0.9e-7
    return FilmSolution(
        time=time, x=1e-4 * np.array([-1.0, 0.0, 1.0]), y=1e-3 * np.array([-1.0, 0.0, 1.0, 2.0]),
        pressure=pressure, film=film, approach=0.0, load=50.0, load_error=0.01, residual=0.02,
        converged=True, outcome="so", newton_steps=7, krylov_steps=30, seconds=11.0,
    )  # fmt: skip
