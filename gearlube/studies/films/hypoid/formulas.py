"""Published formulas and the axle's friction at the instants of a flank's film."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube.studies.films.hypoid.flank import HypoidFlank
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.solid import solid_parameters
from gearlube_core.ehl.gears.hypoid_flank import FlankInstant
from gearlube_core.film.grubin_1949 import (
    grubin_convention,
    grubin_film_thickness,
    grubin_geometry,
)
from gearlube_core.film.point_film import (
    central_film_thickness,
    film_geometry,
    minimum_film_geometry,
    minimum_film_thickness,
)
from gearlube_core.friction.evans_johnson_1986 import (
    solid_resistance,
    surface_heating_number,
    viscous_friction_coefficient,
)
from gearlube_core.friction.flank import flank_friction
from gearlube_core.friction.flank_data import CONSISTENT, contact_geometry
from gearlube_core.friction.traction_regime import traction_regime
from gearlube_core.oil.film_oil import viscosity
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY


class FlankFormulas(NamedTuple):
    """Formulas at one instant, SI."""

    hertz_pressure: float  # largest [Pa]
    chittenden_central: float  # entrainment at its angle to the axes, as the axle takes it [m]
    chittenden_minimum: float
    component_central: float  # Chittenden with the component along the minor axis alone [m]
    component_minimum: float
    grubin: float  # [m]
    evans_johnson: float  # film's friction as the axle has it, with Chittenden's film [-]
    evans_johnson_solved: float  # the same with the solved central film [-]
    evans_johnson_roelands: float  # with the solved film and the solution's viscosity [-]
    axle_friction: float  # film and asperities, with Chittenden's film [-]
    asperity_share: float  # of that friction [-]
    regime: float  # of traction_regime: 0 Newtonian, 1 Eyring, 2 elastic-plastic


def flank_formulas(flank: HypoidFlank, now: FlankInstant, solved_film: float) -> FlankFormulas:
    """Return the formulas at an instant, with the kernels that the axle model calls.

    Parameters
    ----------
    flank
        Pair, oil and roughness.
    now
        Load, radii and motion.
    solved_film
        Central film of the solution [m].

    Notes
    -----
    In a slender contact oil enters across the minor axis; what flows along the major one neither
    adds to the film nor leaves it. `component_*` therefore are Chittenden's with psi = 0 and the
    speed u cos(psi). Evans and Johnson take exp(alpha p) for the viscosity; with that of the
    solution alpha p becomes ln(eta/eta0) of Roelands' law at the mean pressure.
    """
    oil, parameters = flank.oil, flank.parameters
    solid = solid_parameters(parameters.solid, parameters.solid)
    modulus = 2.0 * solid.contact_modulus
    R_x, R_y, psi, speed = now.R_x, now.R_y, now.psi, now.speed
    geometry = contact_geometry(R_x, R_y, psi, solid.contact_modulus)
    axle = flank_friction(
        now.load,
        speed,
        now.slip,
        geometry,
        oil,
        gear_flanks(parameters.roughness_rms),
        solid,
        CONSISTENT,
    )
    operation = (oil.eta0, oil.alpha, speed, now.load, modulus)
    across = (oil.eta0, oil.alpha, now.entrainment[0], now.load, modulus)
    p = axle.mean_pressure
    effusivity = solid.conductivity * solid.density * solid.heat_capacity
    resistance = solid_resistance(geometry.R_e, p, speed, modulus, effusivity)

    def friction(film: float, alpha: float) -> float:
        zeta = surface_heating_number(film, oil.conductivity, resistance)
        return float(
            viscous_friction_coefficient(
                film, p, now.slip, oil.eta0, alpha, oil.beta, oil.tau0, oil.conductivity, zeta
            )
        )

    film = axle.film_thickness
    secant = math.log(viscosity(flank.film.lubricant, p) / oil.eta0) / p
    total = axle.viscous_friction + axle.boundary_friction
    return FlankFormulas(
        hertz_pressure=1.5 * p,
        chittenden_central=film,
        chittenden_minimum=minimum_film_thickness(
            *minimum_film_geometry(R_x, R_y, psi), *operation
        ),
        component_central=central_film_thickness(*film_geometry(R_x, R_y, 0.0), *across),
        component_minimum=minimum_film_thickness(*minimum_film_geometry(R_x, R_y, 0.0), *across),
        grubin=grubin_film_thickness(
            *grubin_geometry(R_x, R_y, psi),
            *operation[:-1],
            grubin_convention("consistent", solid.contact_modulus),
        ),
        evans_johnson=friction(film, oil.alpha),
        evans_johnson_solved=friction(solved_film, oil.alpha),
        evans_johnson_roelands=friction(solved_film, secant),
        axle_friction=axle.friction_coefficient,
        asperity_share=axle.boundary_friction / total if total > 0.0 else 0.0,
        regime=_regime(flank, now, p, solved_film),
    )


def _regime(flank: HypoidFlank, now: FlankInstant, pressure: float, film: float) -> float:
    oil = flank.oil
    log_viscosity = math.log(viscosity(flank.film.lubricant, pressure))
    log_inlet = math.log(oil.eta0)
    reduced = (log_viscosity + ROELANDS_LOG_VISCOSITY) / (log_inlet + ROELANDS_LOG_VISCOSITY)
    # rigid film without a limiting stress: neither is known of these oils
    place = traction_regime(
        log_viscosity,
        log_inlet,
        oil.beta * reduced,
        oil.conductivity,
        oil.tau0,
        film,
        now.slip,
        0.0,
        math.inf,
        math.inf,
        now.speed,
        now.R_x,
    )
    return float(place.state)
