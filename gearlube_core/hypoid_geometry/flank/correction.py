"""Corrections of a flank: material removed along its normal, from the edges inwards or over all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, get_args

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within

Edge = Literal["tip", "root", "toe", "heel"]
EDGES: tuple[Edge, ...] = get_args(Edge)
_METRES = "Give metres, not micrometres or millimetres."
_MOST = 1e-3  # m
_LONGEST = 0.5  # m


class Bends(NamedTuple):
    """A correction and its derivatives by height h and face position l at points of one shape.

    Values [m], first derivatives [-], second derivatives [1/m].
    """

    value: Array
    by_h: Array
    by_l: Array
    by_hh: Array
    by_hl: Array
    by_ll: Array


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeRelief:
    """Removal that grows as a parabola towards one edge of the flank.

    m = amount (1 - d/extent)^2 for d < extent, d being the distance from the edge; zero beyond.

    Parameters
    ----------
    edge : {"tip", "root", "toe", "heel"}
        Distances from tip and root are tooth heights, those from toe and heel lie along the pitch
        cone.
    amount : float
        At the edge [m]; 0 to 1 mm.
    extent : float
        Where it begins, from the edge [m].

    Raises
    ------
    ParameterError
        A field out of range.

    Notes
    -----
    The slope is continuous where the relief begins. A rounding of radius r is `rounding(edge, r)`:
    where it begins it has the curvature of the circle, 1/r.

    Examples
    --------
    >>> EdgeRelief(edge="tip", amount=20e-6, extent=2e-3).slope  # at the edge
    0.02
    """

    edge: Edge
    amount: float
    extent: float

    def __post_init__(self) -> None:
        check_option("edge", self.edge, EDGES)
        check_within("amount", self.amount, 0.0, _MOST, "m", _METRES)
        check_within("extent", self.extent, 1e-6, _LONGEST, "m", _METRES)

    @property
    def slope(self) -> float:
        """Largest slope of the removal [-], at the edge."""
        return 2.0 * self.amount / self.extent

    def at(self, distance: Array) -> tuple[Array, Array, Array]:
        """Return value [m], slope by the distance [-] and bend [1/m] at distances [m]."""
        left = np.maximum(1.0 - distance / self.extent, 0.0)
        bend = np.where(left > 0.0, 2.0 * self.amount / self.extent**2, 0.0)
        return self.amount * left**2, -self.slope * left, bend


def rounding(edge: Edge, radius: float) -> EdgeRelief:
    """Return the relief of an edge rounded with a radius [m]: the circle's parabola."""
    return EdgeRelief(edge=edge, amount=0.5 * radius, extent=radius)


@dataclass(frozen=True, slots=True, kw_only=True)
class FlankCorrection:
    """Corrections of one flank of one member.

    m = sum of reliefs + c_h (2s - 1)^2 + c_l (2t - 1)^2 + w (2s - 1)(2t - 1)

    with the profile position s, root 0 to tip 1, and the face position t, toe 0 to heel 1.

    Parameters
    ----------
    reliefs : tuple of EdgeRelief
    profile_crown, lead_crown : float
        c_h at tip and root, c_l at toe and heel [m]; -1 to 1 mm.
    twist : float
        w [m]: removed at the tip of the heel and the root of the toe, left standing at the other
        two corners; -1 to 1 mm.

    Raises
    ------
    ParameterError
        A field out of range.

    Examples
    --------
    >>> ends = FlankCorrection(reliefs=(EdgeRelief(edge="toe", amount=30e-6, extent=5e-3),))
    >>> float(ends.bends(np.array(0.5), np.array(0.0), 6e-3, 30e-3).value)
    3e-05
    """

    reliefs: tuple[EdgeRelief, ...] = ()
    profile_crown: float = 0.0
    lead_crown: float = 0.0
    twist: float = 0.0

    def __post_init__(self) -> None:
        for name in ("profile_crown", "lead_crown", "twist"):
            check_within(name, getattr(self, name), -_MOST, _MOST, "m", _METRES)

    @property
    def is_none(self) -> bool:
        """Whether nothing is removed."""
        return not (self.reliefs or self.profile_crown or self.lead_crown or self.twist)

    def bends(self, s: Array, t: Array, height: float, width: float) -> Bends:
        """Return removal and derivatives at s, t (...) of a tooth `height` and `width` [m].

        Beyond the edges the laws go on.
        """
        x, y = 2.0 * np.asarray(s) - 1.0, 2.0 * np.asarray(t) - 1.0
        a, b, w = self.profile_crown, self.lead_crown, self.twist
        x_h, y_l = 2.0 / height, 2.0 / width
        value = a * x**2 + b * y**2 + w * x * y
        by_h = (2.0 * a * x + w * y) * x_h
        by_l = (2.0 * b * y + w * x) * y_l
        flat = np.zeros_like(value)
        by_hh, by_ll = flat + 2.0 * a * x_h**2, flat + 2.0 * b * y_l**2
        for relief in self.reliefs:
            far = relief.edge in ("tip", "heel")
            place, whole = (s, height) if relief.edge in ("tip", "root") else (t, width)
            removed, slope, bend = relief.at(whole * (1.0 - place if far else place))
            value = value + removed
            outwards = -slope if far else slope
            if relief.edge in ("tip", "root"):
                by_h, by_hh = by_h + outwards, by_hh + bend
            else:
                by_l, by_ll = by_l + outwards, by_ll + bend
        return Bends(value, by_h, by_l, by_hh, flat + w * x_h * y_l, by_ll)


NO_CORRECTION = FlankCorrection()
