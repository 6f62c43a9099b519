"""Film and friction of one contact by a frozen model of solved thermal Eyring films."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.film_model.groups import (
    LEAST_LOAD,
    LEAST_SPEED,
    FilmContact,
    FilmPlace,
    contact_parts,
    film_groups,
    reference_film,
    semi_minor_axis,
)
from gearlube_core.film_model.inlet import FilmInlet, inlet_cooling
from gearlube_core.film_model.line_contact import (
    LEAST_LINE_LOAD,
    LineContact,
    LinePlace,
    line_groups_at,
    line_parts,
    line_reference_film,
)
from gearlube_core.film_model.net import (
    BOUNDS,
    MODULUS,
    net_outputs,
    share_outside,
    smooth_step,
    take_groups,
)
from gearlube_core.film_model.reference_friction import (
    film_resistance,
    line_reference_friction,
    reference_friction,
)
from gearlube_core.kernels.jit import kernel

MODULUS_MARGIN = 0.02  # of E*, to the full share outside
# share of the limiting stress that the mean stress may reach: where it begins to matter and where
# the model, which has none, says nothing
_LIMIT_BEGINS, _LIMIT_ENDS = 0.5, 0.8
HOTTEST, _TOO_HOT = 150.0, 200.0  # K, the film's mean rise over the inlet, likewise


class SolvedFilm(NamedTuple):
    """Film and friction of one contact; all floats."""

    central_film: float  # [m]
    friction_coefficient: float  # of the film alone [-]
    outside: float  # of what the model was trained for: 0 inside, 1 well outside [-]
    film_bound: float  # half-width of the 95 % band of the central film, relative [-]
    friction_bound: float  # the same of the friction [-]


@kernel
def with_bounds(
    numbers: Array,
    film: float,
    friction: float,
    p: float,
    rise: float,
    outside: float,
    inlet: FilmInlet,
) -> SolvedFilm:
    """Return film and friction with the share outside for solids, heat and limiting stress as well.

    Parameters
    ----------
    numbers
        Numbers of the film model.
    film, friction
        By it [m], [-].
    p
        Mean Hertz pressure [Pa].
    rise
        Of the film over the inlet [K].
    outside
        Of `share_outside`.
    inlet
        From `film_inlet`.
    """
    other = abs(inlet.contact_modulus / numbers[MODULUS] - 1.0) / MODULUS_MARGIN
    inside = (1.0 - outside) * (1.0 - smooth_step(other))
    inside *= 1.0 - smooth_step((rise - HOTTEST) / (_TOO_HOT - HOTTEST))
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
    load = max(load, LEAST_LOAD)
    speed = max(speed, LEAST_SPEED)
    p = place.pressure_coefficient * math.exp(math.log(load) / 3.0)
    film = reference_film(load, speed, place, inlet)
    take_groups(numbers, film_groups(film, load, p, speed, slip, place, inlet))
    outside = share_outside(numbers)
    y_film, y_friction = net_outputs(numbers)
    film *= math.exp(y_film)
    across = speed * place.cos_psi
    semi_axis = semi_minor_axis(load, p, place)
    friction = reference_friction(film, p, across, slip, semi_axis, place.R_x, inlet) * math.exp(
        y_friction
    )
    rise = friction * p * slip * film_resistance(film, across, semi_axis, inlet)
    return with_bounds(numbers, film, friction, p, rise, outside, inlet)


@kernel
def solved_film(numbers: Array, contact: FilmContact) -> SolvedFilm:
    """Return film and friction of a contact from its plain numbers; see `solved_film_at`."""
    place, inlet = contact_parts(contact)
    load, speed, slip = contact.load, contact.entrainment_speed, contact.sliding_speed
    return solved_film_at(numbers, load, speed, slip, place, inlet)


@kernel
def solved_line_at(
    numbers: Array, line_load: float, speed: float, slip: float, place: LinePlace, inlet: FilmInlet
) -> SolvedFilm:
    """Return film and friction of a line contact by the model.

    h = h_ref exp(y_1),  mu = mu_ref(h) exp(y_2), with y of `net_outputs`

    Parameters
    ----------
    numbers : ndarray, shape (N_ARRAY,)
        `FilmModel.numbers` of a model of lines. The call writes into its scratch: threads must not
        share it.
    line_load
        [N/m]; below 1 N/m film and friction are those of 1 N/m.
    speed, slip
        Amounts of entrainment and sliding [m/s].
    place, inlet
        From `line_place`, once for each place, and `film_inlet`, once for each temperature.

    Returns
    -------
    SolvedFilm
        As in `solved_film_at`.

    Notes
    -----
    Long lines, of which ends play no part; the rest as in `solved_film_at`. Below a slide-roll
    ratio of 0.003 the corrections are those of there.
    """
    w = max(line_load, LEAST_LINE_LOAD)
    speed = max(speed, LEAST_SPEED)
    p = line_mean_pressure(w, place.R, inlet.contact_modulus)
    film = line_reference_film(w, speed, place.R, inlet) * inlet_cooling(speed, inlet)
    take_groups(numbers, line_groups_at(film, w, p, speed, slip, place, inlet))
    outside = share_outside(numbers)
    y_film, y_friction = net_outputs(numbers)
    film *= math.exp(y_film)
    half = 0.5 * w / p
    friction = line_reference_friction(film, p, speed, slip, half, place.R, inlet)
    friction *= math.exp(y_friction)
    rise = friction * p * slip * film_resistance(film, speed, half, inlet)
    return with_bounds(numbers, film, friction, p, rise, outside, inlet)


@kernel
def solved_line(numbers: Array, contact: LineContact) -> SolvedFilm:
    """Return film and friction of a contact from its plain numbers; see `solved_line_at`."""
    place, inlet = line_parts(contact)
    return solved_line_at(
        numbers,
        contact.line_load,
        contact.entrainment_speed,
        contact.sliding_speed,
        place,
        inlet,
    )
