"""The transverse involute of one member, in coordinates at one of its points.

A point of the flank is named by its roll length rho, its distance from the base circle along
the line of action and so its radius of curvature. Around the point at rho the profile is the
curve (t, g): t along its tangent towards the tip, g into the material.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.helical_geometry.pair import HelicalPair

MEMBERS = ("pinion", "gear")
_Array = Array
_NEWTON_STEPS = 2  # t is linear in the square of the roll but for fourth powers of the turn


class InvoluteFlank(NamedTuple):
    """Data of a member for the micro-geometry of its flank; all floats, SI."""

    base_radius: float  # r_b [m]
    tip_radius: float  # [m]
    roll_low: float  # roll length where contact begins: the mate's tip, or above undercut [m]
    roll_high: float  # and at the own tip [m]
    face_width: float  # [m]

    def radius(self, roll: ArrayLike) -> _Array:
        """Return the distance from the axis [m] of a point at a roll length [m], any shape."""
        return np.hypot(self.base_radius, np.asarray(roll, dtype=float))

    def roll(self, radius: ArrayLike) -> _Array:
        """Return the roll length [m] at a radius [m], any shape; NaN inside the base circle."""
        square = np.asarray(radius, dtype=float) ** 2 - self.base_radius**2
        return np.sqrt(np.where(square < 0.0, np.nan, square))


def involute_flank(pair: HelicalPair, member: str) -> InvoluteFlank:
    """Return the flank of the "pinion" or the "gear" of a pair."""
    check_option("member", member, MEMBERS)
    if member == "pinion":
        return InvoluteFlank(
            pair.pinion_base_radius, pair.pinion_tip_radius, pair.contact_start,
            pair.tip_end, pair.face_width,
        )  # fmt: skip
    return InvoluteFlank(
        pair.gear_base_radius, pair.gear_tip_radius, pair.tangent_length - pair.contact_end,
        pair.tangent_length - pair.tip_start, pair.face_width,
    )  # fmt: skip


def relative_position(
    roll: ArrayLike, other: ArrayLike, base_radius: float
) -> tuple[_Array, _Array]:
    """Return (t, g) of the profile's point at roll length `other`, seen from `roll`.

    t = r_b (cos(d) - 1) + other sin(d),  g = roll (1 - cos(d)) + r_b (sin(d) - d cos(d)),
    d = (other - roll)/r_b

    Parameters
    ----------
    roll, other
        [m], shapes that broadcast.
    base_radius
        [m]

    Returns
    -------
    tuple of array
        Towards the tip and into the material [m].
    """
    roll, other = np.asarray(roll, dtype=float), np.asarray(other, dtype=float)
    d = (other - roll) / base_radius
    sin_half = np.sin(0.5 * d)
    sin, versine = 2.0 * sin_half * np.cos(0.5 * d), 2.0 * sin_half**2
    t = other * sin - base_radius * versine
    return t, roll * versine + base_radius * (sin - d * (1.0 - versine))


def roll_at_tangent_distance(roll: ArrayLike, t: ArrayLike, base_radius: float) -> _Array:
    """Return the roll length of the profile's point at distance t, the inverse of the above.

    Parameters
    ----------
    roll
        Of the point looked from [m].
    t
        Along its tangent, towards the tip [m]; shapes broadcast.
    base_radius
        [m]

    Returns
    -------
    array
        [m]; NaN where the involute does not reach that far down.
    """
    roll, t = np.asarray(roll, dtype=float), np.asarray(t, dtype=float)
    square = roll**2 + 2.0 * base_radius * t
    other = np.sqrt(np.maximum(square, 0.0))
    for _ in range(_NEWTON_STEPS):
        reached, _depth = relative_position(roll, other, base_radius)
        square = other**2 - 2.0 * base_radius * (reached - t) / np.cos((other - roll) / base_radius)
        other = np.sqrt(np.maximum(square, 0.0))
    lowest, _depth = relative_position(roll, 0.0, base_radius)
    return np.where((roll > 0.0) & (t >= lowest), other, math.nan)
