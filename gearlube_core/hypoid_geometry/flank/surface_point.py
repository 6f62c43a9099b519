"""Point, normal and curvature of a cut flank, and the flank coordinates of a given point."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_geometry.flank.cutting_motion import (
    CutState,
    CuttingMotion,
    cut_state,
    unit_normal,
)
from gearlube_core.hypoid_geometry.flank.vectors import Vector, combine, cross, dot, norm, subtract
from gearlube_core.kernels.jit import kernel

_ITERATIONS = 60
_STEP_HEIGHT = 2e-3  # m, largest step of the blade height in one iteration
_STEP_ANGLE = 0.1  # rad
CONVERGED = 1
NOT_CONVERGED = 0


class SurfacePoint(NamedTuple):
    """Second-order description of a flank at a point.

    `tangent_1` follows the blade edge, `tangent_2` = normal x tangent_1; k_11, k_12, k_22 [1/m] are
    the shape operator in these axes: dn = -K dr, positive where the centre of curvature lies on
    the side of the normal. `regularity` changes sign where the surface folds (undercut).
    """

    r: Vector
    normal: Vector
    tangent_1: Vector
    tangent_2: Vector
    k_11: float
    k_12: float
    k_22: float
    regularity: float


@kernel
def _combine3(a: float, x: Vector, b: float, y: Vector, c: float, z: Vector) -> Vector:
    return Vector(
        a * x.x + b * y.x + c * z.x, a * x.y + b * y.y + c * z.y, a * x.z + b * y.z + c * z.z
    )


@kernel
def regularity(state: CutState) -> float:
    """Return a number of order one that changes sign where the envelope folds.

    With r_ph = alpha r_u + beta r_th on the envelope, the surface's area element is proportional
    to alpha f_u + beta f_th - f_ph; its sign on a sound flank depends on the motion. One for a
    form-cut flank.

    References
    ----------
    [litvin_fuentes_2004 ch. 6.3] (singular points, undercutting).
    """
    n2 = dot(state.normal, state.normal)
    alpha = dot(cross(state.r_ph, state.r_th), state.normal) / n2
    beta = dot(cross(state.r_u, state.r_ph), state.normal) / n2
    value = alpha * state.meshing_u + beta * state.meshing_th - state.meshing_ph
    return -value / abs(state.meshing_ph) if state.meshing_ph != 0.0 else -value


@kernel
def surface_point(
    motion: CuttingMotion, u: float, th: float, ph: float, outward: float
) -> SurfacePoint:
    """Return the second-order description at parameters that satisfy the equation of meshing.

    `outward` is +1 or -1: the sign that makes r_u x r_th point out of the tooth.
    """
    s = cut_state(motion, u, th, ph)
    n = unit_normal(s)
    length = norm(s.normal)
    # two directions of the parameters along which the equation of meshing keeps holding
    if abs(s.meshing_ph) * _STEP_HEIGHT > abs(s.meshing_u) * 1e-9 and (
        abs(s.meshing_ph) >= abs(s.meshing_u) * _STEP_HEIGHT
    ):
        x1 = combine(1.0, s.r_u, -s.meshing_u / s.meshing_ph, s.r_ph)
        x2 = combine(1.0, s.r_th, -s.meshing_th / s.meshing_ph, s.r_ph)
        d1 = combine(1.0, s.normal_u, -s.meshing_u / s.meshing_ph, s.normal_ph)
        d2 = combine(1.0, s.normal_th, -s.meshing_th / s.meshing_ph, s.normal_ph)
    else:
        x1 = combine(1.0, s.r_th, -s.meshing_th / s.meshing_u, s.r_u)
        x2 = combine(1.0, s.r_ph, -s.meshing_ph / s.meshing_u, s.r_u)
        d1 = combine(1.0, s.normal_th, -s.meshing_th / s.meshing_u, s.normal_u)
        d2 = combine(1.0, s.normal_ph, -s.meshing_ph / s.meshing_u, s.normal_u)
    sign = outward / length
    d1 = combine(sign, d1, -sign * dot(d1, n), n)
    d2 = combine(sign, d2, -sign * dot(d2, n), n)
    n = Vector(outward * n.x, outward * n.y, outward * n.z)

    scale = 1.0 / norm(s.r_u)
    t1 = Vector(scale * s.r_u.x, scale * s.r_u.y, scale * s.r_u.z)
    t2 = cross(n, t1)
    a, b, c, d = dot(x1, t1), dot(x2, t1), dot(x1, t2), dot(x2, t2)
    det = a * d - b * c
    # K [x1 x2] = -[d1 d2] in the axes t1, t2
    p1, p2, q1, q2 = dot(d1, t1), dot(d2, t1), dot(d1, t2), dot(d2, t2)
    k11 = -(p1 * d - p2 * c) / det
    k12 = -(-p1 * b + p2 * a) / det
    k21 = -(q1 * d - q2 * c) / det
    k22 = -(-q1 * b + q2 * a) / det
    return SurfacePoint(s.r, n, t1, t2, k11, 0.5 * (k12 + k21), k22, regularity(s))


@kernel
def locate(motion: CuttingMotion, radius: float, axial: float, parameters: Array) -> int:
    """Find the flank point at `radius` [m] from and `axial` [m] along the work axis.

    Parameters
    ----------
    motion : CuttingMotion
    radius, axial : float
        Axial from the work point, along the work axis [m].
    parameters : ndarray of shape (3,)
        u, th, ph; the start on entry, the solution on return.

    Returns
    -------
    int
        Outcome: `CONVERGED` or `NOT_CONVERGED`.
    """
    for _ in range(_ITERATIONS):
        s = cut_state(motion, parameters[0], parameters[1], parameters[2])
        w = subtract(s.r, motion.work_point)
        z = dot(w, motion.work_axis)
        radial = combine(1.0, w, -z, motion.work_axis)
        r = norm(radial)
        radial = Vector(radial.x / r, radial.y / r, radial.z / r)
        f1 = r - radius
        f2 = z - axial
        row1 = Vector(dot(s.r_u, radial), dot(s.r_th, radial), dot(s.r_ph, radial))
        row2 = Vector(
            dot(s.r_u, motion.work_axis),
            dot(s.r_th, motion.work_axis),
            dot(s.r_ph, motion.work_axis),
        )
        row3 = Vector(s.meshing_u, s.meshing_th, s.meshing_ph)
        c23 = cross(row2, row3)
        c31 = cross(row3, row1)
        c12 = cross(row1, row2)
        det = dot(row1, c23)
        if not abs(det) > 0.0:
            return NOT_CONVERGED
        step = _combine3(-f1 / det, c23, -f2 / det, c31, -s.meshing / det, c12)
        size = max(
            abs(step.x) / _STEP_HEIGHT, max(abs(step.y) / _STEP_ANGLE, abs(step.z) / _STEP_ANGLE)
        )
        if not math.isfinite(size):
            return NOT_CONVERGED
        shorten = 1.0 / max(1.0, size)
        parameters[0] += shorten * step.x
        parameters[1] += shorten * step.y
        parameters[2] += shorten * step.z
        if size < 1e-11:
            return CONVERGED
    return NOT_CONVERGED


@kernel
def march(motion: CuttingMotion, radius: Array, axial: Array, starts: Array) -> Array:
    """Locate places (N,) [m] from `starts` (N, 3); return u [m], th, ph [rad], (N, 3), or NaN."""
    found = starts.copy()
    for i in range(radius.size):
        if locate(motion, radius[i], axial[i], found[i]) != CONVERGED:
            found[i] = np.nan
    return found


@kernel
def sample_surface(motion: CuttingMotion, outward: float, parameters: Array) -> Array:
    """Return (N, 16): r, normal, tangent_1, tangent_2, k_11, k_12, k_22, regularity."""
    out = np.full((parameters.shape[0], 16), np.nan)
    for i in range(parameters.shape[0]):
        if np.isnan(parameters[i, 0]):
            continue
        p = surface_point(motion, parameters[i, 0], parameters[i, 1], parameters[i, 2], outward)
        row = out[i]
        row[0], row[1], row[2] = p.r
        row[3], row[4], row[5] = p.normal
        row[6], row[7], row[8] = p.tangent_1
        row[9], row[10], row[11] = p.tangent_2
        row[12], row[13], row[14], row[15] = p.k_11, p.k_12, p.k_22, p.regularity
    return out
