"""Intersection of a line with a flank, and the rotation that moves a flank to a point."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.placement import Placement, place_direction, place_point, turned
from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion, cut_state
from gearlube_core.hypoid_geometry.flank.vectors import Vector, cross, dot, subtract
from gearlube_core.kernels.jit import kernel

HIT = 1
MISSED = 0
_ITERATIONS = 40
_STEP_HEIGHT = 2e-3  # m
_STEP_ANGLE = 0.1  # rad
_STEP_LENGTH = 5e-3  # m
_TOLERANCE = 1e-11  # of the largest steps


@kernel
def _scaled_step(
    a: Vector, b: Vector, c: Vector, d: Vector, slope: Vector, residual: Vector, meshing: float
) -> tuple[float, float, float, float]:
    """Solve a x + b y + c z + d w = -residual, slope . (x, y, z) = -meshing.

    Eliminates the fourth unknown by projecting on two directions normal to d.
    """
    if abs(d.x) < 0.6 * (abs(d.y) + abs(d.z)):
        p = cross(d, Vector(1.0, 0.0, 0.0))
    else:
        p = cross(d, Vector(0.0, 1.0, 0.0))
    q = cross(d, p)
    row1 = Vector(dot(p, a), dot(p, b), dot(p, c))
    row2 = Vector(dot(q, a), dot(q, b), dot(q, c))
    c23 = cross(row2, slope)
    c31 = cross(slope, row1)
    c12 = cross(row1, row2)
    det = dot(row1, c23)
    f1, f2 = -dot(p, residual), -dot(q, residual)
    x = (f1 * c23.x + f2 * c31.x - meshing * c12.x) / det
    y = (f1 * c23.y + f2 * c31.y - meshing * c12.y) / det
    z = (f1 * c23.z + f2 * c31.z - meshing * c12.z) / det
    left = -dot(d, residual) - dot(d, a) * x - dot(d, b) * y - dot(d, c) * z
    return x, y, z, left / dot(d, d)


@kernel
def intersect_line(
    motion: CuttingMotion,
    placement: Placement,
    origin: Vector,
    direction: Vector,
    parameters: Array,
) -> int:
    """Find the intersection of the line `origin` [m] + s `direction` with a flank.

    Parameters
    ----------
    motion, placement : CuttingMotion, Placement
    origin, direction : Vector
    parameters : ndarray of shape (4,)
        u [m], th, ph [rad], s [m]: start on entry, solution on return.

    Returns
    -------
    int
        Outcome: `HIT` or `MISSED`.
    """
    for _ in range(_ITERATIONS):
        s = cut_state(motion, parameters[0], parameters[1], parameters[2])
        r = subtract(place_point(placement, s.r), origin)
        along = parameters[3]
        residual = Vector(
            r.x - along * direction.x, r.y - along * direction.y, r.z - along * direction.z
        )
        du, dth, dph, ds = _scaled_step(
            place_direction(placement, s.r_u),
            place_direction(placement, s.r_th),
            place_direction(placement, s.r_ph),
            Vector(-direction.x, -direction.y, -direction.z),
            Vector(s.meshing_u, s.meshing_th, s.meshing_ph),
            residual,
            s.meshing,
        )
        size = max(
            max(abs(du) / _STEP_HEIGHT, abs(ds) / _STEP_LENGTH),
            max(abs(dth), abs(dph)) / _STEP_ANGLE,
        )
        if not math.isfinite(size):
            return MISSED
        shorten = 1.0 / max(1.0, size)
        parameters[0] += shorten * du
        parameters[1] += shorten * dth
        parameters[2] += shorten * dph
        parameters[3] += shorten * ds
        if size < _TOLERANCE:
            return HIT
    return MISSED


@kernel
def copy_parameters(parameters: Array, copy: Array) -> None:
    """Write the numbers of one array into another.

    numba's assignment of arrays brings the text of an error into the code, which takes two
    seconds of compilation in each process.
    """
    for k in range(parameters.size):
        copy[k] = parameters[k]


@kernel
def intersect_rotation(
    motion: CuttingMotion, placement: Placement, target: Vector, parameters: Array
) -> int:
    """Find the rotation about its work axis with which a flank passes through `target` [m].

    `parameters`, shape (4,): u [m], th, ph, rotation [rad]; start on entry, solution on return.
    Returns HIT or MISSED.
    """
    for _ in range(_ITERATIONS):
        now = turned(placement, parameters[3])
        s = cut_state(motion, parameters[0], parameters[1], parameters[2])
        place = place_point(now, s.r)
        swing = place_direction(now, cross(placement.axis, subtract(s.r, placement.point)))
        du, dth, dph, dturn = _scaled_step(
            place_direction(now, s.r_u),
            place_direction(now, s.r_th),
            place_direction(now, s.r_ph),
            swing,
            Vector(s.meshing_u, s.meshing_th, s.meshing_ph),
            subtract(place, target),
            s.meshing,
        )
        size = max(abs(du) / _STEP_HEIGHT, max(abs(dth), max(abs(dph), abs(dturn))) / _STEP_ANGLE)
        if not math.isfinite(size):
            return MISSED
        shorten = 1.0 / max(1.0, size)
        parameters[0] += shorten * du
        parameters[1] += shorten * dth
        parameters[2] += shorten * dph
        parameters[3] += shorten * dturn
        if size < _TOLERANCE:
            return HIT
    return MISSED
