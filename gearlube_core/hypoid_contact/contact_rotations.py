"""Pinion angles at which its flank passes through points of the gear flank, on a grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.contact_rotation_kernel import find_contact_rotations
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placed_flank import tooth_position
from gearlube_core.hypoid_geometry.flank.flank import FlankSample

_SHORTEST = 1e-5  # m, arm of a normal that still turns the pinion


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
