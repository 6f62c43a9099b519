"""Where on the gear flank a pinion that turns into mesh touches first, on a grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placed_flank import tooth_position
from gearlube_core.hypoid_contact.turning_map import map_turning

_GRID = (9, 13)  # profile and face positions


@dataclass(frozen=True, slots=True)
class TurningMap:
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
    """

    pinion_angle: Array
    pinion_parameters: Array
    pinion_s: Array
    pinion_t: Array
    pinion_regularity: Array

    def on_tooth(self) -> TurningMap:
        """Return the map with NaN beyond the edges of the pinion tooth and beyond folds."""
        places = np.stack([self.pinion_s, self.pinion_t])
        outside = ~((places >= 0.0) & (places <= 1.0)).all(axis=0)
        outside |= ~(self.pinion_regularity > 0.0)
        return TurningMap(
            np.where(outside, np.nan, self.pinion_angle),
            np.where(outside[..., None], np.nan, self.pinion_parameters),
            np.where(outside, np.nan, self.pinion_s),
            np.where(outside, np.nan, self.pinion_t),
            np.where(outside, np.nan, self.pinion_regularity),
        )


@dataclass(frozen=True, slots=True)
class FirstTouch:
    """The grid point that touches first, with all that starts an exact search."""

    gear_angle: float  # rad
    gear_s: float
    gear_t: float
    gear_parameters: Array
    pinion_parameters: Array
    pinion_turn: float  # rad, about the work axis


def turning_map(
    pair: FlankPair, gear_parameters: Array, gear_angles: Array, start: Array | None = None
) -> TurningMap:
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
    map_turning(
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
    return TurningMap(
        np.asarray(pair.pinion_angle(found[..., 3])),
        found[..., :3],
        *tooth_position(pair.pinion, own.r),
        own.regularity,
    )


def first_touch(pair: FlankPair, gear_angle: float) -> FirstTouch | None:
    """Return which point of a coarse grid on the gear flank touches first; None if none does."""
    s, t = np.meshgrid(*(np.linspace(0.0, 1.0, k) for k in _GRID), indexing="ij")
    gear = pair.gear.parameters(s, t)
    reach = turning_map(pair, gear, np.array([gear_angle])).on_tooth()
    order = pair.touching_sign * reach.pinion_angle[0]
    if np.isnan(order).all():
        return None
    i, j = np.unravel_index(np.nanargmin(order), order.shape)
    return FirstTouch(
        gear_angle,
        float(s[i, j]),
        float(t[i, j]),
        gear[i, j],
        reach.pinion_parameters[0, i, j],
        pair.pinion_turn(float(reach.pinion_angle[0, i, j])),
    )
