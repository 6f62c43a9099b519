"""Constants of the viscosity laws and the fit of a viscosity-temperature line to data."""

from __future__ import annotations

import math

MM2_S = 1.0e-6  # m2/s in one mm2/s (one cSt)
WALTHER_SHIFT = 0.7  # mm2/s, [astm_d341] for viscosities above 2 mm2/s
ROELANDS_PRESSURE = 5.1e-9  # 1/Pa, inverse of the Roelands pressure constant 1.96e8 Pa
ROELANDS_LOG_VISCOSITY = 9.67  # -ln of the Roelands viscosity constant 6.31e-5 Pa s


def walther_double_log(kinematic_viscosity: float) -> float:
    """Return log10 log10 (nu + 0.7) with nu in mm2/s, for nu [m2/s] given in SI."""
    return math.log10(math.log10(kinematic_viscosity / MM2_S + WALTHER_SHIFT))


def walther_coefficients(
    nu_1: float, temperature_1: float, nu_2: float, temperature_2: float
) -> tuple[float, float]:
    """Return A and B of the line log10 log10 (nu + 0.7) = A - B log10 T through two points.

    Parameters
    ----------
    nu_1, nu_2
        Kinematic viscosities [m2/s].
    temperature_1, temperature_2
        Absolute temperatures of the points [K].

    Returns
    -------
    tuple of float
        A and B [-].

    Notes
    -----
    [astm_d341] recommends the form above 2 mm2/s.
    """
    w_1, w_2 = walther_double_log(nu_1), walther_double_log(nu_2)
    B = (w_1 - w_2) / math.log10(temperature_2 / temperature_1)
    return w_1 + B * math.log10(temperature_1), B


def walther_kinematic_viscosity(A: float, B: float, temperature: float) -> float:
    """Return the kinematic viscosity [m2/s] at an absolute temperature [K]."""
    logarithm = 10.0 ** (A - B * math.log10(temperature))
    return float((10.0**logarithm - WALTHER_SHIFT) * MM2_S)


def roelands_exponent(eta0: float, alpha: float) -> float:
    """Return the pressure exponent Z = alpha / [5.1e-9 (ln eta0 + 9.67)] [-]."""
    return alpha / (ROELANDS_PRESSURE * (math.log(eta0) + ROELANDS_LOG_VISCOSITY))
