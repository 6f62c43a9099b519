"""Viscosity against pressure: the law of Roelands at constant temperature."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

ROELANDS_PRESSURE = 5.1e-9  # 1/Pa, inverse of the Roelands pressure constant 1.96e8 Pa
# The viscosity constant, as papers round it: Karagiannis 2012 in the axle's friction, Jamali 2015
# in films. They differ by 4e-5 in ln eta.
ROELANDS_LOG_VISCOSITY = 9.67  # -ln of the constant in Pa s, [karagiannis_2012 (16)]
ROELANDS_KAPPA = 63.15e-6  # Pa s, [jamali_2015 (3.4)]
GLASS_TEMPERATURE = 138.0  # K, where the law of Roelands lets the viscosity grow without bound


def roelands_exponent(eta0: float, alpha: float) -> float:
    """Return the pressure exponent Z = alpha / [5.1e-9 (ln eta0 + 9.67)] [-]."""
    return alpha / (ROELANDS_PRESSURE * (math.log(eta0) + ROELANDS_LOG_VISCOSITY))


@kernel
def pressure_viscosity_coefficient(eta0: float, Z: float) -> float:
    """Return the slope of ln eta with pressure at atmospheric pressure.

    alpha = 5.1e-9 Z (ln eta0 + 9.67)

    Parameters
    ----------
    eta0
        Viscosity at atmospheric pressure and the temperature of interest [Pa s].
    Z
        Pressure exponent [-], independent of temperature.

    Returns
    -------
    float
        alpha [1/Pa].

    Notes
    -----
    Needs eta0 above 6.3e-5 Pa s. Source: [roelands_1966].
    """
    return ROELANDS_PRESSURE * Z * (math.log(eta0) + ROELANDS_LOG_VISCOSITY)


@kernel
def roelands_viscosity(eta0: float, Z: float, pressure: float) -> float:
    """Return the viscosity under pressure.

    eta = eta0 exp{(ln eta0 + 9.67) [(1 + 5.1e-9 p)^Z - 1]}

    Parameters
    ----------
    eta0
        Viscosity at atmospheric pressure [Pa s].
    Z
        Pressure exponent [-].
    pressure
        Gauge pressure p [Pa].

    Returns
    -------
    float
        Viscosity eta [Pa s].

    Notes
    -----
    Fitted by Roelands to about 0.5 GPa; used in elastohydrodynamics to about 1 GPa.
    Source: [roelands_1966]; [karagiannis_2012 (16)] at one temperature.
    """
    growth = (1.0 + ROELANDS_PRESSURE * pressure) ** Z - 1.0
    return eta0 * math.exp((math.log(eta0) + ROELANDS_LOG_VISCOSITY) * growth)
