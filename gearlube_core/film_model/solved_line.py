"""Film and friction of one line contact by a frozen model of solved thermal Eyring films."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.contact.line_hertz import line_mean_pressure
from gearlube_core.film_model.groups import LEAST_SPEED, FilmInlet
from gearlube_core.film_model.line_contact import (
    LEAST_LINE_LOAD,
    LineContact,
    LinePlace,
    line_groups_at,
    line_parts,
    line_reference_film,
)
from gearlube_core.film_model.net import net_outputs, share_outside, take_groups
from gearlube_core.film_model.reference_friction import line_reference_friction
from gearlube_core.film_model.solved_film import SolvedFilm, with_bounds
from gearlube_core.kernels.jit import kernel


@kernel
def solved_line_at(
    numbers: Array,
    line_load: float,
    speed: float,
    slip: float,
    place: LinePlace,
    inlet: FilmInlet,
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
    film = line_reference_film(w, speed, place.R, inlet)
    take_groups(numbers, line_groups_at(film, w, p, speed, slip, place, inlet))
    outside = share_outside(numbers)
    y_film, y_friction = net_outputs(numbers)
    film *= math.exp(y_film)
    friction = line_reference_friction(film, p, speed, slip, 0.5 * w / p, place.R, inlet)
    friction *= math.exp(y_friction)
    return with_bounds(numbers, film, friction, p, outside, inlet)


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
