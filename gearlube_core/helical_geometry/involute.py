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
from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.pair import HelicalPair

MEMBERS = ("pinion", "gear")
_Array = Array
_NEWTON_STEPS = 2  # t is linear in the square of the roll but for fourth powers of the turn
_ROOT_STEPS = 4  # the quartic's fourth power is 1e-4 of its linear term: two would do


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


def check_facets(name: str, count: int) -> int:
    """Return a whole number of facets; raise ParameterError outside 0 (smooth) to 10000."""
    value = check_within(name, count, 0, 10_000, "", "Zero leaves the flank smooth.")
    if value != int(value):
        raise ParameterError(f"{name} must be a whole number, got {value:g}. Round it.")
    return int(value)


def facet_bounds(roll: ArrayLike, flank: InvoluteFlank, count: int) -> tuple[_Array, _Array]:
    """Return the roll lengths where the facet at `roll` begins and ends.

    arc = (s_max - s_min)/n_f,  k = floor((s - s_min)/arc),  s_B1 = s_min + k arc,
    s_B2 = s_B1 + arc

    Parameters
    ----------
    roll
        Of a point of the flank [m], any shape; facets go on past the active profile.
    flank
        Involute flank of the member.
    count
        n_f, facets over the active profile [-].

    Returns
    -------
    tuple of array
        [m]; not below the base circle.

    Notes
    -----
    Floor in place of the integer part. s and roll length differ by a constant and, for the gear,
    in sign; both divide the profile alike.
    Source: [jamali_2015 (6.1)] [jamali_2015 (6.6)] [jamali_2015 (6.7-a)] [jamali_2015 (6.7-b)]
    """
    arc = (flank.roll_high - flank.roll_low) / count
    k = np.floor((np.asarray(roll, dtype=float) - flank.roll_low) / arc)
    first = flank.roll_low + k * arc
    return np.maximum(first, 0.0), np.asarray(first + arc)


def facet_depth(
    roll: ArrayLike, t: ArrayLike, point: ArrayLike, flank: InvoluteFlank, count: int
) -> _Array:
    """Return how far the facet lies below the tangent at `roll`.

    z_F' = z_B1' + (z_B2' - z_B1')(x_P - x_B1)/(x_B2 - x_B1)

    Parameters
    ----------
    roll
        Where the tangent touches the involute [m].
    t
        Distance along the tangent, towards the tip [m].
    point
        Roll length of the involute's point at t, which chooses the facet [m]; shapes broadcast.
    flank
        Involute flank of the member.
    count
        n_f [-].

    Returns
    -------
    array
        In the transverse plane [m].

    Notes
    -----
    Source: [jamali_2015 sec. 6.1]; the facet's ends are points of the involute.
    """
    first, second = facet_bounds(point, flank, count)
    t1, g1 = relative_position(roll, first, flank.base_radius)
    t2, g2 = relative_position(roll, second, flank.base_radius)
    return _chord(t, t1, g1, t2, g2)


def facet_depth_parabola(
    roll: ArrayLike, t: ArrayLike, point: ArrayLike, flank: InvoluteFlank, count: int
) -> _Array:
    """Return the facet depth with the facet's ends on the involute's osculating parabola.

    Notes
    -----
    Source: [jamali_2015 (6.8)] [jamali_2015 (6.9)] [jamali_2015 (6.10)]
    The radii r_B1 and r_B2 appear as the roll lengths that belong to them.
    """
    roll = np.asarray(roll, dtype=float)
    first, second = facet_bounds(point, flank, count)
    t1 = parabola_distance(roll, first, flank.base_radius)
    t2 = parabola_distance(roll, second, flank.base_radius)
    return _chord(t, t1, 0.5 * t1**2 / roll, t2, 0.5 * t2**2 / roll)


def _chord(t: ArrayLike, t1: _Array, g1: _Array, t2: _Array, g2: _Array) -> _Array:
    return np.asarray(g1 + (g2 - g1) * (np.asarray(t, dtype=float) - t1) / (t2 - t1))


def parabola_distance(roll: ArrayLike, other: ArrayLike, base_radius: float) -> _Array:
    """Return where the osculating parabola at `roll` reaches the radius of roll length `other`.

    t^4/(4 R^2) + 2 r_b t + R^2 - other^2 = 0,  R = roll

    Parameters
    ----------
    roll, other
        [m], shapes that broadcast.
    base_radius
        [m]

    Returns
    -------
    array
        t, towards the tip [m].

    Notes
    -----
    Source: [jamali_2015 (6.11)] [jamali_2015 (6.12)] [jamali_2015 (7.8)]
    For either member: t = -x on the pinion, +x on the gear. On the involute itself it is
    `relative_position`.
    """
    roll, other = np.asarray(roll, dtype=float), np.asarray(other, dtype=float)
    t = linear = (other**2 - roll**2) / (2.0 * base_radius)
    for _ in range(_ROOT_STEPS):
        t = linear - t**4 / (8.0 * base_radius * roll**2)
    return np.asarray(t)
