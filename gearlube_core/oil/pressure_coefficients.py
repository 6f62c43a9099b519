"""Pressure-viscosity coefficients of one law of viscosity: which alpha a number is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal

import numpy as np

from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_laws import log_viscosity

AlphaIs = Literal["film", "slope", "mean"]
ALPHA_WORDS = {
    "film": "from measured films: [integral of eta0/eta over pressure]^-1",
    "slope": "slope of ln eta at ambient pressure",
    "mean": "mean slope of ln eta from ambient to a pressure",
}
MEAN_PRESSURE = 2.0e8  # Pa, the usual end of a mean slope
_LOST = 40.0  # of ln(eta/eta0): what thicker oil adds to the integral is below rounding
_FARTHEST = 10.0  # end of the integral, of a law that never gets there, over _LOST/slope
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(200)


def pressure_coefficient(law: Any, alpha_is: AlphaIs, to: float = MEAN_PRESSURE) -> float:
    """Return the pressure-viscosity coefficient of a law of viscosity.

    slope: d ln eta/dp at p = 0;  mean: ln(eta/eta0)/p;  film: [int eta0/eta dp]^-1

    Parameters
    ----------
    law
        For kernels, see `film_laws`; its viscosity must grow with pressure.
    alpha_is : {"film", "slope", "mean"}
        Film: the reciprocal asymptotic isoviscous pressure, to which films at moderate pressure
        respond.
    to : float
        Pressure of the mean slope [Pa].

    Returns
    -------
    float
        alpha [1/Pa].

    Notes
    -----
    The integral ends where ln(eta/eta0) is 40 or, of a law that saturates, at some ten times the
    pressure at which it would be without.
    Source: [bair_liu_wang_2006].

    Examples
    --------
    >>> from gearlube_core.oil.film_laws import barus, roelands
    >>> round(1e9 * pressure_coefficient(barus(2e-8), "film"), 6)  # 1/GPa
    20.0
    >>> law = roelands(0.03, 2e-8)
    >>> [round(1e9 * pressure_coefficient(law, one), 2) for one in ("slope", "mean", "film")]
    [20.0, 17.39, 18.39]
    """
    check_option("alpha_is", alpha_is, ALPHA_WORDS)
    slope = log_viscosity(law, 0.0, 1.0)[1]
    if alpha_is == "slope":
        return float(slope)
    if alpha_is == "mean":
        return float(log_viscosity(law, to, 1.0)[0] / to)
    end, most = _LOST / slope, _FARTHEST * _LOST / slope
    while end < most and log_viscosity(law, end, 1.0)[0] < _LOST:
        end *= 1.5
    # of p = end x^2: near, where the oil is thin, lie most points
    x = 0.5 * (_POINTS + 1.0)
    thin = [np.exp(-log_viscosity(law, end * one * one, 1.0)[0]) for one in x]
    return float(1.0 / np.dot(_WEIGHTS * end * x, thin))


def slope_for(
    law_of: Callable[[float], Any], alpha: float, alpha_is: AlphaIs, to: float = MEAN_PRESSURE
) -> float:
    """Return the slope at ambient pressure of the law that has a given coefficient.

    Parameters
    ----------
    law_of
        Returns the law for kernels of a slope [1/Pa].
    alpha, alpha_is, to
        Coefficient [1/Pa] and what it is, see `pressure_coefficient`.

    Raises
    ------
    ParameterError
        No slope from a quarter to four times the coefficient gives it.

    Examples
    --------
    >>> from gearlube_core.oil.film_laws import roelands
    >>> round(1e9 * slope_for(lambda slope: roelands(0.03, slope), 1.8392e-8, "film"), 1)
    20.0
    """
    if alpha_is == "slope":
        return alpha
    from scipy.optimize import brentq  # takes a third of a second

    def excess(slope: float) -> float:
        return pressure_coefficient(law_of(slope), alpha_is, to) - alpha

    low, high = 0.25 * alpha, 4.0 * alpha
    if not excess(low) < 0.0 < excess(high):
        raise ParameterError(
            f"No slope of the viscosity law at ambient pressure between {1e9 * low:.3g} and "
            f"{1e9 * high:.3g} 1/GPa gives {ALPHA_WORDS[alpha_is]} of {1e9 * alpha:.4g} 1/GPa. "
            "Take another law, or check alpha and what it is."
        )
    return float(brentq(excess, low, high, rtol=1e-12, xtol=1e-20))
