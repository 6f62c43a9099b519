"""Rolling force and film of one contact of a roller and a race, by any law of the raceways."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.losses.laws import (
    SOLVED_FILMS,
    aihara_heating,
    heating_factor,
    rolling_force,
)
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film.line_film import minimum_line_film_thickness
from gearlube_core.film_model.inlet import FilmInlet
from gearlube_core.film_model.line_contact import line_place, line_reference_film
from gearlube_core.film_model.model import ROLLER, SHIPPED, FilmModel, shipped_model
from gearlube_core.film_model.rolling import solved_rolling_at
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import has_own_law
from gearlube_core.oil.lubricant_state import LubricantState

ROLLER_MODEL = SHIPPED[ROLLER]  # name of the film model in the package
NO_ROLLER_MODEL = np.empty(0)  # in place of its numbers, for laws without one
# How far off the formulas are where the model does not hold, relative to them, see
# docs/film_model/outside_rollers.py
FORMULA_FORCE_BOUND = 0.5
FORMULA_RACE_FILM_BOUND = 0.4


class RaceRolling(NamedTuple):
    """One contact; all floats, SI."""

    force: float  # F on either surface per length, flooded [N/m]
    film: float  # smallest film; by solved films the central one [m]
    outside: float  # of the range of the law: 0 or 1; of the film model's domain: 0 to 1 [-]


def roller_film_model(law: str, own: FilmModel | None = None) -> Array:
    """Return the numbers of the film model that a law takes, a copy of its own; empty: none.

    Kernels write into them: two threads must not share them.

    Parameters
    ----------
    law
        One of `laws.LAWS`.
    own
        A model of rollers in place of the one in the package.
    """
    if law != "solved_films":
        return NO_ROLLER_MODEL
    return (own or shipped_model(ROLLER)).copied_numbers()


@kernel
def solved_race(
    R: float,
    line_load: float,
    speed: float,
    oil: LubricantState,
    solid: SolidParameters,
    inlet: FilmInlet,
    film_model: Array,
) -> RaceRolling:
    """Return rolling force and central film by the film model; arguments as in `race_rolling`.

    Notes
    -----
    Towards the outside of the model's domain both go over into formulas with the weight `outside`:
    the force of Biboulet and Houpert with Aihara's heating, the film of Moes, which unlike that of
    Dowson and Toyoda holds for light contacts as well.
    """
    place = line_place(R, solid.conductivity, solid.density * solid.heat_capacity)
    found = solved_rolling_at(film_model, line_load, speed, place, inlet)
    force, film, w = 0.5 * found.friction_coefficient * line_load, found.central_film, found.outside
    if has_own_law(oil):
        w = 1.0
    if w > 0.0:
        E = 2.0 * solid.contact_modulus
        number = inlet_heating_number(oil.eta0, oil.beta, speed, oil.conductivity)
        cold, _ = biboulet_houpert_force(R, line_load, E, oil.eta0, oil.alpha, speed)
        force += w * (cold * aihara_heating(number) - force)
        film += w * (line_reference_film(line_load, speed, R, inlet) - film)
    return RaceRolling(force, film, w)


@kernel
def race_rolling(
    law: int,
    heating: int,
    R: float,
    line_load: float,
    speed: float,
    oil: LubricantState,
    solid: SolidParameters,
    inlet: FilmInlet,
    film_model: Array,
) -> RaceRolling:
    """Return rolling force and film of one flooded contact, heated once.

    Parameters
    ----------
    law
        Value of `laws.RACE_LAWS`.
    heating
        Value of `laws.HEATINGS`; solved films are heated by themselves.
    R
        Relative radius [m].
    line_load
        q, above zero [N/m].
    speed
        u of rolling, above zero [m/s].
    oil
        Oil at the inlet temperature.
    solid
        Material of roller and race.
    inlet
        Of `model_inlet`.
    film_model : ndarray
        Numbers of the film model, written into; empty with other laws.
    """
    if law == SOLVED_FILMS:
        return solved_race(R, line_load, speed, oil, solid, inlet, film_model)
    E = 2.0 * solid.contact_modulus
    force, status = rolling_force(law, R, line_load, E, oil.eta0, oil.alpha, speed)
    film = minimum_line_film_thickness(R, oil.eta0, oil.alpha, speed, line_load, E)
    number = inlet_heating_number(oil.eta0, oil.beta, speed, oil.conductivity)
    pressure_ratio = math.sqrt(line_load / (2.0 * math.pi * R * E))
    force *= heating_factor(heating, number, pressure_ratio)
    return RaceRolling(force, film, float(status))
