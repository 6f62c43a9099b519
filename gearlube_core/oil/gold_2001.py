"""Pressure-viscosity coefficient from the kinematic viscosity and the class of the base oil."""

from __future__ import annotations

import math

from gearlube_core.checks import check_option
from gearlube_core.oil.roelands_1966 import (
    ROELANDS_LOG_VISCOSITY,
    ROELANDS_PRESSURE,
    pressure_viscosity_coefficient,
)
from gearlube_core.oil.walther_1931 import MM2_S

SECANT_PRESSURE = 2.0e8  # Pa, of the correlated coefficient
# [gold_2001]: s [1/GPa] and t [-]
_CONSTANTS = {
    "mineral": (9.904, 0.1390),
    "pao": (7.382, 0.1335),
    "ester": (6.605, 0.1360),
    "pag": (5.489, 0.1485),
}


def secant_coefficient(base_oil: str, nu: float) -> float:
    """Return the mean pressure-viscosity coefficient up to 200 MPa.

    alpha_2000 = s nu^t, nu in mm2/s, alpha in 1/GPa

    Parameters
    ----------
    base_oil : {"mineral", "pao", "ester", "pag"}
        Mineral: paraffinic.
    nu : float
        Kinematic viscosity at atmospheric pressure and the temperature of interest [m2/s].

    Returns
    -------
    float
        ln(eta/eta0)/p at p = 200 MPa [1/Pa].

    Notes
    -----
    The form is quoted by [arana_2019]; the constants are from memory, not compared with the
    printed source. Measured: FVA 3A is 3 % higher at 25 and 6 % at 80 degC [manjunath_2023]; a
    paraffinic and a PAO oil of ISO VG 100 at 40 degC are 3 % higher, a naphthenic one 46 %
    [arana_2019 Table 3]. No measured ester or polyglycol was at hand.
    Source: [gold_2001].

    Examples
    --------
    >>> round(1e9 * secant_coefficient("pao", 94.1e-6), 1)  # 1/GPa
    13.5
    """
    check_option("base_oil", base_oil, _CONSTANTS)
    s, t = _CONSTANTS[base_oil]
    return 1e-9 * float(s * (nu / MM2_S) ** t)


def ambient_coefficient(secant: float, eta0: float) -> float:
    """Return the slope of ln eta at ambient pressure for a mean slope up to 200 MPa.

    By Roelands' law: Z = ln[1 + alpha_2000 p/(ln eta0 + 9.67)]/ln(1 + 5.1e-9 p)

    Parameters
    ----------
    secant : float
        From `secant_coefficient` [1/Pa].
    eta0 : float
        Viscosity at ambient pressure, the same temperature [Pa s].

    Returns
    -------
    float
        alpha [1/Pa]; 13 to 23 % above the mean slope for gear oils.

    Notes
    -----
    With `secant_coefficient`, at 40 and 100 degC: a measured paraffinic oil of ISO VG 100 is
    4 % lower and 2 % higher, a PAO 7 and 11 % lower, a naphthenic oil 25 and 13 % higher
    [arana_2019 Table 3].
    """
    growth = secant * SECANT_PRESSURE / (math.log(eta0) + ROELANDS_LOG_VISCOSITY)
    Z = math.log1p(growth) / math.log1p(ROELANDS_PRESSURE * SECANT_PRESSURE)
    return float(pressure_viscosity_coefficient(eta0, Z))
