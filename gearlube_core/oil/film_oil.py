"""How the oil in a film answers to pressure and temperature: kernels and the data they take.

One form holds every viscosity law here,

    eta = eta0 exp{A [t^(-S0) (1 + chi p)^Z - 1]},  t = (T - 138)/(T0 - 138)

Roelands with A = ln(eta0/kappa), Houpert with S0 above zero, Barus with Z = 1, A = alpha/chi.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.houpert_1985 import GLASS_TEMPERATURE

ROELANDS_CHI = 5.1e-9  # 1/Pa, [jamali_2015 (3.4)]
ROELANDS_KAPPA = 63.15e-6  # Pa s, [jamali_2015 (3.4)]
DOWSON_HIGGINSON_GAMMA = 2.266e-9  # 1/Pa, [jamali_2015 (3.5)]
DOWSON_HIGGINSON_LAMBDA = 1.683e-9  # 1/Pa, the same
VISCOSITY_LAWS = ("barus", "roelands", "houpert")
DENSITY_LAWS = ("dowson_higginson", "incompressible")

# eta/eta0 = e^200 lies far above glass; beyond, the law goes on along its tangent in ln eta
_LARGEST_EXPONENT = 200.0
_LARGEST_RATIO = math.exp(_LARGEST_EXPONENT)


class EhlLubricant(NamedTuple):
    """Oil of a film; all floats, SI. Build it with `ehl_lubricant` or `lubricant_from_library`."""

    eta0: float  # viscosity at ambient pressure and `temperature` [Pa s]
    log_ratio: float  # A [-]
    chi: float  # [1/Pa]
    Z: float  # [-]
    rho0: float  # density at ambient pressure and `temperature` [kg/m3]
    gamma: float  # of the density law [1/Pa]; 0 with `lam` 0: incompressible
    lam: float  # of the density law [1/Pa]
    tau0: float  # Eyring stress [Pa]; 0: Newtonian
    tau_limit: float  # limiting shear stress at ambient pressure [Pa]
    limit_slope: float  # its slope with pressure [-]; both 0: no limit
    temperature: float  # T0 [K]
    S0: float  # temperature exponent [-]; 0: isothermal
    expansion: float  # thermal expansion of volume [1/K]
    conductivity: float  # [W/(m K)]
    heat_capacity: float  # [J/(kg K)]


@kernel
def _bounded_exponential(y: float) -> float:
    # exp(y) with a linear tail: the value goes on growing, so a Newton step still sees a slope
    if y > _LARGEST_EXPONENT:
        return _LARGEST_RATIO * (1.0 + y - _LARGEST_EXPONENT)
    return math.exp(y)


@kernel
def _bounded_exponential_slope(y: float) -> float:
    if y > _LARGEST_EXPONENT:
        return _LARGEST_RATIO
    return math.exp(y)


@kernel
def _pressure_exponent(oil: EhlLubricant, p: float) -> float:
    # (1 + chi p)^Z - 1; below ambient pressure its tangent at zero
    if p <= 0.0:
        return oil.Z * oil.chi * p
    return math.expm1(oil.Z * math.log1p(oil.chi * p))


@kernel
def _pressure_exponent_slope(oil: EhlLubricant, p: float) -> float:
    if p <= 0.0:
        return oil.Z * oil.chi
    return oil.Z * oil.chi * math.exp((oil.Z - 1.0) * math.log1p(oil.chi * p))


@kernel
def viscosity(oil: EhlLubricant, p: float) -> float:
    """Return the viscosity at the reference temperature.

    eta = eta0 exp{A [(1 + chi p)^Z - 1]}

    Parameters
    ----------
    oil
        Lubricant data.
    p
        Gauge pressure [Pa].

    Returns
    -------
    float
        eta [Pa s].

    Notes
    -----
    Meant for 0 to about 1 GPa. Below zero the tangent exponential eta0 exp(alpha p) is taken;
    above eta/eta0 = e^200 the ratio grows linearly in the exponent, so that no step of an
    iteration can overflow. Source: [roelands_1966] [jamali_2015 (3.4)]
    """
    return oil.eta0 * _bounded_exponential(oil.log_ratio * _pressure_exponent(oil, p))


@kernel
def viscosity_slope(oil: EhlLubricant, p: float) -> float:
    """Return d eta/dp [s], the exact derivative of `viscosity`."""
    ratio = _bounded_exponential_slope(oil.log_ratio * _pressure_exponent(oil, p))
    return oil.eta0 * ratio * oil.log_ratio * _pressure_exponent_slope(oil, p)


@kernel
def thermal_viscosity(oil: EhlLubricant, p: float, temperature: float) -> float:
    """Return the viscosity at a pressure [Pa] and a temperature [K], above 138 K [Pa s].

    eta = eta0 exp{A [t^(-S0) (1 + chi p)^Z - 1]},  t = (T - 138)/(T0 - 138)

    Notes
    -----
    Source: [houpert_1985]. At the reference temperature it is `viscosity`.
    """
    t = (temperature - GLASS_TEMPERATURE) / (oil.temperature - GLASS_TEMPERATURE)
    cooling = math.expm1(-oil.S0 * math.log(t))
    growth = _pressure_exponent(oil, p)
    return oil.eta0 * _bounded_exponential(oil.log_ratio * (growth + cooling * (1.0 + growth)))


@kernel
def cooling_factor(oil: EhlLubricant, temperature: float) -> float:
    """Return t^(-S0), t = (T - 138)/(T0 - 138), of the law of Houpert [-]; T [K]."""
    t = (temperature - GLASS_TEMPERATURE) / (oil.temperature - GLASS_TEMPERATURE)
    return math.exp(-oil.S0 * math.log(t))


@kernel
def viscosity_cooling(oil: EhlLubricant, p: float, temperature: float) -> float:
    """Return -d ln eta/dT of the law of Houpert at a pressure [Pa] and a temperature [K] [1/K]."""
    exponent = cooling_factor(oil, temperature) * (1.0 + _pressure_exponent(oil, p))
    return oil.log_ratio * oil.S0 * exponent / (temperature - GLASS_TEMPERATURE)


@kernel
def thermal_log_slope(oil: EhlLubricant, p: float, cooling: float) -> tuple[float, float]:
    """Return ln(eta/eta0) and its slope with pressure at a cooling factor.

    Parameters
    ----------
    oil
        Lubricant data.
    p
        Gauge pressure [Pa].
    cooling
        `cooling_factor` of the temperature [-]; 1 at the reference temperature.

    Returns
    -------
    tuple of float
        ln(eta/eta0) [-] and d ln eta/dp [1/Pa], without the linear tail of `viscosity`.
    """
    growth = _pressure_exponent(oil, p)
    log_eta = oil.log_ratio * (cooling * growth + cooling - 1.0)
    return log_eta, oil.log_ratio * cooling * _pressure_exponent_slope(oil, p)


@kernel
def density(oil: EhlLubricant, p: float) -> float:
    """Return the density at the reference temperature.

    rho = rho0 (1 + gamma p)/(1 + lambda p)

    Parameters
    ----------
    oil
        Lubricant data.
    p
        Gauge pressure [Pa]; below zero rho0 is returned.

    Returns
    -------
    float
        rho [kg/m3].

    Notes
    -----
    Measured to about 0.4 GPa; bounded by 1.346 rho0 at any pressure. (3.5)
    prints another letter for gamma p in the numerator.
    Source: [dowson_higginson_1966] [jamali_2015 (3.5)]
    """
    if p <= 0.0:
        return oil.rho0
    return oil.rho0 * (1.0 + oil.gamma * p) / (1.0 + oil.lam * p)


@kernel
def density_slope(oil: EhlLubricant, p: float) -> float:
    """Return d rho/dp [s2/m2], the exact derivative of `density`; from above at zero."""
    if p < 0.0:
        return 0.0
    return oil.rho0 * (oil.gamma - oil.lam) / (1.0 + oil.lam * p) ** 2


@kernel
def limiting_stress(oil: EhlLubricant, p: float) -> float:
    """Return the limiting shear stress tau_limit + slope p [Pa]; infinite where there is none."""
    limit = oil.tau_limit + oil.limit_slope * max(p, 0.0)
    return limit if limit > 0.0 else math.inf


@kernel
def fill_properties(
    oil: EhlLubricant,
    p: np.ndarray,
    eta: np.ndarray,
    eta_slope: np.ndarray,
    rho: np.ndarray,
    rho_slope: np.ndarray,
) -> None:
    """Fill viscosity [Pa s], density [kg/m3] and their slopes with pressure.

    Parameters
    ----------
    oil
        Lubricant data.
    p
        Pressure [Pa], one-dimensional.
    eta, eta_slope, rho, rho_slope
        Filled; of the shape of `p`.
    """
    for i in range(p.size):
        y = oil.log_ratio * _pressure_exponent(oil, p[i])
        eta[i] = oil.eta0 * _bounded_exponential(y)
        steepness = oil.log_ratio * _pressure_exponent_slope(oil, p[i])
        eta_slope[i] = oil.eta0 * _bounded_exponential_slope(y) * steepness
        rho[i] = density(oil, p[i])
        rho_slope[i] = density_slope(oil, p[i])


@kernel
def fill_warm_properties(
    oil: EhlLubricant,
    p: np.ndarray,
    cooling: np.ndarray,
    dilation: np.ndarray,
    eta: np.ndarray,
    eta_slope: np.ndarray,
    rho: np.ndarray,
    rho_slope: np.ndarray,
) -> None:
    """Fill viscosity, density and their slopes in a film of uneven temperature.

    Parameters
    ----------
    oil, p, eta, eta_slope, rho, rho_slope
        As in `fill_properties`.
    cooling, dilation
        `cooling_factor` and the density's factor by heat, of the shape of `p` [-].
    """
    for i in range(p.size):
        y, slope = thermal_log_slope(oil, p[i], cooling[i])
        eta[i] = oil.eta0 * _bounded_exponential(y)
        eta_slope[i] = oil.eta0 * _bounded_exponential_slope(y) * slope
        rho[i] = dilation[i] * density(oil, p[i])
        rho_slope[i] = dilation[i] * density_slope(oil, p[i])


@kernel
def pressure_viscosity(oil: EhlLubricant) -> float:
    """Return alpha = A Z chi, the slope of ln eta with pressure at ambient pressure [1/Pa]."""
    return oil.log_ratio * oil.Z * oil.chi


def ehl_lubricant(
    *,
    eta0: float,
    alpha: float,
    law: str = "roelands",
    density_law: str = "dowson_higginson",
    rho0: float = 870.0,
    eyring_stress: float | None = None,
    limiting_shear: tuple[float, float] | None = None,
    temperature: float = 313.15,
    temperature_exponent: float = 0.0,
    expansion: float = 0.0,
    conductivity: float = 0.14,
    heat_capacity: float = 2000.0,
) -> EhlLubricant:
    """Return the data of an oil from its viscosity and pressure coefficient.

    Parameters
    ----------
    eta0 : float
        Viscosity at ambient pressure [Pa s]; above 63.15e-6 Pa s for Roelands.
    alpha : float
        Pressure-viscosity coefficient [1/Pa], 0 for constant viscosity.
    law : {"barus", "roelands", "houpert"}
        Viscosity law. Houpert is Roelands with `temperature_exponent` above zero.
    density_law : {"dowson_higginson", "incompressible"}
        Density law.
    rho0 : float
        Density [kg/m3].
    eyring_stress : float, optional
        tau0 [Pa]; without it the oil is Newtonian.
    limiting_shear : tuple of float, optional
        Limiting shear stress at ambient pressure [Pa] and its slope with pressure [-].
    temperature : float
        Of the oil at the inlet [K].
    temperature_exponent, expansion, conductivity, heat_capacity : float
        S0 of Houpert [-], [1/K], [W/(m K)], [J/(kg K)]: used by thermal solutions only.

    Returns
    -------
    EhlLubricant

    Raises
    ------
    ParameterError
        When a number is out of range.

    Examples
    --------
    >>> oil = ehl_lubricant(eta0=0.00625, alpha=13.3e-9)
    >>> round(oil.Z, 4)
    0.5676
    """
    check_option("law", law, VISCOSITY_LAWS)
    check_option("density_law", density_law, DENSITY_LAWS)
    lowest = 0.0 if law == "barus" else 1.0001 * ROELANDS_KAPPA
    check_positive("eta0", eta0, "Pa s", "20 cP is 0.02 Pa s.")
    check_within("eta0", eta0, lowest, 1e4, "Pa s", "20 cP is 0.02 Pa s.")
    check_within("alpha", alpha, 0.0, 1e-6, "1/Pa", "20 1/GPa is 2e-8 1/Pa.")
    check_within("rho0", rho0, 100.0, 3000.0, "kg/m3", "0.87 g/cm3 is 870 kg/m3.")
    check_within("temperature", temperature, GLASS_TEMPERATURE + 1.0, 1000.0, "K")
    check_within("temperature_exponent", temperature_exponent, 0.0, 5.0)
    if law != "houpert" and temperature_exponent > 0.0:
        check_within("temperature_exponent", temperature_exponent, 0.0, 0.0, "", "Take houpert.")
    check_within("expansion", expansion, 0.0, 1e-2, "1/K")
    check_positive("conductivity", conductivity, "W/(m K)")
    check_positive("heat_capacity", heat_capacity, "J/(kg K)")
    tau0 = 0.0
    if eyring_stress is not None:
        tau0 = check_within("eyring_stress", eyring_stress, 1e4, 1e12, "Pa", "5 MPa is 5e6 Pa.")
    limit, slope = (0.0, 0.0) if limiting_shear is None else limiting_shear
    check_within("limiting_shear[0]", limit, 0.0, 1e10, "Pa", "5 MPa is 5e6 Pa.")
    check_within("limiting_shear[1]", slope, 0.0, 1.0)
    if law == "barus":
        log_ratio, Z = alpha / ROELANDS_CHI, 1.0
    else:
        log_ratio = math.log(eta0 / ROELANDS_KAPPA)
        Z = alpha / (ROELANDS_CHI * log_ratio)
    compressible = density_law == "dowson_higginson"
    return EhlLubricant(
        eta0=float(eta0),
        log_ratio=float(log_ratio),
        chi=ROELANDS_CHI,
        Z=float(Z),
        rho0=float(rho0),
        gamma=DOWSON_HIGGINSON_GAMMA if compressible else 0.0,
        lam=DOWSON_HIGGINSON_LAMBDA if compressible else 0.0,
        tau0=tau0,
        tau_limit=float(limit),
        limit_slope=float(slope),
        temperature=float(temperature),
        S0=float(temperature_exponent),
        expansion=float(expansion),
        conductivity=float(conductivity),
        heat_capacity=float(heat_capacity),
    )
