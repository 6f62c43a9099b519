"""The pinion flank that is conjugate to a gear flank, and the gap of a real pinion to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.gap_map import along_normals, closing_arm
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import tooth_position


@dataclass(frozen=True, slots=True)
class ConjugateFlank:
    """Conjugate pinion flank at places of the gear flank, shape (n,), pinion at angle zero.

    Parameters
    ----------
    s, t : ndarray of shape (n,)
        Profile and face positions on the gear [-].
    gear_angle : ndarray of shape (n,)
        Gear angle [rad] at which the place is in contact.
    r, normal : ndarray of shape (n, 3)
        Points [m] and unit normals [-] from the gear to the pinion, fixed frame.
    arm : ndarray of shape (n,)
        Closing of the gap per pinion rotation [m].
    """

    s: Array
    t: Array
    gear_angle: Array
    r: Array
    normal: Array
    arm: Array


def conjugate_flank(pair: FlankPair, s: Array, t: Array) -> ConjugateFlank:
    """Return the conjugate pinion flank of a pair's gear flank; its own pinion plays no part.

    A place of the gear is in contact at the gear angle phi where both members move alike along
    the normal, n . (k x r) = (z_2/z_1) n . (j_p x (r - P)): A cos(phi) + B sin(phi) + C = 0. The
    root nearest to zero is that of the mesh. NaN where there is none.

    Parameters
    ----------
    pair : FlankPair
        Aligned.
    s, t : ndarray of shape (n,)

    References
    ----------
    [litvin_fuentes_2004 ch. 6] (equation of meshing).
    """
    own = pair.gear.sample(s, t)
    r, n = pair.gear_in_place(0.0, own.r, own.normal)
    axis, origin = pair.pinion_axis_placed
    drive = -axis  # positive rotation of the pinion, along -x
    ratio = pair.ratio
    zero = np.einsum("ni,ni->n", n, np.cross(pair.gear.axis, r))

    def speed(angle: float) -> Array:
        """Return the pinion's speed along the normals with the gear turned by `angle` [rad]."""
        turn = Rotation.from_rotvec(angle * pair.gear.axis)
        place = turn.apply(r) - origin
        return np.asarray(ratio * np.einsum("ni,ni->n", turn.apply(n), np.cross(drive, place)))

    # three values fix a function of the form A cos + B sin + C
    at = speed(0.0), speed(0.5 * np.pi), speed(np.pi)
    c = 0.5 * (at[0] + at[2])
    a, b = at[0] - c, at[1] - c
    size = np.hypot(a, b)
    with np.errstate(invalid="ignore"):
        half = np.arccos((zero - c) / size)
    middle = np.arctan2(b, a)
    roots = np.angle(np.exp(1j * np.stack([middle - half, middle + half])))
    first = np.abs(roots[0]) <= np.abs(roots[1])
    angle = np.where(first, roots[0], roots[1])
    forward = Rotation.from_rotvec(np.nan_to_num(angle)[:, None] * pair.gear.axis)
    back = Rotation.from_rotvec(-ratio * np.nan_to_num(angle)[:, None] * drive)
    point = back.apply(forward.apply(r) - origin) + origin
    normal = back.apply(forward.apply(n))
    return ConjugateFlank(s, t, angle, point, normal, closing_arm(pair, point, normal))


@dataclass(frozen=True)
class PinionGap:
    """Gap of pinions of any settings to a conjugate flank, along its normals.

    Parameters
    ----------
    conjugate : ConjugateFlank
    starts : ndarray of shape (n, 3)
        u [m], th, ph [rad] of a pinion near the conjugate flank.
    """

    conjugate: ConjugateFlank
    starts: Array

    @classmethod
    def from_pair(cls, pair: FlankPair, conjugate: ConjugateFlank) -> PinionGap:
        """Return the search that starts at the places of a pair's pinion flank."""
        base = pair.pinion_turn(0.0)
        turn = Rotation.from_rotvec(-base * pair.pinion.axis)
        own = turn.apply(conjugate.r - pair.pinion.axis_point) + pair.pinion.axis_point
        starts = pair.pinion.parameters(*tooth_position(pair.pinion, own))
        starts[np.isnan(starts[:, 0])] = pair.pinion.start
        return cls(conjugate, starts)

    def of(self, pair: FlankPair) -> Array:
        """Return the gap [m] of the pair's pinion at pinion angle zero, (n,); NaN where none."""
        still = pair.gear_base  # the conjugate flank stands in the fixed frame
        return along_normals(
            pair.pinion.motion,
            pair.pinion_placed(0.0),
            still,
            self.conjugate.r,
            self.conjugate.normal,
            self.starts,
        )[:, 3]
