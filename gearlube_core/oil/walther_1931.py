"""Viscosity against temperature: the double-logarithmic line of Walther, ASTM D341."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.viscosity_constants import MM2_S, WALTHER_SHIFT

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
