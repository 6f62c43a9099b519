"""Film of a point contact after Grubin 1949, with side leakage after Archard and Cowking."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.checks import check_option, check_positive
from gearlube_core.film.point_film import film_geometry
from gearlube_core.kernels.jit import kernel

# [karagiannis_2012 (10)]
_PRINTED_COEFFICIENT = 1.212
_SPEED_EXPONENT = 0.75
_LOAD_EXPONENT = -1.0 / 12.0
_LEAKAGE_EXPONENT = 2.0 / 3.0
# integral of t^(3/2)/(1 + t^(3/2))^3 over t > 0: (2/3) B(5/3, 4/3)
GRUBIN_INTEGRAL = 2.0 / 3.0 * math.gamma(5.0 / 3.0) * math.gamma(4.0 / 3.0) / math.gamma(3.0)
# gap beside a Hertz contact (8 sqrt 2/(3 pi)) a^(1/2) (x - a)^(3/2)/R, a^3 = 3 W R/(4 E*)
_GAP = 8.0 * math.sqrt(2.0) / (3.0 * math.pi)
CONSISTENT_COEFFICIENT = (12.0 * GRUBIN_INTEGRAL) ** 0.75 * _GAP**-0.5 * 0.75 ** (-1.0 / 12.0)

CONVENTIONS = ("consistent", "as_printed")
# thermal reduction, [gupta_1992]
_PRESSURE_TERM, _PRESSURE_POWER = 13.2, 0.42
_LOADING_TERM, _LOADING_POWER = 0.213, 0.64
_SLIDE_TERM, _SLIDE_POWER = 2.23, 0.83


class GrubinConvention(NamedTuple):
    """Coefficient of the film and the modulus that belongs to it; floats."""

    coefficient: float  # [-]
    modulus: float  # [Pa]


def grubin_convention(name: str, contact_modulus: float) -> GrubinConvention:
    """Return coefficient and modulus of `grubin_film_thickness`, both for a mean speed.

    Parameters
    ----------
    name : {"consistent", "as_printed"}
        "consistent": 2.250 with E*, from the Grubin integral. "as_printed": 1.212 with
        Er = pi E*, [karagiannis_2012 (10)], with the mean speed of its (12).
    contact_modulus : float
        E* [Pa].

    Returns
    -------
    GrubinConvention

    Raises
    ------
    ParameterError

    Notes
    -----
    The consistent coefficient for the *sum* of speeds and Er is 1.2159, so 1.212 belongs to the
    sum; with the printed half the film is 2^(3/4) 1.003 = 1.69 times too thin.
    """
    check_option("film convention", name, CONVENTIONS)
    check_positive("contact_modulus", contact_modulus, "Pa", "115 GPa is 1.15e11 Pa.")
    if name == "as_printed":
        return GrubinConvention(_PRINTED_COEFFICIENT, math.pi * contact_modulus)
    return GrubinConvention(CONSISTENT_COEFFICIENT, float(contact_modulus))


@kernel
def grubin_geometry(R_x: float, R_y: float, angle: float) -> tuple[float, float]:
    """Return the radius along entrainment and the side-leakage factor of the film.

    psi^(2/3),  psi = 1/[1 + 2 R_e/(3 R_s)]

    Parameters
    ----------
    R_x, R_y
        Relative principal radii of curvature along the minor and the major axis, R_x <= R_y [m].
    angle
        Angle between entrainment and the minor axis [rad].

    Returns
    -------
    tuple of float
        R_e [m] and psi^(2/3) [-].

    Notes
    -----
    Evaluate once per contact position. Source: [karagiannis_2012 (11)];
    [archard_cowking_1965] for psi. A factor on the pressure build-up would enter the film with
    power 3/4; the printed 2/3 is used, the difference is 0.5 % at R_e/R_s = 0.1 and 4 % for a
    circle.
    """
    R_e = film_geometry(R_x, R_y, angle)[0]
    side_curvature = 1.0 / R_x + 1.0 / R_y - 1.0 / R_e
    psi = 1.0 / (1.0 + 2.0 / 3.0 * R_e * side_curvature)
    return R_e, psi**_LEAKAGE_EXPONENT


@kernel
def grubin_film_thickness(
    R_e: float,
    leakage: float,
    eta0: float,
    alpha: float,
    entrainment_speed: float,
    load: float,
    convention: GrubinConvention,
) -> float:
    """Return the film thickness of the parallel region.

    h = R_e C (alpha eta0 u/R_e)^(3/4) [W/(M R_e^2)]^(-1/12) psi^(2/3)

    Parameters
    ----------
    R_e, leakage
        From `grubin_geometry` [m], [-].
    eta0
        Viscosity at inlet temperature and atmospheric pressure [Pa s].
    alpha
        Pressure-viscosity coefficient at inlet temperature [1/Pa].
    entrainment_speed
        Mean surface speed u = (u_1 + u_2)/2 [m/s], positive.
    load
        W [N], positive.
    convention
        C [-] and M [Pa] from `grubin_convention`.

    Returns
    -------
    float
        h [m].

    Notes
    -----
    Steady, fully flooded, heavily loaded: Hertz pressure well above 1/alpha, film far below the
    Hertz deflection. The gap outside the contact is that of a dry circular contact near its edge.
    Source: [grubin_1949]; [karagiannis_2012 (10)]
    """
    return (
        convention.coefficient
        * leakage
        * R_e
        * math.exp(
            _SPEED_EXPONENT * math.log(alpha * eta0 * entrainment_speed / R_e)
            + _LOAD_EXPONENT * math.log(load / (convention.modulus * R_e * R_e))
        )
    )


@kernel
def inlet_heating_factor(
    eta0: float,
    beta: float,
    conductivity: float,
    entrainment_speed: float,
    sliding_speed: float,
    largest_pressure: float,
    reduced_modulus: float,
) -> float:
    """Return the film reduction factor of inlet shear heating.

    phi = [1 - 13.2 (p_0/E') L^0.42] / [1 + 0.213 (1 + 2.23 S^0.83) L^0.64]
    L = beta eta0 u^2/K,  S = |dU|/u

    Parameters
    ----------
    eta0, beta
        Viscosity [Pa s] and -d ln eta0/dT [1/K] at inlet temperature and atmospheric pressure.
    conductivity
        Of the lubricant, K [W/(m K)].
    entrainment_speed
        Mean surface speed u [m/s], positive.
    sliding_speed
        dU [m/s], either sign.
    largest_pressure
        Largest Hertz pressure p_0 [Pa].
    reduced_modulus
        E' = 2 E* [Pa].

    Returns
    -------
    float
        phi, 0 to 1 [-].

    Notes
    -----
    A fit to line contact solutions up to L about 20 and S about 1; beyond, it is an
    extrapolation, limited to between 0 and 1. In pure rolling it is within 8 % of
    3.94/(3.94 + L^0.62) of [murch_wilson_1975].
    Source: [gupta_1992]
    """
    L = beta * eta0 * entrainment_speed * entrainment_speed / conductivity
    if not L > 0.0:
        return 1.0 + 0.0 * L
    S = abs(sliding_speed) / entrainment_speed
    log_L = math.log(L)
    pressure_term = largest_pressure / reduced_modulus * math.exp(_PRESSURE_POWER * log_L)
    thinning = 1.0 - _PRESSURE_TERM * pressure_term
    heating = _LOADING_TERM * math.exp(_LOADING_POWER * log_L)
    if S > 0.0:
        heating *= 1.0 + _SLIDE_TERM * math.exp(_SLIDE_POWER * math.log(S))
    return max(thinning, 0.0) / (1.0 + heating)
