"""Mixed friction of a contact whose film and pressure are known: asperities, traction, heat.

One kernel for contacts of any shape. Loads, friction forces and areas are those of the whole
contact, or of a line contact per unit length of the line.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import (
    RACE_B,
    RACE_C,
    SurfaceParameters,
    arana_share,
    asperity_area_factor,
    asperity_integrals,
    asperity_load_factor,
    asperity_share,
    f_2_as_printed,
    f_5_2_as_printed,
)
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film.zhu_cheng_1989 import zhu_cheng_heating
from gearlube_core.friction.evans_johnson_1986 import (
    solid_resistance,
    surface_heating_number,
    viscous_friction_coefficient,
)
from gearlube_core.friction.flank_data import AS_PRINTED, PRINTED_TRACTION, ZHOU_HOEPRICH_SHARE
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import eyring_stress_ratio
from gearlube_core.oil.formula_laws import bounded_stress, mean_slope
from gearlube_core.oil.lubricant_state import LubricantState, eyring_stress_under

SPEED_FLOOR = 1.0e-6  # m/s, film and heat of a resting contact are those at this floor
BOUNDARY_SPEED = 1.0e-3  # m/s, boundary friction builds up over this sliding speed
_SATURATION = 20.0  # tanh is 1 in double precision above
_FLASH_FACTOR = 8.0 * math.sqrt(2.0) / (3.0 * math.pi)
_STILL_FACTOR = 16.0 / (9.0 * math.pi**3)  # s^2 Ks^2/A


class MixedFriction(NamedTuple):
    """Friction of a contact, or of a line per unit length; all floats, SI, no negative number."""

    viscous_friction: float  # [N] or [N/m]
    boundary_friction: float  # [N] or [N/m]
    friction_coefficient: float  # total friction over load [-]
    temperature_rise: float  # mean of the film over the oil [K]
    film_ratio: float  # as the asperities take it [-]


@kernel
def contact_temperature_rise(
    heat_flux: float,
    film_thickness: float,
    area: float,
    resistance: float,
    conductivity: float,
    solid_conductivity: float,
) -> float:
    """Return the mean temperature rise of the film above the oil.

    dT = q (1/m^2 + 1/s^2)^(-1/2) + q h/(12 K)
    m = (4/3) (1/2) [2 b/(pi Ks rho cs U)]^(1/2),  b = (16/pi) p R_e/E'
    s = (1/2) (8/3 pi) (A/pi)^(1/2)/Ks

    Parameters
    ----------
    heat_flux
        Friction power per contact area q [W/m2].
    film_thickness
        h [m].
    area
        Of a round heat source that stands for the contact at rest, A [m2].
    resistance
        r of `solid_resistance` [m2 K/W]; m = 8 sqrt(2)/(3 pi) r.
    conductivity, solid_conductivity
        K of the lubricant and Ks of the solids [W/(m K)].

    Returns
    -------
    float
        dT [K].

    Notes
    -----
    m is the mean flash temperature of a uniform band source of half width b moving over a
    half-space, half of the heat to each surface. b is the half width of a line contact with
    mean pressure p; that of an ellipse under the same mean pressure is 7 % smaller (circle) to
    18 % larger (slender), 4 to 9 % in m. s is the stationary limit, a uniform round source of
    the same area, and only matters below a Peclet number of about 5. The last term is the mean
    over a film heated uniformly across its thickness.
    Source: [jaeger_1942] for m, [carslaw_jaeger_1959 sec. 8.2] for s, joined as by
    [tian_kennedy_1994].
    """
    m = _FLASH_FACTOR * resistance
    m_over_s_squared = m * m * solid_conductivity * solid_conductivity / (_STILL_FACTOR * area)
    surface = m / math.sqrt(1.0 + m_over_s_squared)
    return heat_flux * (surface + film_thickness / (12.0 * conductivity))


@kernel
def asperity_contact(
    load: float,
    area: float,
    film_ratio: float,
    surface: SurfaceParameters,
    solid: SolidParameters,
    form: int,
) -> tuple[float, float]:
    """Return the load that asperities carry, at most `load`, and their area.

    Parameters
    ----------
    load
        Of the whole contact [N] or per unit length [N/m].
    area
        Of the contact [m2] or [m].
    film_ratio
        Film over composite roughness [-].
    surface, solid, form
        As in `mixed_friction`.

    Returns
    -------
    tuple of float
        W_a [N] or [N/m], A_a [m2] or [m].

    Notes
    -----
    Range and sources as in `mixed_friction`.
    """
    if surface.share_exponent > 0.0:
        return load * arana_share(film_ratio, surface.share_exponent), 0.0
    load_factor = asperity_load_factor(surface)
    if form == AS_PRINTED:
        W_a = load_factor * (2.0 * solid.contact_modulus) * area * f_5_2_as_printed(film_ratio)
        A_a = asperity_area_factor(surface) * area * f_2_as_printed(film_ratio)
        return min(W_a, load), A_a
    F_2, F_5_2 = asperity_integrals(film_ratio)
    W_a = load_factor * solid.contact_modulus * area * F_5_2
    if form == ZHOU_HOEPRICH_SHARE:
        W_a = load * asperity_share(film_ratio, RACE_B, RACE_C)
    A_a = asperity_area_factor(surface) * area * F_2
    return min(W_a, load), A_a


@kernel
def boundary_friction(
    W_a: float, A_a: float, slip: float, lubricant: LubricantState, surface: SurfaceParameters
) -> float:
    """Return the friction of asperities, tau_l0 A_a + gamma W_a, built up over BOUNDARY_SPEED.

    With Arana's share it is mu_b W_a, and mu_b is that of the surface.

    Parameters
    ----------
    W_a, A_a
        Load and area of `asperity_contact`.
    slip
        Magnitude of the sliding speed [m/s].
    lubricant
        Strength of its boundary layers.
    surface
        As in `mixed_friction`.

    Returns
    -------
    float
        [N] or [N/m], not negative.
    """
    gamma = surface.boundary if surface.share_exponent > 0.0 else lubricant.gamma
    f_b = lubricant.tau_l0 * A_a + gamma * W_a
    f_b = max(f_b, 0.0)  # the printed area integral is negative from a film ratio of 2 on
    build_up = slip / BOUNDARY_SPEED
    if build_up < _SATURATION:
        f_b *= math.tanh(build_up)
    return f_b


@kernel
def friction_with_asperities(
    film_friction: float,
    load: float,
    film_load: float,
    mean_pressure: float,
    film_thickness: float,
    film_ratio: float,
    slip: float,
    resistance: float,
    still_area: float,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    form: int,
) -> MixedFriction:
    """Return friction and temperature of a contact whose film's own friction is known.

    Parameters
    ----------
    film_friction
        Friction coefficient mu of the film where it carries all of the load [-].
    film_ratio
        Film over composite roughness, for the asperities [-].
    resistance
        r of `solid_resistance` [m2 K/W].

    Others, result and notes as in `mixed_friction`.
    """
    W_a, A_a = asperity_contact(load, load / mean_pressure, film_ratio, surface, solid, form)
    F_viscous = load if form == AS_PRINTED else load - W_a
    f_v = film_friction * F_viscous
    f_b = boundary_friction(W_a, A_a, slip, lubricant, surface)
    friction = f_v + f_b
    dT = contact_temperature_rise(
        friction * slip * mean_pressure / film_load,
        film_thickness,
        still_area,
        resistance,
        lubricant.conductivity,
        solid.conductivity,
    )
    return MixedFriction(f_v, f_b, friction / film_load, dT, film_ratio)


@kernel
def mixed_friction(
    load: float,
    film_load: float,
    mean_pressure: float,
    film_thickness: float,
    speed: float,
    slip: float,
    R_e: float,
    still_area: float,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    form: int,
) -> MixedFriction:
    """Return friction and temperature of a contact with a known film.

    consistent:  f_v = mu (F - W_a),  f_b = tau_l0 A_a + gamma W_a,  0 <= W_a <= F
    as printed:  f_v = mu F, with E' in W_a, beta = 1 1/K in mu and the printed F_2, F_5/2
    printed traction:  as consistent, with beta = 1 1/K in mu
    Zhou and Hoeprich's share:  as consistent, with W_a = F exp(-B Lambda^C)
    Arana's share, in `surface`:  f_b = mu_b W_a,  W_a = F (1 - erf Lambda)^k

    Parameters
    ----------
    load
        F, not negative [N], or per unit length [N/m].
    film_load
        The load that film and pressure belong to, F or its floor [N] or [N/m].
    mean_pressure
        p of `film_load` [Pa]; the contact area is F/p [m2] or [m].
    film_thickness
        Central film h [m].
    speed
        Mean surface speed, above zero [m/s].
    slip
        Magnitude of the sliding speed [m/s].
    R_e
        Relative radius of curvature along entrainment [m].
    still_area
        Of the round heat source that replaces the contact at rest [m2].
    lubricant
        Lubricant at oil temperature.
    surface
        Roughness of the pair.
    solid
        Elastic and thermal data of the pair.
    form
        CONSISTENT = 0, AS_PRINTED = 1, PRINTED_TRACTION = 2 or ZHOU_HOEPRICH_SHARE = 3.

    Returns
    -------
    MixedFriction
        The friction coefficient refers to `film_load`.

    Notes
    -----
    Range: that of `plateau_stress_ratio` and `asperity_load`. See `flank_friction` for what the
    two forms share and where they part.
    Source: [mohammadpour_2015 (11)] [mohammadpour_2015 (12)] [mohammadpour_2015 (15)].
    (12) prints the whole load, the other forms take off what asperities carry.
    [zhou_hoeprich_1991 (45)] for the share; B and C are those of rollers on a race.
    [arana_2019] for the other; its film is hot: that of the formula times Zhu and Cheng's factor
    without its term of pressure, which is small where the film is thin and below zero in cold oil.
    """
    reduced_modulus = 2.0 * solid.contact_modulus
    effusivity_squared = solid.conductivity * solid.density * solid.heat_capacity
    beta = 1.0 if form in (AS_PRINTED, PRINTED_TRACTION) else lubricant.beta
    resistance = solid_resistance(R_e, mean_pressure, speed, reduced_modulus, effusivity_squared)
    zeta = surface_heating_number(film_thickness, lubricant.conductivity, resistance)
    mu = viscous_friction_coefficient(
        film_thickness,
        mean_pressure,
        slip,
        lubricant.eta0,
        mean_slope(lubricant.viscosity, lubricant, mean_pressure),
        beta,
        eyring_stress_under(lubricant, mean_pressure),
        lubricant.conductivity,
        zeta,
    )
    p, film_ratio = mean_pressure, film_thickness / surface.sigma
    if surface.share_exponent > 0.0:
        heat = inlet_heating_number(lubricant.eta0, lubricant.beta, speed, lubricant.conductivity)
        film_ratio *= zhu_cheng_heating(heat, 0.0, slip / speed)
    mu = bounded_stress(lubricant.shear, mu, p, lubricant, p, slip, film_thickness)
    return friction_with_asperities(
        mu,
        load,
        film_load,
        mean_pressure,
        film_thickness,
        film_ratio,
        slip,
        resistance,
        still_area,
        lubricant,
        surface,
        solid,
        form,
    )


class FormulaBounds(NamedTuple):
    """How far off formulas are where a film model does not hold; both floats."""

    film: float  # of the film, relative
    friction: float  # most friction of the film over that of an isothermal Eyring film [-]


@kernel
def formula_error(
    load: float,
    slip: float,
    formula: Any,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    form: int,
    bounds: FormulaBounds,
) -> float:
    """Return how far off the formulas' friction may be outside of a film model's domain.

    0 <= f <= b F (tau0/p) asinh[eta0 exp(alpha p) dU/(h tau0)], and what asperities add

    Parameters
    ----------
    load
        F, not negative [N], or of a line per length [N/m].
    slip
        Magnitude of the sliding speed dU [m/s].
    formula
        `FlankState` or `LineState` by the formulas, with p and h.
    lubricant, surface, solid, form
        As in `flank.flank_friction`.
    bounds
        Of the formulas; b is that of friction.

    Returns
    -------
    float
        Force [N], or per length [N/m].

    Notes
    -----
    Not relative to the formula's friction: Evans and Johnson's regression goes to zero in light
    contacts, whose films are nearly isothermal. A film thinner by its bound raises the load of
    asperities.
    """
    p, h = formula.mean_pressure, formula.film_thickness
    tau0 = eyring_stress_under(lubricant, p)
    newtonian_ratio = lubricant.eta0 * slip / (h * tau0)
    exponent = mean_slope(lubricant.viscosity, lubricant, p) * p
    stress = tau0 * eyring_stress_ratio(newtonian_ratio, exponent)
    most = bounds.friction * stress / p * load
    thinner = formula.film_ratio * (1.0 - bounds.film)
    W_a, A_a = asperity_contact(load, load / p, thinner, surface, solid, form)
    more = boundary_friction(W_a, A_a, slip, lubricant, surface) - formula.boundary_friction
    return max(formula.viscous_friction, most - formula.viscous_friction) + max(more, 0.0)
