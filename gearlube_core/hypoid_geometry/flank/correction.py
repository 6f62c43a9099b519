"""Corrections of a flank: material removed along its normal, from the edges inwards or over all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, get_args

import numpy as np
from scipy.interpolate import BSpline

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError

Edge = Literal["tip", "root", "toe", "heel"]
EDGES: tuple[Edge, ...] = get_args(Edge)
_METRES = "Give metres, not micrometres or millimetres."
_MOST = 1e-3  # m
_LONGEST = 0.5  # m
_MOST_DEGREE = 5  # of a surface
WORN_GRID = (16, 32)  # cubic B-splines from root to tip, and from toe to heel


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

    m = sum of reliefs + c_h x^2 + c_l y^2 + w x y + sum of a_ij x^i y^j + sum of b_ij B_i(s) B_j(t)

    x = 2s - 1, y = 2t - 1, with the profile position s, root 0 to tip 1, and the face position t,
    toe 0 to heel 1.

    Parameters
    ----------
    reliefs : tuple of EdgeRelief
    profile_crown, lead_crown : float
        c_h at tip and root, c_l at toe and heel [m]; -1 to 1 mm.
    twist : float
        w [m]: removed at the tip of the heel and the root of the toe, left standing at the other
        two corners; -1 to 1 mm.
    surface : tuple of float
        a_ij [m] by rising degree, in each by falling power of x: 1, x, y, x^2, x y, y^2, ...; none
        or 1, 3, 6, 10, 15 or 21 of them. Below 0 material stands over the flank as cut.
    worn : tuple of float
        b_ij [m] of wear, row by row from root to tip, each from toe to heel; none or as many as
        `WORN_GRID` has. The splines B are those of `worn_splines`: wherever all b are 0 or more,
        nothing is added to the flank.

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
    surface: tuple[float, ...] = ()
    worn: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        for name in ("profile_crown", "lead_crown", "twist"):
            check_within(name, getattr(self, name), -_MOST, _MOST, "m", _METRES)
        if self.surface:
            surface_degree(len(self.surface))
        for value in self.surface:
            check_within("surface", value, -_MOST, _MOST, "m", _METRES)
        if self.worn:
            cells = WORN_GRID[0] * WORN_GRID[1]
            check_within("number of worn", len(self.worn), cells, cells, "", "Or give none.")
        for value in self.worn:
            check_within("worn", value, 0.0, _MOST, "m", _METRES)

    @property
    def is_none(self) -> bool:
        """Whether nothing is removed."""
        return not (
            self.reliefs or self.profile_crown or self.lead_crown or self.twist
            or any(self.surface) or any(self.worn)
        )  # fmt: skip

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
        by_hl = flat + w * x_h * y_l
        for (i, j), a_ij in zip(surface_powers(len(self.surface)), self.surface, strict=True):
            x_0, x_1, x_2 = _power(x, i)
            y_0, y_1, y_2 = _power(y, j)
            value = value + a_ij * x_0 * y_0
            by_h, by_l = by_h + a_ij * x_1 * y_0 * x_h, by_l + a_ij * x_0 * y_1 * y_l
            by_hh = by_hh + a_ij * x_2 * y_0 * x_h**2
            by_hl = by_hl + a_ij * x_1 * y_1 * x_h * y_l
            by_ll = by_ll + a_ij * x_0 * y_2 * y_l**2
        found = Bends(value, by_h, by_l, by_hh, by_hl, by_ll)
        return self._with_wear(found, x, y, height, width) if any(self.worn) else found

    def _with_wear(self, found: Bends, x: Array, y: Array, height: float, width: float) -> Bends:
        places = [np.ravel(0.5 * (one + 1.0)) for one in np.broadcast_arrays(x, y)]
        up, along = (
            [worn_splines(place, count, n) / size**n for n in range(3)]
            for place, count, size in zip(places, WORN_GRID, (height, width), strict=True)
        )
        b = np.reshape(self.worn, WORN_GRID)
        orders = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))  # as in `Bends`
        added = (np.einsum("ni,ij,nj->n", up[m], b, along[n]) for m, n in orders)
        return Bends(*(one + more.reshape(x.shape) for one, more in zip(found, added, strict=True)))


def worn_splines(place: Array, count: int, derivative: int = 0) -> Array:
    """Return cubic B-splines, or a derivative, at places 0 to 1 of a flank, (N, count) [-].

    None is below 0, and their sum is 1; beyond the edges they are those at the edge.

    >>> worn_splines(np.array([0.0, 0.3]), 5).sum(axis=1)
    array([1., 1.])
    """
    knots = np.concatenate([np.zeros(3), np.linspace(0.0, 1.0, count - 2), np.ones(3)])
    splines = BSpline(knots, np.eye(count), 3)
    found = np.asarray(splines(np.clip(place, 0.0, 1.0), nu=derivative))
    return found if derivative == 0 else found * ((place >= 0.0) & (place <= 1.0))[:, None]


def surface_degree(count: int) -> int:
    """Return the degree of a surface of so many coefficients; raise ParameterError for others."""
    for degree in range(_MOST_DEGREE + 1):
        if count == (degree + 1) * (degree + 2) // 2:
            return degree
    raise ParameterError(
        f"surface must hold 1, 3, 6, 10, 15 or 21 coefficients, got {count}. A surface of degree n "
        "has (n + 1)(n + 2)/2: 1, x, y, x^2, x y, y^2, ..."
    )


def surface_powers(count: int) -> list[tuple[int, int]]:
    """Return the powers of x and y of each coefficient of a surface; none for a count of 0.

    >>> surface_powers(6)
    [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
    """
    if count == 0:
        return []
    return [(n - j, j) for n in range(surface_degree(count) + 1) for j in range(n + 1)]


def _power(x: Array, power: int) -> tuple[Array, Array, Array]:
    """Return x^power and its first and second derivative."""
    value = x**power
    first = power * x ** max(power - 1, 0)
    return value, first, power * (power - 1) * x ** max(power - 2, 0)


NO_CORRECTION = FlankCorrection()
