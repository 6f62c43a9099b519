"""Measured traction of a rolling and sliding contact, from a table."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.contact.hertz import hertz_coefficients
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.errors import ParameterError
from gearlube_core.film.line_film import line_film_thickness
from gearlube_core.film.point_film import central_film_thickness, film_geometry
from gearlube_core.friction.evans_johnson_1986 import (
    solid_resistance,
    surface_heating_number,
    viscous_friction_coefficient,
)
from gearlube_core.input_file.table import Table, read_table
from gearlube_core.oil.formula_laws import mean_slope
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.units import celsius_to_kelvin

CONTACTS = ("point", "line")
MAX_OVER_MEAN = {"point": 1.5, "line": 4.0 / math.pi}  # Hertz pressure
FEWEST_POINTS = 5
# column: low, high, unit, cure
_COLUMNS = {
    "slide_roll_ratio": (-2.0, 2.0, "", "It is sliding speed over mean speed; 5 % is 0.05."),
    "sliding_speed_m_s": (-200.0, 200.0, "m/s", "It is the difference of the surface speeds."),
    "entrainment_speed_m_s": (0.001, 200.0, "m/s", "It is the mean of the surface speeds."),
    "mean_pressure_gpa": (0.05, 5.0, "GPa", "500 MPa is 0.5 GPa."),
    "hertz_pressure_gpa": (0.05, 5.0, "GPa", "500 MPa is 0.5 GPa."),
    "temperature_degc": (-60.0, 250.0, "degC", "Of the oil at the inlet; 333 K is 60 degC."),
    "traction_coefficient": (-0.5, 0.5, "", "Traction over load; 5 % is 0.05."),
}
_ALWAYS = ("entrainment_speed_m_s", "temperature_degc", "traction_coefficient")
_EITHER = (("slide_roll_ratio", "sliding_speed_m_s"), ("mean_pressure_gpa", "hertz_pressure_gpa"))


class FilmPoint(NamedTuple):
    """Inputs of the traction of one measured point besides both stresses; all floats, SI."""

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
        mean_slope(state.viscosity, state, point.mean_pressure),
        state.beta,
        eyring_stress,
        state.conductivity,
        point.zeta,
    )
    return min(mu, limit)


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionMeasurements:
    """Measured points, arrays of shape (n,).

    Parameters
    ----------
    sliding_speed, entrainment_speed : ndarray
        Difference, without sign, and mean of the surface speeds [m/s].
    mean_pressure : ndarray
        [Pa].
    temperature : ndarray
        Of the oil at the inlet [K].
    traction : ndarray
        Coefficient, without sign [-].
    """

    sliding_speed: Array
    entrainment_speed: Array
    mean_pressure: Array
    temperature: Array
    traction: Array

    def __len__(self) -> int:
        return self.traction.size

    @property
    def curve(self) -> npt.NDArray[np.intp]:
        """Number of the curve of each point: equal speed, pressure and temperature."""
        conditions = np.column_stack([self.entrainment_speed, self.mean_pressure, self.temperature])
        return np.unique(np.round(conditions, 6), axis=0, return_inverse=True)[1].reshape(-1)


def read_traction(path: str | Path, contact: str) -> TractionMeasurements:
    """Return the measurements of a table, see `read_table`.

    Parameters
    ----------
    path : path
        Columns `slide_roll_ratio` or `sliding_speed_m_s`,
        `entrainment_speed_m_s`, `mean_pressure_gpa` or `hertz_pressure_gpa` (the largest),
        `temperature_degc`, `traction_coefficient`. Other columns are not read.
    contact : {"point", "line"}
        From which follows the mean of a largest Hertz pressure.

    Raises
    ------
    ParameterError
        The file cannot be read, a column is missing or there twice, or a number is wrong.
    """
    check_option("contact", contact, CONTACTS)
    table = read_table(path, _ALWAYS, fewest=FEWEST_POINTS)
    needed = (*_ALWAYS, *(_either(path, table, pair) for pair in _EITHER))
    slip, pressure = needed[len(_ALWAYS) :]
    data = {name: table.column(name, *_COLUMNS[name]) for name in needed}
    speed = data["entrainment_speed_m_s"]
    sliding = data[slip] * speed if slip == "slide_roll_ratio" else data[slip]
    if not np.any(sliding):
        raise ParameterError(f"{path} must have points with sliding, got none.")
    # without the sign of braking or driving, if traction has that of sliding
    sign = np.where(sliding < 0.0, -1.0, 1.0) if np.any(data["traction_coefficient"] < 0.0) else 1.0
    mean = data[pressure] * 1e9
    if pressure == "hertz_pressure_gpa":
        mean = mean / MAX_OVER_MEAN[contact]
    return TractionMeasurements(
        sliding_speed=np.abs(sliding),
        entrainment_speed=speed,
        mean_pressure=mean,
        temperature=np.array([celsius_to_kelvin(t) for t in data["temperature_degc"]]),
        traction=sign * data["traction_coefficient"],
    )


def _either(path: str | Path, table: Table, pair: tuple[str, str]) -> str:
    found = [name for name in pair if name in table.places]
    if len(found) != 1:
        raise ParameterError(
            f"{path} must have one of the columns {pair[0]} and {pair[1]}, got "
            f"{'both' if found else f'none of them among {chr(44).join(table.names)}'}."
        )
    return found[0]
