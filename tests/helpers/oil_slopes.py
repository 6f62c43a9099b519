"""Slopes of an oil's viscosity and density with pressure, as films take them."""

from __future__ import annotations

import numpy as np

from gearlube_core.oil.film_oil import FilmOil, film_properties


def viscosity_slope(oil: FilmOil, p: float) -> float:
    """Return d eta/dp [s]."""
    return float(film_properties(oil, np.array([p]))[1][0])


def density_slope(oil: FilmOil, p: float) -> float:
    """Return d rho/dp [s2/m2]."""
    return float(film_properties(oil, np.array([p]))[3][0])
