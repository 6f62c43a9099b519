"""Viscosity against temperature: the double-logarithmic line of Walther, ASTM D341."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

MM2_S = 1.0e-6  # m2/s in one mm2/s (one cSt)
WALTHER_SHIFT = 0.7  # mm2/s, [astm_d341] for viscosities above 2 mm2/s
_LN10 = math.log(10.0)


@kernel
def walther_viscosity(A: float, B: float, temperature: float) -> tuple[float, float]:
    """Return kinematic viscosity and its logarithmic slope with temperature.

    log10 log10 (nu + 0.7) = A - B log10 T, with nu in mm2/s

    Parameters
    ----------
    A, B
        Coefficients of the line [-].
    temperature
        Absolute temperature T [K].

    Returns
    -------
    tuple of float
        Kinematic viscosity nu [m2/s] and beta = -d ln nu / dT [1/K].

    Notes
    -----
    For viscosities above 2 mm2/s. At constant density beta is also that of the dynamic
    viscosity. Source: [walther_1931]; [astm_d341].
    """
    log10_shifted = math.exp(_LN10 * A - B * math.log(temperature))
    shifted = math.exp(_LN10 * log10_shifted)
    nu_mm2_s = shifted - WALTHER_SHIFT
    beta = shifted / nu_mm2_s * _LN10 * log10_shifted * B / temperature
    return nu_mm2_s * MM2_S, beta


@kernel
def walther_temperature(A: float, B: float, kinematic_viscosity: float) -> float:
    """Return the temperature [K] at which the line has a viscosity [m2/s]."""
    shifted = kinematic_viscosity / MM2_S + WALTHER_SHIFT
    return math.exp((_LN10 * A - math.log(math.log(shifted) / _LN10)) / B)


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
