"""Smallest film of a line contact, Dowson 1968."""

from __future__ import annotations

import math

from gearlube_core.jit import kernel

# Dowson 1968
_COEFFICIENT = 2.65
_SPEED_EXPONENT = 0.70
_MATERIAL_EXPONENT = 0.54
_LOAD_EXPONENT = -0.13


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
        h_m [m].

    Notes
    -----
    Fully flooded, isothermal, steady, Newtonian, piezoviscous-elastic regime; U about 1e-13 to
    1e-10, G about 2500 to 5000, W' about 3e-5 to 3e-4. Quoted from later literature.
    Source: Dowson 1968, revising Dowson and Higginson 1966.
    """
    stiffness = reduced_modulus * R
    return (
        _COEFFICIENT
        * R
        * math.exp(
            _SPEED_EXPONENT * math.log(eta0 * entrainment_speed / stiffness)
            + _MATERIAL_EXPONENT * math.log(alpha * reduced_modulus)
            + _LOAD_EXPONENT * math.log(line_load / stiffness)
        )
    )
