"""Requested statistics of a generated surface, and checks that need no computation."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares
from scipy.special import expit, ndtri

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_option, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.surface.heights import MICROMETRE, NODES_PER_WAVE
from gearlube_core.surface.spectrum import CORRELATION_LEVEL

# of normal heights and their shares, for moments: the rule of even steps is exact to rounding
_NORMAL = np.linspace(-10.0, 10.0, 401)
_SHARES = np.exp(-0.5 * _NORMAL**2) / np.exp(-0.5 * _NORMAL**2).sum()
_BOUNDS = ([-12.0, 1e-4], [12.0, 20.0])  # shift, scale
_STOP = 1e-8
_STARTS = ((0.3, 0.3), (2.0, 0.7), (0.5, 2.0), (4.0, 1.0), (1.0, 6.0))
_SOLVED = 1e-4  # near the normal distribution the moments hardly change with the scale
SHAPES = ("exponential", "gaussian")
_FEWEST_NODES = 2.0  # a wave: shorter ones have no meaning on a grid
_LARGEST_HEIGHT = 1e-4  # m, of Ra or Rq of a machined surface
_MOST_SKEWNESS, _MOST_KURTOSIS = 10.0, 150.0  # beyond any machined surface
_SHARE_OF_PERIOD = 0.25  # longest correlation length in a period


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


@dataclass(frozen=True, slots=True, kw_only=True)
class RoughnessRequest:
    """Wanted statistics of a random profile or map, for `generated_profile` and `generated_map`.

    Parameters
    ----------
    correlation_length
        Distance at which the autocorrelation falls to `correlation_level` [m]; of a map: across
        its lay.
    arithmetic_mean, root_mean_square
        Ra (Sa) or Rq (Sq) [m]; give one of them.
    correlation_length_along
        The same along the lay of a map [m]; None: as across.
    lay
        Direction of the crests of a map, from y towards x [rad].
    skewness, kurtosis
        Skewness and kurtosis of the heights [-]; 0 and 3 for normally distributed heights.
    shortest_wave, longest_wave
        Limits of the band of waves [m]; None: 8 spacings, and the longest that fits the periods.
    autocorrelation
        Shape of the autocorrelation before the band is cut: exponential, or gaussian with fewer
        short waves.
    correlation_level
        Level that defines the correlation length [-]; 0.2 is the default of [iso_25178_2].

    Raises
    ------
    ParameterError
        A number is out of its range, both or no height are given, no distribution has these
        moments, or a band is too long for the correlation length.

    Examples
    --------
    >>> RoughnessRequest(root_mean_square=4e-7, correlation_length=8e-6).kurtosis
    3.0
    """

    correlation_length: float
    arithmetic_mean: float | None = None
    root_mean_square: float | None = None
    correlation_length_along: float | None = None
    lay: float = 0.0
    skewness: float = 0.0
    kurtosis: float = 3.0
    shortest_wave: float | None = None
    longest_wave: float | None = None
    autocorrelation: str = "exponential"
    correlation_level: float = CORRELATION_LEVEL

    def __post_init__(self) -> None:
        heights = (self.arithmetic_mean, self.root_mean_square)
        if sum(one is not None for one in heights) != 1:
            raise ParameterError(
                "Give one of arithmetic_mean (Ra, Sa) and root_mean_square (Rq, Sq) in m, got "
                f"{heights[0]} and {heights[1]}. Normally distributed heights have Rq = 1.253 Ra."
            )
        for name in ("arithmetic_mean", "root_mean_square"):
            value = getattr(self, name)
            if value is not None:
                check_positive(name, value, "m")
                check_within(
                    name, value, 0.0, _LARGEST_HEIGHT, "m", "Give it in m: 0.3 um is 3e-7 m."
                )
        for name in ("correlation_length", "correlation_length_along", "shortest_wave"):
            value = getattr(self, name)
            if value is not None:
                check_positive(name, value, "m")
        check_within("skewness", self.skewness, -_MOST_SKEWNESS, _MOST_SKEWNESS)
        check_within("kurtosis", self.kurtosis, 1.0, _MOST_KURTOSIS)
        check_finite("lay", self.lay, "rad")
        check_moments(self.skewness, self.kurtosis)
        check_option("autocorrelation", self.autocorrelation, SHAPES)
        check_within("correlation_level", self.correlation_level, 0.05, 0.9)
        self._check_band()

    def _check_band(self) -> None:
        short, long = self.shortest_wave, self.longest_wave
        if long is not None and long <= (short or 0.0):
            raise ParameterError(
                f"longest_wave must exceed shortest_wave, {(short or 0.0) / MICROMETRE:.4g} um, "
                f"got {long / MICROMETRE:.4g} um. Swap them or widen the band."
            )
        if short is not None:
            # no sum of waves falls sooner than the cosine of the shortest
            lowest = short * math.acos(self.correlation_level) / (2.0 * math.pi)
            check_reachable(self.correlation_length, lowest, short)

    def resolved_shortest(self, spacing: float) -> tuple[float, tuple[str, ...]]:
        """Return the shortest wave [m] on a spacing [m], and what is to be said of it.

        Raises
        ------
        ParameterError
            It is shorter than two spacings.
        """
        if self.shortest_wave is None:
            return NODES_PER_WAVE * spacing, ()
        nodes = self.shortest_wave / spacing
        if nodes < _FEWEST_NODES:
            raise ParameterError(
                f"shortest_wave must be at least {_FEWEST_NODES:g} spacings, "
                f"{_FEWEST_NODES * spacing / MICROMETRE:.4g} um, got "
                f"{self.shortest_wave / MICROMETRE:.4g} um. Take a finer spacing or longer waves."
            )
        if nodes < NODES_PER_WAVE * (1.0 - 1e-9):
            return self.shortest_wave, (
                f"The shortest wave has {nodes:.3g} nodes; films need {NODES_PER_WAVE:g}, "
                f"a spacing of {self.shortest_wave / NODES_PER_WAVE / MICROMETRE:.4g} um.",
            )
        return self.shortest_wave, ()


def check_reachable(length: float, lowest: float, shortest: float) -> None:
    """Refuse a correlation length that the shortest wave of a band cannot have."""
    if length < lowest:
        raise ParameterError(
            f"correlation_length must be at least {lowest / MICROMETRE:.4g} um with waves of "
            f"{shortest / MICROMETRE:.4g} um and longer, got {length / MICROMETRE:.4g} um. "
            "Allow shorter waves or ask for a longer length."
        )


def check_fits(name: str, length: float, period: float) -> None:
    """Refuse a correlation length that a period cannot show."""
    if length > _SHARE_OF_PERIOD * period:
        raise ParameterError(
            f"{name} must be at most a quarter of the period, "
            f"{_SHARE_OF_PERIOD * period / MICROMETRE:.4g} um, got {length / MICROMETRE:.4g} um. "
            "Take a longer period; for a straight lay extrude a profile."
        )
