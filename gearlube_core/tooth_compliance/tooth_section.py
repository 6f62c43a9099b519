"""Outline of the tooth, its fillets and the base block at every lengthwise station."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry

_MOST_OF_THE_SLOT = 0.85  # of the half slot; the rest stays flat so that no element vanishes


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
    geometry: ToothGeometry,
    side: str,
    s: Array,
    t: Array,
    fillet: Array,
    slot: Array,
    rim: Array,
) -> HalfSection:
    """Return the outline on one side of the tooth.

    Parameters
    ----------
    geometry
        The tooth.
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
