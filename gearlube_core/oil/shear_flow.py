"""Flow of a film of any shear law, sheared along one direction and pumped along any: kernels.

s is the direction of sliding, r the one across it. Stresses are over tau0, Z = 2z/h runs from -1
to 1, G(q) is the `rate_ratio` of the law, sinh(sqrt q)/sqrt q for Eyring's:

    tau = T + Sigma Z,  rate = tau G(|tau|^2),  mean(rate) = (a, 0),  flow = 3 mean(Z rate)
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import eyring_mean_stress
from gearlube_core.oil.film_laws import rate_ratio

LARGEST_SIGMA = 100.0  # as in one dimension
LARGEST_COUETTE = 1.0e86  # e^198: products of two rates stay below the largest double
_SMALL_SIGMA = 1.0e-5  # below, a ratio of two small numbers gives way to its limit
_STEPS = 20
_NEAR = 1.0e-5  # a Newton step of that size leaves an error of its square
_THERE = 1.0e-9  # a smaller one is the last
_BRACKETS = 200  # halvings of a bracket, with room to widen it first
_END = 1.0e-13  # a step of roundings

# Gauss-Legendre nodes above zero and their weights, one rule after the other; a rule with n
# nodes is exact to 1e-10 up to the Sigma beside it
_RULES = ((4, 0.13), (6, 0.95), (8, 2.6), (12, 8.0), (20, 27.0), (40, 1e300))
STARTS = np.cumsum([0] + [n // 2 for n, _ in _RULES])
REACHES = np.array([reach for _, reach in _RULES])
NODES = np.concatenate([np.polynomial.legendre.leggauss(n)[0][n // 2 :] for n, _ in _RULES])
WEIGHTS = np.concatenate([np.polynomial.legendre.leggauss(n)[1][n // 2 :] for n, _ in _RULES])


class ShearFlow(NamedTuple):
    """Flow factors, mid-film stress and slopes of one point of a film; all floats [-]."""

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
    """Means across the film of G, Z G, Z^2 G, and of K = d(rate)/d(tau)."""

    g0: float
    g1: float
    g2: float
    ss: float
    sr: float
    rr: float


class Equilibrium(NamedTuple):
    """Mid-film stress that lets the walls slide as they do, and the means there."""

    sigma_s: float  # kept within its bound
    sigma_r: float
    a: float  # what is sheared, not slip
    stress_s: float
    stress_r: float
    slips: bool
    first: int  # of the rule
    last: int
    g0: float
    g1: float
    g2: float


@kernel
def _moments(
    law: Any,
    stress_s: float,
    stress_r: float,
    sigma_s: float,
    sigma_r: float,
    first: int,
    last: int,
) -> _Moments:
    g0 = g1 = g2 = ss = sr = rr = 0.0
    for k in range(first, last):
        Z, weight = NODES[k], 0.5 * WEIGHTS[k]
        us, ur = stress_s + sigma_s * Z, stress_r + sigma_r * Z
        ls, lr = stress_s - sigma_s * Z, stress_r - sigma_r * Z
        upper, upper_slope = rate_ratio(law, us * us + ur * ur)
        lower, lower_slope = rate_ratio(law, ls * ls + lr * lr)
        even = weight * (upper + lower)
        g0 += even
        g1 += weight * Z * (upper - lower)
        g2 += Z * Z * even
        upper_slope *= 2.0 * weight
        lower_slope *= 2.0 * weight
        ss += upper_slope * us * us + lower_slope * ls * ls
        sr += upper_slope * us * ur + lower_slope * ls * lr
        rr += upper_slope * ur * ur + lower_slope * lr * lr
    return _Moments(g0, g1, g2, g0 + ss, sr, g0 + rr)


@kernel
def _side_stress(
    law: Any,
    stress_s: float,
    stress_r: float,
    sigma_s: float,
    sigma_r: float,
    first: int,
    last: int,
) -> float:
    # T_r at a given T_s: no flow across sliding at rest. |T_r| <= |Sigma_r|, where every layer is
    # sheared one way; the rate rises with T_r, so that a bracket holds its root
    low, high = -abs(sigma_r), abs(sigma_r)
    T = min(max(stress_r, low), high)
    step = math.inf
    for _ in range(_BRACKETS):
        m = _moments(law, stress_s, T, sigma_s, sigma_r, first, last)
        rate = T * m.g0 + sigma_r * m.g1
        if rate < 0.0:
            low = T
        else:
            high = T
        before = step
        step = -math.asinh(rate) * math.hypot(1.0, rate) / m.rr
        if abs(step) <= _END:
            break
        if abs(step) > 0.5 * abs(before) or not low <= T + step <= high:
            step = 0.5 * (low + high) - T
        T += step
    return T


@kernel
def _bracketed(
    law: Any, sigma_s: float, sigma_r: float, a: float, stress: float, first: int, last: int
) -> tuple[float, float]:
    # T_s and T_r for a >= 0: with T_r at its own root the rate rises with T_s, from 0 at T_s = 0
    low, high, goal = 0.0, math.inf, math.asinh(a)
    T, T_r, step = stress, 0.0, math.inf
    for _ in range(_BRACKETS):
        T_r = _side_stress(law, T, T_r, sigma_s, sigma_r, first, last)
        m = _moments(law, T, T_r, sigma_s, sigma_r, first, last)
        rate = T * m.g0 + sigma_s * m.g1
        if rate < a:
            low = T
        else:
            high = T
        before = step
        slope = m.ss - m.sr * m.sr / m.rr
        step = (goal - math.asinh(rate)) * math.hypot(1.0, rate) / slope
        if abs(step) <= _END:
            break
        if not low <= T + step <= high or (high < math.inf and abs(step) > 0.5 * abs(before)):
            step = 0.5 * (low + high) - T if high < math.inf else max(T, 1.0)
        T += step
    return T, T_r


@kernel
def equilibrium(law: Any, sigma_s: float, sigma_r: float, a: float, limit: float) -> Equilibrium:
    """Return the mid-film stress of a point of a film; arguments are those of `shear_flow`."""
    size = math.sqrt(sigma_s * sigma_s + sigma_r * sigma_r)
    if size > LARGEST_SIGMA:
        sigma_s *= LARGEST_SIGMA / size
        sigma_r *= LARGEST_SIGMA / size
        size = LARGEST_SIGMA
    a = min(max(a, -LARGEST_COUETTE), LARGEST_COUETTE)
    rule = 0
    while size > REACHES[rule]:
        rule += 1
    first, last = STARTS[rule], STARTS[rule + 1]
    goal = math.asinh(a)
    start = eyring_mean_stress(size, a, 1.0)
    T_s, T_r, found = start, 0.0, False
    step_s, step_r, share = 0.0, 0.0, 1.0
    best, best_s, best_r = math.inf, T_s, T_r
    m = _moments(law, T_s, T_r, sigma_s, sigma_r, first, last)
    for _ in range(_STEPS):
        rate_s, rate_r = T_s * m.g0 + sigma_s * m.g1, T_r * m.g0 + sigma_r * m.g1
        rate = math.sqrt(rate_s * rate_s + rate_r * rate_r)
        lag = math.asinh(rate) / rate if rate > 1.0e-8 else 1.0
        miss_s, miss_r = goal - lag * rate_s, -lag * rate_r
        miss = math.sqrt(miss_s * miss_s + miss_r * miss_r)
        # a step that leaves a larger miss is halved: the slopes are never singular, so that a
        # short enough one does better
        if miss > best and share > 1.0e-3:
            share *= 0.5
        else:
            best, best_s, best_r, share = miss, T_s, T_r, 1.0
            turned = 0.0
            if rate > 1.0e-8:
                root = math.sqrt(1.0 + rate * rate)
                turned = (miss_s * rate_s + miss_r * rate_r) / (rate * rate) * (root - 1.0 / lag)
            miss_s = miss_s / lag + turned * rate_s
            miss_r = miss_r / lag + turned * rate_r
            determinant = m.ss * m.rr - m.sr * m.sr
            step_s = (m.rr * miss_s - m.sr * miss_r) / determinant
            step_r = (m.ss * miss_r - m.sr * miss_s) / determinant
            length = math.sqrt(step_s * step_s + step_r * step_r)
            # where stress across the film is large T is small and its scale smaller yet: there a
            # short step says nothing about the next one
            found = length <= _END or (length <= _NEAR and miss <= _NEAR)
        T_s, T_r = best_s + share * step_s, best_r + share * step_r
        if found and length <= _THERE:
            break
        m = _moments(law, T_s, T_r, sigma_s, sigma_r, first, last)
        if found:
            break
    if not found:
        T_s, T_r = _bracketed(law, sigma_s, sigma_r, abs(a), abs(start), first, last)
        if a < 0.0:
            T_s, T_r = -T_s, -T_r
        m = _moments(law, T_s, T_r, sigma_s, sigma_r, first, last)
    slips = abs(T_s) > limit
    if slips:
        T_s = math.copysign(limit, a)
        T_r = _side_stress(law, T_s, T_r, sigma_s, sigma_r, first, last)
        m = _moments(law, T_s, T_r, sigma_s, sigma_r, first, last)
        a = T_s * m.g0 + sigma_s * m.g1
    return Equilibrium(sigma_s, sigma_r, a, T_s, T_r, slips, first, last, m.g0, m.g1, m.g2)


@kernel
def _slopes(law: Any, e: Equilibrium) -> tuple[float, float, float, float, float]:
    # d(flow)/d(Sigma) = 3 (K2 - K1 K0^-1 K1): ss, sr, rr; d(flow)/da = 3 K1 K0^-1: s, r
    g0, g1, g2 = e.g0, e.g1, e.g2
    ss0 = sr0 = rr0 = ss1 = sr1 = rr1 = ss2 = sr2 = rr2 = 0.0
    for k in range(e.first, e.last):
        Z, weight = NODES[k], WEIGHTS[k]
        us, ur = e.stress_s + e.sigma_s * Z, e.stress_r + e.sigma_r * Z
        ls, lr = e.stress_s - e.sigma_s * Z, e.stress_r - e.sigma_r * Z
        _, upper = rate_ratio(law, us * us + ur * ur)
        _, lower = rate_ratio(law, ls * ls + lr * lr)
        upper *= weight
        lower *= weight
        u, v = upper * us * us, lower * ls * ls
        ss0 += u + v
        ss1 += Z * (u - v)
        ss2 += Z * Z * (u + v)
        u, v = upper * us * ur, lower * ls * lr
        sr0 += u + v
        sr1 += Z * (u - v)
        sr2 += Z * Z * (u + v)
        u, v = upper * ur * ur, lower * lr * lr
        rr0 += u + v
        rr1 += Z * (u - v)
        rr2 += Z * Z * (u + v)
    ss0, rr0, ss1, rr1, ss2, rr2 = ss0 + g0, rr0 + g0, ss1 + g1, rr1 + g1, ss2 + g2, rr2 + g2
    # a stress held at its limit does not answer
    inverse_ss, inverse_sr, inverse_rr = 0.0, 0.0, 1.0 / rr0
    if not e.slips:
        determinant = ss0 * rr0 - sr0 * sr0
        inverse_ss, inverse_sr = rr0 / determinant, -sr0 / determinant
        inverse_rr = ss0 / determinant
    answer_ss = inverse_ss * ss1 + inverse_sr * sr1
    answer_sr = inverse_ss * sr1 + inverse_sr * rr1
    answer_rs = inverse_sr * ss1 + inverse_rr * sr1
    answer_rr = inverse_sr * sr1 + inverse_rr * rr1
    return (
        3.0 * (ss2 - ss1 * answer_ss - sr1 * answer_rs),
        3.0 * (sr2 - ss1 * answer_sr - sr1 * answer_rr),
        3.0 * (rr2 - sr1 * answer_sr - rr1 * answer_rr),
        0.0 if e.slips else 3.0 * answer_ss,
        0.0 if e.slips else 3.0 * answer_sr,
    )


@kernel
def flow_factors(law: Any, e: Equilibrium) -> tuple[float, float]:
    """Return the flow factors along and across sliding at a mid-film stress [-]."""
    across = 3.0 * (e.g2 - e.g1 * e.g1 / e.g0)
    if abs(e.sigma_s) < _SMALL_SIGMA:
        return _slopes(law, e)[0], across
    return across + 3.0 * e.a / e.sigma_s * e.g1 / e.g0, across


@kernel
def shear_factors(
    law: Any, sigma_s: float, sigma_r: float, a: float, limit: float
) -> tuple[float, float]:
    """Return the flow factors along and across sliding alone; see `shear_flow`."""
    return flow_factors(law, equilibrium(law, sigma_s, sigma_r, a, limit))


@kernel
def shear_flow(law: Any, sigma_s: float, sigma_r: float, a: float, limit: float) -> ShearFlow:
    """Return flow factors along and across sliding, mid-film stress and the slopes of the flow.

    S_r = 3 [m2 - m1^2/m0],  S_s = S_r + 3 (a/Sigma_s) m1/m0,  m_n = mean(Z^n G)

    Parameters
    ----------
    law
        Shear law of the oil.
    sigma_s, sigma_r
        Stress drop over half the film, h (dp/ds)/(2 tau0) and the like along r [-].
    a
        Newtonian shear stress of sliding over tau0, eta (u2 - u1)/(h tau0) [-], either sign.
    limit
        Limiting shear stress over tau0, above zero [-]; infinite where there is none.

    Returns
    -------
    ShearFlow
        Factors relative to the Newtonian flow -rho h^3/(12 eta) grad p. The slopes of the flow
        are finite everywhere, symmetric and positive definite; d Sigma/dh = Sigma/h,
        da/dh = -a/h and da/dp = a d ln eta/dp give those by film and pressure.

    Notes
    -----
    The no-slip conditions have one solution, since they are the gradient of a convex function,
    mean(cosh|tau|) for Eyring; it is found to 1e-9. Damped Newton solves them in T with both sides
    taken through asinh, which makes Eyring's linear where Sigma is zero: two or three sets of
    moments. Where it does not end, T_s is held in a bracket and T_r, for each T_s, within
    |Sigma_r|: either rate rises with its own stress. Where dp/ds is zero S_s is its limit
    d(flow_s)/d(Sigma_s). Without sliding or pumping S is 1; without dp/dr S_s of Eyring is
    `eyring_flow_factor`. Beyond |Sigma| = 100 and |a| = 1e86 all values are those there. The
    quadrature is exact to 1e-10 for Eyring's law and for any that grows as slowly and as smoothly
    with stress.

    With a limit, sliding beyond what mid-film stress T_s = limit shears is slip; the rest of the
    film flows as if the surfaces slid no faster. Slip is taken as equal at both walls, so that
    entrainment is not changed.

    Source: [sharif_2001]; in one dimension [conry_1987];
    [jamali_2015 (3.25)] [jamali_2015 (3.26)] [jamali_2015 (3.27)] [jamali_2015 (3.28)]
    [jamali_2015 (3.29)] [jamali_2015 (3.30)] [jamali_2015 (3.29a)] [jamali_2015 (3.30a)]
    [jamali_2015 (3.31)] [jamali_2015 (3.32)] [jamali_2015 (3.33)] [jamali_2015 (3.34)]
    [jamali_2015 (3.35)] [jamali_2015 (3.36)] [jamali_2015 (3.37)] [jamali_2015 (3.38)]
    [jamali_2015 (3.39)] [jamali_2015 (3.40)] [jamali_2015 (3.43)]
    (3.38) prints u for v.
    """
    e = equilibrium(law, sigma_s, sigma_r, a, limit)
    along, across = flow_factors(law, e)
    ss, sr, rr, s_a, r_a = _slopes(law, e)
    return ShearFlow(along, across, e.stress_s, e.stress_r, ss, sr, rr, s_a, r_a)
