"""Viscosity against pressure and temperature in one law, Houpert 1985 after Roelands."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.roelands_1966 import (
    GLASS_TEMPERATURE,
    ROELANDS_LOG_VISCOSITY,
    ROELANDS_PRESSURE,
    roelands_exponent,
)

# the two temperatures of an oil data sheet
_COLD, _HOT = 313.15, 373.15  # K


class HoupertParameters(NamedTuple):
    """Viscosity law of one oil; all floats, SI."""

    log_viscosity: float  # ln eta + 9.67 at atmospheric pressure and `temperature` [-]
    temperature: float  # [K]
    S0: float  # temperature exponent [-]
    Z: float  # pressure exponent [-]


def fit_houpert(
    eta_1: float,
    temperature_1: float,
    eta_2: float,
    temperature_2: float,
    alpha: float,
    alpha_temperature: float,
) -> HoupertParameters:
    """Return the law through two viscosities and one pressure coefficient.

    S0 = ln[(ln eta_1 + 9.67)/(ln eta_2 + 9.67)] / ln[(T_2 - 138)/(T_1 - 138)]
    Z = alpha/[5.1e-9 (ln eta + 9.67)] at the temperature of alpha

    Parameters
    ----------
    eta_1, eta_2
        Dynamic viscosities at atmospheric pressure [Pa s], above 6.31e-5 Pa s.
    temperature_1, temperature_2
        Their temperatures [K], above 138 K.
    alpha
        Pressure-viscosity coefficient [1/Pa].
    alpha_temperature
        Its temperature [K].

    Returns
    -------
    HoupertParameters
        With `temperature_1` as its reference.

    Raises
    ------
    ParameterError
        When a number is out of range or viscosity does not fall with temperature.

    Notes
    -----
    Karagiannis et al. 2012 print neither S0 nor Z; both follow from Table 2.
    """
    lowest = math.exp(-ROELANDS_LOG_VISCOSITY) * 1.0001
    cure = "94.8 mPa s is 0.0948 Pa s."
    for name, eta in (("eta_1", eta_1), ("eta_2", eta_2)):
        check_within(name, eta, lowest, 1e3, "Pa s", cure)
    for name, T in (
        ("temperature_1", temperature_1),
        ("temperature_2", temperature_2),
        ("alpha_temperature", alpha_temperature),
    ):
        check_within(name, T, GLASS_TEMPERATURE + 1.0, 1000.0, "K", "40 degC is 313.15 K.")
    check_positive("alpha", alpha, "1/Pa", "14.4 1/GPa is 1.44e-8 1/Pa.")
    if (eta_1 - eta_2) * (temperature_2 - temperature_1) <= 0.0:
        raise ParameterError(
            f"Viscosity must fall with temperature, got {eta_1:g} Pa s at {temperature_1:g} K "
            f"and {eta_2:g} Pa s at {temperature_2:g} K."
        )
    L_1 = math.log(eta_1) + ROELANDS_LOG_VISCOSITY
    L_2 = math.log(eta_2) + ROELANDS_LOG_VISCOSITY
    t_1, t_2 = temperature_1 - GLASS_TEMPERATURE, temperature_2 - GLASS_TEMPERATURE
    S0 = math.log(L_1 / L_2) / math.log(t_2 / t_1)
    L_alpha = L_1 * ((alpha_temperature - GLASS_TEMPERATURE) / t_1) ** -S0
    Z = roelands_exponent(math.exp(L_alpha - ROELANDS_LOG_VISCOSITY), alpha)
    return HoupertParameters(L_1, temperature_1, S0, Z)


def houpert_parameters(lubricant: Lubricant) -> HoupertParameters:
    """Return the law of an oil of the library, fitted at 40 and 100 degC.

    Between the two temperatures it departs from the double-logarithmic line of Walther by less
    than 3 %.

    Examples
    --------
    >>> law = houpert_parameters(Lubricant.named("karagiannis_2012"))
    >>> round(law.S0, 3), round(law.Z, 3)
    (1.006, 0.386)
    """
    return fit_houpert(
        lubricant.dynamic_viscosity(_COLD),
        _COLD,
        lubricant.dynamic_viscosity(_HOT),
        _HOT,
        lubricant.roelands_slope,
        lubricant.alpha_temperature,
    )


@kernel
def houpert_log_viscosity(law: HoupertParameters, pressure: float, temperature: float) -> float:
    """Return the reduced logarithm of the viscosity.

    ln eta + 9.67 = (ln eta_0 + 9.67) [(T - 138)/(T_0 - 138)]^(-S0) (1 + 5.1e-9 p)^Z

    Parameters
    ----------
    law
        Constants of the law for one oil.
    pressure
        Gauge pressure p [Pa].
    temperature
        T [K], above 138 K.

    Returns
    -------
    float
        [-].

    Notes
    -----
    To about 1 GPa, as `roelands_viscosity`, to which it reduces at T_0. Karagiannis et al. 2012
    add 273 to the temperature in degC; 273.15 here changes S0 by 0.07 %.
    Source: [houpert_1985]; [karagiannis_2012 (16)], [karagiannis_2012 (17)].
    """
    cooling = math.log((temperature - GLASS_TEMPERATURE) / (law.temperature - GLASS_TEMPERATURE))
    compression = math.log(1.0 + ROELANDS_PRESSURE * pressure)
    return law.log_viscosity * math.exp(law.Z * compression - law.S0 * cooling)


@kernel
def houpert_viscosity(law: HoupertParameters, pressure: float, temperature: float) -> float:
    """Return the viscosity [Pa s]; parameters, range and source as `houpert_log_viscosity`."""
    return math.exp(houpert_log_viscosity(law, pressure, temperature) - ROELANDS_LOG_VISCOSITY)


@kernel
def houpert_temperature_coefficient(
    law: HoupertParameters, log_viscosity: float, temperature: float
) -> float:
    """Return the temperature-viscosity coefficient.

    beta = -d ln eta/dT = S0 (ln eta + 9.67)/(T - 138)

    Parameters
    ----------
    law
        Constants of the law for one oil.
    log_viscosity
        ln eta + 9.67 at the pressure and temperature of interest [-].
    temperature
        T [K].

    Returns
    -------
    float
        beta [1/K]; grows with pressure.

    Notes
    -----
    Source: derivative of `houpert_log_viscosity`.
    """
    return law.S0 * log_viscosity / (temperature - GLASS_TEMPERATURE)
