"""Load and area carried by the asperities of two rough surfaces, Greenwood and Tripp 1971."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import gamma, pbdv

from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number

LAMBDA_CRITICAL = 3.0  # Mohammadpour et al. 2015, below [mohammadpour_2015 (19)]
# of rollers on a race, the values of [wingertszahn_2023]; none for gear flanks are known
RACE_B, RACE_C = 2.32, 0.97


@kernel
def f_5_2_as_printed(film_ratio: float) -> float:
    """Return the load integral as printed.

    -0.004 l^5 + 0.057 l^4 - 0.296 l^3 + 0.784 l^2 - 1.078 l + 0.617, zero for l > 3

    Parameters
    ----------
    film_ratio
        l = h/sigma [-].

    Returns
    -------
    float
        [-].

    Notes
    -----
    Three printed decimals are too few: the value at l = 3 is 0.092 (exact 0.00017) and rises
    from about l = 1.8 on. Source: [mohammadpour_2015 (18)]. Use `f_5_2`.
    """
    l = film_ratio  # noqa: E741
    if l > LAMBDA_CRITICAL:
        return 0.0
    return 0.617 + l * (-1.078 + l * (0.784 + l * (-0.296 + l * (0.057 - 0.004 * l))))


@kernel
def f_2_as_printed(film_ratio: float) -> float:
    """Return the area integral as printed.

    -0.002 l^5 + 0.028 l^4 - 0.173 l^3 + 0.526 l^2 - 0.804 l + 0.500, zero for l > 3

    Parameters
    ----------
    film_ratio
        l = h/sigma [-].

    Returns
    -------
    float
        [-], negative from about l = 2 to 3.

    Notes
    -----
    Source: [mohammadpour_2015 (19)]. Use `f_2`.
    """
    l = film_ratio  # noqa: E741
    if l > LAMBDA_CRITICAL:
        return 0.0
    return 0.500 + l * (-0.804 + l * (0.526 + l * (-0.173 + l * (0.028 - 0.002 * l))))


@kernel
def asperity_share(film_ratio: float, B: float, C: float) -> float:
    """Return the share of the load that asperities carry, exp(-B Lambda^C) [-].

    Parameters
    ----------
    film_ratio
        Lambda, film over composite rms roughness [-].
    B, C
        Of the pair of surfaces [-]: 1.90 and 0.99 for a rib, 2.32 and 0.97 for a race, the
        values of [wingertszahn_2023].

    Notes
    -----
    The printed equation lost its minus; without it the share would be above 1.
    Source: [zhou_hoeprich_1991 (45)]
    """
    return math.exp(-B * max(film_ratio, 0.0) ** C)


@kernel
def arana_share(film_ratio: float, exponent: float) -> float:
    """Return the share of the load that asperities of flanks carry, (1 - erf Lambda)^k [-].

    Parameters
    ----------
    film_ratio
        Lambda, hot central film over composite rms roughness, not negative [-].
    exponent
        k, above zero [-]: 1 in the source. With 1/1.6 to 1.6 it covers other laws of this kind.

    Notes
    -----
    Made to fit contacts that were counted electrically: they begin below 2 and rise steeply below
    1. All of the load without a film, 0.48 at 0.5, 0.16 at 1, 0.005 at 2. Source: [arana_2019]
    """
    return float(math.erfc(film_ratio) ** exponent)


# composite root-mean-square roughness of two flanks
ROUGHNESS = Number("m", 1e-9, 2e-5, "0.5 um is 5e-7 m.")
# of `arana_share` and where asperities touch; the factors are of gears, and of laws of the share
ARANA_FRICTION = 0.07  # advised for ground gears, [arana_2019]
BOUNDARY_FRICTION = Number(
    "1", 1e-3, 0.5, "0.07 is usual for ground flanks.", "Friction coefficient of touching flanks",
    "of ground spur and helical gears, Arana et al. 2019; assumed for others", 1.7,
    "friction.boundary_friction",
)  # fmt: skip
SHARE_EXPONENT = Number(
    "1", 0.2, 5.0, "1 is the law as printed.", "Exponent of the share of load on asperities",
    "laws of the share among each other", 1.6, "friction.share_exponent",
)  # fmt: skip


class SurfaceParameters(NamedTuple):
    """Roughness of a pair of surfaces; all floats, SI."""

    sigma: float  # composite root-mean-square roughness [m]
    xi_beta_sigma: float  # asperity density x tip radius x roughness [-], 0.03 to 0.07
    sigma_over_beta: float  # roughness over tip radius [-], 1e-4 to 1e-2
    share_exponent: float = 0.0  # of `arana_share` [-]; 0: Greenwood and Tripp's load
    boundary: float = 0.0  # with that share: friction coefficient of asperities [-]


# finished gear flanks, Mohammadpour et al. 2015, text below [mohammadpour_2015 (17)]
FLANK_XI_BETA_SIGMA = 0.055
FLANK_SIGMA_OVER_BETA = 0.001


@kernel
def gear_flanks(sigma: float) -> SurfaceParameters:
    """Return finished gear flanks of a composite root-mean-square roughness [m].

    Notes
    -----
    Mohammadpour et al. 2015, text below [mohammadpour_2015 (17)].
    """
    return SurfaceParameters(sigma, FLANK_XI_BETA_SIGMA, FLANK_SIGMA_OVER_BETA, 0.0, 0.0)


LAMBDA_MAX = 5.0  # asperities are dropped beyond: F_5/2(5) = 1.35e-8, F_2(5) = 1.93e-8
_INTERVALS = 1024
_STEP = LAMBDA_MAX / _INTERVALS
_LOAD_FACTOR = 16.0 * math.sqrt(2.0) / 15.0 * math.pi
_AREA_FACTOR = math.pi**2
_SQRT_2_PI = math.sqrt(2.0 / math.pi)
_1_SQRT2 = math.sqrt(0.5)


def _gaussian_moment(order: float, separation: np.ndarray) -> np.ndarray:
    """Return F_n(l) = Gamma(n+1)/sqrt(2 pi) exp(-l^2/4) D_(-n-1)(l)."""
    parabolic_cylinder = pbdv(-order - 1.0, separation)[0]
    scale = gamma(order + 1.0) / math.sqrt(2.0 * math.pi)
    return np.asarray(scale * np.exp(-0.25 * separation**2) * parabolic_cylinder)


# F_2, F_5/2 and their slopes per interval, interleaved: one or two cache lines serve a look-up
_GRID = np.linspace(0.0, LAMBDA_MAX, _INTERVALS + 1)
_TABLE = np.column_stack(
    (
        _gaussian_moment(2.0, _GRID),
        -2.0 * _STEP * _gaussian_moment(1.0, _GRID),
        _gaussian_moment(2.5, _GRID),
        -2.5 * _STEP * _gaussian_moment(1.5, _GRID),
    )
).ravel()


@kernel
def _cubic(y_0: float, m_0: float, y_1: float, m_1: float, t: float) -> float:
    """Return the cubic on 0 <= t <= 1 with values y and slopes m at its ends."""
    rise = y_1 - y_0
    return y_0 + t * (m_0 + t * (3.0 * rise - 2.0 * m_0 - m_1 + t * (m_0 + m_1 - 2.0 * rise)))


@kernel
def asperity_integrals(film_ratio: float) -> tuple[float, float]:
    """Return the area and the load integral of a Gaussian height distribution.

    F_n(l) = 1/sqrt(2 pi) integral over s > l of (s - l)^n exp(-s^2/2)
           = Gamma(n+1)/sqrt(2 pi) exp(-l^2/4) D_(-n-1)(l)

    Parameters
    ----------
    film_ratio
        l = h/sigma [-]; negative values count as zero.

    Returns
    -------
    tuple of float
        F_2 and F_5/2 [-], within 1e-8 relative of the integrals up to l = 5, zero beyond.

    Notes
    -----
    Cubic Hermite interpolation of exact values and slopes. The tails dropped at l = 5 are
    F_2 = 1.93e-8 and F_5/2 = 1.35e-8. D is Whittaker's parabolic cylinder function.
    Source: [greenwood_tripp_1971]; in place of the fits [mohammadpour_2015 (18)] and
    [mohammadpour_2015 (19)].
    """
    if film_ratio >= LAMBDA_MAX:
        return 0.0, 0.0
    if not film_ratio > 0.0:
        keep_nan = 0.0 * film_ratio
        return _TABLE[0] + keep_nan, _TABLE[2] + keep_nan
    position = film_ratio * (1.0 / _STEP)
    i = int(position)
    t = position - i
    j = 4 * i
    F_2 = _cubic(_TABLE[j], _TABLE[j + 1], _TABLE[j + 4], _TABLE[j + 5], t)
    F_5_2 = _cubic(_TABLE[j + 2], _TABLE[j + 3], _TABLE[j + 6], _TABLE[j + 7], t)
    return F_2, F_5_2


@kernel
def f_5_2(film_ratio: float) -> float:
    """Return the load integral F_5/2 [-], see `asperity_integrals`."""
    return asperity_integrals(film_ratio)[1]


@kernel
def f_2(film_ratio: float) -> float:
    """Return the area integral of a Gaussian height distribution.

    F_2(l) = 1/2 [(1 + l^2) erfc(l/sqrt 2) - l sqrt(2/pi) exp(-l^2/2)]

    Parameters
    ----------
    film_ratio
        l = h/sigma [-]; negative values count as zero.

    Returns
    -------
    float
        [-], zero beyond l = 5, where the value has fallen to 1.93e-8.

    Notes
    -----
    Exact; the difference of the two terms costs three digits at l = 5.
    Source: [greenwood_tripp_1971].
    """
    if film_ratio >= LAMBDA_MAX:
        return 0.0
    l = max(film_ratio, 0.0)  # noqa: E741
    square = l * l
    tail = l * _SQRT_2_PI * math.exp(-0.5 * square)
    return 0.5 * ((1.0 + square) * math.erfc(l * _1_SQRT2) - tail)


@kernel
def asperity_load_factor(surface: SurfaceParameters) -> float:
    """Return (16 sqrt 2/15) pi (xi beta sigma)^2 sqrt(sigma/beta) [-], see `asperity_load`."""
    squared = surface.xi_beta_sigma * surface.xi_beta_sigma
    return _LOAD_FACTOR * squared * math.sqrt(surface.sigma_over_beta)


@kernel
def asperity_area_factor(surface: SurfaceParameters) -> float:
    """Return pi^2 (xi beta sigma)^2 [-], see `asperity_area`."""
    return _AREA_FACTOR * surface.xi_beta_sigma * surface.xi_beta_sigma


@kernel
def asperity_load(
    film_ratio: float, area: float, contact_modulus: float, surface: SurfaceParameters
) -> float:
    """Return the load carried by asperities.

    W_a = (16 sqrt 2/15) pi (xi beta sigma)^2 sqrt(sigma/beta) E* A F_5/2(l)

    Parameters
    ----------
    film_ratio
        l = h/sigma [-].
    area
        Apparent contact area A [m2].
    contact_modulus
        E* [Pa], not E' = 2 E*.
    surface
        Roughness of the pair.

    Returns
    -------
    float
        W_a [N], not limited to the load on the contact.

    Notes
    -----
    Meant for l above about 0.5: elastic asperities with Gaussian heights that do not interact.
    [mohammadpour_2015 (16)] prints E', defined as twice E*, which doubles W_a.
    Source: [greenwood_tripp_1971].
    """
    return asperity_load_factor(surface) * contact_modulus * area * f_5_2(film_ratio)


@kernel
def asperity_area(film_ratio: float, area: float, surface: SurfaceParameters) -> float:
    """Return the area of asperity contact.

    A_a = pi^2 (xi beta sigma)^2 A F_2(l)

    Parameters
    ----------
    film_ratio
        l = h/sigma [-].
    area
        Apparent contact area A [m2].
    surface
        Roughness of the pair.

    Returns
    -------
    float
        A_a [m2].

    Notes
    -----
    Range as `asperity_load`.
    Source: [greenwood_tripp_1971]; [mohammadpour_2015 (17)] [karagiannis_2012 (22)]
    """
    return asperity_area_factor(surface) * area * f_2(film_ratio)
