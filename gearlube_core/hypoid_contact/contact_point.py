"""Point of contact of two flanks: equal positions, opposite normals, both points on envelopes."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.placement import Placement, place_direction, place_point, turned
from gearlube_core.hypoid_geometry.flank.cutting_motion import CutState, CuttingMotion, cut_state
from gearlube_core.hypoid_geometry.flank.vectors import Vector, combine, cross, dot, norm, subtract
from gearlube_core.kernels.jit import kernel

TOUCHING = 1
APART = 0
UNKNOWNS = 7  # u, th, ph of the gear, u, th, ph of the pinion, rotation of the pinion
_ITERATIONS = 60
_STEP_HEIGHT = 1e-3  # m, largest step of a blade height in one iteration
_STEP_ANGLE = 0.1  # rad
UNKNOWN_STEPS = (
    _STEP_HEIGHT,
    _STEP_ANGLE,
    _STEP_ANGLE,
    _STEP_HEIGHT,
    _STEP_ANGLE,
    _STEP_ANGLE,
    _STEP_ANGLE,
)  # units of the unknowns in the linearised equations
_LENGTH = 1e-3  # m, brings positions to the size of the other equations
_TOLERANCE = 1e-10  # of the largest steps


@kernel
def solve_in_place(rows: Array, n: int) -> bool:
    """Solve n linear equations given as `rows` (n, n + 1), right side last, by elimination.

    The solution takes the place of the last column. Returns whether the matrix is regular.
    """
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(rows[i, k]) > abs(rows[pivot, k]):
                pivot = i
        if not abs(rows[pivot, k]) > 0.0:
            return False
        for j in range(k, n + 1):
            rows[k, j], rows[pivot, j] = rows[pivot, j], rows[k, j]
        for i in range(k + 1, n):
            factor = rows[i, k] / rows[k, k]
            for j in range(k, n + 1):
                rows[i, j] -= factor * rows[k, j]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            rows[k, n] -= rows[k, j] * rows[j, n]
        rows[k, n] /= rows[k, k]
    return True


@kernel
def _put_column(
    rows: Array, j: int, scale: float, change: Vector, turn_1: float, turn_2: float
) -> None:
    """Write the derivatives of the gap (3 equations) and normals (2 equations) by an unknown."""
    rows[0, j] = change.x * scale / _LENGTH
    rows[1, j] = change.y * scale / _LENGTH
    rows[2, j] = change.z * scale / _LENGTH
    rows[3, j] = turn_1 * scale
    rows[4, j] = turn_2 * scale


@kernel
def _put_meshing(rows: Array, i: int, first: int, state: CutState) -> None:
    """Write a member's equation of meshing, its unknowns starting at column `first`."""
    size = max(
        abs(state.meshing_u) * _STEP_HEIGHT,
        max(abs(state.meshing_th), abs(state.meshing_ph)) * _STEP_ANGLE,
    )
    for j in range(UNKNOWNS):
        rows[i, j] = 0.0
    rows[i, first] = state.meshing_u * _STEP_HEIGHT / size
    rows[i, first + 1] = state.meshing_th * _STEP_ANGLE / size
    rows[i, first + 2] = state.meshing_ph * _STEP_ANGLE / size
    rows[i, UNKNOWNS] = -state.meshing / size


@kernel
def _put_equations(
    gear: CutState, pinion: CutState, gear_placed: Placement, pinion_placed: Placement, rows: Array
) -> float:
    """Write the seven equations linearised about a state; return the cosine of the normals."""
    n_g = place_direction(gear_placed, gear.normal)
    n_p = place_direction(pinion_placed, pinion.normal)
    a = 1.0 / norm(n_g)
    b = 1.0 / norm(n_p)
    n_g = Vector(a * n_g.x, a * n_g.y, a * n_g.z)
    n_p = Vector(b * n_p.x, b * n_p.y, b * n_p.z)
    cosine = dot(n_g, n_p)
    sign = 1.0 if cosine > 0.0 else -1.0
    t1 = place_direction(gear_placed, gear.r_u)
    c = 1.0 / norm(t1)
    t1 = Vector(c * t1.x, c * t1.y, c * t1.z)
    t2 = cross(n_g, t1)
    gap = subtract(place_point(pinion_placed, pinion.r), place_point(gear_placed, gear.r))
    rows[0, UNKNOWNS] = -gap.x / _LENGTH
    rows[1, UNKNOWNS] = -gap.y / _LENGTH
    rows[2, UNKNOWNS] = -gap.z / _LENGTH
    rows[3, UNKNOWNS] = -dot(n_p, t1)
    rows[4, UNKNOWNS] = -dot(n_p, t2)

    # the gear's tangents turn with its normal: n_p . dt = -sign t . dn_g where normals are parallel
    for j in range(3):
        if j == 0:
            r, n, scale = gear.r_u, gear.normal_u, _STEP_HEIGHT
        elif j == 1:
            r, n, scale = gear.r_th, gear.normal_th, _STEP_ANGLE
        else:
            r, n, scale = gear.r_ph, gear.normal_ph, _STEP_ANGLE
        r = place_direction(gear_placed, r)
        n = place_direction(gear_placed, n)
        _put_column(rows, j, -scale, r, sign * a * dot(n, t1), sign * a * dot(n, t2))
    for j in range(3):
        if j == 0:
            r, n, scale = pinion.r_u, pinion.normal_u, _STEP_HEIGHT
        elif j == 1:
            r, n, scale = pinion.r_th, pinion.normal_th, _STEP_ANGLE
        else:
            r, n, scale = pinion.r_ph, pinion.normal_ph, _STEP_ANGLE
        r = place_direction(pinion_placed, r)
        n = place_direction(pinion_placed, n)
        n = combine(b, n, -b * dot(n, n_p), n_p)
        _put_column(rows, 3 + j, scale, r, dot(n, t1), dot(n, t2))
    axis = place_direction(pinion_placed, pinion_placed.axis)
    swing = place_direction(
        pinion_placed, cross(pinion_placed.axis, subtract(pinion.r, pinion_placed.point))
    )
    n = cross(axis, n_p)
    _put_column(rows, 6, _STEP_ANGLE, swing, dot(n, t1), dot(n, t2))
    _put_meshing(rows, 5, 0, gear)
    _put_meshing(rows, 6, 3, pinion)
    return cosine


@kernel
def find_contact(
    gear: CuttingMotion,
    pinion: CuttingMotion,
    gear_placed: Placement,
    pinion_base: Placement,
    facing: float,
    x: Array,
    rows: Array,
) -> int:
    """Find the rotation of the pinion and the point in which it touches the fixed gear.

    r_p = r_g,  n_p x n_g = 0,  f_p = 0,  f_g = 0

    Newton's method with the analytic Jacobian; f is each member's equation of meshing.

    Parameters
    ----------
    gear, pinion : CuttingMotion
    gear_placed, pinion_base : Placement
        Of the gear as it stands, of the pinion at rotation zero.
    facing : float
        Sign of (r_u x r_th)_g . (r_u x r_th)_p where both outward normals oppose.
    x : ndarray of shape (7,)
        u [m], th, ph [rad] of the gear, the same of the pinion, rotation of the pinion about its
        work axis [rad]; start on entry, solution on return.
    rows : ndarray of shape (7, 8)
        Scratch memory, its values are lost.

    Returns
    -------
    int
        Outcome: `TOUCHING` or `APART`.

    References
    ----------
    [litvin_fuentes_2004 ch. 9.4] (equations of tangency).
    """
    for _ in range(_ITERATIONS):
        cosine = _put_equations(
            cut_state(gear, x[0], x[1], x[2]),
            cut_state(pinion, x[3], x[4], x[5]),
            gear_placed,
            turned(pinion_base, x[6]),
            rows,
        )
        if not solve_in_place(rows, UNKNOWNS):
            return APART
        size = 0.0
        for i in range(UNKNOWNS):
            size = max(size, abs(rows[i, UNKNOWNS]))
        if not math.isfinite(size):
            return APART
        shorten = 1.0 / max(1.0, size)
        for i in range(UNKNOWNS):
            step = _STEP_HEIGHT if i == 0 or i == 3 else _STEP_ANGLE
            x[i] += shorten * step * rows[i, UNKNOWNS]
        if size < _TOLERANCE:
            return TOUCHING if cosine * facing > 0.0 else APART
    return APART


@kernel
def trace_contact(
    gear: CuttingMotion,
    pinion: CuttingMotion,
    gear_base: Placement,
    pinion_base: Placement,
    facing: float,
    turns: Array,
    longest_step: float,
    start_turn: float,
    start: Array,
    found: Array,
    rows: Array,
) -> None:
    """Follow the contact from a known one through the rotations `turns` of the gear, in order.

    Parameters
    ----------
    turns : ndarray of shape (N,)
        Rotation of the gear about its work axis [rad], moving away from `start_turn`.
    longest_step : float
        Of the gear's rotation [rad]; longer ways are cut into equal steps.
    start : ndarray of shape (7,)
        Contact at `start_turn`; overwritten.
    found : ndarray of shape (N, 7)
        Contacts on return; rows after the first failure stay as they are.
    rows : ndarray of shape (7, 8)
        Scratch memory, its values are lost.
    """
    x = start
    here = start_turn
    for k in range(turns.size):
        steps = max(1, math.ceil(abs(turns[k] - here) / longest_step))
        for i in range(steps):
            turn = here + (turns[k] - here) * (i + 1) / steps
            placed = turned(gear_base, turn)
            if find_contact(gear, pinion, placed, pinion_base, facing, x, rows) != TOUCHING:
                return
        here = turns[k]
        for i in range(UNKNOWNS):
            found[k, i] = x[i]


@kernel
def linearise_contacts(
    gear: CuttingMotion,
    pinion: CuttingMotion,
    gear_base: Placement,
    pinion_base: Placement,
    turns: Array,
    x: Array,
    rows: Array,
) -> None:
    """Write the equations of tangency, linearised about states that need not be contacts.

    Parameters
    ----------
    turns : ndarray of shape (N,)
        Rotation of the gear about its work axis [rad].
    x : ndarray of shape (N, 7)
        As in `find_contact`.
    rows : ndarray of shape (N, 7, 8)
        On return the derivatives by the unknowns in units of `UNKNOWN_STEPS`, in the last column
        the residuals with opposite sign. Each equation has a factor of its own.
    """
    for k in range(turns.size):
        _put_equations(
            cut_state(gear, x[k, 0], x[k, 1], x[k, 2]),
            cut_state(pinion, x[k, 3], x[k, 4], x[k, 5]),
            turned(gear_base, turns[k]),
            turned(pinion_base, x[k, 6]),
            rows[k],
        )
