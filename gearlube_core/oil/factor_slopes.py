"""Slopes of the flow factors of a film of any shear law, over stress, sliding and limit: kernels.

Names are those of `shear_flow`. No slip and no flow across sliding at rest hold along a change,

    K0 dT + K1 dSigma = (da, 0),  K_n = mean(Z^n d(rate)/d(tau)),

and with dT known every mean follows, d mean(Z^n G) = mean(Z^n 2 G' tau . d(tau)).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import rate_ratio
from gearlube_core.oil.shear_flow import (
    LARGEST_COUETTE,
    LARGEST_SIGMA,
    NODES,
    WEIGHTS,
    Equilibrium,
    equilibrium,
    flow_factors,
)

# a smaller Sigma along sliding gives way to this: the factor changes with its square
SMALL_SIGMA = 1.0e-4


class FactorSlopes(NamedTuple):
    """Flow factors of one point of a film and their slopes; all floats [-]."""

    along: float  # flow along s over its Newtonian value
    along_s: float  # d(along)/d(Sigma_s)
    along_r: float  # d(along)/d(Sigma_r)
    along_a: float  # d(along)/da
    along_limit: float  # d(along)/d(limit)
    across: float  # flow along r over its Newtonian value
    across_s: float
    across_r: float
    across_a: float
    across_limit: float


class Means(NamedTuple):
    """Means across the film of Z^n 2 G' tau_i tau_j, n to 2, and of Z^n 2 G' tau_i, n to 3."""

    ss0: float
    ss1: float
    ss2: float
    sr0: float
    sr1: float
    sr2: float
    rr0: float
    rr1: float
    s0: float
    s1: float
    s2: float
    s3: float
    r0: float
    r1: float
    r2: float
    r3: float


@kernel
def _means(law: Any, e: Equilibrium) -> Means:
    ss0 = ss1 = ss2 = sr0 = sr1 = sr2 = rr0 = rr1 = 0.0
    s0 = s1 = s2 = s3 = r0 = r1 = r2 = r3 = 0.0
    for k in range(e.first, e.last):
        for side in (1.0, -1.0):
            Z = side * NODES[k]
            s, r = e.stress_s + e.sigma_s * Z, e.stress_r + e.sigma_r * Z
            _, slope = rate_ratio(law, s * s + r * r)
            slope *= WEIGHTS[k]
            of_s, of_r = slope * s, slope * r
            s0 += of_s
            s1 += Z * of_s
            s2 += Z * Z * of_s
            s3 += Z * Z * Z * of_s
            r0 += of_r
            r1 += Z * of_r
            r2 += Z * Z * of_r
            r3 += Z * Z * Z * of_r
            ss0 += of_s * s
            ss1 += Z * of_s * s
            ss2 += Z * Z * of_s * s
            sr0 += of_s * r
            sr1 += Z * of_s * r
            sr2 += Z * Z * of_s * r
            rr0 += of_r * r
            rr1 += Z * of_r * r
    return Means(ss0, ss1, ss2, sr0, sr1, sr2, rr0, rr1, s0, s1, s2, s3, r0, r1, r2, r3)


@kernel
def factor_changes(
    e: Equilibrium,
    m: Means,
    along: float,
    d_sigma_s: float,
    d_sigma_r: float,
    d_a: float,
    d_limit: float,
) -> tuple[float, float]:
    """Return the changes of both factors under changes of what sets them."""
    moved_s = (e.g1 + m.ss1) * d_sigma_s + m.sr1 * d_sigma_r
    moved_r = m.sr1 * d_sigma_s + (e.g1 + m.rr1) * d_sigma_r
    k_ss, k_rr = e.g0 + m.ss0, e.g0 + m.rr0
    if e.slips:
        dT_s = math.copysign(d_limit, e.stress_s * d_limit)
        dT_r = -(m.sr0 * dT_s + moved_r) / k_rr
    else:
        determinant = k_ss * k_rr - m.sr0 * m.sr0
        dT_s = (k_rr * (d_a - moved_s) + m.sr0 * moved_r) / determinant
        dT_r = (-k_ss * moved_r - m.sr0 * (d_a - moved_s)) / determinant
    d_g0 = m.s0 * dT_s + m.r0 * dT_r + m.s1 * d_sigma_s + m.r1 * d_sigma_r
    d_g1 = m.s1 * dT_s + m.r1 * dT_r + m.s2 * d_sigma_s + m.r2 * d_sigma_r
    d_g2 = m.s2 * dT_s + m.r2 * dT_r + m.s3 * d_sigma_s + m.r3 * d_sigma_r
    lean = e.g1 / e.g0
    d_across = 3.0 * (d_g2 - 2.0 * lean * d_g1 + lean * lean * d_g0)
    d_flow = (e.g1 + m.ss1) * dT_s + m.sr1 * dT_r + (e.g2 + m.ss2) * d_sigma_s + m.sr2 * d_sigma_r
    return (3.0 * d_flow - along * d_sigma_s) / e.sigma_s, d_across


@kernel
def factor_slopes(law: Any, sigma_s: float, sigma_r: float, a: float, limit: float) -> FactorSlopes:
    """Return the flow factors along and across sliding and all their slopes.

    Parameters
    ----------
    law
        Shear law of the oil.
    sigma_s, sigma_r, a, limit
        As in `shear_flow`.

    Returns
    -------
    FactorSlopes
        Slopes over the limit are zero where the film does not slip, slopes over `a` where it does.

    Notes
    -----
    Exact slopes of the factors of `shear_flow`, but for |Sigma_s| below 1e-4, where they are
    those at 1e-4 times the ratio of both: both factors are even in either Sigma. Beyond
    |Sigma| = 100 the factors keep their values along the direction of Sigma, beyond |a| = 1e86
    all values.

    Source: derived from the equations of `shear_flow`; [sharif_2001]
    """
    size = math.sqrt(sigma_s * sigma_s + sigma_r * sigma_r)
    if size > LARGEST_SIGMA:
        shrink = LARGEST_SIGMA / size
        f = factor_slopes_within(law, shrink * sigma_s, shrink * sigma_r, a, limit)
        n_s, n_r = sigma_s / size, sigma_r / size
        along_out, across_out = (
            n_s * f.along_s + n_r * f.along_r,
            n_s * f.across_s + n_r * f.across_r,
        )
        return FactorSlopes(
            f.along,
            shrink * (f.along_s - along_out * n_s),
            shrink * (f.along_r - along_out * n_r),
            f.along_a,
            f.along_limit,
            f.across,
            shrink * (f.across_s - across_out * n_s),
            shrink * (f.across_r - across_out * n_r),
            f.across_a,
            f.across_limit,
        )
    return factor_slopes_within(law, sigma_s, sigma_r, a, limit)


@kernel
def factor_slopes_within(
    law: Any, sigma_s: float, sigma_r: float, a: float, limit: float
) -> FactorSlopes:
    """Return the same for |Sigma| up to 100."""
    e = equilibrium(law, sigma_s, sigma_r, a, limit)
    along, across = flow_factors(law, e)
    share = 1.0
    if abs(sigma_s) < SMALL_SIGMA:
        at = math.copysign(SMALL_SIGMA, sigma_s)
        share = sigma_s / at
        e = equilibrium(law, at, sigma_r, a, limit)
    m = _means(law, e)
    near = flow_factors(law, e)[0]
    along_s, across_s = factor_changes(e, m, near, 1.0, 0.0, 0.0, 0.0)
    along_r, across_r = factor_changes(e, m, near, 0.0, 1.0, 0.0, 0.0)
    along_a, across_a = 0.0, 0.0
    if not e.slips and abs(a) < LARGEST_COUETTE:
        along_a, across_a = factor_changes(e, m, near, 0.0, 0.0, 1.0, 0.0)
    along_limit, across_limit = 0.0, 0.0
    if e.slips:
        along_limit, across_limit = factor_changes(e, m, near, 0.0, 0.0, 0.0, 1.0)
    return FactorSlopes(
        along,
        share * along_s,
        along_r,
        along_a,
        along_limit,
        across,
        share * across_s,
        across_r,
        across_a,
        across_limit,
    )
