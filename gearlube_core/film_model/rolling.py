"""Film and rolling friction of a roller on its race by a frozen model of solved films.

The groups are those of a line contact in pure rolling. In place of a friction of sliding the
model's second output corrects the rolling force.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
from gearlube_core.film_model.groups import LEAST_SPEED, FilmGroups
from gearlube_core.film_model.inlet import FilmInlet, inlet_cooling
from gearlube_core.film_model.line_contact import (
    LEAST_LINE_LOAD,
    LineContact,
    LinePlace,
    line_contact_groups,
    line_groups_at,
    line_parts,
    line_reference_film,
)
from gearlube_core.film_model.net import net_outputs, share_outside, take_groups
from gearlube_core.film_model.solved_film import SolvedFilm, with_bounds
from gearlube_core.kernels.jit import kernel


class RollerContact(NamedTuple):
    """One line contact of a roller and a race of the same steel, in pure rolling; all floats, SI.

    The oil's numbers are those at the inlet.
    """

    line_load: float  # [N/m]
    contact_modulus: float  # E* [Pa]
    R: float  # relative radius across the line [m]
    speed: float  # of rolling: mean surface speed [m/s]
    eta0: float  # viscosity at ambient pressure [Pa s]
    alpha: float  # slope of ln eta at ambient pressure by Roelands [1/Pa]; idle with a modulus
    beta: float  # -d ln eta0/dT [1/K]
    tau0: float  # Eyring stress [Pa]; idle with an Eyring slope
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


@kernel
def rolling_line(contact: RollerContact) -> LineContact:
    """Return the line contact without sliding and without limiting stress."""
    c = contact
    return LineContact(
        c.line_load,
        c.contact_modulus,
        c.R,
        c.speed,
        0.0,
        c.eta0,
        c.alpha,
        c.beta,
        c.tau0,
        0.0,
        0.0,
        c.temperature,
        c.conductivity,
        c.heat_capacity,
        c.solid_conductivity,
        c.solid_heat_capacity,
        c.modulus,
        c.modulus_slope,
        c.modulus_turn,
        c.slope_turn,
        c.eyring_slope,
    )


@kernel
def rolling_groups(contact: RollerContact) -> FilmGroups:
    """Return the groups of a contact."""
    return line_contact_groups(rolling_line(contact))


@kernel
def reference_rolling_friction(line_load: float, speed: float, R: float, inlet: FilmInlet) -> float:
    """Return the coefficient of rolling friction that the model corrects [-].

    mu = 2 F/w, F of `biboulet_houpert_force` times `inlet_cooling`

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
    A contact loses 2 F u per length: mu is this loss over load times rolling speed.
    Source: [biboulet_houpert_2010].
    """
    modulus = 2.0 * inlet.contact_modulus
    force, _ = biboulet_houpert_force(R, line_load, modulus, inlet.eta0, inlet.alpha, speed)
    return 2.0 * force / line_load * inlet_cooling(speed, inlet)


@kernel
def solved_rolling_at(
    numbers: Array, line_load: float, speed: float, place: LinePlace, inlet: FilmInlet
) -> SolvedFilm:
    """Return film and rolling friction of a contact by the model.

    h = h_ref exp(y_1),  mu = mu_ref exp(y_2), with y of `net_outputs`

    Parameters
    ----------
    numbers : ndarray, shape (N_ARRAY,)
        `FilmModel.numbers` of a model of rollers. The call writes into its scratch: threads must
        not share it.
    line_load
        w [N/m]; below 1 N/m film and friction are those of 1 N/m.
    speed
        u, amount of the mean surface speed [m/s].
    place, inlet
        From `line_place`, once for each race, and `film_inlet`, once for each temperature.

    Returns
    -------
    SolvedFilm
        Its friction coefficient is that of rolling, 2 F/w: the film takes the power mu w u per
        length, F = mu w/2 on either surface. The rest as in `solved_film_at`.

    Notes
    -----
    Steady, flooded, smooth, steel at the oil's temperature, long lines in pure rolling: creep,
    drilling and the ends of rollers play no part.
    """
    w = max(line_load, LEAST_LINE_LOAD)
    speed = max(speed, LEAST_SPEED)
    p = line_mean_pressure(w, place.R, inlet.contact_modulus)
    film = line_reference_film(w, speed, place.R, inlet) * inlet_cooling(speed, inlet)
    take_groups(numbers, line_groups_at(film, w, p, speed, 0.0, place, inlet))
    outside = share_outside(numbers)
    y_film, y_friction = net_outputs(numbers)
    film *= math.exp(y_film)
    friction = reference_rolling_friction(w, speed, place.R, inlet) * math.exp(y_friction)
    return with_bounds(numbers, film, friction, p, 0.0, outside, inlet)


@kernel
def solved_rolling(numbers: Array, contact: RollerContact) -> SolvedFilm:
    """Return film and rolling friction of a contact from its plain numbers."""
    place, inlet = line_parts(rolling_line(contact))
    return solved_rolling_at(numbers, contact.line_load, contact.speed, place, inlet)
