"""Plateau traction of a thermal Eyring film, Evans and Johnson 1986."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import eyring_stress_ratio

MAP_RANGE = (2.0, 30.0)  # of `traction_map_number`, see `plateau_stress_ratio`

# [evans_johnson_1986]; [mohammadpour_2015 (13)] [mohammadpour_2015 (14)]
_PRESSURE_COEFFICIENT = 0.87
_LOG_COEFFICIENT = 1.74
_LOG_FACTOR = 1.2
_SURFACE_COEFFICIENT = 9.6
_4_PI = 4.0 / math.pi
_LN2 = math.log(2.0)


@kernel
def solid_resistance(
    R_e: float,
    mean_pressure: float,
    speed: float,
    reduced_modulus: float,
    solid_effusivity_squared: float,
) -> float:
    """Return the thermal resistance of a solid that moves through the contact.

    r = [p R'/(E' Ks rho cs U)]^(1/2)

    Parameters
    ----------
    R_e
        Relative radius of curvature along rolling R' [m].
    mean_pressure
        p [Pa].
    speed
        Mean surface speed U [m/s].
    reduced_modulus
        E' = 2 E* [Pa].
    solid_effusivity_squared
        Ks rho cs of the solids [W2 s/(m4 K2)].

    Returns
    -------
    float
        r [m2 K/W].

    Notes
    -----
    Heat moves into the solids faster than it spreads (Peclet number above about 5).
    Source: [evans_johnson_1986], the solid part of zeta.
    """
    flow = reduced_modulus * solid_effusivity_squared * speed
    return math.sqrt(mean_pressure * R_e / flow)


@kernel
def surface_heating_number(film_thickness: float, conductivity: float, resistance: float) -> float:
    """Return the ratio of surface to film heating.

    zeta = (4/pi) (K R'/h) [p/(E' R' Ks rho cs U)]^(1/2) = (4/pi) (K/h) r

    Parameters
    ----------
    film_thickness
        Central film h [m].
    conductivity
        Of the lubricant, K [W/(m K)].
    resistance
        r of `solid_resistance` [m2 K/W].

    Returns
    -------
    float
        zeta [-].

    Notes
    -----
    Source: [evans_johnson_1986]; [mohammadpour_2015 (14)].
    """
    return _4_PI * conductivity * resistance / film_thickness


@kernel
def traction_map_number(
    film_thickness: float,
    mean_pressure: float,
    eta0: float,
    alpha: float,
    beta: float,
    tau0: float,
    conductivity: float,
) -> float:
    """Return L = alpha p + ln{2 K eta0/[beta (tau0 h)^2]} [-], which ranges are stated in.

    Parameters as in `plateau_stress_ratio`, whose notes say how exact it is within `MAP_RANGE`.
    """
    stress_length = tau0 * film_thickness
    cooling = beta * stress_length * stress_length
    return alpha * mean_pressure + math.log(2.0 * conductivity * eta0 / cooling)


@kernel
def plateau_stress_ratio(
    film_thickness: float,
    mean_pressure: float,
    eta0: float,
    alpha: float,
    beta: float,
    tau0: float,
    conductivity: float,
    zeta: float,
) -> float:
    """Return the largest shear stress of a thermal Eyring film over the Eyring stress.

    s = mu p/tau0 = 0.87 alpha p + 1.74 ln{1.2/(tau0 h) [2 K eta0/(beta (1 + 9.6 zeta))]^(1/2)}

    Parameters
    ----------
    film_thickness
        Central film h [m].
    mean_pressure
        p [Pa].
    eta0, alpha, beta
        Viscosity [Pa s] at atmospheric pressure, its pressure coefficient [1/Pa] and its
        temperature coefficient -d ln eta0/dT [1/K].
    tau0
        Eyring stress [Pa].
    conductivity
        Of the lubricant, K [W/(m K)].
    zeta
        Surface heating number [-].

    Returns
    -------
    float
        s [-], negative where the formula does not apply (thick film, low pressure).

    Notes
    -----
    A straight line through the exact maximum of [johnson_greenwood_1980]. With the argument
    L = alpha p + ln{2 K eta0/[beta (tau0 h)^2]} and zeta = 0 it is within 1 % for L from 5 to
    11.8, 3.4 % low at 20, 5.4 % low at 30 and 14 % low at 2; below L = 0 it is negative, while the
    true traction is only small. [mohammadpour_2015 (13)] omits beta, without which the argument of
    the logarithm is not dimensionless; beta = 1 1/K gives the printed form.
    Source: [evans_johnson_1986].
    """
    stress_length = tau0 * film_thickness
    cooling = beta * (1.0 + _SURFACE_COEFFICIENT * zeta) * stress_length * stress_length
    # the square root is taken out of the logarithm
    logarithm = 0.5 * math.log(_LOG_FACTOR**2 * 2.0 * conductivity * eta0 / cooling)
    return _PRESSURE_COEFFICIENT * alpha * mean_pressure + _LOG_COEFFICIENT * logarithm


@kernel
def limited_stress_ratio(plateau: float, newtonian_ratio: float, exponent: float) -> float:
    """Return the plateau stress ratio, limited to between zero and the isothermal Eyring value.

    0 <= s <= asinh[eta0 exp(alpha p) |dU|/(h tau0)]

    Parameters
    ----------
    plateau
        s of `plateau_stress_ratio` [-].
    newtonian_ratio
        eta0 |dU|/(h tau0) [-], not negative.
    exponent
        alpha p [-].

    Returns
    -------
    float
        s [-]; vanishes linearly with sliding speed.

    Notes
    -----
    Heat only weakens a film, so no traction exceeds the isothermal one. Any finite input.
    """
    if plateau <= 0.0 or newtonian_ratio <= 0.0:
        return 0.0 * newtonian_ratio  # zero, but for a sliding speed that is no number
    # asinh(x) > ln 2x: the cheap bound settles all but small sliding speeds
    if plateau <= math.log(newtonian_ratio) + exponent + _LN2:
        return plateau
    isothermal = eyring_stress_ratio(newtonian_ratio, exponent)
    return plateau if plateau < isothermal else isothermal


@kernel
def viscous_friction_coefficient(
    film_thickness: float,
    mean_pressure: float,
    sliding_speed: float,
    eta0: float,
    alpha: float,
    beta: float,
    tau0: float,
    conductivity: float,
    zeta: float,
) -> float:
    """Return the friction coefficient of the lubricant film.

    mu = 0.87 alpha tau0 + 1.74 (tau0/p) ln{1.2/(tau0 h) [2 K eta0/(beta (1 + 9.6 zeta))]^(1/2)}
    limited to 0 <= mu <= (tau0/p) asinh[eta0 exp(alpha p) |dU|/(h tau0)]

    Parameters
    ----------
    film_thickness, mean_pressure, eta0, alpha, beta, tau0, conductivity, zeta
        As in `plateau_stress_ratio`.
    sliding_speed
        Speed of one surface relative to the other dU [m/s], either sign.

    Returns
    -------
    float
        mu [-], not negative.

    Notes
    -----
    Range and source as in `plateau_stress_ratio`.
    """
    plateau = plateau_stress_ratio(
        film_thickness, mean_pressure, eta0, alpha, beta, tau0, conductivity, zeta
    )
    newtonian_ratio = eta0 * abs(sliding_speed) / (film_thickness * tau0)
    s = limited_stress_ratio(plateau, newtonian_ratio, alpha * mean_pressure)
    return s * tau0 / mean_pressure
