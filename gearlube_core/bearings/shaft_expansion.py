"""Bearing forces of a shaft expanded about one state: exact there, linear around it.

Within an integrator step the rollers' approaches change by about one per cent. The forces of all
rollers and their slopes are summed once, in the frame that turns with the cage, where a stage of
the step then costs a 3 x 3 product. What is left out is of second order in that change.
"""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.parameters import (
    COS_TABLE,
    FILM_FLOOR_APPROACH,
    FILM_RANGE,
    SIN_TABLE,
    ApproachTerms,
    BearingParameters,
    approach_terms,
)
from gearlube_core.bearings.roller_contact import (
    N_LINE,
    approach_with_film,
    film_amplitude,
    roller_approach_line,
    roller_response_general,
    roller_response_line,
)
from gearlube_core.film.mostofi_gohar_1983 import LOAD_EXPONENT
from gearlube_core.kernels.inlining import summing
from gearlube_core.kernels.jit import kernel

# layout of an expansion: base approaches and rates (g1, g2, ga, v1, v2, va), sums of the load
# (w cos b, w sin b, +-w), lost power, symmetric 3 x 3 slopes against approach and against rate
# and cage angle with its cosine and sine
BASE, SUMS, LOST, STIFFNESS, DAMPING, CAGE = 0, 6, 9, 10, 16, 22  # N_EXPANSION floats

_1_6, _1_24, _1_120 = 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0

_Sums = tuple[
    float, float, float, float,
    float, float, float, float, float, float,
    float, float, float, float, float, float,
]  # fmt: skip


@kernel
def roller_energy(g: float, film: float, n: float) -> float:
    """Return the integral of x^n dg up to the geometric approach g, with x = g + H(x).

    x^(n+1)/(n+1) + m A (min(x, R)^(n-m) - 1)/(n-m),  m = 0.045 n, the second term for x > 1.

    Lengths are in units of FILM_FLOOR_APPROACH, R is FILM_RANGE. The second term is the work
    that the rollers do as the film gives way under load, -integral of x^n dH.
    """
    x = approach_with_film(g, film, n)
    if x <= 0.0:
        return 0.0
    energy = x ** (n + 1.0) / (n + 1.0)
    if x > 1.0:
        m = -LOAD_EXPONENT * n
        energy += m * film * (min(x, FILM_RANGE) ** (n - m) - 1.0) / (n - m)
    return energy


@summing
def _sum_line(count: int, g: float, g1: float, g2: float, film: float) -> float:
    """Return the sum of `roller_energy` over the rollers of a line contact bearing.

    With y = x^(1/9) and the film H = x - g: x^(n+1) = x^2 y, A x^(n-m) = x y H for 1 < x < R.
    """
    n = N_LINE
    m = -LOAD_EXPONENT * n
    limit = FILM_RANGE ** (n - m)
    total = 0.0
    for i in range(count):
        gap = g + g1 * COS_TABLE[count, i] + g2 * SIN_TABLE[count, i]
        x, y, _, _ = roller_approach_line(gap, film)
        given = x * y * (x - gap) if x < FILM_RANGE else film * limit
        given = given - film if x > 1.0 else 0.0
        total += x * x * y / (n + 1.0) + m * given / (n - m)
    return total


@kernel
def bearing_energy(
    r1: float,
    r2: float,
    xa: float,
    cage_angle: float,
    shaft_speed: float,
    eta0: float,
    alpha: float,
    p: BearingParameters,
    side: float,
) -> float:
    """Return the elastic energy of one bearing [J]; see `shaft_bearing_energy`."""
    film, _ = film_amplitude(shaft_speed, eta0, alpha, p)
    still = ShaftMotion(r1, r2, xa, 0.0, 0.0, 0.0, cage_angle, 0.0)
    g0, g1, g2, ga, _, _, _ = approach_terms(still, math.cos(cage_angle), math.sin(cage_angle), p)
    count = int(p.n_rollers)
    if p.n == N_LINE:
        total = _sum_line(count, g0 + side * ga, g1, g2, film)
    else:
        total = 0.0
        for i in range(count):
            g = g0 + side * ga + g1 * COS_TABLE[count, i] + g2 * SIN_TABLE[count, i]
            total += roller_energy(g, film, p.n)
    return total * p.kn * FILM_FLOOR_APPROACH ** (p.n + 1.0) / p.approach_factor


@kernel
def shaft_bearing_energy(
    r1: float,
    r2: float,
    xa: float,
    cage_angle: float,
    shaft_speed: float,
    eta0: float,
    alpha: float,
    p: BearingParameters,
) -> float:
    """Return the elastic energy of all rollers of both opposed bearings.

    V = sum kn d^(n+1)/(n+1) without film; F = -grad V for the quasi-steady forces.

    Parameters
    ----------
    r1, r2, xa : float
        Radial and axial displacement of the shaft [m].
    cage_angle, shaft_speed : float
        Angle of roller 0 [rad]; speed of the shaft [rad/s].
    eta0, alpha, p
        As in `shaft_bearing_forces`.

    Returns
    -------
    float
        V [J].

    Notes
    -----
    With the halved approach of [mohammadpour_2015 (26)] as printed, V is divided by the factor 1/2,
    so that the forces still have a potential. With a film, V holds at constant speed and oil; a
    change of these lifts the rollers and does work on the shaft that no term of the model supplies.

    References
    ----------
    [mohammadpour_2015 (25)] integrated over the approach
    """
    return bearing_energy(
        r1, r2, xa, cage_angle, shaft_speed, eta0, alpha, p, 1.0
    ) + bearing_energy(r1, r2, xa, cage_angle, shaft_speed, eta0, alpha, p, -1.0)


@summing
def _sums_line(
    count: int,
    terms: ApproachTerms,
    film: float,
    squeeze_scale: float,
    K: float,
    c: float,
    w_min: float,
) -> _Sums:
    """Return the sums over both sides' rollers in the order of SUMS, LOST, STIFFNESS, DAMPING."""
    g, g1, g2, ga, v1, v2, va = terms
    w_c = w_s = w_a = lost = 0.0
    k_cc = k_cs = k_ss = k_ca = k_sa = k_aa = 0.0
    d_cc = d_cs = d_ss = d_ca = d_sa = d_aa = 0.0
    for i in range(count):
        cos_b = COS_TABLE[count, i]
        sin_b = SIN_TABLE[count, i]
        gap = g + g1 * cos_b + g2 * sin_b
        rate = v1 * cos_b + v2 * sin_b
        w, steady, k, d = roller_response_line(
            gap + ga, rate + va, film, squeeze_scale, K, c, w_min
        )
        w2, steady2, k2, d2 = roller_response_line(
            gap - ga, rate - va, film, squeeze_scale, K, c, w_min
        )
        lost += (w - steady) * (rate + va) + (w2 - steady2) * (rate - va)
        both = w + w2
        w_c += both * cos_b
        w_s += both * sin_b
        w_a += w - w2
        cc = cos_b * cos_b
        cs = cos_b * sin_b
        ss = sin_b * sin_b
        both = k + k2
        k_cc += both * cc
        k_cs += both * cs
        k_ss += both * ss
        k_ca += (k - k2) * cos_b
        k_sa += (k - k2) * sin_b
        k_aa += both
        both = d + d2
        d_cc += both * cc
        d_cs += both * cs
        d_ss += both * ss
        d_ca += (d - d2) * cos_b
        d_sa += (d - d2) * sin_b
        d_aa += both
    return (
        w_c, w_s, w_a, lost,
        k_cc, k_cs, k_ss, k_ca, k_sa, k_aa,
        d_cc, d_cs, d_ss, d_ca, d_sa, d_aa,
    )  # fmt: skip


@kernel
def _sums_general(
    count: int,
    terms: ApproachTerms,
    film: float,
    squeeze_scale: float,
    K: float,
    c: float,
    w_min: float,
    n: float,
    e: Array,
) -> None:
    """Write the sums of `_sums_line` for any exponent n into the expansion `e`."""
    g, g1, g2, ga, v1, v2, va = terms
    for i in range(SUMS, CAGE):
        e[i] = 0.0
    for i in range(count):
        cos_b = COS_TABLE[count, i]
        sin_b = SIN_TABLE[count, i]
        for side in range(2):
            s = 1.0 - 2.0 * side
            rate = v1 * cos_b + v2 * sin_b + s * va
            w, steady, k, d = roller_response_general(
                g + g1 * cos_b + g2 * sin_b + s * ga, rate, film, squeeze_scale, K, c, w_min, n
            )
            e[SUMS] += w * cos_b
            e[SUMS + 1] += w * sin_b
            e[SUMS + 2] += w * s
            e[LOST] += (w - steady) * rate
            for at, slope in ((STIFFNESS, k), (DAMPING, d)):
                e[at] += slope * cos_b * cos_b
                e[at + 1] += slope * cos_b * sin_b
                e[at + 2] += slope * sin_b * sin_b
                e[at + 3] += slope * s * cos_b
                e[at + 4] += slope * s * sin_b
                e[at + 5] += slope


@kernel
def expand_shaft_bearings(
    motion: ShaftMotion, f_ref: float, eta0: float, alpha: float, p: BearingParameters, e: Array
) -> None:
    """Write the expansion of both bearings' forces about this state into `e`.

    Parameters
    ----------
    motion, f_ref, eta0, alpha, p
        As in `shaft_bearing_forces`.
    e : ndarray of shape (N_EXPANSION,)
        Expansion, see `bearing_type`, for `expanded_shaft_forces`.
    """
    count = int(p.n_rollers)
    film, squeeze_scale = film_amplitude(motion.speed, eta0, alpha, p)
    cos_c = math.cos(motion.cage_angle)
    sin_c = math.sin(motion.cage_angle)
    terms = approach_terms(motion, cos_c, sin_c, p)
    e[CAGE] = motion.cage_angle
    e[CAGE + 1] = cos_c
    e[CAGE + 2] = sin_c
    e[0] = terms.g1
    e[1] = terms.g2
    e[2] = terms.ga
    e[3] = terms.v1
    e[4] = terms.v2
    e[5] = terms.va
    K = p.kn * FILM_FLOOR_APPROACH**p.n
    c = p.loss / f_ref
    w_min = 0.0 if p.clip != 0.0 else -math.inf
    if p.n == N_LINE:
        sums = _sums_line(count, terms, film, squeeze_scale, K, c, w_min)
        for i in range(CAGE - SUMS):
            e[SUMS + i] = sums[i]
    else:
        _sums_general(count, terms, film, squeeze_scale, K, c, w_min, p.n, e)
    e[LOST] *= FILM_FLOOR_APPROACH / p.approach_factor


@kernel
def expanded_shaft_forces(
    motion: ShaftMotion, p: BearingParameters, e: Array
) -> tuple[float, float, float, float]:
    """Return the forces of both bearings on the shaft near the state of the expansion `e`.

    S = S0 + K (g - g0) + D (g' - g0'),  F = -(cos L Q S_r, sin L S_a), Q by the cage angle.

    Parameters
    ----------
    motion, p
        As in `shaft_bearing_forces`.
    e : ndarray of shape (N_EXPANSION,)
        From `expand_shaft_bearings`.

    Returns
    -------
    tuple of float
        F_r1, F_r2, F_a [N]; power lost in the rollers at the damping of the expansion [W].

    Notes
    -----
    The turning of the cage is followed by series, to 1e-12 within 0.02 rad and to 2e-9 within
    0.1 rad; the film of the expansion is kept. The error is (n - 1)/2 (change of approach /
    approach)^2 of a roller's load, 6e-6 for one per cent, and n - 1 times that change of the
    lost power.
    """
    turn = motion.cage_angle - e[CAGE]
    cos_t = 1.0 - turn * turn * (0.5 - turn * turn * _1_24)
    sin_t = turn * (1.0 - turn * turn * (_1_6 - turn * turn * _1_120))
    cos_c = e[CAGE + 1] * cos_t - e[CAGE + 2] * sin_t
    sin_c = e[CAGE + 2] * cos_t + e[CAGE + 1] * sin_t
    _, g1, g2, ga, v1, v2, va = approach_terms(motion, cos_c, sin_c, p)
    x = g1 - e[0]
    y = g2 - e[1]
    a = ga - e[2]
    u = v1 - e[3]
    v = v2 - e[4]
    w = va - e[5]
    k = STIFFNESS
    d = DAMPING
    damping_1 = e[d] * u + e[d + 1] * v + e[d + 3] * w
    damping_2 = e[d + 1] * u + e[d + 2] * v + e[d + 4] * w
    damping_a = e[d + 3] * u + e[d + 4] * v + e[d + 5] * w
    S_1 = e[SUMS] + e[k] * x + e[k + 1] * y + e[k + 3] * a + damping_1
    S_2 = e[SUMS + 1] + e[k + 1] * x + e[k + 2] * y + e[k + 4] * a + damping_2
    S_a = e[SUMS + 2] + e[k + 3] * x + e[k + 4] * y + e[k + 5] * a + damping_a
    lost = 2.0 * (damping_1 * e[3] + damping_2 * e[4] + damping_a * e[5])
    lost += damping_1 * u + damping_2 * v + damping_a * w
    return (
        -p.cos_contact * (S_1 * cos_c - S_2 * sin_c),
        -p.cos_contact * (S_1 * sin_c + S_2 * cos_c),
        -p.sin_contact * S_a,
        e[LOST] + lost * FILM_FLOOR_APPROACH / p.approach_factor,
    )
