"""Flow of an Eyring film sheared along one direction and pumped along any: kernels.

s is the direction of sliding, r the one across it. Stresses are over tau0, Z = 2z/h runs from -1
to 1, G(q) = sinh(sqrt q)/sqrt q, and a bar is the mean across the film:

    tau = T + Sigma Z,  rate = tau G(|tau|^2),  mean(rate) = (a, 0),  flow = 3 mean(Z rate)
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.checks import check_finite, check_positive
from gearlube_core.ehl.eyring_flow import eyring_mean_stress
from gearlube_core.ehl.lubricant import EhlLubricant
from gearlube_core.jit import kernel

_LARGEST_SIGMA = 100.0  # as in one dimension
_LARGEST_COUETTE = 1.0e86  # e^198: products of two rates stay below the largest double
_SMALL_SIGMA = 1.0e-5  # below, a ratio of two small numbers gives way to its limit
_SMALL_SQUARE = 0.25
_STEPS = 40
_NEAR = 1.0e-7  # a Newton step of that size leaves an error of its square

# Gauss-Legendre nodes above zero and their weights, one rule after the other; a rule with n
# nodes integrates e^(Sigma Z) to 1e-13 up to the Sigma beside it
_RULES = ((6, 0.5), (10, 2.5), (16, 7.0), (28, 20.0), (80, 1e300))
_STARTS = np.cumsum([0] + [n // 2 for n, _ in _RULES])
_REACHES = np.array([reach for _, reach in _RULES])
_NODES = np.concatenate([np.polynomial.legendre.leggauss(n)[0][n // 2 :] for n, _ in _RULES])
_WEIGHTS = np.concatenate([np.polynomial.legendre.leggauss(n)[1][n // 2 :] for n, _ in _RULES])


class EyringFlow(NamedTuple):
    """Flow factors, mid-film stress and slopes of one point of a film; all floats [1]."""

    along: float  # flow along s over its Newtonian value
    across: float  # flow along r over its Newtonian value
    stress_s: float  # T along s
    stress_r: float  # T along r
    flow_ss: float  # d(flow_s)/d(Sigma_s), flow_s = along Sigma_s
    flow_sr: float  # d(flow_s)/d(Sigma_r) = d(flow_r)/d(Sigma_s)
    flow_rr: float  # d(flow_r)/d(Sigma_r), flow_r = across Sigma_r
    flow_s_a: float  # d(flow_s)/da
    flow_r_a: float  # d(flow_r)/da


class _Moments(NamedTuple):
    """Means across the film of G, Z G, Z^2 G, and of K = d(rate)/d(tau) with the same weights."""

    g0: float
    g1: float
    g2: float
    ss0: float
    sr0: float
    rr0: float
    ss1: float
    sr1: float
    rr1: float
    ss2: float
    sr2: float
    rr2: float


@kernel
def _rate_ratio(q: float) -> tuple[float, float]:
    # G = sinh t/t and dG/dq, q = t^2
    if q < _SMALL_SQUARE:
        G = 1.0 + q / 6.0 * (
            1.0 + q / 20.0 * (1.0 + q / 42.0 * (1.0 + q / 72.0 * (1.0 + q / 110.0)))
        )
        slope = (
            1.0
            + q / 10.0 * (1.0 + q / 28.0 * (1.0 + q / 54.0 * (1.0 + q / 88.0 * (1.0 + q / 130.0))))
        ) / 6.0
        return G, slope
    t = math.sqrt(q)
    grown = math.exp(t)
    shrunk = 1.0 / grown
    G = 0.5 * (grown - shrunk) / t
    return G, (0.5 * (grown + shrunk) - G) / (2.0 * q)


@kernel
def _moments(
    stress_s: float, stress_r: float, sigma_s: float, sigma_r: float, first: int, last: int
) -> _Moments:
    g0 = g1 = g2 = 0.0
    ss0 = sr0 = rr0 = ss1 = sr1 = rr1 = ss2 = sr2 = rr2 = 0.0
    for k in range(first, last):
        Z, weight = _NODES[k], 0.5 * _WEIGHTS[k]
        us, ur = stress_s + sigma_s * Z, stress_r + sigma_r * Z
        ls, lr = stress_s - sigma_s * Z, stress_r - sigma_r * Z
        upper, upper_slope = _rate_ratio(us * us + ur * ur)
        lower, lower_slope = _rate_ratio(ls * ls + lr * lr)
        even, odd = weight * (upper + lower), weight * Z * (upper - lower)
        g0 += even
        g1 += odd
        g2 += Z * Z * even
        upper_slope *= 2.0 * weight
        lower_slope *= 2.0 * weight
        u, v = upper_slope * us * us, lower_slope * ls * ls
        ss0 += u + v
        ss1 += Z * (u - v)
        ss2 += Z * Z * (u + v)
        u, v = upper_slope * us * ur, lower_slope * ls * lr
        sr0 += u + v
        sr1 += Z * (u - v)
        sr2 += Z * Z * (u + v)
        u, v = upper_slope * ur * ur, lower_slope * lr * lr
        rr0 += u + v
        rr1 += Z * (u - v)
        rr2 += Z * Z * (u + v)
    return _Moments(
        g0, g1, g2, g0 + ss0, sr0, g0 + rr0, g1 + ss1, sr1, g1 + rr1, g2 + ss2, sr2, g2 + rr2
    )


@kernel
def eyring_flow(sigma_s: float, sigma_r: float, a: float, limit: float) -> EyringFlow:
    """Return flow factors along and across sliding, mid-film stress and the slopes of the flow.

    S_r = 3 [m2 - m1^2/m0],  S_s = S_r + 3 (a/Sigma_s) m1/m0,  m_n = mean(Z^n G)

    Parameters
    ----------
    sigma_s, sigma_r
        Stress drop over half the film, h (dp/ds)/(2 tau0) and the like along r [1].
    a
        Newtonian shear stress of sliding over tau0, eta (u2 - u1)/(h tau0) [1], either sign.
    limit
        Limiting shear stress over tau0, above zero [1]; infinite where there is none.

    Returns
    -------
    EyringFlow
        Factors relative to the Newtonian flow -rho h^3/(12 eta) grad p. The slopes of the flow
        are finite everywhere, symmetric and positive definite; d Sigma/dh = Sigma/h,
        da/dh = -a/h and da/dp = a d ln eta/dp give those by film and pressure.

    Notes
    -----
    The no-slip conditions have one solution, since they are the gradient of the convex
    mean(cosh|tau|). Damped Newton solves them in T with both sides taken through asinh, which
    makes them linear where Sigma is zero. Where dp/ds is zero S_s is its limit
    d(flow_s)/d(Sigma_s). Without sliding or pumping S is 1; without dp/dr S_s is
    `eyring_flow_factor`. Beyond |Sigma| = 100 and |a| = 1e86 all values are those there.

    With a limit, sliding beyond what mid-film stress T_s = limit shears is slip; the rest of the
    film flows as if the surfaces slid no faster. Slip is taken as equal at both walls, so that
    entrainment is not changed.

    Sources: Jamali 2015 eq. (3.25)-(3.43) with v for u in (3.38); Sharif, Evans and Snidle 2001;
    in one dimension Conry, Wang and Cusano 1987.
    """
    size = math.sqrt(sigma_s * sigma_s + sigma_r * sigma_r)
    if size > _LARGEST_SIGMA:
        sigma_s *= _LARGEST_SIGMA / size
        sigma_r *= _LARGEST_SIGMA / size
        size = _LARGEST_SIGMA
    a = min(max(a, -_LARGEST_COUETTE), _LARGEST_COUETTE)
    rule = 0
    while size > _REACHES[rule]:
        rule += 1
    first, last = _STARTS[rule], _STARTS[rule + 1]
    goal = math.asinh(a)
    T_s, T_r, slips = eyring_mean_stress(size, a, 1.0), 0.0, False
    step_s, step_r, length, share = 0.0, 0.0, math.inf, 1.0
    best, best_s, best_r = math.inf, T_s, T_r
    m = _moments(T_s, T_r, sigma_s, sigma_r, first, last)
    for _ in range(_STEPS):
        rate_s = T_s * m.g0 + sigma_s * m.g1
        rate_r = T_r * m.g0 + sigma_r * m.g1
        if slips:
            rate_s = 0.0
        rate = math.sqrt(rate_s * rate_s + rate_r * rate_r)
        lag = math.asinh(rate) / rate if rate > 1.0e-8 else 1.0
        miss_s = 0.0 if slips else goal - lag * rate_s
        miss_r = -lag * rate_r
        miss = math.sqrt(miss_s * miss_s + miss_r * miss_r)
        # a step that leaves a larger miss is halved: the slopes are never singular, so that a
        # short enough one does better
        if miss > best and share > 1.0e-3 and length > _NEAR:
            share *= 0.5
        else:
            if length <= _NEAR:
                if slips or abs(T_s) <= limit:
                    break
                T_s, slips, length, best = math.copysign(limit, a), True, math.inf, math.inf
                m = _moments(T_s, T_r, sigma_s, sigma_r, first, last)
                continue
            best, best_s, best_r, share = miss, T_s, T_r, 1.0
            root = math.sqrt(1.0 + rate * rate)
            turned = (
                (miss_s * rate_s + miss_r * rate_r) / (rate * rate) * (root - 1.0 / lag)
                if rate > 1.0e-8
                else 0.0
            )
            miss_s = miss_s / lag + turned * rate_s
            miss_r = miss_r / lag + turned * rate_r
            if slips:
                step_s, step_r = 0.0, miss_r / m.rr0
            else:
                determinant = m.ss0 * m.rr0 - m.sr0 * m.sr0
                step_s = (m.rr0 * miss_s - m.sr0 * miss_r) / determinant
                step_r = (m.ss0 * miss_r - m.sr0 * miss_s) / determinant
            length = math.sqrt(step_s * step_s + step_r * step_r)
        T_s, T_r = best_s + share * step_s, best_r + share * step_r
        m = _moments(T_s, T_r, sigma_s, sigma_r, first, last)
    if slips:
        a = T_s * m.g0 + sigma_s * m.g1
    across = 3.0 * (m.g2 - m.g1 * m.g1 / m.g0)
    # d(flow)/d(Sigma) = K2 - K1 K0^-1 K1; a stress held at its limit does not answer
    if slips:
        inverse_ss, inverse_sr, inverse_rr = 0.0, 0.0, 1.0 / m.rr0
    else:
        determinant = m.ss0 * m.rr0 - m.sr0 * m.sr0
        inverse_ss, inverse_sr = m.rr0 / determinant, -m.sr0 / determinant
        inverse_rr = m.ss0 / determinant
    answer_ss = inverse_ss * m.ss1 + inverse_sr * m.sr1
    answer_sr = inverse_ss * m.sr1 + inverse_sr * m.rr1
    answer_rs = inverse_sr * m.ss1 + inverse_rr * m.sr1
    answer_rr = inverse_sr * m.sr1 + inverse_rr * m.rr1
    flow_ss = 3.0 * (m.ss2 - m.ss1 * answer_ss - m.sr1 * answer_rs)
    flow_sr = 3.0 * (m.sr2 - m.ss1 * answer_sr - m.sr1 * answer_rr)
    flow_rr = 3.0 * (m.rr2 - m.sr1 * answer_sr - m.rr1 * answer_rr)
    small = abs(sigma_s) < _SMALL_SIGMA
    along = flow_ss if small else across + 3.0 * a / sigma_s * m.g1 / m.g0
    return EyringFlow(
        along,
        across,
        T_s,
        T_r,
        flow_ss,
        flow_sr,
        flow_rr,
        0.0 if slips else 3.0 * answer_ss,
        0.0 if slips else 3.0 * answer_sr,
    )


class FlowScales(NamedTuple):
    """What turns film, pressure and viscosity of a uniform grid into arguments; all floats."""

    sigma_x: float  # Sigma_x over film and pressure between the nodes on either side
    sigma_y: float
    couette: float  # a times film over viscosity
    cosine: float  # of the angle from x to sliding
    sine: float
    limit: float  # limiting shear stress over tau0 at ambient pressure; 0 with its slope 0: none
    limit_slope: float  # its slope with pressure


def flow_scales(
    lubricant: EhlLubricant,
    sliding: tuple[float, float],
    dx: float,
    dy: float,
    *,
    film: float = 1.0,
    pressure: float = 1.0,
    viscosity: float = 1.0,
) -> FlowScales:
    """Return the constants of `fill_flow_factors`.

    Parameters
    ----------
    lubricant
        Oil with an Eyring stress, in SI.
    sliding
        Difference of the surface velocities along x and y [m/s].
    dx, dy
        Node spacing [m].
    film, pressure, viscosity
        Units of the arrays: [m], [Pa], [Pa s].

    Raises
    ------
    ParameterError
        An input is out of range, or the oil is Newtonian.
    """
    tau0 = check_positive("lubricant.tau0", lubricant.tau0, "Pa", "A Newtonian film has factors 1.")
    for axis, component in zip("xy", sliding, strict=True):
        check_finite(f"sliding along {axis}", component, "m/s")
    for name, value, unit in (
        ("dx", dx, "m"),
        ("dy", dy, "m"),
        ("film", film, "m"),
        ("pressure", pressure, "Pa"),
        ("viscosity", viscosity, "Pa s"),
    ):
        check_positive(name, value, unit)
    speed = math.hypot(*sliding)
    return FlowScales(
        sigma_x=film * pressure / (4.0 * tau0 * dx),
        sigma_y=film * pressure / (4.0 * tau0 * dy),
        couette=viscosity * speed / (tau0 * film),
        cosine=sliding[0] / speed if speed > 0.0 else 1.0,
        sine=sliding[1] / speed if speed > 0.0 else 0.0,
        limit=lubricant.tau_limit / tau0,
        limit_slope=lubricant.limit_slope * pressure / tau0,
    )


@kernel
def fill_flow_factors(
    scales: FlowScales,
    pressure: np.ndarray,
    film: np.ndarray,
    viscosity: np.ndarray,
    factor_xx: np.ndarray,
    factor_xy: np.ndarray,
    factor_yy: np.ndarray,
) -> None:
    """Fill the flow factors of all nodes, as a symmetric tensor in x and y.

    flow = -rho h^3/(12 eta) [[xx, xy], [xy, yy]] grad p

    Parameters
    ----------
    scales
        Of the oil, the motion and the grid.
    pressure, film, viscosity : ndarray, shape (ny, nx)
        p, h and eta in the units of `scales`; where the film is not above zero factors are 1.
    factor_xx, factor_xy, factor_yy : ndarray, shape (ny, nx)
        Result [1]; xy is zero where sliding is along x or y.

    Notes
    -----
    Pressure slopes are central, one-sided on the border. A node takes about 1.5 us.
    """
    ny, nx = pressure.shape
    c, s = scales.cosine, scales.sine
    limited = scales.limit > 0.0 or scales.limit_slope > 0.0
    for j in range(ny):
        below, above = max(j - 1, 0), min(j + 1, ny - 1)
        for i in range(nx):
            h = film[j, i]
            if h <= 0.0:
                factor_xx[j, i], factor_xy[j, i], factor_yy[j, i] = 1.0, 0.0, 1.0
                continue
            left, right = max(i - 1, 0), min(i + 1, nx - 1)
            sigma_x = scales.sigma_x * h * (pressure[j, right] - pressure[j, left])
            sigma_y = scales.sigma_y * h * (pressure[above, i] - pressure[below, i])
            if right - left == 1:
                sigma_x *= 2.0
            if above - below == 1:
                sigma_y *= 2.0
            limit = math.inf
            if limited:
                limit = scales.limit + scales.limit_slope * max(pressure[j, i], 0.0)
            flow = eyring_flow(
                c * sigma_x + s * sigma_y,
                c * sigma_y - s * sigma_x,
                scales.couette * viscosity[j, i] / h,
                limit,
            )
            factor_xx[j, i] = c * c * flow.along + s * s * flow.across
            factor_xy[j, i] = c * s * (flow.along - flow.across)
            factor_yy[j, i] = s * s * flow.along + c * c * flow.across
