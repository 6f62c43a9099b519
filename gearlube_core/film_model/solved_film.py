"""Film and friction of one contact by a frozen model of solved thermal Eyring films."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.film.chittenden_1985 import central_film_thickness
from gearlube_core.film_model.groups import (
    LEAST_LOAD,
    LEAST_SPEED,
    FilmContact,
    FilmInlet,
    FilmPlace,
    contact_parts,
    film_groups,
)
from gearlube_core.film_model.net import (
    BOUNDS,
    MODULUS,
    net_outputs,
    share_outside,
    smooth_step,
    take_groups,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import eyring_stress_ratio
from gearlube_core.oil.roelands_1966 import ROELANDS_PRESSURE

_STEEPEST = 1e-3  # least cos(psi) of the reference film
_MODULUS_MARGIN = 0.02  # of E*, to the full share outside
# share of the limiting stress that the mean stress may reach: where it begins to matter and where
# the model, which has none, says nothing
_LIMIT_BEGINS, _LIMIT_ENDS = 0.5, 0.8


class SolvedFilm(NamedTuple):
    """Film and friction of one contact; all floats."""

    central_film: float  # [m]
    friction_coefficient: float  # of the film alone [-]
    outside: float  # of what the model was trained for: 0 inside, 1 well outside [-]
    film_bound: float  # half-width of the 95 % band of the central film, relative [-]
    friction_bound: float  # the same of the friction [-]


class FilmCorrections(NamedTuple):
    """Natural logarithms of film and friction over their references; all floats."""

    film: float  # [-]
    friction: float  # [-]
    outside: float  # of what the model was trained for, see `SolvedFilm` [-]


@kernel
def reference_film(load: float, speed: float, place: FilmPlace, inlet: FilmInlet) -> float:
    """Return the central film that the model corrects [m].

    Chittenden et al. 1985 at psi = 0 with the component u cos(psi); arguments as in
    `solved_film_at`, load and speed above zero.
    """
    return central_film_thickness(
        place.R_x,
        place.side_flow,
        inlet.eta0,
        inlet.alpha,
        speed * max(place.cos_psi, _STEEPEST),
        load,
        2.0 * inlet.contact_modulus,
    )


@kernel
def reference_friction(film: float, p: float, slip: float, inlet: FilmInlet) -> float:
    """Return the friction coefficient that the model corrects [-].

    mu = (tau0/p) asinh(eta(p) slip/(h tau0)), eta after Roelands at the inlet's temperature

    Parameters
    ----------
    film
        Central film h [m].
    p
        Mean Hertz pressure [Pa].
    slip
        Amount of sliding [m/s].
    inlet
        Oil.
    """
    growth = math.exp(inlet.Z * math.log(1.0 + ROELANDS_PRESSURE * p)) - 1.0
    newtonian = inlet.eta0 * slip / (film * inlet.tau0)
    return inlet.tau0 / p * eyring_stress_ratio(newtonian, inlet.viscosity * growth)


@kernel
def film_corrections(
    numbers: Array, load: float, speed: float, slip: float, place: FilmPlace, inlet: FilmInlet
) -> FilmCorrections:
    """Return what the model adds to the references at a contact; arguments as in `solved_film_at`.

    Notes
    -----
    They vary slowly along a tooth engagement: between two of them they may be extrapolated.
    """
    speed = max(speed, LEAST_SPEED)
    p = place.pressure_coefficient * math.exp(math.log(max(load, LEAST_LOAD)) / 3.0)
    take_groups(numbers, film_groups(p, speed, slip, place, inlet))
    outside = share_outside(numbers)
    y_film, y_friction = net_outputs(numbers)
    other = abs(inlet.contact_modulus / numbers[MODULUS] - 1.0) / _MODULUS_MARGIN
    inside = (1.0 - outside) * (1.0 - smooth_step(other))
    return FilmCorrections(y_film, y_friction, 1.0 - inside)


@kernel
def corrected_film(
    numbers: Array,
    load: float,
    speed: float,
    slip: float,
    place: FilmPlace,
    inlet: FilmInlet,
    corrections: FilmCorrections,
) -> SolvedFilm:
    """Return film and friction of a contact with corrections found there or close by.

    h = h_ref exp(y_1),  mu = mu_ref(h) exp(y_2)

    Parameters
    ----------
    numbers, load, speed, slip, place, inlet
        As in `solved_film_at`; the numbers are read alone.
    corrections
        Of `film_corrections`.
    """
    load = max(load, LEAST_LOAD)
    speed = max(speed, LEAST_SPEED)
    p = place.pressure_coefficient * math.exp(math.log(load) / 3.0)
    film = reference_film(load, speed, place, inlet) * math.exp(corrections.film)
    friction = reference_friction(film, p, slip, inlet) * math.exp(corrections.friction)
    inside = 1.0 - corrections.outside
    limit = inlet.limiting_stress + inlet.limiting_slope * p
    if limit > 0.0:
        reached = (friction * p / limit - _LIMIT_BEGINS) / (_LIMIT_ENDS - _LIMIT_BEGINS)
        inside *= 1.0 - smooth_step(reached)
    return SolvedFilm(film, friction, 1.0 - inside, numbers[BOUNDS], numbers[BOUNDS + 1])


@kernel
def solved_film_at(
    numbers: Array, load: float, speed: float, slip: float, place: FilmPlace, inlet: FilmInlet
) -> SolvedFilm:
    """Return film and friction of a contact by the model.

    h = h_ref exp(y_1),  mu = mu_ref(h) exp(y_2), with y of `net_outputs`

    Parameters
    ----------
    numbers : ndarray, shape (N_ARRAY,)
        `FilmModel.numbers`. The call writes into its scratch: threads must not share it.
    load
        [N]; below 1e-3 N film and friction are those of 1e-3 N.
    speed, slip
        Amounts of entrainment and sliding [m/s].
    place, inlet
        From `film_place`, once for each place, and `film_inlet`, once for each temperature.

    Returns
    -------
    SolvedFilm
        Smooth once where `outside` is below 1. Blend with a formula by `outside`; at 1 film and
        friction are finite but mean nothing. The bounds are the same numbers everywhere and hold
        where `outside` is 0.

    Notes
    -----
    Steady, fully flooded, smooth flanks in bulk at the oil's temperature, no limiting stress: a
    contact whose mean stress comes near the limiting one counts as outside. The bounds hold for
    95 % of contacts drawn from the domain, not for each one.
    """
    corrections = film_corrections(numbers, load, speed, slip, place, inlet)
    return corrected_film(numbers, load, speed, slip, place, inlet, corrections)


@kernel
def solved_film(numbers: Array, contact: FilmContact) -> SolvedFilm:
    """Return film and friction of a contact from its plain numbers; see `solved_film_at`."""
    place, inlet = contact_parts(contact)
    load, speed, slip = contact.load, contact.entrainment_speed, contact.sliding_speed
    return solved_film_at(numbers, load, speed, slip, place, inlet)
