"""Forces and roller loads of a single bearing, exact, and between rings under given forces."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.parameters import (
    COS_TABLE,
    FILM_FLOOR_APPROACH,
    SIN_TABLE,
    BearingParameters,
    approach_terms,
)
from gearlube_core.bearings.roller_contact import (
    N_LINE,
    approach_with_film,
    film_amplitude,
    roller_approach_line,
    roller_load_general,
    roller_load_line,
)
from gearlube_core.kernels.jit import kernel

LARGEST_RATIO = 0.8  # of F_r tan(a)/F_a, where about half of the rollers carry load
_APPROACH = 1e-5  # m; the share of each roller is free of it
_HALVINGS = 60


@kernel
def bearing_forces(
    motion: ShaftMotion, f_ref: float, eta0: float, alpha: float, p: BearingParameters, side: float
) -> tuple[float, float, float, float]:
    """Return the force of one bearing on the shaft, and the power of its hysteresis.

    Parameters
    ----------
    motion, f_ref, eta0, alpha, p
        As in `shaft_bearing_forces`.
    side : float
        +1 or -1, the axial direction of displacement that loads the bearing [-].

    Returns
    -------
    tuple of float
        F_r1, F_r2, F_a [N]; lost power, >= 0 [W].

    References
    ----------
    [mohammadpour_2015 (24)]; `roller_contact` has the load of a roller.
    """
    film, squeeze_scale = film_amplitude(motion.speed, eta0, alpha, p)
    cos_c = math.cos(motion.cage_angle)
    sin_c = math.sin(motion.cage_angle)
    g0, g1, g2, ga, v1, v2, va = approach_terms(motion, cos_c, sin_c, p)
    K = p.kn * FILM_FLOOR_APPROACH**p.n
    c = p.loss / f_ref
    w_min = 0.0 if p.clip != 0.0 else -math.inf
    count = int(p.n_rollers)
    line = p.n == N_LINE
    sum_cos = sum_sin = sum_all = lost = 0.0
    for i in range(count):
        cos_b = COS_TABLE[count, i]
        sin_b = SIN_TABLE[count, i]
        g = g0 + side * ga + g1 * cos_b + g2 * sin_b
        rate = side * va + v1 * cos_b + v2 * sin_b
        if line:
            w, steady = roller_load_line(g, rate, film, squeeze_scale, K, c, w_min)
        else:
            w, steady = roller_load_general(g, rate, film, squeeze_scale, K, c, w_min, p.n)
        sum_cos += w * cos_b
        sum_sin += w * sin_b
        sum_all += w
        lost += (w - steady) * rate
    return (
        -p.cos_contact * (sum_cos * cos_c - sum_sin * sin_c),
        -p.cos_contact * (sum_cos * sin_c + sum_sin * cos_c),
        -side * p.sin_contact * sum_all,
        lost * FILM_FLOOR_APPROACH / p.approach_factor,
    )


@kernel
def roller_loads(
    motion: ShaftMotion,
    f_ref: float,
    eta0: float,
    alpha: float,
    p: BearingParameters,
    side: float,
    out: np.ndarray,
) -> int:
    """Write the load of every roller of one bearing into `out`, roller 0 first.

    Parameters
    ----------
    motion, f_ref, eta0, alpha, p, side
        As in `bearing_forces`.
    out : ndarray, shape (>= n_rollers,)
        Receives w_i [N].

    Returns
    -------
    int
        0, or 1 when `out` is too short (nothing is written then).

    References
    ----------
    [mohammadpour_2015 (25)]
    """
    count = int(p.n_rollers)
    if out.shape[0] < count:
        return 1
    film, squeeze_scale = film_amplitude(motion.speed, eta0, alpha, p)
    g0, g1, g2, ga, v1, v2, va = approach_terms(
        motion, math.cos(motion.cage_angle), math.sin(motion.cage_angle), p
    )
    K = p.kn * FILM_FLOOR_APPROACH**p.n
    c = p.loss / f_ref
    w_min = 0.0 if p.clip != 0.0 else -math.inf
    line = p.n == N_LINE
    for i in range(count):
        cos_b = COS_TABLE[count, i]
        sin_b = SIN_TABLE[count, i]
        g = g0 + side * ga + g1 * cos_b + g2 * sin_b
        rate = side * va + v1 * cos_b + v2 * sin_b
        if line:
            w, _ = roller_load_line(g, rate, film, squeeze_scale, K, c, w_min)
        else:
            w, _ = roller_load_general(g, rate, film, squeeze_scale, K, c, w_min, p.n)
        out[i] = w
    return 0


@kernel
def roller_films(
    motion: ShaftMotion,
    eta0: float,
    alpha: float,
    p: BearingParameters,
    side: float,
    out: np.ndarray,
) -> int:
    """Write the film that is part of every roller's load, roller 0 first.

    H = (d - g) d_f where the races touch, see `roller_contact`

    Parameters
    ----------
    motion, eta0, alpha, p, side
        As in `bearing_forces`; velocities play no part.
    out : ndarray, shape (>= n_rollers,)
        Receives the film [m]; 0 without load, and for a bearing without a film.

    Returns
    -------
    int
        0, or 1 when `out` is too short (nothing is written then).

    References
    ----------
    [mohammadpour_2015 (27)]
    """
    count = int(p.n_rollers)
    if out.shape[0] < count:
        return 1
    film, _ = film_amplitude(motion.speed, eta0, alpha, p)
    g0, g1, g2, ga, _, _, _ = approach_terms(
        motion, math.cos(motion.cage_angle), math.sin(motion.cage_angle), p
    )
    line = p.n == N_LINE
    for i in range(count):
        g = g0 + side * ga + g1 * COS_TABLE[count, i] + g2 * SIN_TABLE[count, i]
        if line:
            x, _, _, _ = roller_approach_line(g, film)
        else:
            x = approach_with_film(g, film, p.n)
        out[i] = (x - g) * FILM_FLOOR_APPROACH if g + film > 0.0 else 0.0
    return 0


@kernel
def _shares(angle: float, p: BearingParameters, out: Array) -> tuple[float, float]:
    # rollers under an axial and a radial approach in the ratio cos : sin; sums of w and w cos psi
    motion = ShaftMotion(
        _APPROACH * math.sin(angle) / p.cos_contact,
        0.0,
        _APPROACH * math.cos(angle) / p.sin_contact,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    )
    roller_loads(motion, 1.0, 1.0, 1.0, p, 1.0, out)
    total = radial = 0.0
    count = int(p.n_rollers)
    for i in range(count):
        total += out[i]
        radial += out[i] * math.cos(2.0 * math.pi * i / count)
    return total, radial


@kernel
def ring_loads(axial_load: float, radial_load: float, p: BearingParameters, out: Array) -> int:
    """Write the load of every roller on the outer race into `out`, the most loaded first.

    sum Q sin(a) = F_a,  sum Q cos(a) cos(psi) = F_r,
    Q ~ max(0, d_a sin(a) + d_r cos(a) cos(psi))^(10/9)

    Parameters
    ----------
    axial_load, radial_load
        F_a, F_r of the row, not negative [N].
    p
        Bearing without film, preload and loss, as `BearingGeometry.dry_rollers` returns it.
    out : ndarray, shape (>= n_rollers,)
        Receives Q [N].

    Returns
    -------
    int
        0; 1 where F_r tan(a)/F_a is above LARGEST_RATIO or F_a is not above 0: `out` is all zero.

    Notes
    -----
    Rigid, coaxial rings; the rollers are those of `roller_loads`, which the axle uses too. A roller
    stands under the load. All rollers carry load until F_r tan(a)/F_a is about 0.5.
    """
    count = int(p.n_rollers)
    wanted = radial_load * p.sin_contact / p.cos_contact
    if axial_load <= 0.0 or wanted > LARGEST_RATIO * axial_load:
        for i in range(count):
            out[i] = 0.0
        return 1
    low = 0.0
    high = 0.75 * math.pi
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        total, radial = _shares(middle, p, out)
        if radial < wanted / axial_load * total:
            low = middle
        else:
            high = middle
    total, _ = _shares(low, p, out)
    scale = axial_load / (p.sin_contact * total)
    for i in range(count):
        out[i] *= scale
    return 0
