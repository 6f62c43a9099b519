"""Friction of a heated Eyring film under Hertz's pressure: what the film model corrects."""

from __future__ import annotations

import math

from gearlube_core.contact.hertz import LARGEST_OVER_MEAN
from gearlube_core.film_model.inlet import FilmInlet, oil_under
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.roelands_1966 import ROELANDS_KAPPA

_LARGEST_OVER_MEAN = 1.5  # Hertz pressure
# Gauss's three points of p/p_max over the ellipse, whose area is evenly spread over (p/p_max)^2
_HALF = 0.5 * math.sqrt(0.6)
_LOW, _MIDDLE, _HIGH = 0.5 - _HALF, 0.5, 0.5 + _HALF
_OUTER_WEIGHT, _MIDDLE_WEIGHT = 5.0 / 9.0, 8.0 / 9.0
# Gauss's five points of X from the middle of a strip to its edge, with their weights
_STRIP = (
    (0.046910077030668, 0.118463442528095),
    (0.230765344947158, 0.239314335249683),
    (0.5, 0.284444444444444),
    (0.769234655052842, 0.239314335249683),
    (0.953089922969332, 0.118463442528095),
)
_STRIP_WIDENING, _ELLIPSE_WIDENING = 0.15, 0.5  # of thick films, see the references
_FILM_PART = 1.0 / 8.0  # middle of an evenly heated film over its surfaces
_SURFACE_PART = 0.3665  # of both surfaces; the model corrects least with it
_LOG_LARGE = 18.0  # asinh(exp(y)) = y + ln 2 to double precision above
_LN2 = math.log(2.0)


@kernel
def _asinh_exp(y: float) -> float:
    if y > _LOG_LARGE:
        return y + _LN2
    e = math.exp(y)
    return math.asinh(e)


@kernel
def _heated_stress(log_rate: float, log_viscosity: float, softening: float) -> float:
    # s = asinh(exp(log_rate + G/(1 + k s/G))), G = ln(eta/kappa) of the cold film, k softening:
    # that of asinh(exp(x)) = x + c with c of the cold film, then one step of Newton
    G, k = log_viscosity, softening
    cold = _asinh_exp(log_rate + G)
    b = G * (1.0 + k) - k * cold
    s = 2.0 * cold * G / (b + math.sqrt(b * b + 4.0 * k * cold * G))
    fall = 1.0 / (1.0 + k * s / G)
    y = log_rate + G * fall
    if y > _LOG_LARGE:
        return s - (s - y - _LN2) / (1.0 + k * fall * fall)
    e = math.exp(y)
    slope = k * fall * fall * e / math.sqrt(1.0 + e * e)
    return s - (s - math.asinh(e)) / (1.0 + slope)


@kernel
def film_resistance(film: float, speed: float, half: float, inlet: FilmInlet) -> float:
    """Return the film's rise over its heat flux [K m2/W], `reference_friction`; half across [m]."""
    resistance = film * _FILM_PART / inlet.oil_conductivity
    return resistance + _SURFACE_PART * math.sqrt(half / speed) / inlet.effusivity


@kernel
def stress_under(p: float, film: float, slip: float, resistance: float, inlet: FilmInlet) -> float:
    """Return the stress of a heated film under a pressure [Pa]; resistance of `film_resistance`."""
    oil = oil_under(p, inlet)
    log_rate = math.log(max(slip, 1e-300) * ROELANDS_KAPPA / (film * oil.stress))
    softening = oil.decline * slip * resistance * oil.stress
    stress = oil.stress * _heated_stress(log_rate, inlet.log_ratio + oil.log_ratio, softening)
    if inlet.eyring_slope > 0.0:
        over = stress / (inlet.eyring_slope * p)
        over *= over
        over *= over
        over *= over
        stress /= math.sqrt(math.sqrt(math.sqrt(1.0 + over)))
    return stress


@kernel
def reference_friction(
    film: float,
    p: float,
    speed: float,
    slip: float,
    semi_axis: float,
    R_x: float,
    inlet: FilmInlet,
) -> float:
    """Return the friction coefficient that the model corrects [-].

    mu = <tau>/p,  tau = tau0 asinh[eta slip/(h tau0)],
    ln(eta/kappa) = G/[1 + beta(p') dT/G],  dT = tau slip R,
    R = h/(8 k) + 0.37 [a_x/(K rho c u)]^(1/2)

    Parameters
    ----------
    film
        Central film h [m].
    p
        Mean Hertz pressure [Pa].
    speed
        u across the contact, u cos(psi) [m/s].
    slip
        Amount of sliding [m/s].
    semi_axis
        a_x, half of the way across the contact [m].
    R_x
        Relative radius across it [m].
    inlet
        Oil and solids at the inlet.

    Notes
    -----
    The mean is over the ellipse with Hertz's pressures p', by three points; thick films spread over
    an area 1 + 0.5 (h R_x/a_x^2)^(3/2) times as large. G = ln(eta/kappa) and
    beta at p' and the inlet's temperature; with heat G falls as Houpert's law with an exponent S0
    of one. With an Eyring stress 2 Lambda p/ln(eta/eta0) the limit Lambda p is rounded. R, the
    film's rise over the heat flux, is rough, and one Newton step ends each stress: what the model
    corrects need only be smooth and near.
    """
    thickness = math.sqrt(film * R_x) / semi_axis
    p /= 1.0 + _ELLIPSE_WIDENING * thickness**3
    top = _LARGEST_OVER_MEAN * p
    resistance = film_resistance(film, speed, semi_axis, inlet)
    mean = 0.0
    for q, weight in ((_LOW, _OUTER_WEIGHT), (_MIDDLE, _MIDDLE_WEIGHT), (_HIGH, _OUTER_WEIGHT)):
        mean += weight * q * stress_under(q * top, film, slip, resistance, inlet)
    return mean / p


@kernel
def line_reference_friction(
    film: float, p: float, speed: float, slip: float, half_width: float, R: float, inlet: FilmInlet
) -> float:
    """Return the friction coefficient of a line that the model corrects [-].

    As `reference_friction`, with the mean over a strip whose pressure is p_0 (1 - X^2)^(1/2) and
    whose half width is b [1 + 0.15 (h R/b^2)^(3/2)/(alpha p)^(1/2)]

    Parameters
    ----------
    film, p, speed, slip, inlet
        As of `reference_friction`.
    half_width
        b, dry [m].
    R
        Relative radius [m].

    Notes
    -----
    Five points over half of the strip: a line passes through pure rolling, where the stress is
    linear and its mean depends on the peak of the viscosity. Three points are off by a quarter
    there, five by a few per cent. Thick films carry over more than the dry width; the widening
    brings the solved friction of light contacts nearest.
    """
    thickness = math.sqrt(film * R) / half_width
    wider = 1.0 + _STRIP_WIDENING * thickness**3 / math.sqrt(inlet.alpha * p)
    p /= wider
    top = LARGEST_OVER_MEAN * p
    resistance = film_resistance(film, speed, half_width * wider, inlet)
    mean = 0.0
    for X, weight in _STRIP:
        share = math.sqrt(1.0 - X * X)
        mean += weight * stress_under(share * top, film, slip, resistance, inlet)
    return mean / p
