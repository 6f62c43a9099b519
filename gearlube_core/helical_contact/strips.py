"""Cells along the contact line of one tooth pair, on both sides of it and beyond its ends.

A strip lies in the tangent plane of the flanks: its second axis runs along the contact line, its
first off the line of action. Beyond the plane of contact its rows follow the tip edge that is
nearest to the mate there, so that corner contact is met by cells like any other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap


class Engagement(NamedTuple):
    """Position where the flanks meet across the line of action at x; arrays of one shape [m]."""

    y: Array  # nearest points of the two tooth bodies: 0, or on an edge beyond A or D
    pinion_arm: Array  # of the transverse force about the pinion's axis
    gear_arm: Array


_SAMPLES = 801  # points across the face at which a line's gap is looked at
_ON_EDGE = 1e-3  # cells: a centre on the tip edge counts as inside
_FARTHEST = 0.5  # base pitches beyond A or D that are looked at
_SHORTEST = 1e-5  # of the face width: shorter strips are left out


@dataclass(frozen=True, slots=True, kw_only=True)
class StripSettings:
    """Resolution of a strip.

    Parameters
    ----------
    cells_across : int
        Off the line of action; odd, so that one row of centres lies on the line or tip edge.
    cells_along : int
        Along the contact line.
    """

    cells_across: int = 31
    cells_along: int = 48

    def __post_init__(self) -> None:
        check_within("cells_across", self.cells_across, 7, 255)
        check_within("cells_along", self.cells_along, 6, 512)
        if self.cells_across % 2 == 0:
            raise ParameterError(
                f"cells_across must be odd, got {self.cells_across}. Take {self.cells_across + 1}."
            )


@dataclass(frozen=True, slots=True)
class LineGap:
    """Closest approach of two flanks along one contact line, without load.

    Parameters
    ----------
    X : float
        Position of the line on the face z = +W/2 [m].
    z : ndarray of shape (n,)
        Over the face [m].
    gap : ndarray of shape (n,)
        Normal gap [m] where the flanks come closest; inf beyond mesh.
    arm : ndarray of shape (n,)
        Closing per pinion rotation [m].
    """

    X: float
    z: Array
    gap: Array
    arm: Array

    @property
    def touching_rotation(self) -> float:
        """Pinion rotation to first touch [rad], inf if the line is out of reach."""
        return float(np.min(self.gap / self.arm))

    def extent(self, rotation: float) -> tuple[float, float] | None:
        """Return the z between which `rotation` closes the gap [m], or None."""
        over = self.gap - rotation * self.arm
        inside = np.flatnonzero(over <= 0.0)
        if not inside.size:
            return None
        return self._crossing(over, inside[0], -1), self._crossing(over, inside[-1], 1)

    def _crossing(self, over: Array, inner: int, step: int) -> float:
        outer = inner + step
        if outer < 0 or outer >= self.z.size or not math.isfinite(over[outer]):
            return float(self.z[inner])
        share = over[inner] / (over[inner] - over[outer])
        return float(self.z[inner] + share * (self.z[outer] - self.z[inner]))


def line_gap(modified: ModifiedPair, X: float) -> LineGap:
    """Return the gap along the line X, on and beyond the plane of contact."""
    pair = modified.pair
    z = np.linspace(-0.5, 0.5, _SAMPLES) * pair.face_width
    x = _along_action(modified, X, z)
    met = engagement(x, pair)
    gap = normal_gap(modified, X, met.y, z)
    far = _FARTHEST * pair.base_pitch
    beyond = (x < pair.contact_start - far) | (x > pair.contact_end + far) | ~np.isfinite(gap)
    arm = np.where(beyond, 1.0, met.pinion_arm) * math.cos(pair.base_helix_angle)
    return LineGap(X, z, np.where(beyond, np.inf, gap), arm)


@dataclass(frozen=True, slots=True)
class LineStrip:
    """Cells of one tooth pair.

    Parameters
    ----------
    line : int
        Number of the contact line, as in `contact_line.line_position`; -1 comes next.
    X : float
        Position of the line [m].
    cell : tuple of float
        Sides of a cell off the line of action and along the line [m].
    x, z : ndarray of shape (ny,)
        Line of action and axial position of the rows [m].
    y : ndarray of shape (nx, ny)
        Off the line of action [m].
    gap : ndarray of shape (nx, ny)
        Normal, without load [m]; inf where a tooth is missing.
    arm, gear_arm : ndarray of shape (ny,)
        Of the normal forces about the axes [m].
    pinion_roll, gear_roll : ndarray of shape (nx, ny)
        Roll lengths [m].
    """

    line: int
    X: float
    cell: tuple[float, float]
    x: Array
    z: Array
    y: Array
    gap: Array
    arm: Array
    gear_arm: Array
    pinion_roll: Array
    gear_roll: Array

    def sliding_arm(self, pair: HelicalPair) -> Array:
        """Return the sliding speed per pinion speed on the line of action [m], (ny,)."""
        return np.asarray(np.abs(self.x - pair.pitch_point) * (1.0 + 1.0 / pair.ratio))

    @property
    def usable(self) -> NDArray[np.bool_]:
        """Cells with both teeth, (nx, ny)."""
        return np.isfinite(self.gap)


def cut_strip(
    modified: ModifiedPair,
    line: int,
    X: float,
    extent: tuple[float, float],
    half_width: float,
    settings: StripSettings,
) -> LineStrip | None:
    """Return the strip of a line between two z, or None where it would be a point.

    Parameters
    ----------
    modified
        Gears and their modifications.
    line, X
        Number and position of the line.
    extent
        Lowest and highest z [m]; for spur gears too.
    half_width
        Off the line of action [m].
    settings
        Numbers of cells of a strip.
    """
    pair = modified.pair
    low, high = extent
    if high - low < _SHORTEST * pair.face_width:
        return None
    edges = np.linspace(low, high, settings.cells_along + 1)
    z = 0.5 * (edges[1:] + edges[:-1])
    x = _along_action(modified, X, z)
    met = engagement(x, pair)
    across = 2.0 * half_width / settings.cells_across
    offset = (np.arange(settings.cells_across) - settings.cells_across // 2) * across
    y = met.y + offset[:, None]
    r_p, r_g = pair.pinion_base_radius, pair.gear_base_radius
    tip, mate_tip, start, mate_start = _involute_bounds(x, pair)
    on = _ON_EDGE * across
    outside = (y > np.minimum(tip, mate_start) + on) | (y < np.maximum(mate_tip, start) - on)
    gap = normal_gap(modified, X, y, z)
    cos_b = math.cos(pair.base_helix_angle)
    return LineStrip(
        line=line,
        X=X,
        cell=(across, (high - low) / settings.cells_along / cos_b),
        x=x,
        z=z,
        y=y,
        gap=np.where(outside | ~np.isfinite(gap), np.inf, gap),
        arm=met.pinion_arm * cos_b,
        gear_arm=met.gear_arm * cos_b,
        pinion_roll=roll_beside(x, y, r_p),
        gear_roll=roll_beside(pair.tangent_length - x, -y, r_g),
    )


def _along_action(modified: ModifiedPair, X: float, z: ArrayLike) -> Array:
    pair = modified.pair
    lag = 0.5 * pair.face_width - np.asarray(z, dtype=float)
    return np.asarray(X - lag * math.tan(pair.base_helix_angle))


def normal_gap(modified: ModifiedPair, X: float, y: Array, z: Array) -> Array:
    """Return the gap normal to the flanks [m] at y off the line X and axial position z [m]."""
    along = z / math.cos(modified.pair.base_helix_angle)
    return UndeformedGap(modified=modified).heights(-y, along, X)


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


def _involute_bounds(x: ArrayLike, pair: HelicalPair) -> tuple[Array, Array, Array, Array]:
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


def engagement(x: ArrayLike, pair: HelicalPair) -> Engagement:
    """Return where along y the flanks at x of the (extended) line of action are closest.

    Beyond D the pinion's tip edge meets the gear's flank, whose normal is a base tangent of the
    gear: the gear's arm is its base radius, the pinion's is that of this tangent. Before A the
    members change places. The edge where an undercut begins is one like that of a tip.
    """
    x = np.asarray(x, dtype=float)
    r_p, r_g = pair.pinion_base_radius, pair.gear_base_radius
    tip, mate_tip, start, mate_start = _involute_bounds(x, pair)
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
