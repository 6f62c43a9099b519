"""Flow factors of many points of a film at once: kernels.

The equations of `shear_flow` and `factor_slopes`, with loops over points inside and quadrature
outside, so that the compiler takes several points in one instruction. Points of a block share a
quadrature rule.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import eyring_mean_stress
from gearlube_core.oil.factor_slopes import Means, factor_changes
from gearlube_core.oil.film_laws import rate_ratio
from gearlube_core.oil.shear_flow import NODES, WEIGHTS, Equilibrium

BLOCK = 128  # points
_STEPS = 8
_NEAR = 1.0e-5  # a Newton step of that size leaves an error of its square


class ShearBlock(NamedTuple):
    """Points of a film; arrays of shape (BLOCK,) [-], names as in `shear_flow`."""

    sigma_s: np.ndarray
    sigma_r: np.ndarray
    a: np.ndarray
    stress_s: np.ndarray  # T
    stress_r: np.ndarray
    g0: np.ndarray
    g1: np.ndarray
    g2: np.ndarray
    size: np.ndarray  # of the last Newton step
    q: np.ndarray  # square of the stress over tau0
    upper: np.ndarray  # G and dG/dq at Z and at -Z
    upper_slope: np.ndarray
    lower: np.ndarray
    lower_slope: np.ndarray
    sums: np.ndarray  # (16, BLOCK), means as in `Means`
    along: np.ndarray  # (4, BLOCK), factor and its slopes over Sigma_s, Sigma_r and a
    across: np.ndarray  # (4, BLOCK)

    @classmethod
    def empty(cls) -> ShearBlock:
        """Return a block to be filled."""
        ones = [np.empty(BLOCK) for _ in range(14)]
        return cls._make([*ones, *(np.empty((rows, BLOCK)) for rows in (16, 4, 4))])


@kernel
def _rate_ratios_one_by_one(law: Any, q: np.ndarray, G: np.ndarray, slope: np.ndarray) -> None:
    for i in range(q.size):
        G[i], slope[i] = rate_ratio(law, q[i])


@by_class(_rate_ratios_one_by_one)
def rate_ratios(law: Any, q: np.ndarray, G: np.ndarray, slope: np.ndarray) -> None:
    """Fill G and dG/dq of `rate_ratio`, shapes (n,); a law may bring a faster one.

    Parameters
    ----------
    law
        Shear law of the oil.
    q : ndarray, shape (n,)
        Square of the amount of the stress over tau0 [-].
    G, slope : ndarray, shape (n,)
        Result [-].
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def _evaluate(law: Any, b: ShearBlock, n: int, Z: float, G: np.ndarray, slope: np.ndarray) -> None:
    q, T, U = b.q[:n], b.stress_s[:n], b.stress_r[:n]
    s, r = b.sigma_s[:n], b.sigma_r[:n]
    for i in range(n):
        q[i] = (T[i] + s[i] * Z) * (T[i] + s[i] * Z) + (U[i] + r[i] * Z) * (U[i] + r[i] * Z)
    rate_ratios(law, q, G[:n], slope[:n])


@kernel
def _add(even: float, odd: float, upper: np.ndarray, lower: np.ndarray, total: np.ndarray) -> None:
    for i in range(total.size):
        total[i] += (even + odd) * upper[i] + (even - odd) * lower[i]


@kernel
def _add_first(
    weight: float,
    Z: float,
    sign: float,
    upper: np.ndarray,
    lower: np.ndarray,
    T: np.ndarray,
    s: np.ndarray,
    total: np.ndarray,
) -> None:
    for i in range(total.size):
        total[i] += weight * (upper[i] * (T[i] + s[i] * Z) + sign * (lower[i] * (T[i] - s[i] * Z)))


@kernel
def _add_second(
    weight: float,
    Z: float,
    sign: float,
    upper: np.ndarray,
    lower: np.ndarray,
    T: np.ndarray,
    s: np.ndarray,
    U: np.ndarray,
    r: np.ndarray,
    total: np.ndarray,
) -> None:
    for i in range(total.size):
        total[i] += weight * (
            upper[i] * ((T[i] + s[i] * Z) * (U[i] + r[i] * Z))
            + sign * (lower[i] * ((T[i] - s[i] * Z) * (U[i] - r[i] * Z)))
        )


@kernel
def _sum_moments(law: Any, b: ShearBlock, n: int, first: int, last: int, slopes: bool) -> None:
    # g0, g1, g2 and, with slopes, the means ss0, sr0 and rr0
    g0, g1, g2 = b.g0[:n], b.g1[:n], b.g2[:n]
    ss, sr, rr = b.sums[0, :n], b.sums[3, :n], b.sums[6, :n]
    T, U, s, r = b.stress_s[:n], b.stress_r[:n], b.sigma_s[:n], b.sigma_r[:n]
    for one in (g0, g1, g2, ss, sr, rr):
        one[:] = 0.0
    upper, lower = b.upper[:n], b.lower[:n]
    upper_slope, lower_slope = b.upper_slope[:n], b.lower_slope[:n]
    for k in range(first, last):
        Z, weight = NODES[k], 0.5 * WEIGHTS[k]
        _evaluate(law, b, n, Z, b.upper, b.upper_slope)
        _evaluate(law, b, n, -Z, b.lower, b.lower_slope)
        _add(weight, 0.0, upper, lower, g0)
        _add(0.0, weight * Z, upper, lower, g1)
        _add(weight * Z * Z, 0.0, upper, lower, g2)
        if slopes:
            double = 2.0 * weight
            _add_second(double, Z, 1.0, upper_slope, lower_slope, T, s, T, s, ss)
            _add_second(double, Z, 1.0, upper_slope, lower_slope, T, s, U, r, sr)
            _add_second(double, Z, 1.0, upper_slope, lower_slope, U, r, U, r, rr)


@kernel
def _newton_step(b: ShearBlock, n: int) -> None:
    # no slip through asinh along sliding, plainly across; a >= 0
    T, U, s, r = b.stress_s[:n], b.stress_r[:n], b.sigma_s[:n], b.sigma_r[:n]
    a, g0, g1 = b.a[:n], b.g0[:n], b.g1[:n]
    ss, sr, rr = b.sums[0, :n], b.sums[3, :n], b.sums[6, :n]
    rate_s, rate_r, miss, size = b.upper[:n], b.lower[:n], b.upper_slope[:n], b.size[:n]
    for i in range(n):
        rate_s[i] = T[i] * g0[i] + s[i] * g1[i]
    for i in range(n):
        rate_r[i] = U[i] * g0[i] + r[i] * g1[i]
    for i in range(n):
        # sinh of the difference of asinh, and asinh again to the third order
        rate, goal = rate_s[i], a[i]
        root = math.sqrt(1.0 + rate * rate)
        d = (goal - rate) * (goal + rate)
        d /= goal * root + rate * math.sqrt(1.0 + goal * goal) + 1e-300
        size[i] = abs(d)
        miss[i] = root * d / math.sqrt(1.0 + d * d / 3.0)
    for i in range(n):
        across = g0[i] + rr[i]
        determinant = (g0[i] + ss[i]) * across - sr[i] * sr[i]
        step = (across * miss[i] + sr[i] * rate_r[i]) / determinant
        size[i] = max(size[i], abs(step))
        T[i] += step
    for i in range(n):
        along = g0[i] + ss[i]
        determinant = along * (g0[i] + rr[i]) - sr[i] * sr[i]
        step = (-along * rate_r[i] - sr[i] * miss[i]) / determinant
        size[i] = max(size[i], abs(step))
        U[i] += step


@kernel
def balance_block(law: Any, b: ShearBlock, n: int, first: int, last: int) -> None:
    """Find the mid-film stresses of n points and their flow factors.

    Parameters
    ----------
    law
        Shear law of the oil.
    b
        With `sigma_s`, `sigma_r` and `a` of either sign; `stress_s`, `stress_r` and the factors
        `along[0]` and `across[0]` are written. `stress_s` is NaN where none was found.
    n, first, last
        Number of points; quadrature nodes of their rule.

    Notes
    -----
    Newton for the two conditions of no slip, to steps of 1e-5 and one more set of moments, as in
    `equilibrium`. The mid-film stress turns with `a`: T(-a) = -T(a), so that a >= 0 in between.
    """
    a, T, U = b.a[:n], b.stress_s[:n], b.stress_r[:n]
    s, r, g0, g1, g2 = b.sigma_s[:n], b.sigma_r[:n], b.g0[:n], b.g1[:n], b.g2[:n]
    for i in range(n):
        T[i] = eyring_mean_stress(math.sqrt(s[i] * s[i] + r[i] * r[i]), abs(a[i]), 1.0)
        U[i] = 0.0
    signs = b.along[1, :n]
    for i in range(n):
        signs[i] = math.copysign(1.0, a[i])
        a[i] = abs(a[i])
    found = False
    for _ in range(_STEPS):
        _sum_moments(law, b, n, first, last, True)
        _newton_step(b, n)
        found = True
        for i in range(n):
            found = found and b.size[i] <= _NEAR
        if found:
            break
    for i in range(n):
        if not b.size[i] <= _NEAR:
            T[i] = U[i] = 0.0  # it would spoil the range of the others
    _sum_moments(law, b, n, first, last, False)
    along, across = b.along[0, :n], b.across[0, :n]
    for i in range(n):
        across[i] = 3.0 * (g2[i] - g1[i] * g1[i] / g0[i])
    for i in range(n):
        along[i] = across[i] + 3.0 * a[i] / s[i] * (g1[i] / g0[i])
    for i in range(n):
        a[i] *= signs[i]
        T[i] *= signs[i]
        U[i] *= signs[i]
    for i in range(n):
        if not b.size[i] <= _NEAR:
            T[i] = math.nan


@kernel
def block_slopes(law: Any, b: ShearBlock, n: int, first: int, last: int) -> None:
    """Write the flow factors and their slopes, see `factor_slopes`, of n points that do not slip.

    Parameters
    ----------
    law, n, first, last
        As in `balance_block`.
    b
        With `sigma_s`, `sigma_r`, `a`, `stress_s` and `stress_r`; `along` and `across` are written.
    """
    g0, g1, g2 = b.g0[:n], b.g1[:n], b.g2[:n]
    T, U, s, r = b.stress_s[:n], b.stress_r[:n], b.sigma_s[:n], b.sigma_r[:n]
    for one in (g0, g1, g2):
        one[:] = 0.0
    b.sums[:, :n] = 0.0
    upper, lower, x, y = b.upper[:n], b.lower[:n], b.upper_slope[:n], b.lower_slope[:n]
    for k in range(first, last):
        Z, weight = NODES[k], 0.5 * WEIGHTS[k]
        _evaluate(law, b, n, Z, b.upper, b.upper_slope)
        _evaluate(law, b, n, -Z, b.lower, b.lower_slope)
        _add(weight, 0.0, upper, lower, g0)
        _add(0.0, weight * Z, upper, lower, g1)
        _add(weight * Z * Z, 0.0, upper, lower, g2)
        power, sign = WEIGHTS[k], 1.0
        for m in range(4):
            _add_first(power, Z, sign, x, y, T, s, b.sums[8 + m, :n])
            _add_first(power, Z, sign, x, y, U, r, b.sums[12 + m, :n])
            if m < 3:
                _add_second(power, Z, sign, x, y, T, s, T, s, b.sums[m, :n])
                _add_second(power, Z, sign, x, y, T, s, U, r, b.sums[3 + m, :n])
            if m < 2:
                _add_second(power, Z, sign, x, y, U, r, U, r, b.sums[6 + m, :n])
            power, sign = power * Z, -sign
    along, across, sums = b.along, b.across, b.sums
    for i in range(n):
        lean = g1[i] / g0[i]
        second = 3.0 * (g2[i] - g1[i] * lean)
        factor = second + 3.0 * b.a[i] / s[i] * lean
        e = Equilibrium(s[i], r[i], b.a[i], T[i], U[i], False, 0, 0, g0[i], g1[i], g2[i])
        means = Means(
            sums[0, i],
            sums[1, i],
            sums[2, i],
            sums[3, i],
            sums[4, i],
            sums[5, i],
            sums[6, i],
            sums[7, i],
            sums[8, i],
            sums[9, i],
            sums[10, i],
            sums[11, i],
            sums[12, i],
            sums[13, i],
            sums[14, i],
            sums[15, i],
        )
        along[0, i], across[0, i] = factor, second
        along[1, i], across[1, i] = factor_changes(e, means, factor, 1.0, 0.0, 0.0, 0.0)
        along[2, i], across[2, i] = factor_changes(e, means, factor, 0.0, 1.0, 0.0, 0.0)
        along[3, i], across[3, i] = factor_changes(e, means, factor, 0.0, 0.0, 1.0, 0.0)
