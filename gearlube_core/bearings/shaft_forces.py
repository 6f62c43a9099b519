"""Forces of two opposed roller bearings on a shaft that translates.

Coordinates: (r1, r2, a) right-handed, a along the shaft; u = (r1, r2, xa). Roller i stands at the
angle cage_angle + 2 pi i/N from r1 towards r2. Positive shaft speed turns r1 towards r2. The
bearing with side s = +1 is loaded by positive axial displacement, the one with s = -1 unloaded.
"""

from __future__ import annotations

import math

from gearlube_core.bearings.inlining import summing
from gearlube_core.bearings.parameters import (
    COS_TABLE,
    FILM_FLOOR_APPROACH,
    SIN_TABLE,
    BearingParameters,
)
from gearlube_core.bearings.roller_contact import (
    N_LINE,
    film_amplitude,
    roller_load_general,
    roller_load_line,
)
from gearlube_core.jit import kernel

_FLOOR_LINE = FILM_FLOOR_APPROACH**N_LINE


@summing
def _sums_line(
    count: int,
    g: float,
    g1: float,
    g2: float,
    ga: float,
    v1: float,
    v2: float,
    va: float,
    film: float,
    squeeze_scale: float,
    K: float,
    c: float,
    w_min: float,
) -> tuple[float, float, float, float, float, float, float]:
    """Return sum w cos b, sum w sin b, sum w of both sides, and sum (w - steady) g'.

    b = 2 pi i/count, g_i = g +- ga + g1 cos b + g2 sin b; both sides in one loop because each
    roller is one long chain of operations and two of them overlap.
    """
    c1 = s1 = a1 = c2 = s2 = a2 = lost = 0.0
    for i in range(count):
        cos_b = COS_TABLE[count, i]
        sin_b = SIN_TABLE[count, i]
        gap = g + g1 * cos_b + g2 * sin_b
        rate = v1 * cos_b + v2 * sin_b
        w, steady = roller_load_line(gap + ga, rate + va, film, squeeze_scale, K, c, w_min)
        c1 += w * cos_b
        s1 += w * sin_b
        a1 += w
        lost += (w - steady) * (rate + va)
        w, steady = roller_load_line(gap - ga, rate - va, film, squeeze_scale, K, c, w_min)
        c2 += w * cos_b
        s2 += w * sin_b
        a2 += w
        lost += (w - steady) * (rate - va)
    return c1, s1, a1, c2, s2, a2, lost


@kernel
def _sums_general(
    count: int,
    g: float,
    g1: float,
    g2: float,
    ga: float,
    v1: float,
    v2: float,
    va: float,
    film: float,
    squeeze_scale: float,
    K: float,
    c: float,
    w_min: float,
    n: float,
) -> tuple[float, float, float, float, float, float, float]:
    """Return the sums of `_sums_line` for any exponent n."""
    c1 = s1 = a1 = c2 = s2 = a2 = lost = 0.0
    for i in range(count):
        cos_b = COS_TABLE[count, i]
        sin_b = SIN_TABLE[count, i]
        gap = g + g1 * cos_b + g2 * sin_b
        rate = v1 * cos_b + v2 * sin_b
        w, steady = roller_load_general(gap + ga, rate + va, film, squeeze_scale, K, c, w_min, n)
        c1 += w * cos_b
        s1 += w * sin_b
        a1 += w
        lost += (w - steady) * (rate + va)
        w, steady = roller_load_general(gap - ga, rate - va, film, squeeze_scale, K, c, w_min, n)
        c2 += w * cos_b
        s2 += w * sin_b
        a2 += w
        lost += (w - steady) * (rate - va)
    return c1, s1, a1, c2, s2, a2, lost


@kernel
def approach_terms(
    r1: float,
    r2: float,
    xa: float,
    vr1: float,
    vr2: float,
    vxa: float,
    cos_c: float,
    sin_c: float,
    cage_speed: float,
    p: BearingParameters,
) -> tuple[float, float, float, float, float, float, float]:
    """Return the approach and its rate as sums over the roller angle b from the cage frame.

    g_i = g0 + s ga + g1 cos b + g2 sin b,  g_i' = s va + v1 cos b + v2 sin b, with b = 2 pi i/N,
    in units of FILM_FLOOR_APPROACH. The rates contain the turning of the cage.
    """
    scale = p.approach_factor / FILM_FLOOR_APPROACH
    radial = scale * p.cos_contact
    g1 = radial * (r1 * cos_c + r2 * sin_c)
    g2 = radial * (r2 * cos_c - r1 * sin_c)
    v1 = radial * (vr1 * cos_c + vr2 * sin_c) + cage_speed * g2
    v2 = radial * (vr2 * cos_c - vr1 * sin_c) - cage_speed * g1
    axial = scale * p.sin_contact
    return p.interference / FILM_FLOOR_APPROACH, g1, g2, axial * xa, v1, v2, axial * vxa


@kernel
def cage_torque(r1: float, r2: float, F_r1: float, F_r2: float) -> float:
    """Return the torque that the rollers of a bearing exert on the cage.

    T_c = r1 (-F_r2) - r2 (-F_r1) = -dV/d(cage angle) without hysteresis.

    Parameters
    ----------
    r1, r2 : float
        Radial displacement of the shaft [m].
    F_r1, F_r2 : float
        Force of the bearing on the shaft, or the sum over the bearings of a shaft [N].

    Returns
    -------
    float
        T_c [N m], positive in the direction of growing cage angle.

    Notes
    -----
    Mohammadpour et al. 2015 turn the cage without a torque. Where the cage angle follows the
    shaft, adding cage_ratio T_c to the torque on the shaft closes the energy balance exactly.
    """
    return r2 * F_r1 - r1 * F_r2


@kernel
def shaft_bearing_forces(
    r1: float,
    r2: float,
    xa: float,
    vr1: float,
    vr2: float,
    vxa: float,
    cage_angle: float,
    shaft_speed: float,
    f_ref: float,
    eta0: float,
    alpha: float,
    p: BearingParameters,
) -> tuple[float, float, float, float, float, float, float]:
    """Return the forces of both opposed bearings on the shaft, and the power of the hysteresis.

    w_i = kn d^n + 0.009 n kn d^(n-1) d'/f_ref,  d = H - C + (r1 cos th + r2 sin th) cos L
    + s xa sin L,  F_r1 = -sum w cos th cos L,  F_r2 = -sum w sin th cos L,  F_a = -s sum w sin L.

    Parameters
    ----------
    r1, r2, xa : float
        Radial and axial displacement of the shaft [m].
    vr1, vr2, vxa : float
        Velocities [m/s].
    cage_angle : float
        Angle of roller 0 [rad]; keep it within a few turns for accuracy.
    shaft_speed : float
        Speed of the shaft [rad/s].
    f_ref : float
        Reference frequency of the hysteresis, above zero [Hz].
    eta0, alpha : float
        Viscosity [Pa s] and pressure-viscosity coefficient [1/Pa] of the oil.
    p : BearingParameters
        The bearing on either side.

    Returns
    -------
    tuple of float
        F1_r1, F1_r2, F1_a of the side s = +1, F2_r1, F2_r2, F2_a of s = -1 [N]; power lost in the
        rollers, >= 0 [W].

    Notes
    -----
    The lost power covers the motion of the shaft and of the cage: with the potential V of
    `shaft_bearing_energy` at constant film, dV/dt = -F.v - T_c cage_speed - power, where T_c is
    `cage_torque`. Printed eq. (24) has no side s; printed eq. (26) halves the displacement, which
    is the option approach="as_printed". A NaN in any input gives NaN forces.

    References
    ----------
    Mohammadpour et al. 2015 eq. (24)-(27).
    """
    count = int(p.n_rollers)
    film, squeeze_scale = film_amplitude(shaft_speed, eta0, alpha, p)
    cos_c = math.cos(cage_angle)
    sin_c = math.sin(cage_angle)
    g0, g1, g2, ga, v1, v2, va = approach_terms(
        r1, r2, xa, vr1, vr2, vxa, cos_c, sin_c, p.cage_ratio * shaft_speed, p
    )
    K = p.kn * (_FLOOR_LINE if p.n == N_LINE else FILM_FLOOR_APPROACH**p.n)
    c = p.loss / f_ref
    w_min = 0.0 if p.clip != 0.0 else -math.inf
    if p.n == N_LINE:
        c1, s1, a1, c2, s2, a2, lost = _sums_line(
            count, g0, g1, g2, ga, v1, v2, va, film, squeeze_scale, K, c, w_min
        )
    else:
        c1, s1, a1, c2, s2, a2, lost = _sums_general(
            count, g0, g1, g2, ga, v1, v2, va, film, squeeze_scale, K, c, w_min, p.n
        )
    return (
        -p.cos_contact * (c1 * cos_c - s1 * sin_c),
        -p.cos_contact * (c1 * sin_c + s1 * cos_c),
        -p.sin_contact * a1,
        -p.cos_contact * (c2 * cos_c - s2 * sin_c),
        -p.cos_contact * (c2 * sin_c + s2 * cos_c),
        p.sin_contact * a2,
        lost * FILM_FLOOR_APPROACH / p.approach_factor,
    )
