"""Rolling force and film of a roller between its races by solved films, kept over its load.

All rollers of a shaft roll at one speed, in one oil, on the same two radii: they differ in load
alone. So the film model is evaluated at fixed loads, when a roller first comes near them, and kept
with slopes over speed until speed or oil have changed. Between these loads the logarithms of force
and film are cubic in that of the load.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    NO_RACEWAYS,
    RollerFilms,
    ShaftMotion,
    SolvedRaceways,
)
from gearlube_core.bearings.losses.race_rolling import (
    FORMULA_FORCE_BOUND,
    FORMULA_RACE_FILM_BOUND,
    solved_race,
)
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.raceway_drag import line_radii, steady_load, steady_rollers
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film_model import net
from gearlube_core.film_model.inlet import FilmInlet, model_inlet
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

_SPEED, _OIL, _FIRST = 0, 1, 2  # rolling speed [m/s] and oil temperature [K] of then; first node
_KNOWN, _FORCE, _FILM, _OUTSIDE, _FORCE_BOUND, _FILM_BOUND, _OVER_FORCE, _OVER_FILM = range(8)
_N_NODE = 8
_LOWEST = math.log(300.0)  # of the load per length [N/m]
_STEP = 0.15
_NODES = 56  # up to 1.1 MN/m, some 3 GPa
N_ROLLER_NODES = _FIRST + _NODES * _N_NODE
# relative change of speed that slopes are taken over, and what asks for new values
_NUDGE = 0.02
_REACH = 0.03
_OIL_REACH = 0.02  # K; a kelvin changes the force by 2 %


class Races(NamedTuple):
    """Data that the rollers of a shaft share: races and oil."""

    R_inner: float  # relative radii [m]
    R_outer: float
    solid: SolidParameters
    oil: LubricantState
    inlet: FilmInlet


class RollerFilm(NamedTuple):
    """A roller between its races under one load; all floats."""

    force: float  # rolling force on either surface per length, both races together [N/m]
    log_film: float  # ln of the thinner of both central films in m
    outside: float  # of the film model's domain, mean of both races: 0 to 1 [-]
    force_bound: float  # of the force, relative [-]
    film_bound: float  # of the film, relative [-]


@kernel
def roller_film(line_load: float, speed: float, races: Races, film_model: Array) -> RollerFilm:
    """Return film and force of a roller by the film model; outside its domain by formulas.

    Parameters
    ----------
    line_load, speed
        Load per length, above zero [N/m]; of rolling, above zero [m/s].
    races
        Races of the shaft's bearings.
    film_model : ndarray, shape (net.N_ARRAY,)
        Numbers of the film model of rollers, written into.
    """
    solid, oil, inlet = races.solid, races.oil, races.inlet
    inner = solved_race(races.R_inner, line_load, speed, oil, solid, inlet, film_model)
    outer = solved_race(races.R_outer, line_load, speed, oil, solid, inlet, film_model)
    force = inner.force + outer.force
    of_model, of_film = film_model[net.BOUNDS + 1], film_model[net.BOUNDS]
    beyond = (inner.outside * inner.force + outer.outside * outer.force) / force
    thinner = inner if inner.film < outer.film else outer
    return RollerFilm(
        force,
        math.log(thinner.film),
        0.5 * (inner.outside + outer.outside),
        of_model + beyond * (FORMULA_FORCE_BOUND - of_model),
        of_film + thinner.outside * (FORMULA_RACE_FILM_BOUND - of_film),
    )


@kernel
def centre_nodes(nodes: Array, speed: float, temperature: float) -> float:
    """Forget what is kept if speed or oil have changed since; return ln of speed over that of then.

    Parameters
    ----------
    nodes : ndarray of shape (N_ROLLER_NODES,)
        What is kept of one shaft; zeros: nothing.
    speed, temperature
        Of rolling, above zero [m/s], and of the oil [K].
    """
    then = nodes[_SPEED]
    if abs(speed - then) <= _REACH * then and abs(temperature - nodes[_OIL]) <= _OIL_REACH:
        return math.log(speed / then)
    nodes[_SPEED] = speed
    nodes[_OIL] = temperature
    for i in range(_NODES):
        nodes[_FIRST + i * _N_NODE + _KNOWN] = 0.0
    return 0.0


@kernel
def _know_node(i: int, races: Races, nodes: Array, film_model: Array) -> int:
    """Evaluate node `i` if it is not kept; return its place."""
    at = _FIRST + i * _N_NODE
    if nodes[at + _KNOWN] == 0.0:
        q, u = math.exp(_LOWEST + _STEP * i), nodes[_SPEED]
        here = roller_film(q, u, races, film_model)
        faster = roller_film(q, u * (1.0 + _NUDGE), races, film_model)
        per = 1.0 / math.log(1.0 + _NUDGE)
        nodes[at + _FORCE] = math.log(here.force)
        nodes[at + _FILM] = here.log_film
        nodes[at + _OUTSIDE] = here.outside
        nodes[at + _FORCE_BOUND] = here.force_bound
        nodes[at + _FILM_BOUND] = here.film_bound
        nodes[at + _OVER_FORCE] = per * math.log(faster.force / here.force)
        nodes[at + _OVER_FILM] = per * (faster.log_film - here.log_film)
        nodes[at + _KNOWN] = 1.0
    return at


@kernel
def kept_roller_film(
    line_load: float, speed: float, faster: float, races: Races, nodes: Array, film_model: Array
) -> RollerFilm:
    """Return `roller_film` between nodes; beyond them itself. `faster` is of `centre_nodes`."""
    x = (math.log(line_load) - _LOWEST) / _STEP
    if not 1.0 <= x < _NODES - 2:
        return roller_film(line_load, speed, races, film_model)
    i = int(x)
    t = x - i
    a = _know_node(i - 1, races, nodes, film_model)
    b = _know_node(i, races, nodes, film_model)
    c = _know_node(i + 1, races, nodes, film_model)
    d = _know_node(i + 2, races, nodes, film_model)
    # Lagrange's cubic through four nodes
    w_a = -t * (t - 1.0) * (t - 2.0) / 6.0
    w_b = (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0
    w_c = -(t + 1.0) * t * (t - 2.0) / 2.0
    w_d = (t + 1.0) * t * (t - 1.0) / 6.0
    force = w_a * (nodes[a + _FORCE] + nodes[a + _OVER_FORCE] * faster)
    force += w_b * (nodes[b + _FORCE] + nodes[b + _OVER_FORCE] * faster)
    force += w_c * (nodes[c + _FORCE] + nodes[c + _OVER_FORCE] * faster)
    force += w_d * (nodes[d + _FORCE] + nodes[d + _OVER_FORCE] * faster)
    film = w_a * (nodes[a + _FILM] + nodes[a + _OVER_FILM] * faster)
    film += w_b * (nodes[b + _FILM] + nodes[b + _OVER_FILM] * faster)
    film += w_c * (nodes[c + _FILM] + nodes[c + _OVER_FILM] * faster)
    film += w_d * (nodes[d + _FILM] + nodes[d + _OVER_FILM] * faster)
    s = 1.0 - t
    return RollerFilm(
        math.exp(force),
        film,
        s * nodes[b + _OUTSIDE] + t * nodes[c + _OUTSIDE],
        s * nodes[b + _FORCE_BOUND] + t * nodes[c + _FORCE_BOUND],
        s * nodes[b + _FILM_BOUND] + t * nodes[c + _FILM_BOUND],
    )


@kernel
def races_of(oil: LubricantState, p: BearingParameters) -> Races:
    """Return the data that the rollers of a shaft share."""
    solid = SolidParameters(0.5 * p.reduced_modulus, p.conductivity, p.density, p.heat_capacity)
    R_inner, R_outer = line_radii(p)
    return Races(R_inner, R_outer, solid, oil, model_inlet(oil, solid, 0.0))


@kernel
def solved_raceway_drag(
    motion: ShaftMotion,
    oil: LubricantState,
    p: BearingParameters,
    films: RollerFilms,
    side: float = 0.0,
) -> SolvedRaceways:
    """Return torque, bound and films of the raceways of the bearings.

    T = sum over rollers and races of 2 F r_u l

    Parameters
    ----------
    motion
        Of the shaft; its velocities play no part.
    oil
        Oil at the inlet temperature.
    p
        Numbers of a bearing of either type.
    films
        With the nodes of this shaft.
    side
        0: both bearings; +1 or -1: the one of that side alone.

    Notes
    -----
    As `raceway_drag`, with F of solved films, which heat themselves. Bounds of single rollers add:
    what the model misses is much the same for all.
    """
    u = p.film_speed_radius * abs(motion.speed)
    if u == 0.0:
        return NO_RACEWAYS
    races = races_of(oil, p)
    faster = 0.0
    if films.kept != 0.0:
        faster = centre_nodes(films.nodes, u, oil.temperature)
    rollers = steady_rollers(motion, oil, p)
    total = error = carried = outside = 0.0
    first_film = first_bound = thinnest = bound = 0.0
    for bearing in range(2):
        here = 1.0 - 2.0 * bearing
        thinnest, bound, loaded = math.inf, 0.0, 0
        for i in range(int(p.n_rollers) if here * side >= 0.0 else 0):
            load = steady_load(rollers, here, i, p)
            if load <= 0.0:
                continue
            q = load / p.roller_length
            if films.kept != 0.0:
                found = kept_roller_film(q, u, faster, races, films.nodes, films.model)
            else:
                found = roller_film(q, u, races, films.model)
            total += found.force
            error += found.force * found.force_bound
            carried += load
            outside += load * found.outside
            loaded += 1
            if found.log_film < thinnest:
                thinnest = found.log_film
                bound = found.film_bound
        thinnest = math.exp(thinnest) if loaded > 0 else 0.0
        if bearing == 0:
            first_film = thinnest
            first_bound = bound
    arm = 2.0 * p.film_speed_radius * p.roller_length
    torque = arm * total
    if motion.speed < 0.0:
        torque = -torque
    return SolvedRaceways(
        torque,
        arm * error,
        carried,
        outside,
        first_film,
        first_bound,
        thinnest,
        bound,
    )
