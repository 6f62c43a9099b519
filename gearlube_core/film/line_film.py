"""Film thickness of line contacts: Dowson and Toyoda, Dowson, Moes."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.checks import check_positive
from gearlube_core.kernels.jit import kernel

# Groups of Moes. Over this range, which is wider than that of the fit, the formula is between 18 %
# thinner and 34 % thicker than solved isothermal films of a Newtonian oil of 20 1/GPa between
# steel, extrapolated from 801 and 1601 nodes. It is up to 42 % thicker than films of 12 1/GPa,
# which are compressed more. Outside: 58 % thinner at M 0.3, L 2.5, and 39 % thicker at M 500, L 10.
LOAD_RANGE, MATERIAL_RANGE = (1.0, 150.0), (2.5, 30.0)


class LineFilmLaw(NamedTuple):
    """Coefficient and exponents of the dimensionless groups [-]."""

    coefficient: float
    speed: float
    material: float
    load: float


@kernel
def power_law_line_film(
    law: LineFilmLaw,
    R: float,
    eta0: float,
    alpha: float,
    entrainment_speed: float,
    line_load: float,
    reduced_modulus: float,
) -> float:
    """Return C R U^s G^m W'^l [m]; arguments as in `line_film_thickness`.

    U = eta0 u/(E' R),  G = alpha E',  W' = w/(E' R),  u = (u_1 + u_2)/2
    """
    stiffness = reduced_modulus * R
    return (
        law.coefficient
        * R
        * math.exp(
            law.speed * math.log(eta0 * entrainment_speed / stiffness)
            + law.material * math.log(alpha * reduced_modulus)
            + law.load * math.log(line_load / stiffness)
        )
    )


_DOWSON_TOYODA_1979 = LineFilmLaw(coefficient=3.06, speed=0.69, material=0.56, load=-0.10)


@kernel
def line_film_thickness(
    R: float,
    eta0: float,
    alpha: float,
    entrainment_speed: float,
    line_load: float,
    reduced_modulus: float,
) -> float:
    """Return the film thickness in the centre of a line contact.

    h_c = R 3.06 U^0.69 G^0.56 W'^-0.10
    U = eta0 u/(E' R),  G = alpha E',  W' = w/(E' R),  u = (u_1 + u_2)/2

    Parameters
    ----------
    R
        Relative radius of curvature along entrainment [m].
    eta0
        Viscosity at inlet temperature and atmospheric pressure [Pa s].
    alpha
        Pressure-viscosity coefficient [1/Pa].
    entrainment_speed
        Mean surface speed u across the line [m/s], positive.
    line_load
        w, load per unit length of the line [N/m], positive.
    reduced_modulus
        E' = 2 E* [Pa].

    Returns
    -------
    float
        h_c [m].

    Notes
    -----
    Fully flooded, isothermal, steady, piezoviscous-elastic regime, as the minimum film of
    [dowson_1968]: U about 1e-13 to 1e-10, G about 2500 to 5000, W' about 3e-5 to 3e-4. At light
    load the film of rigid solids, 4.9 R U/W' of [martin_1916], is the thicker one: below
    W' = 1.5e-6 at U = 1e-11, or 3 N/mm on gears of this size.
    Coefficient, exponents and groups are quoted from later literature, which agrees; the original
    was not at hand. That U has the mean speed and E' = 2 E* is checked against the inlet integral
    of Ertel and Grubin: within a fifth, where the sum of speeds would make it 1.6 times thinner.
    Source: [dowson_toyoda_1979].
    """
    return power_law_line_film(
        _DOWSON_TOYODA_1979, R, eta0, alpha, entrainment_speed, line_load, reduced_modulus
    )


def central_line_film(
    *,
    radius: float,
    viscosity: float,
    pressure_viscosity: float,
    entrainment_speed: float,
    line_load: float,
    contact_modulus: float,
) -> float:
    """Return the central film thickness of a line contact after Dowson and Toyoda 1979.

    Parameters
    ----------
    radius : float
        R [m].
    viscosity, pressure_viscosity : float
        eta0 [Pa s] and alpha [1/Pa] of the oil at the inlet.
    entrainment_speed : float
        u = (u_1 + u_2)/2 [m/s].
    line_load : float
        w [N/m].
    contact_modulus : float
        E* [Pa].

    Returns
    -------
    float
        h_c [m].

    Raises
    ------
    ParameterError
        When an argument is not above zero.

    Notes
    -----
    Equation, range and source as in `line_film_thickness`.

    Examples
    --------
    >>> h = central_line_film(radius=0.0148, viscosity=0.00625, pressure_viscosity=13.3e-9,
    ...                       entrainment_speed=6.7, line_load=3.6e5, contact_modulus=113.7e9)
    >>> round(1e6 * h, 2)
    0.3
    """
    for name, value, unit, cure in (
        ("radius", radius, "m", "Give metres, not millimetres."),
        ("viscosity", viscosity, "Pa s", "20 cP is 0.02 Pa s."),
        ("pressure_viscosity", pressure_viscosity, "1/Pa", "20 1/GPa is 2e-8 1/Pa."),
        ("entrainment_speed", entrainment_speed, "m/s", ""),
        ("line_load", line_load, "N/m", "100 N/mm is 1e5 N/m."),
        ("contact_modulus", contact_modulus, "Pa", "115 GPa is 1.15e11 Pa."),
    ):
        check_positive(name, value, unit, cure)
    return line_film_thickness(
        float(radius),
        float(viscosity),
        float(pressure_viscosity),
        float(entrainment_speed),
        float(line_load),
        2.0 * contact_modulus,
    )


_DOWSON_1968 = LineFilmLaw(coefficient=2.65, speed=0.70, material=0.54, load=-0.13)


@kernel
def minimum_line_film_thickness(
    R: float,
    eta0: float,
    alpha: float,
    entrainment_speed: float,
    line_load: float,
    reduced_modulus: float,
) -> float:
    """Return the smallest film thickness of a line contact, at the outlet constriction.

    h_m = R 2.65 U^0.70 G^0.54 W'^-0.13
    U = eta0 u/(E' R),  G = alpha E',  W' = w/(E' R),  u = (u_1 + u_2)/2

    Parameters
    ----------
    R, eta0, alpha, entrainment_speed, line_load, reduced_modulus
        As in `line_film_thickness`.

    Returns
    -------
    float
        h_m [m].

    Notes
    -----
    Fully flooded, isothermal, steady, Newtonian, piezoviscous-elastic regime; U about 1e-13 to
    1e-10, G about 2500 to 5000, W' about 3e-5 to 3e-4. Quoted from later literature.
    Source: [dowson_1968], revising [dowson_higginson_1966].
    """
    return power_law_line_film(
        _DOWSON_1968, R, eta0, alpha, entrainment_speed, line_load, reduced_modulus
    )


@kernel
def central_film_group(M: float, L: float) -> float:
    """Return the central film H = (h/R) (2U)^(-1/2) between the four regimes.

    H = [(RI^(7/3) + EI^(7/3))^(3s/7) + (RP^(-7/2) + EP^(-7/2))^(-2s/7)]^(1/s),
    s = (7 + 8 exp(-2 EI/RI))/5, RI = 3/M, EI = 2.621 M^(-1/5), RP = 1.287 L^(2/3),
    EP = 1.311 M^(-1/8) L^(3/4)

    Parameters
    ----------
    M, L : float
        Moes load, above zero, and material, not negative [-].

    Returns
    -------
    float
        H [-].

    Notes
    -----
    A fit, accurate to about 10 %. It sets domain sizes and initial values, and is what the film
    model of lines corrects.
    Source: [moes_1992], coefficients for the central film as quoted by [venner_lubrecht_2000].
    """
    RI, EI = 3.0 / M, 2.621 * M**-0.2
    s = (7.0 + 8.0 * math.exp(-2.0 * EI / RI)) / 5.0
    isoviscous = (RI ** (7.0 / 3.0) + EI ** (7.0 / 3.0)) ** (3.0 * s / 7.0)
    if L <= 0.0:
        return isoviscous ** (1.0 / s)
    RP, EP = 1.287 * L ** (2.0 / 3.0), 1.311 * M**-0.125 * L**0.75
    piezoviscous = (RP**-3.5 + EP**-3.5) ** (-2.0 * s / 7.0)
    return (isoviscous + piezoviscous) ** (1.0 / s)
