"""Closest points of a tooth pair, on the line of action and at tip edges beyond its ends.

A point Q of the transverse plane stands at (x, r_bp + y): y off the line of action. Both involutes
touch at (x, r_bp) or would, were the teeth longer.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.helical_geometry.pair import HelicalPair


def roll_beside(x: ArrayLike, y: ArrayLike, base_radius: float) -> Array:
    """Return the roll length of points Q [m], NaN inside the base circle.

    rho = sqrt(x^2 + y (2 r_b + y))

    Parameters
    ----------
    x
        From the member's own tangent point [m].
    y
        Off the line of action, away from the member's axis [m]; shapes broadcast.
    base_radius
        [m]
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    square = x * x + y * (2.0 * base_radius + y)
    return np.sqrt(np.where(square < 0.0, np.nan, square))


def edge(x: ArrayLike, base_radius: float, end: float) -> Array:
    """Return y of a point of a member's involute, such as its tip, while it touches at x [m].

    y_e = -r_b (1 - cos(phi)) - x_a sin(phi),  phi = (x - x_a)/r_b

    Zero where it lies on the line of action, x = x_a, its roll length `end` [m], and negative
    beyond; x as in `roll_beside`.
    """
    turned = (np.asarray(x, dtype=float) - end) / base_radius
    return np.asarray(-2.0 * base_radius * np.sin(0.5 * turned) ** 2 - end * np.sin(turned))


def involute_bounds(x: ArrayLike, pair: HelicalPair) -> tuple[Array, Array, Array, Array]:
    """Return y of the pinion's tip, the gear's tip, and the starts of both involutes [m].

    A tooth lies below the first and above the second; a start counts where the member is undercut,
    above the third for the pinion and below the last for the gear; infinite where it is not.
    """
    x = np.asarray(x, dtype=float)
    mate = pair.tangent_length - x
    r_p, r_g = pair.pinion_base_radius, pair.gear_base_radius
    pinion, gear = pair.involute_starts
    none = np.full(x.shape, np.inf)
    return (
        edge(x, r_p, pair.tip_end),
        -edge(mate, r_g, pair.tangent_length - pair.tip_start),
        edge(x, r_p, pinion.roll) if pinion.undercut else -none,
        -edge(mate, r_g, gear.roll) if gear.undercut else none,
    )


class Engagement(NamedTuple):
    """Position where the flanks meet across the line of action at x; arrays of one shape [m]."""

    y: Array  # nearest points of the two tooth bodies: 0, or on an edge beyond A or D
    pinion_arm: Array  # of the transverse force about the pinion's axis
    gear_arm: Array


def engagement(x: ArrayLike, pair: HelicalPair) -> Engagement:
    """Return where along y the flanks at x of the (extended) line of action are closest.

    Beyond D the pinion's tip edge meets the gear's flank, whose normal is a base tangent of the
    gear: the gear's arm is its base radius, the pinion's is that of this tangent. Before A the
    members change places. The edge where an undercut begins is one like that of a tip.
    """
    x = np.asarray(x, dtype=float)
    r_p, r_g = pair.pinion_base_radius, pair.gear_base_radius
    tip, mate_tip, start, mate_start = involute_bounds(x, pair)
    over, under = np.minimum(tip, mate_start), np.maximum(mate_tip, start)
    y = np.where(over < 0.0, over, np.where(under > 0.0, under, 0.0))
    y = np.where(over < under, np.nan, y)  # rotated out of mesh altogether
    on_edge = np.abs(y) > 0.0
    pinion_edge = on_edge & np.where(y < 0.0, tip <= mate_start, start > mate_tip)
    gear_edge = on_edge & ~pinion_edge
    pinion_arm = np.where(pinion_edge, _arm(x, y, pair.tangent_length - x, -y, r_p, r_g), r_p)
    gear_arm = np.where(gear_edge, _arm(pair.tangent_length - x, -y, x, y, r_g, r_p), r_g)
    return Engagement(y, pinion_arm, gear_arm)


def _arm(x: Array, y: Array, x_mate: Array, y_mate: Array, r: float, r_mate: float) -> Array:
    """Return the arm about a member of its mate's base tangent through Q."""
    turned = np.arctan2(roll_beside(x_mate, y_mate, r_mate), r_mate)
    turned = turned - np.arctan2(x_mate, r_mate + y_mate)
    return np.asarray((r + y) * np.cos(turned) - x * np.sin(turned))
