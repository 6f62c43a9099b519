"""Traction of a smooth rolling and sliding contact by the law of the axle's flanks."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.checks import check_option, check_within
from gearlube_core.contact.elliptical_hertz import hertz_coefficients
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film.chittenden_1985 import central_film_thickness, film_geometry
from gearlube_core.film.dowson_toyoda_1979 import line_film_thickness
from gearlube_core.friction.evans_johnson_1986 import (
    solid_resistance,
    surface_heating_number,
    viscous_friction_coefficient,
)
from gearlube_core.oil.lubricant_state import LubricantState

CONTACTS = ("point", "line")
MAX_OVER_MEAN = {"point": 1.5, "line": 4.0 / math.pi}  # Hertz pressure


class FilmPoint(NamedTuple):
    """What the traction of one measured point needs beside the two stresses; all floats, SI."""

    state: LubricantState
    film_thickness: float  # [m]
    mean_pressure: float  # [Pa]
    sliding_speed: float  # [m/s]
    zeta: float  # surface heating number [-]


def film_point(
    state: LubricantState,
    solid: SolidParameters,
    *,
    contact: str,
    radius: float,
    entrainment_speed: float,
    sliding_speed: float,
    mean_pressure: float,
) -> FilmPoint:
    """Return film and heating of a smooth contact.

    Parameters
    ----------
    state : LubricantState
        Oil at the temperature of the inlet.
    solid : SolidParameters
    contact : {"point", "line"}
        A circle or a line.
    radius : float
        Relative radius of curvature along entrainment [m], of a circle in both directions.
    entrainment_speed : float
        Mean of the surface speeds [m/s].
    sliding_speed : float
        Difference of the surface speeds [m/s], either sign.
    mean_pressure : float
        [Pa].

    Returns
    -------
    FilmPoint

    Notes
    -----
    Film by `central_film_thickness` or `line_film_thickness`, flooded and isothermal at the inlet.
    """
    check_option("contact", contact, CONTACTS)
    check_within("radius", radius, 1e-4, 10.0, "m", "20 mm is 0.02 m.")
    E_star = solid.contact_modulus
    if contact == "point":
        load = (mean_pressure / hertz_coefficients(radius, radius, E_star)[2]) ** 3
        R_e, side_flow = film_geometry(radius, radius, 0.0)
        h = central_film_thickness(
            R_e, side_flow, state.eta0, state.alpha, entrainment_speed, load, 2.0 * E_star
        )
    else:
        # p_max = sqrt(w E*/(pi R))
        largest = MAX_OVER_MEAN["line"] * mean_pressure
        line_load = math.pi * radius * largest * largest / E_star
        h = line_film_thickness(
            radius, state.eta0, state.alpha, entrainment_speed, line_load, 2.0 * E_star
        )
    effusivity_squared = solid.conductivity * solid.density * solid.heat_capacity
    resistance = solid_resistance(
        radius, mean_pressure, entrainment_speed, 2.0 * E_star, effusivity_squared
    )
    zeta = surface_heating_number(h, state.conductivity, resistance)
    return FilmPoint(state, h, mean_pressure, sliding_speed, zeta)


def traction_coefficient(point: FilmPoint, eyring_stress: float, limit: float) -> float:
    """Return the traction coefficient of a film.

    mu = min[mu(tau_E), Lambda]

    Parameters
    ----------
    point : FilmPoint
    eyring_stress : float
        tau_E [Pa].
    limit : float
        Limiting shear stress over pressure Lambda [-]; infinite: none.

    Returns
    -------
    float
        [-], not negative.

    Notes
    -----
    Law and range of mu(tau_E) as in `viscous_friction_coefficient`, [evans_johnson_1986].
    """
    state = point.state
    mu = viscous_friction_coefficient(
        point.film_thickness,
        point.mean_pressure,
        point.sliding_speed,
        state.eta0,
        state.alpha,
        state.beta,
        eyring_stress,
        state.conductivity,
        point.zeta,
    )
    return min(mu, limit)
