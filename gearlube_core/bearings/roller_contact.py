"""Load of one roller from the approach of its races, with the film and the hysteresis.

The film adds to the approach and depends on the load: d = g + H(d), with the geometric approach
g and H = A (d/d_f)^(-0.045 n) between the limits of `parameters`. Both kernels solve this
equation. Because H depends on the approach only, the quasi-steady load is a function of g and
has a potential (see `shaft_energy`). The squeeze speed needs no memory either: at a given speed
v = dH/dt = -0.045 n (H/d) dd/dt. All approaches here are in units of d_f = FILM_FLOOR_APPROACH.
"""

from __future__ import annotations

import math

from gearlube_core.bearings.ninth_root import (
    ROOT_MIN,
    ninth_root_change,
    ninth_root_refined,
    ninth_root_residual,
    ninth_root_start,
)
from gearlube_core.bearings.parameters import FILM_FLOOR_APPROACH, FILM_RANGE, BearingParameters
from gearlube_core.film.mostofi_gohar_1983 import (
    LOAD_EXPONENT,
    MATERIAL_EXPONENT,
    SPEED_EXPONENT,
    SQUEEZE_FACTOR_MIN,
    SQUEEZE_RATE,
    SQUEEZE_SHARE,
)
from gearlube_core.kernels.inlining import inlined
from gearlube_core.kernels.jit import kernel

N_LINE = 10.0 / 9.0  # 1, exponent of a line contact, [mohammadpour_2015 (25)]
_M_LINE = -LOAD_EXPONENT * N_LINE  # 0.05: the film goes with d^-0.05
# Coefficients of the reversed Taylor series of x - g - H(x), and of the slope of H.
_HALF = 0.5 * (1.0 + _M_LINE)
_SECOND = 0.5 * (1.0 + _M_LINE) * (2.0 + _M_LINE)
_THIRD = _SECOND / 3.0
_RATIO = 3.0 * (1.0 + _M_LINE) / (2.0 + _M_LINE)
# The start of the root, 7e-4 off, may lie beyond either end of its range
_Y_MIN, _Y_MAX = 0.999, 1.001 * FILM_RANGE ** (1.0 / 9.0)
_FACTOR_MIN = FILM_RANGE**-_M_LINE
# y^-0.45 = x^-0.05 for 1 <= y <= 2^(8/9) in powers of y - 1.4, relative error 1.6e-8
_C0, _C1, _C2 = 8.5949307304674676e-01, -2.7626541955432316e-01, 1.4306731966889319e-01
_C3, _C4, _C5 = -8.3471653477310503e-02, 5.1380959307017110e-02, -3.2342442232490484e-02
_C6, _C7, _C8 = 2.1439964607431590e-02, -1.6579160463181739e-02, 9.5607876228063268e-03
# Lengths over which films begin and end to give way to a change of load, see `moving_share`
_BEGINS, _ENDS = 0.25, 64.0
_SPEED_MIN = 1e-9  # m/s; the film is below 1e-12 m there
# 132 v/u at which the squeeze factor reaches its lower clip, and where its Pade form turns
_T_MAX = math.log((1.0 - SQUEEZE_FACTOR_MIN) / SQUEEZE_SHARE)
_T_MIN = -math.sqrt(12.0)


@kernel
def preload_approach(
    preload: float, n_rollers: float, sin_contact: float, kn: float, n: float
) -> float:
    """Return the approach of every roller under an axial preload [m], without film.

    F0 = N kn d^n sin L solved for d; units as in `BearingParameters`, preload in N.
    """
    if preload == 0.0:
        return 0.0
    return (preload / (n_rollers * sin_contact) / kn) ** (1.0 / n)


@kernel
def contact_angle_terms(angle: float) -> tuple[float, float, float]:
    """Return sine and cosine of the contact angle [rad], and the factor 2 Y of the drag.

    2 Y = 0.8 cot(angle), 0 for cylindrical rollers.
    """
    return math.sin(angle), math.cos(angle), 0.8 / math.tan(angle) if angle > 0.0 else 0.0


@kernel
def film_amplitude(
    shaft_speed: float, eta0: float, alpha: float, p: BearingParameters
) -> tuple[float, float]:
    """Return the film at and below the floor load, and the squeeze scale of the kernels.

    A = c (eta0 u)^0.647 alpha^0.46 / d_f,  t = 132 d_f/u, with u = r_u |shaft speed|.

    Parameters
    ----------
    shaft_speed : float
        Speed of the inner race [rad/s].
    eta0, alpha : float
        Viscosity [Pa s] and pressure-viscosity coefficient [1/Pa], above zero.
    p : BearingParameters
        Bearing.

    Returns
    -------
    tuple of float
        A [FILM_FLOOR_APPROACH]; t [s], zero without squeeze.
    """
    u = p.film_speed_radius * abs(shaft_speed)
    if p.film_constant == 0.0 or u < _SPEED_MIN:
        return 0.0, 0.0
    shape = math.exp(SPEED_EXPONENT * math.log(eta0 * u) + MATERIAL_EXPONENT * math.log(alpha))
    scale = SQUEEZE_RATE * FILM_FLOOR_APPROACH / u * p.squeeze
    return p.film_constant * shape / FILM_FLOOR_APPROACH, scale


@inlined
def moving_share(x: float) -> float:
    """Return how far a film gives way where the approach x [d_f] changes, 0 to 1.

    At the limits of its load dependence the slope of a film jumps, and with it the rate of the
    approach. The forces by that rate build up over a quarter of the floor's approach, and over 64
    at the other end, so that they are continuous; the steady load is as it is.
    """
    begins = (x - 1.0) * (1.0 / _BEGINS)
    ends = (FILM_RANGE - x) * (1.0 / _ENDS)
    share = begins if begins < ends else ends
    share = 0.0 if share < 0.0 else share
    return 1.0 if share > 1.0 else share


@inlined
def _squeezed_excess(t: float) -> tuple[float, float]:
    """Return q(t)/q(0) - 1 = 3 (1 - exp(t)), clipped as the squeeze factor, and its slope over t.

    Pade [2/2] form of exp(t) - 1, exact to 2e-8 for |t| < 0.1 and to 0.04 at t = -3.
    """
    t = _T_MAX if t > _T_MAX else t
    t = _T_MIN if t < _T_MIN else t
    part = -36.0 / (12.0 + t * (t - 6.0))
    return part * t, part * part * (t * t - 12.0) * (1.0 / 36.0)


@inlined
def roller_approach_line(g: float, film: float) -> tuple[float, float, float, float]:
    """Return approach and film of a roller with n = 10/9, without branches or library calls.

    x = g + A x^-0.05

    Parameters
    ----------
    g : float
        Geometric approach [d_f].
    film : float
        A from `film_amplitude` [d_f].

    Returns
    -------
    tuple of float
        x [d_f]; x^(1/9), zero where the races do not touch; dx/dg; -dH/dx.

    Notes
    -----
    Solved by a reversed Taylor series of third order about x0 = g + A. x^n has a relative error
    below 1e-8 for A < 0.8 (films up to 0.4 um), 5e-8 for A = 2, and 1e-13 without film;
    approaches from 0.04 nm to 90 mm.
    """
    raw = g + film
    touching = raw * (1.0 / ROOT_MIN)  # continuous: damping does not vanish with the approach
    touching = 0.0 if touching < 0.0 else touching
    touching = 1.0 if touching > 1.0 else touching
    x0 = ROOT_MIN if raw < ROOT_MIN else raw
    inverse = 1.0 / x0
    start = ninth_root_start(x0)
    r = ninth_root_residual(start, inverse)
    y0 = ninth_root_refined(start, r)
    s = _Y_MIN if start < _Y_MIN else start
    s = (_Y_MAX if s > _Y_MAX else s) - 1.4
    s2 = s * s
    s4 = s2 * s2
    low = (_C0 + _C1 * s) + (_C2 + _C3 * s) * s2
    high = (_C4 + _C5 * s) + (_C6 + _C7 * s) * s2
    factor = (low + (high + _C8 * s4) * s4) * (1.0 - r * (0.05 + r * (0.02375 + r * 0.0154375)))
    factor = _FACTOR_MIN if x0 > FILM_RANGE else factor
    factor = 1.0 if x0 < 1.0 else factor
    slope = _M_LINE * film * factor * inverse
    slope = 0.0 if x0 < 1.0 else slope
    slope = 0.0 if x0 > FILM_RANGE else slope
    q = 1.0 / (1.0 + slope)
    step = film * (1.0 - factor) * q
    curvature = slope * q * step * inverse
    third = _THIRD * curvature * (1.0 - _RATIO * slope * q) * step * inverse
    change = step * (_HALF * curvature - 1.0 + third)
    x = raw + change
    y = y0 + y0 * ninth_root_change(change * inverse)
    part = change * inverse
    correction = -slope * part * (2.0 * _HALF - _SECOND * part)
    return x, touching * y, q * (1.0 - correction * q), slope + correction


@inlined
def roller_response_line(
    g: float, g_rate: float, film: float, squeeze_scale: float, K: float, c: float, w_min: float
) -> tuple[float, float, float, float]:
    """Return the load of a roller with n = 10/9 and its slopes, without branches or library calls.

    w = K x^n + n K x^(n-1) (c x' + x_squeeze),  x = g + A x^-0.05.

    Parameters
    ----------
    g, g_rate : float
        Geometric approach [d_f] and its rate [d_f/s].
    film, squeeze_scale : float
        From `film_amplitude`.
    K : float
        kn d_f^n [N].
    c : float
        Hysteresis time, loss/f_ref [s].
    w_min : float
        Lower limit of the load: 0, or -inf to allow tension [N].

    Returns
    -------
    tuple of float
        Load and its quasi-steady part K x^n [N]; slopes of the load against g [N], without the
        squeeze, and against g_rate [N s]; zero where the load is clipped.

    Notes
    -----
    Accuracy as in `roller_approach_line`.

    The squeeze is tiny: with v = dH/dt from the load alone, a shaft 5 um off centre at 145 rad/s
    changes H by 1.2e-4 of it, and the extra load is a damper 0.3 % as strong as the hysteresis.
    It enters to first order in its share of the approach.

    References
    ----------
    [mohammadpour_2015 (25)] [mohammadpour_2015 (26)] [mohammadpour_2015 (27)]
    """
    x, y, x_g, slope = roller_approach_line(g, film)
    share = moving_share(x)
    moving = 1.0 - share * (1.0 - x_g)
    x_rate = g_rate * moving
    squeeze = squeeze_scale * share * slope
    excess, steepness = _squeezed_excess(-squeeze * x_rate)
    squeezed = (x - g) * excess
    stiffness = K * y
    steady = stiffness * x
    w = steady + N_LINE * stiffness * (c * x_rate + squeezed)
    tangent = 0.0 if w <= w_min else N_LINE * stiffness
    w_g = tangent * x_g * (1.0 + (N_LINE - 1.0) * c * x_rate / max(x, ROOT_MIN))
    damping = tangent * moving * (c - (x - g) * squeeze * steepness)
    return w_min if w <= w_min else w, steady, w_g, damping


@inlined
def roller_load_line(
    g: float, g_rate: float, film: float, squeeze_scale: float, K: float, c: float, w_min: float
) -> tuple[float, float]:
    """Return load and quasi-steady part: the first two numbers of `roller_response_line`."""
    w, steady, _, _ = roller_response_line(g, g_rate, film, squeeze_scale, K, c, w_min)
    return w, steady


@kernel
def film_and_slope(x: float, film: float, n: float) -> tuple[float, float]:
    """Return the film and -dH/dx at the approach x; all in units of FILM_FLOOR_APPROACH.

    H = A min(max(x, 1), FILM_RANGE)^(-0.045 n).
    """
    m = -LOAD_EXPONENT * n
    if x <= 1.0:
        return film, 0.0
    if x >= FILM_RANGE:
        return film * FILM_RANGE**-m, 0.0
    h = film * x**-m
    return h, m * h / x


@kernel
def approach_with_film(g: float, film: float, n: float) -> float:
    """Return x with x = g + H(x), by Newton; all in units of FILM_FLOOR_APPROACH."""
    x = g + film
    for _ in range(12):
        h, slope = film_and_slope(x, film, n)
        change = (g + h - x) / (1.0 + slope)
        x += change
        if abs(change) <= 1e-15 * abs(x):
            break
    return x


@kernel
def roller_response_general(
    g: float,
    g_rate: float,
    film: float,
    squeeze_scale: float,
    K: float,
    c: float,
    w_min: float,
    n: float,
) -> tuple[float, float, float, float]:
    """Return load and slopes of a roller for any exponent n, as `roller_response_line`."""
    x = approach_with_film(g, film, n)
    if x <= 0.0:
        return max(w_min, 0.0), 0.0, 0.0, 0.0
    h, slope = film_and_slope(x, film, n)
    share = moving_share(x)
    moving = 1.0 - share * slope / (1.0 + slope)
    x_rate = g_rate * moving
    squeeze = squeeze_scale * share * slope
    excess, steepness = _squeezed_excess(-squeeze * x_rate)
    squeezed = h * excess
    stiffness = K * x ** (n - 1.0)
    steady = stiffness * x
    w = steady + n * stiffness * (c * x_rate + squeezed)
    if w <= w_min:
        return w_min, steady, 0.0, 0.0
    tangent = n * stiffness
    w_g = tangent / (1.0 + slope) * (1.0 + (n - 1.0) * c * x_rate / x)
    return w, steady, w_g, tangent * moving * (c - h * squeeze * steepness)


@kernel
def roller_load_general(
    g: float,
    g_rate: float,
    film: float,
    squeeze_scale: float,
    K: float,
    c: float,
    w_min: float,
    n: float,
) -> tuple[float, float]:
    """Return load and quasi-steady part: the first two numbers of `roller_response_general`."""
    w, steady, _, _ = roller_response_general(g, g_rate, film, squeeze_scale, K, c, w_min, n)
    return w, steady
