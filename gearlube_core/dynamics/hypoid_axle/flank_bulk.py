"""Temperature of the flanks' bulk from their own friction."""

from __future__ import annotations

import math
from collections.abc import Callable

from scipy.optimize import brentq

SETTLED = 0.01  # K, error of the temperature


def bulk_temperature(
    friction: Callable[[float], float], oil: float, resistance: float, highest: float
) -> float:
    """Return the temperature of the flanks at which their friction keeps them warm [K].

    T = T_oil + R P(T)

    Parameters
    ----------
    friction
        Mean power lost in friction of the flanks [W] with films at a temperature [K].
    oil
        Temperature of the oil around the teeth [K].
    resistance
        From the flanks to that oil [K/W].
    highest
        Highest temperature at which the friction is known [K].

    Returns
    -------
    float
        The lowest such temperature within `SETTLED`; nan: above `highest`.

    Notes
    -----
    One temperature for both members, steady. Thin hot films may rub more: the friction need not
    fall with temperature.

    Examples
    --------
    >>> round(bulk_temperature(lambda T: 700.0 - T, 300.0, 0.25, 400.0), 2)
    380.0
    """

    def missing(temperature: float) -> float:
        return oil + resistance * friction(temperature) - temperature

    low, gap = oil, missing(oil)
    if gap <= SETTLED:
        return oil + max(gap, 0.0)
    while low < highest:
        high = min(low + 1.05 * gap + SETTLED, highest)
        above = missing(high)
        if above <= 0.0:
            return float(brentq(missing, low, high, xtol=SETTLED, rtol=1e-12))
        low, gap = high, above
    return math.nan
