"""Pinion angles at which its flank passes through points of the gear flank, on a grid."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.flank_intersection import HIT, intersect_rotation
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Placement, place_point, tooth_position, turned
from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion
from gearlube_core.hypoid_geometry.flank.flank import FlankSample
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.kernels.jit import kernel

_SHORTEST = 1e-5  # m, arm of a normal that still turns the pinion


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


@dataclass(frozen=True, slots=True)
class ContactRotations:
    """Pinion angle at which its flank passes through each gear point, at each gear angle.

    Parameters
    ----------
    pinion_angle : ndarray of shape (K, m, n)
        [rad]; NaN where the pinion tooth has no such point.
    pinion_parameters : ndarray of shape (K, m, n, 3)
        u [m], th, ph [rad] of the pinion point.
    pinion_s, pinion_t : ndarray of shape (K, m, n)
        Profile and face position of the pinion point [-].
    pinion_regularity : ndarray of shape (K, m, n)
        Not positive beyond a fold of the pinion surface (undercut) [-].
    by_correction : ndarray of shape (K, m, n)
        Part of pinion_angle that closes what the corrections of both flanks took away [rad].
    """

    pinion_angle: Array
    pinion_parameters: Array
    pinion_s: Array
    pinion_t: Array
    pinion_regularity: Array
    by_correction: Array

    def on_tooth(self) -> ContactRotations:
        """Return the map with NaN beyond the edges of the pinion tooth and beyond folds."""
        places = np.stack([self.pinion_s, self.pinion_t])
        outside = ~((places >= 0.0) & (places <= 1.0)).all(axis=0)
        outside |= ~(self.pinion_regularity > 0.0)
        return ContactRotations(
            np.where(outside, np.nan, self.pinion_angle),
            np.where(outside[..., None], np.nan, self.pinion_parameters),
            np.where(outside, np.nan, self.pinion_s),
            np.where(outside, np.nan, self.pinion_t),
            np.where(outside, np.nan, self.pinion_regularity),
            np.where(outside, np.nan, self.by_correction),
        )


def contact_rotations(
    pair: FlankPair, gear_parameters: Array, gear_angles: Array, start: Array | None = None
) -> ContactRotations:
    """Return the pinion angles that bring its flank to gear points (m, n, 3) at angles (K,) [rad].

    The pinion surface goes on beyond the edges of its tooth. `start`, shape (4,), holds u [m], th,
    ph and rotation about the work axis [rad] of the pinion near the middle of the grid at the
    angle nearest zero; absent, the pinion's reference point.
    """
    points = pair.gear.sample_parameters(gear_parameters).r
    found = np.full((gear_angles.size, *points.shape[:2], 4), np.nan)
    middle = int(np.argmin(np.abs(gear_angles)))
    if start is None:
        turn = pair.pinion_turn(pair.ratio * gear_angles[middle])
        start = np.array([*pair.pinion.start, turn])
    find_contact_rotations(
        pair.pinion.motion,
        pair.pinion_base,
        pair.gear_base,
        points,
        pair.gear_turn(gear_angles),
        middle,
        pair.ratio,
        start,
        found,
    )
    own = pair.pinion.sample_parameters(found[..., :3])
    extra = _by_correction(pair, points, own)
    return ContactRotations(
        np.asarray(pair.pinion_angle(found[..., 3])) + extra,
        found[..., :3],
        *tooth_position(pair.pinion, own.r),
        own.regularity,
        extra,
    )


def _by_correction(pair: FlankPair, gear_points: Array, own: FlankSample) -> Array:
    """Return the pinion rotation that closes the removals of gear (m, n) and pinion (K, m, n).

    The rotation over the arm of the pinion's normal; infinite where that has none.
    """
    if not pair.is_corrected:
        return np.zeros(own.r.shape[:-1])
    removed = pair.gear.removal(gear_points) + pair.pinion.removal(own.r)
    swing = np.cross(pair.pinion.axis, own.r - pair.pinion.axis_point)
    arm = np.abs(np.einsum("...i,...i->...", own.normal, swing))
    turn = np.divide(removed, arm, out=np.full_like(removed, np.inf), where=arm > _SHORTEST)
    return np.asarray(pair.touching_sign * np.where(np.isnan(arm), np.nan, turn))
