"""Central film of a line contact across all regimes, Moes 1992."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel


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
