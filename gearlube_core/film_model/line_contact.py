"""Dimensionless groups of one line contact with a thermal Eyring film.

The groups are those of `FilmGroups`, so that one net serves ellipses and lines. A line has neither
ellipticity nor angles: these three are zero.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.film.groups import line_moes_groups
from gearlube_core.film.line_film import central_film_group
from gearlube_core.film_model.groups import LEAST_SPEED, THIN, FilmGroups
from gearlube_core.film_model.inlet import FilmInlet, contact_inlet, inlet_cooling, oil_under
from gearlube_core.kernels.jit import kernel

LEAST_LINE_LOAD = 1.0  # N/m, film and pressure of an unloaded line are those at this load
# Slide-roll ratio below which the model's corrections change no more. Heat is gone there; that the
# stress becomes linear in sliding is left to the reference friction.
LEAST_SLIDING = 0.003


class LineContact(NamedTuple):
    """One line contact of equal solids and its oil at the inlet; all floats, SI."""

    line_load: float  # [N/m]
    contact_modulus: float  # E* [Pa]
    R: float  # relative radius across the line [m]
    entrainment_speed: float  # mean surface speed across the line [m/s]
    sliding_speed: float  # amount of the difference of both, across the line [m/s]
    eta0: float  # viscosity at ambient pressure [Pa s]
    alpha: float  # slope of ln eta at ambient pressure by Roelands [1/Pa]; idle with a modulus
    beta: float  # -d ln eta0/dT [1/K]
    tau0: float  # Eyring stress [Pa]; idle with an Eyring slope
    limiting_stress: float  # of the oil at ambient pressure [Pa]; with the slope 0: none
    limiting_slope: float  # its slope with pressure [-]
    temperature: float  # of oil and solids at the inlet [K]
    conductivity: float  # of the oil [W/(m K)]
    heat_capacity: float  # of the oil by volume, density times specific [J/(m3 K)]
    solid_conductivity: float  # [W/(m K)]
    solid_heat_capacity: float  # by volume [J/(m3 K)]
    modulus: float = 0.0  # A of the pressure factor at the inlet [Pa]; 0: Roelands and Houpert
    modulus_slope: float = 0.0  # B [-]
    modulus_turn: float = 0.0  # dA/dT [Pa/K]
    slope_turn: float = 0.0  # dB/dT [1/K]
    eyring_slope: float = 0.0  # Lambda [-]; 0: the constant tau0 without a limit


class LinePlace(NamedTuple):
    """Groups that depend on the place of a contact on the flank alone; all floats."""

    R: float  # [m]
    log_R: float  # ln R, R in m
    peclet: float  # ln(R rho c/k) of the solids, u in m/s


@kernel
def line_place(R: float, solid_conductivity: float, solid_heat_capacity: float) -> LinePlace:
    """Return the numbers of a place; arguments as the fields of `LineContact`."""
    return LinePlace(
        R,
        math.log(R),
        math.log(R * solid_heat_capacity / solid_conductivity),
    )


@kernel
def line_parts(contact: LineContact) -> tuple[LinePlace, FilmInlet]:
    """Return place and inlet of a contact."""
    c = contact
    place = line_place(c.R, c.solid_conductivity, c.solid_heat_capacity)
    return place, contact_inlet(c)


@kernel
def line_reference_film(line_load: float, speed: float, R: float, inlet: FilmInlet) -> float:
    """Return the central film that the model corrects [m].

    h = R (2 U)^(1/2) H(M, L), H of `central_film_group`

    Parameters
    ----------
    line_load, speed
        Above zero [N/m], [m/s].
    R
        Relative radius [m].
    inlet
        From `film_inlet`.

    Notes
    -----
    Moes' formula joins rigid and elastic, isoviscous and piezoviscous lines, all of which gear
    teeth visit. The power law of Dowson and Toyoda, which the models take as their formula, holds
    for one of these regimes alone.
    Source: [moes_1992].
    """
    modulus = 2.0 * inlet.contact_modulus
    M, L = line_moes_groups(R, inlet.eta0, inlet.alpha, speed, line_load, modulus)
    return R * math.sqrt(2.0 * inlet.eta0 * speed / (modulus * R)) * central_film_group(M, L)


@kernel
def line_groups_at(
    film: float,
    line_load: float,
    p: float,
    speed: float,
    slip: float,
    place: LinePlace,
    inlet: FilmInlet,
) -> FilmGroups:
    """Return the groups of a contact.

    slide_roll = ln[(slip/u)^2 + 0.003^2]/2, which stays finite in pure rolling;
    thickness = ln[(h R)^(1/2)/b], b = w/(2 p)

    Parameters
    ----------
    film
        `line_reference_film` [m].
    line_load
        w, above zero [N/m].
    p
        Mean Hertz pressure, above zero [Pa].
    speed, slip
        Amounts of entrainment, above zero, and of sliding [m/s].
    place, inlet
        From `line_place` and `film_inlet`.
    """
    log_speed = math.log(speed)
    ratio = slip / speed
    under = oil_under(p, inlet)
    thickness = math.log(math.sqrt(film * place.R) * 2.0 * p / line_load)
    return FilmGroups(
        math.log(p / inlet.contact_modulus),
        0.0,
        0.0,
        0.5 * math.log(ratio * ratio + LEAST_SLIDING * LEAST_SLIDING),
        0.0,
        math.log(inlet.alpha * p) - THIN * thickness,
        math.log(under.log_ratio / (inlet.alpha * p)),
        math.log(under.stress / inlet.contact_modulus),
        1.0 if inlet.eyring_slope > 0.0 else 0.0,
        inlet.rate + log_speed - place.log_R,
        place.peclet + log_speed,
        math.log(under.decline / inlet.beta),
        inlet.warmth,
        inlet.conductivity,
        inlet.capacity,
        inlet.heat + 2.0 * log_speed,
        thickness,
    )


@kernel
def line_contact_groups(contact: LineContact) -> FilmGroups:
    """Return the groups of a contact."""
    place, inlet = line_parts(contact)
    w = max(contact.line_load, LEAST_LINE_LOAD)
    p = line_mean_pressure(w, contact.R, contact.contact_modulus)
    speed = max(contact.entrainment_speed, LEAST_SPEED)
    film = line_reference_film(w, speed, contact.R, inlet) * inlet_cooling(speed, inlet)
    return line_groups_at(film, w, p, speed, contact.sliding_speed, place, inlet)
