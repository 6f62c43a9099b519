"""Map of the gap between two flanks over a whole tooth, to find possible contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.flank_intersection import HIT, copy_parameters, intersect_line
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import (
    Placement,
    place_direction,
    place_point,
    tooth_position,
)
from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.kernels.jit import kernel

_PROFILE = np.linspace(0.02, 1.0, 25)
_FACE = np.linspace(0.0, 1.0, 49)


@kernel
def along_normals(
    motion: CuttingMotion,
    placement: Placement,
    gear_placement: Placement,
    r: Array,
    normal: Array,
    starts: Array,
) -> Array:
    """Return where lines along the normals of gear points meet a pinion flank, (n, 4).

    Parameters
    ----------
    motion, placement : CuttingMotion, Placement
        Of the pinion flank.
    gear_placement : Placement
        Of the gear points.
    r, normal : ndarray of shape (n, 3)
        Gear points [m] and unit normals out of the tooth, in the gear's frame; NaN is skipped.
    starts : ndarray of shape (n, 3)
        u [m], th, ph [rad] of the pinion from which each search starts.

    Returns
    -------
    ndarray of shape (n, 4)
        u [m], th, ph [rad] of the pinion point, and the gap [m]; NaN where the line meets none.
    """
    found = np.full((r.shape[0], 4), np.nan)
    for i in range(r.shape[0]):
        if np.isnan(r[i, 0]):
            continue
        origin = place_point(gear_placement, Vector(r[i, 0], r[i, 1], r[i, 2]))
        direction = place_direction(
            gear_placement, Vector(normal[i, 0], normal[i, 1], normal[i, 2])
        )
        x = np.array([starts[i, 0], starts[i, 1], starts[i, 2], 0.0])
        if intersect_line(motion, placement, origin, direction, x) == HIT:
            copy_parameters(x, found[i])
    return found


@dataclass(frozen=True, slots=True)
class GapMap:
    """Gap along the gear's normals on a grid of the gear flank.

    Parameters
    ----------
    gap : ndarray of shape (m, n)
        Gap [m] to the pinion, inf where the pinion has no flank there or turning does not close
        the gap, as two pitches away on some pairs. Negative: overlap.
    point, normal : ndarray of shape (m, n, 3)
        Gear points [m] and outward normals in the fixed frame.
    gear_parameters, pinion_parameters : ndarray of shape (m, n, 3)
        u [m], th, ph [rad] of the gear point and the pinion point before it.
    arm : ndarray of shape (m, n)
        Closing of the gap per pinion rotation towards the gear [m].
    """

    gap: Array
    point: Array
    normal: Array
    gear_parameters: Array
    pinion_parameters: Array
    arm: Array

    @property
    def touching_rotation(self) -> Array:
        """Pinion rotation [rad] towards the gear that closes each gap, (m, n); inf where none.

        Where the arm is zero or less, turning does not close the gap.
        """
        none = np.full_like(self.gap, np.inf)
        return np.divide(self.gap, self.arm, out=none, where=self.arm > 0.0)


def within_tooth(flank: Flank, r: Array) -> NDArray[np.bool_]:
    """Return whether points (..., 3) [m] of a flank's surface lie within the edges of the tooth.

    Points in the frame of the member, rotation zero.
    """
    s, t = tooth_position(flank, r)
    with np.errstate(invalid="ignore"):
        return (s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0)


def closing_arm(pair: FlankPair, point: Array, normal: Array) -> Array:
    """Return the closing of the gap per pinion rotation [m] at points (..., 3) of the gear flank.

    `normal` points from the gear to the pinion, both in the fixed frame.
    """
    axis, origin = pair.pinion_axis_placed
    swing = np.cross(pair.touching_sign * -axis, point - origin)
    return -np.einsum("...i,...i->...", normal, swing)


def gear_arm(pair: FlankPair, point: Array, normal: Array) -> Array:
    """Return the arm of the normal force about the gear axis [m], positive where it is driven."""
    swing = np.cross(pair.touching_sign * pair.gear.axis, point)
    return -np.einsum("...i,...i->...", normal, swing)


def gap_map(pair: FlankPair, gear_angle: float, pinion_angle: float) -> GapMap:
    """Return the gap of a pair at gear and pinion angles [rad] over the gear's flank."""
    gear, pinion = pair.gear, pair.pinion
    s, t = np.meshgrid(_PROFILE, _FACE, indexing="ij")
    parameters = gear.parameters(s, t)
    surface = gear.sample_parameters(parameters)
    starts = pinion.parameters(1.05 - 0.9 * s, t)
    starts[np.isnan(starts[..., 0])] = pinion.start
    placed = pair.gear_placed(gear_angle)
    found = along_normals(
        pinion.motion,
        pair.pinion_placed(pinion_angle),
        placed,
        surface.r.reshape(-1, 3).copy(),  # whole arrays: for parts it would be compiled once more
        surface.normal.reshape(-1, 3).copy(),
        starts.reshape(-1, 3),
    ).reshape(*s.shape, 4)
    opposite = pinion.sample_parameters(found[..., :3])
    on_tooth = within_tooth(pinion, opposite.r) & (opposite.regularity > 0.0)
    point, normal = pair.gear_in_place(gear_angle, surface.r, surface.normal)
    arm = closing_arm(pair, point, normal)
    removed = gear.removal(surface.r) + pinion.removal(opposite.r)
    gap = np.where(on_tooth & (arm > 0.0), found[..., 3] + removed, np.inf)
    return GapMap(gap, point, normal, parameters, found[..., :3], arm)
