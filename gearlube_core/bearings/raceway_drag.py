"""Drag torque of the raceways of two opposed bearings, or one, under the load of each roller."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.losses.laws import heating_factor, rolling_force, usual_heating
from gearlube_core.bearings.parameters import (
    COS_TABLE,
    FILM_FLOOR_APPROACH,
    SIN_TABLE,
    ApproachTerms,
    BearingParameters,
    approach_terms,
)
from gearlube_core.bearings.roller_contact import (
    N_LINE,
    film_amplitude,
    roller_load_general,
    roller_load_line,
)
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState


class SteadyRollers(NamedTuple):
    """Inputs of the steady loads of the rollers of both bearings."""

    terms: ApproachTerms
    film: float
    floor_load: float  # N


@kernel
def steady_rollers(motion: ShaftMotion, oil: LubricantState, p: BearingParameters) -> SteadyRollers:
    """Return the inputs of the roller loads at rest at this motion."""
    film, _ = film_amplitude(motion.speed, oil.eta0, oil.alpha, p)
    terms = approach_terms(motion, math.cos(motion.cage_angle), math.sin(motion.cage_angle), p)
    return SteadyRollers(terms, film, p.kn * FILM_FLOOR_APPROACH**p.n)


@kernel
def steady_load(rollers: SteadyRollers, side: float, i: int, p: BearingParameters) -> float:
    """Return the load of roller `i` of the bearing on `side`, +1 or -1 [N]."""
    terms, film, K = rollers
    count = int(p.n_rollers)
    g = terms.g0 + side * terms.ga
    g += terms.g1 * COS_TABLE[count, i] + terms.g2 * SIN_TABLE[count, i]
    if p.n == N_LINE:
        load, _ = roller_load_line(g, 0.0, film, 0.0, K, 0.0, 0.0)
    else:
        load, _ = roller_load_general(g, 0.0, film, 0.0, K, 0.0, 0.0, p.n)
    return load


@kernel
def line_radii(p: BearingParameters) -> tuple[float, float]:
    """Return the relative radii of a roller on the inner and on the outer race [m].

    The races are cones: their curvature lies across the line of contact.
    """
    return (
        1.0 / (1.0 / p.roller_radius + p.cos_contact / p.inner_radius),
        1.0 / (1.0 / p.roller_radius - p.cos_contact / p.outer_radius),
    )


@kernel
def raceway_drag(
    motion: ShaftMotion, law: int, oil: LubricantState, p: BearingParameters, side: float = 0.0
) -> float:
    """Return the torque of the raceways of the bearings, with the sign of the speed [N m].

    T = sum over rollers and races of 2 F phi r_u l

    Parameters
    ----------
    motion
        Of the shaft; its velocities play no part.
    law
        Value of `laws.ROLLING_LAWS`; inlet heating is what the law is used with.
    oil
        Oil at the inlet temperature.
    p
        Numbers of a bearing of either type.
    side
        0: both bearings; +1 or -1: the one of that side alone.

    Notes
    -----
    F is the rolling force of the law for each length under the steady load of the roller, which is
    the same at both races; r_u is the mean surface speed over the shaft speed, l the length of the
    roller. Each contact is flooded and heated once. Rib, oil drag and the steel's hysteresis are
    those of `rib_drag`.
    Source: [zhou_hoeprich_1991 (42)]
    """
    u = p.film_speed_radius * abs(motion.speed)
    if u == 0.0:
        return 0.0
    heating = usual_heating(law)
    number = inlet_heating_number(oil.eta0, oil.beta, u, oil.conductivity)
    rollers = steady_rollers(motion, oil, p)
    R_inner, R_outer = line_radii(p)
    E = p.reduced_modulus
    total = 0.0
    for bearing in range(2):
        here = 1.0 - 2.0 * bearing
        if here * side < 0.0:
            continue
        for i in range(int(p.n_rollers)):
            load = steady_load(rollers, here, i, p)
            if load <= 0.0:
                continue
            q = load / p.roller_length
            for race in range(2):
                R = R_inner if race == 0 else R_outer
                force, _ = rolling_force(law, R, q, E, oil.eta0, oil.alpha, u)
                pressure_ratio = math.sqrt(q / (2.0 * math.pi * R * E))
                total += force * heating_factor(heating, number, pressure_ratio)
    torque = 2.0 * total * p.film_speed_radius * p.roller_length
    return torque if motion.speed > 0.0 else -torque
