"""Rolling friction and films of the rollers of a shaft by a model of solved films."""

from __future__ import annotations

import math

from gearlube_core.bearings.bearing_type import (
    NO_RACEWAYS,
    RollerFilms,
    ShaftMotion,
    SolvedRaceways,
)
from gearlube_core.bearings.losses.race_rolling import roller_inlet
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.raceway_drag import line_radii, steady_load, steady_rollers
from gearlube_core.bearings.roller_nodes import (
    Races,
    centre_nodes,
    kept_roller_film,
    roller_film,
)
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState


@kernel
def races_of(oil: LubricantState, p: BearingParameters) -> Races:
    """Return what the rollers of a shaft share."""
    solid = SolidParameters(0.5 * p.reduced_modulus, p.conductivity, p.density, p.heat_capacity)
    R_inner, R_outer = line_radii(p)
    return Races(R_inner, R_outer, solid, oil, roller_inlet(oil, solid))


@kernel
def solved_raceway_drag(
    motion: ShaftMotion, oil: LubricantState, p: BearingParameters, films: RollerFilms
) -> SolvedRaceways:
    """Return torque, bound and films of the raceways of both bearings.

    T = sum over rollers and races of 2 F r_u l

    Parameters
    ----------
    motion
        Of the shaft; its velocities play no part.
    oil
        At the inlet.
    p
        Either bearing.
    films
        With the nodes of this shaft.

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
    total = doubt = carried = outside = 0.0
    first_film = first_bound = thinnest = bound = 0.0
    for bearing in range(2):
        thinnest, bound, loaded = math.inf, 0.0, 0
        for i in range(int(p.n_rollers)):
            load = steady_load(rollers, 1.0 - 2.0 * bearing, i, p)
            if load <= 0.0:
                continue
            q = load / p.roller_length
            if films.kept != 0.0:
                found = kept_roller_film(q, u, faster, races, films.nodes, films.model)
            else:
                found = roller_film(q, u, races, films.model)
            total += found.force
            doubt += found.force * found.force_bound
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
        arm * doubt,
        carried,
        outside,
        first_film,
        first_bound,
        thinnest,
        bound,
    )
