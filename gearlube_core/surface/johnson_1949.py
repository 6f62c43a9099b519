"""Johnson's distributions: heights of any skewness and kurtosis from normal ones [johnson_1949]."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares
from scipy.special import expit, ndtri

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

# of normal heights and their shares, for moments: the rule of even steps is exact to rounding
_NORMAL = np.linspace(-10.0, 10.0, 401)
_SHARES = np.exp(-0.5 * _NORMAL**2) / np.exp(-0.5 * _NORMAL**2).sum()
_BOUNDS = ([-12.0, 1e-4], [12.0, 20.0])  # shift, scale
_STOP = 1e-8
_STARTS = ((0.3, 0.3), (2.0, 0.7), (0.5, 2.0), (4.0, 1.0), (1.0, 6.0))
_SOLVED = 1e-4  # near the normal distribution the moments hardly change with the scale


def check_moments(skewness: float, kurtosis: float) -> None:
    """Refuse a kurtosis that no distribution with this skewness has.

    kurtosis >= skewness^2 + 1 [johnson_1949]; only two heights reach the bound itself.
    """
    lowest = skewness**2 + 1.0
    if not kurtosis > lowest:
        raise ParameterError(
            f"kurtosis must be above skewness^2 + 1 = {lowest:.4g}, got {kurtosis:g}. No "
            "distribution of heights has less. Normally distributed heights have 3."
        )


def normal_scores(count: int) -> Array:
    """Return the heights (count,) [-] of a standard normal distribution at even shares."""
    return np.asarray(ndtri((np.arange(count) + 0.5) / count))


def lognormal_kurtosis(skewness: float) -> float:
    """Return the kurtosis [-] of the lognormal distribution with a skewness.

    It parts the unbounded distributions (above) from the bounded ones (below) [johnson_1949].
    """
    square = skewness**2
    w = 1.0
    if square > 0.0:
        w = brentq(lambda w: (w + 2.0) ** 2 * (w - 1.0) - square, 1.0, 1.0 + square)
    return w**4 + 2.0 * w**3 + 3.0 * w**2 - 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class JohnsonTransform:
    """A rising function of normal heights; its scale is free.

    Unbounded: sinh((g - gamma)/delta), bounded: 1/(1 + exp(-(g - gamma)/delta)) [johnson_1949].

    Parameters
    ----------
    bounded
        Which of the two.
    shift, scale
        -gamma/delta, 1/delta [-] for a skewness of zero or above.
    sign
        -1: turned round, for one below zero.
    """

    bounded: bool
    shift: float
    scale: float
    sign: float

    def __call__(self, normal: Array) -> Array:
        """Return the heights [-] of normal ones [-]."""
        shape = expit if self.bounded else np.sinh
        return np.asarray(self.sign * shape(self.shift + self.sign * self.scale * normal))


def johnson_transform(
    skewness: float, kurtosis: float, near: JohnsonTransform | None = None
) -> JohnsonTransform:
    """Return the function that gives normal heights these moments.

    Parameters
    ----------
    skewness, kurtosis
        [-]. Near the lowest kurtosis the bounded distribution has two peaks.
    near
        One with moments nearby, from which the search starts.

    Raises
    ------
    ParameterError
        No distribution has these moments, or none is found.
    """
    check_moments(skewness, kurtosis)
    lean = abs(skewness)
    bounded = kurtosis <= lognormal_kurtosis(lean)
    shape, side = (expit, -1.0) if bounded else (np.sinh, 1.0)

    def error(at: Array) -> list[float]:
        got = _moments(shape(at[0] + at[1] * _NORMAL))
        return [got[0] - lean, (got[1] - kurtosis) / kurtosis]

    starts = [(side * shift, scale) for shift, scale in _STARTS]
    if near is not None and near.bounded == bounded:
        starts.insert(0, (near.shift, near.scale))
    for start in starts:
        found = least_squares(error, start, bounds=_BOUNDS, xtol=_STOP, ftol=_STOP)
        if np.abs(found.fun).max() < _SOLVED:
            shift, scale = (float(one) for one in found.x)
            sign = math.copysign(1.0, skewness)
            return JohnsonTransform(bounded=bounded, shift=shift, scale=scale, sign=sign)
    raise ParameterError(
        f"No distribution of heights was found for skewness {skewness:.4g} and kurtosis "
        f"{kurtosis:.4g}. Take a kurtosis farther from skewness^2 + 1 = {skewness**2 + 1.0:.4g}, "
        "or a smaller skewness."
    )


def _moments(values: Array) -> tuple[float, float]:
    deviation = values - _SHARES @ values
    deviation = deviation / math.sqrt(_SHARES @ deviation**2)
    return float(_SHARES @ deviation**3), float(_SHARES @ deviation**4)
