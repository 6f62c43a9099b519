"""Rotation of the pinion to contact, at many points of the gear flank and many gear angles."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.flank_intersection import HIT, intersect_rotation
from gearlube_core.hypoid_contact.placement import Placement, place_point, turned
from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.kernels.jit import kernel


@kernel
def _try_from(
    pinion: CuttingMotion,
    base: Placement,
    target: Vector,
    start: Array,
    extra_turn: float,
    found: Array,
) -> bool:
    """Search from `start` (4,), its rotation moved by `extra_turn`; NaN in `found` on failure."""
    if math.isnan(start[0]):
        return False
    for i in range(4):
        found[i] = start[i]
    found[3] += extra_turn
    if intersect_rotation(pinion, base, target, found) == HIT:
        return True
    for i in range(4):
        found[i] = math.nan
    return False


@kernel
def find_contact_rotations(
    pinion: CuttingMotion,
    pinion_base: Placement,
    gear_base: Placement,
    points: Array,
    turns: Array,
    middle: int,
    ratio: float,
    start: Array,
    found: Array,
) -> None:
    """Find the rotation at which the pinion flank passes through each gear point.

    Goes from the middle angle and the middle of the grid outwards; each search starts from the
    same point at the angle before, else from a neighbour.

    Parameters
    ----------
    pinion : CuttingMotion
    pinion_base, gear_base : Placement
        Both at rotation zero.
    points : ndarray of shape (m, n, 3)
        Of the gear flank in its own frame [m]; NaN is skipped.
    turns : ndarray of shape (K,)
        Rotations of the gear [rad].
    middle : int
        Which of `turns` comes first.
    ratio : float
        Teeth ratio gear / pinion [-].
    start : ndarray of shape (4,)
        u [m], th, ph, rotation [rad] of the pinion near the middle of the grid.
    found : ndarray of shape (K, m, n, 4)
        The same for every point; NaN on entry, and where there is no flank on return.
    """
    m, n = points.shape[0], points.shape[1]
    count = turns.size
    for step in range(count):
        # middle, middle + 1, ..., last, middle - 1, ..., 0
        k = middle + step if middle + step < count else count - 1 - step
        before = k if k == middle else (k - 1 if k > middle else k + 1)
        placed = turned(gear_base, turns[k])
        # the drive direction is +z on the gear, opposite to the work axis on the pinion
        extra = -ratio * (turns[k] - turns[before])
        for p in range(m):
            i = m // 2 + p if m // 2 + p < m else m - 1 - p
            inner_i = i if i == m // 2 else (i - 1 if i > m // 2 else i + 1)
            for q in range(n):
                j = n // 2 + q if n // 2 + q < n else n - 1 - q
                inner_j = j if j == n // 2 else (j - 1 if j > n // 2 else j + 1)
                if math.isnan(points[i, j, 0]):
                    continue
                own = Vector(points[i, j, 0], points[i, j, 1], points[i, j, 2])
                target = place_point(placed, own)
                here = found[k, i, j]
                if before != k and _try_from(
                    pinion, pinion_base, target, found[before, i, j], extra, here
                ):
                    continue
                if inner_j != j and _try_from(
                    pinion, pinion_base, target, found[k, i, inner_j], 0.0, here
                ):
                    continue
                if inner_i != i and _try_from(
                    pinion, pinion_base, target, found[k, inner_i, j], 0.0, here
                ):
                    continue
                _try_from(pinion, pinion_base, target, start, extra if before != k else 0.0, here)


@kernel
def rotations_to_points(
    pinion: CuttingMotion,
    pinion_base: Placement,
    gear_base: Placement,
    points: Array,
    turns: Array,
    found: Array,
) -> None:
    """Find the rotation at which the pinion flank passes through each gear point, from near by.

    Parameters
    ----------
    points : ndarray of shape (N, 3)
        Of the gear flank in its own frame [m].
    turns : ndarray of shape (N,)
        Rotation of the gear at each point [rad].
    found : ndarray of shape (N, 4)
        u [m], th, ph, rotation [rad] of the pinion: near on entry, the solution on return, NaN
        where there is none.
    """
    for i in range(points.shape[0]):
        own = Vector(points[i, 0], points[i, 1], points[i, 2])
        target = place_point(turned(gear_base, turns[i]), own)
        if intersect_rotation(pinion, pinion_base, target, found[i]) != HIT:
            found[i, :] = math.nan
