"""Geometry of one gear member for the compliance model: flanks, axis, rim, sections."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError

_FEWEST_POINTS = 4  # the grids are interpolated by cubic splines
_MOST_OF_THE_SLOT = 0.85  # of the half slot; the rest stays flat so that no element vanishes


def _unit_vector(name: str, vector: Array) -> Array:
    length = float(np.linalg.norm(vector))
    if vector.shape != (3,) or not math.isfinite(length) or length == 0.0:
        raise ParameterError(f"{name} must be 3 finite numbers that are not all zero.")
    return vector / length


def _flank_points(name: str, points: Array) -> Array:
    grid = np.ascontiguousarray(points, dtype=np.float64)
    if grid.ndim != 3 or grid.shape[2] != 3 or min(grid.shape[:2]) < _FEWEST_POINTS:
        raise ParameterError(
            f"{name} must have the shape (m, n, 3) with m, n >= {_FEWEST_POINTS}, "
            f"got {grid.shape}. Axis 0 runs root to tip, axis 1 toe to heel."
        )
    if not np.all(np.isfinite(grid)):
        raise ParameterError(f"{name} must hold finite coordinates [m]; some are not.")
    return grid


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothGeometry:
    """One tooth of a gear of any kind: two flanks, the axis and the block that carries it.

    Parameters
    ----------
    left, right
        Points of the two flanks of one tooth [m], (m, n, 3); axis 0 from the root line to the
        tip, axis 1 from toe to heel. Seen from the toe, tip upwards, `left` is on the left.
    inward
        Direction into the body below the tooth (normal of the root cone) at each station, (n, 3).
    axis_point, axis_direction
        A point [m] and the direction of the gear's axis, (3,).
    teeth
        Number of teeth [-].
    slot_depth
        Depth of the slot's bottom below the root lines of the flanks [m]; the root fillet
        takes it up.
    base_depth
        Depth of the base block below the slot's bottom [m].
    neighbour_pitches
        Plain rim on each side beyond the middle of the slot, in pitches.

    Notes
    -----
    The flank's parameters are the fractions of the grids' indices: s = 0 at the root line and
    1 at the tip, t = 0 at the toe and 1 at the heel.

    The displacement far below a loaded tooth dies out slowly, so the block's size is part of the
    model. On a 36-tooth bevel gear, whole displacement under a line load at mid height, against 3
    modules and 1 pitch: 1, 2 and 4 modules give -18, -5 and +2 %; with 4 modules, 0.5, 1.5 and
    2 pitches give -8, +4.5 and +7 % against 1.
    """

    left: Array
    right: Array
    inward: Array
    axis_point: Array
    axis_direction: Array
    teeth: int
    slot_depth: float
    base_depth: float
    neighbour_pitches: float

    def __post_init__(self) -> None:
        left, right = _flank_points("left", self.left), _flank_points("right", self.right)
        if left.shape != right.shape:
            raise ParameterError(
                f"left and right must have the same shape, got {left.shape} and {right.shape}. "
                "Sample both flanks with one grid."
            )
        inward = np.array(self.inward, dtype=np.float64)
        lengths = np.linalg.norm(inward, axis=-1)
        if inward.shape != (left.shape[1], 3) or not np.all(lengths > 0.0):
            raise ParameterError(
                f"inward must hold a direction for each station, shape ({left.shape[1]}, 3), "
                f"got {inward.shape} or a zero vector."
            )
        axis_point = np.array(self.axis_point, dtype=np.float64)
        if axis_point.shape != (3,) or not np.all(np.isfinite(axis_point)):
            raise ParameterError("axis_point must be 3 finite coordinates [m].")
        check_within("teeth", self.teeth, 3, 1e4, "", "Give the number of teeth of the gear.")
        check_positive("slot_depth", self.slot_depth, "m", "About 0.3 of a module is usual.")
        check_positive("base_depth", self.base_depth, "m", "About 3 modules are usual.")
        # the rim's two ends must stay apart: half a turn in all
        most = 0.25 * self.teeth - 0.5
        check_within("neighbour_pitches", self.neighbour_pitches, 0.0, most, "pitches")
        for name, value in (
            ("left", left),
            ("right", right),
            ("inward", inward / lengths[:, None]),
            ("axis_point", axis_point),
            (
                "axis_direction",
                _unit_vector("axis_direction", np.array(self.axis_direction, dtype=np.float64)),
            ),
        ):
            value.setflags(write=False)
            object.__setattr__(self, name, value)

    @property
    def pitch(self) -> float:
        """Pitch angle [rad]."""
        return 2.0 * math.pi / self.teeth

    def rotated_vectors(self, vectors: Array, angle: float | Array) -> Array:
        """Return directions (..., 3) turned about the axis by angles (...) [rad] (Rodrigues)."""
        k = self.axis_direction
        c, s = np.cos(angle)[..., None], np.sin(angle)[..., None]
        along = (vectors @ k)[..., None] * k
        return along + c * (vectors - along) + s * np.cross(k, vectors)

    def rotated_points(self, points: Array, angle: float | Array) -> Array:
        """Return points (..., 3) [m] turned about the axis by angles (...) [rad]."""
        return self.axis_point + self.rotated_vectors(points - self.axis_point, angle)

    def angle_between(self, start: Array, end: Array) -> Array:
        """Return the angle about the axis from points (..., 3) to points (..., 3) [rad]."""
        k = self.axis_direction
        a, b = np.cross(k, start - self.axis_point), np.cross(k, end - self.axis_point)
        sine = np.einsum("...j,j->...", np.cross(a, b), k)
        return np.arctan2(sine, np.einsum("...j,...j->...", a, b))


@dataclass(frozen=True, slots=True)
class Flank:
    """Spline surface through the points of one flank, in s and t from 0 to 1."""

    points: Array  # (m, n, 3) [m]

    def at(self, s: Array, t: Array, derivative: int = 0) -> Array:
        """Return points [m], or their derivatives along s [m], on the grid s x t, (ns, nt, 3)."""
        m, n = self.points.shape[:2]
        along_s = make_interp_spline(np.linspace(0.0, 1.0, m), self.points, k=3, axis=0)
        rows = along_s(s, nu=derivative)
        return make_interp_spline(np.linspace(0.0, 1.0, n), rows, k=3, axis=1)(t)


@dataclass(frozen=True, slots=True)
class HalfSection:
    """One side of the outline, from the tip to the end of the rim; lengthwise axis 1."""

    flank: Array  # tip to root line, (rows, stations, 3) [m]
    fillet: Array  # without the root line, (rows, stations, 3) [m]
    rim: Array  # slot's bottom and plain rim beyond the fillet, (rows, stations, 3) [m]
    base: Array  # bottom corner below the end of the rim, (stations, 3) [m]

    @property
    def outline(self) -> Array:
        """Points from the tip to the end of the rim, (rows, stations, 3) [m]."""
        return np.concatenate([self.flank, self.fillet, self.rim])


def _along(a: Array, b: Array) -> Array:
    return np.einsum("ij,ij->i", a, b)[:, None]


def _fillet_curve(start: Array, corner: Array, end: Array, x: Array) -> Array:
    """Return the cubic Bezier curve inscribed in the corner, (len(x), stations, 3).

    With the handle length (4/3) tan(theta/4) / tan(theta/2) of the tangents it follows a
    circle of turning angle theta to better than 0.1 % up to 110 degrees.
    """
    a, b = corner - start, end - corner
    cosine = _along(a, b) / np.sqrt(_along(a, a) * _along(b, b))
    theta = np.arccos(np.clip(cosine, -1.0, 1.0))
    handle = 4.0 / 3.0 * np.tan(0.25 * theta) / np.tan(0.5 * theta)
    first, second = start + handle * a, end - handle * b
    x = x[:, None, None]
    y = 1.0 - x
    return y**3 * start + 3.0 * y**2 * x * first + 3.0 * y * x**2 * second + x**3 * end


def half_section(
    geometry: ToothGeometry, side: str, s: Array, t: Array, fillet: Array, slot: Array, rim: Array
) -> HalfSection:
    """Return the outline on one side of the tooth.

    Parameters
    ----------
    geometry
        Geometry of the tooth.
    side
        `left` or `right`.
    s, t
        Flank parameters of the rows (from 1 down to 0) and of the stations [-].
    fillet, slot, rim
        Fractions (0, 1] of the way along the fillet, the flat of the slot's bottom and the
        plain rim at which rows lie [-]; `rim` may be empty.

    Raises
    ------
    ParameterError
        When flank and slot leave no room for a fillet.
    """
    own = Flank(getattr(geometry, side))
    other = Flank(geometry.right if side == "left" else geometry.left)
    root = own.at(np.zeros(1), t)[0]
    opposite = other.at(np.zeros(1), t)[0]
    # the neighbour on this side is the copy of the other flank that lies nearer to this one
    copies = [geometry.rotated_points(opposite, sign * geometry.pitch) for sign in (1.0, -1.0)]
    distances = [float(np.linalg.norm(copy - root, axis=1).mean()) for copy in copies]
    sense = 1.0 if distances[0] < distances[1] else -1.0
    across = copies[0 if sense > 0.0 else 1]

    inward_of = make_interp_spline(np.linspace(0.0, 1.0, len(geometry.inward)), geometry.inward)
    inward_tooth = inward_of(t)
    inward_tooth /= np.linalg.norm(inward_tooth, axis=1)[:, None]
    inward = geometry.rotated_vectors(inward_tooth, 0.5 * sense * geometry.pitch)
    middle = 0.5 * (root + across) + geometry.slot_depth * inward

    down = -own.at(np.zeros(1), t, derivative=1)[0]
    down /= np.linalg.norm(down, axis=1)[:, None]
    descent = _along(down, inward)
    if np.any(descent < 0.2):
        raise ParameterError(
            f"the {side} flank must fall towards the body at its root line; its steepest "
            "descent along `inward` is below 0.2. Check the order of axis 0 (root first) and "
            "the sign of `inward`."
        )
    length = _along(middle - root, inward) / descent
    corner = root + length * down
    flat = middle - corner
    room = np.sqrt(_along(flat, flat))
    if np.any(length <= 0.0) or np.any(_along(flat, middle - root) <= 0.0):
        raise ParameterError(
            f"slot_depth must leave a flat slot beside the {side} flank, got "
            f"{geometry.slot_depth:g} m: the flank meets its slot's other half first. "
            "Reduce slot_depth, or end the flank grids higher."
        )
    end = corner + flat * np.minimum(_MOST_OF_THE_SLOT, length / room)

    def turned(points: Array, pitches: float) -> Array:
        return geometry.rotated_points(points, sense * pitches * geometry.pitch)

    rows = [end + x * (middle - end) for x in slot]
    rows += [turned(middle, x * geometry.neighbour_pitches) for x in rim]
    below = middle + geometry.base_depth * inward
    return HalfSection(
        flank=own.at(s, t),
        fillet=_fillet_curve(root, corner, end, fillet),
        rim=np.array(rows),
        base=turned(below, geometry.neighbour_pitches),
    )
