"""Nominal points of a measuring machine against the flanks of a gear file."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.export import MIRROR
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role, Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import MOST_POINTS, GridPlaces
from gearlube_core.hypoid_geometry.measured.member_rows import role_of, side_of
from gearlube_core.input_file.table import read_table
from gearlube_core.units import MILLIMETRE

COLUMNS = ("member", "flank", "row", "column", "x_mm", "y_mm", "z_mm")
FURTHEST = 2e-6  # m, of a nominal point from the flank
_ROUGH = 20e-6  # m, rms with which another hand or flank is recognised
_SPREAD = 0.03  # of s or t along a row or column
_FARTHEST = 1e4  # mm


@dataclass(frozen=True, slots=True, kw_only=True)
class PointFit:
    """Where points of a member lie on a flank, after one rotation and one axial shift.

    Parameters
    ----------
    s, t : ndarray of shape (m, n)
        Profile and face positions [-].
    distance : ndarray of shape (m, n)
        From the flank along its normals [m], above 0 outside.
    rotation : float
        Of the points from the flank at rotation zero [rad].
    shift : float
        Added to their axial positions [m].
    """

    s: Array
    t: Array
    distance: Array
    rotation: float
    shift: float

    @property
    def rms(self) -> float:
        """Root mean square distance [m]."""
        return float(np.sqrt(np.mean(self.distance**2)))


def fit_points(flank: Flank, points: Array) -> PointFit | None:
    """Return points (m, n, 3) [m] laid on a flank by one rotation and one axial shift.

    Their frame is right-handed, z along the member's axis and away from the crossing point. None
    where they do not lie near the flank.
    """
    radius, height = np.hypot(points[..., 0], points[..., 1]), points[..., 2]
    azimuth = _unwound(points[..., 1], points[..., 0])
    axis = flank.axis
    first = np.roll(axis, 1)
    second = np.cross(axis, first)

    def laid(shift: float) -> PointFit:
        s, t = flank.region.position(radius, height + shift)
        sample = flank.sample(s, t)
        own = sample.r - flank.axis_point
        turn = azimuth - _unwound(own @ second, own @ first)
        lever = np.einsum("...i,...i->...", sample.normal, np.cross(axis, own))
        rotation = float(np.sum(turn * lever**2) / np.sum(lever**2))
        return PointFit(
            s=s, t=t, distance=lever * (turn - rotation), rotation=rotation, shift=shift
        )

    _, middle = flank.region.section(np.array(0.5), np.array(0.5))
    start = float(middle) - float(height.mean())
    if not np.isfinite(laid(start).distance).all():
        return None

    def distances(shift: Array) -> Array:
        # in micrometres; points that leave the flank end the search
        return np.nan_to_num(1e6 * laid(float(shift[0])).distance.ravel(), nan=1e6)

    found = least_squares(distances, [start], x_scale=1e-4, diff_step=1e-4, xtol=1e-15, ftol=1e-15)
    fit = laid(float(found.x[0]))
    return fit if np.isfinite(fit.distance).all() else None


def check_nominal_points(
    path: str | Path, file: HypoidGearFile
) -> dict[tuple[Role, Side], GridPlaces]:
    """Return where the nominal points of a CSV file lie on the flanks of a gear file.

    Parameters
    ----------
    path
        Columns of `COLUMNS`, in the frame of `fit_points`; rows and columns as in the deviations.
    file : HypoidGearFile

    Raises
    ------
    ParameterError
        A point is missing, or farther from the flank than FURTHEST: the points are those of
        another flank, of the other hand, or of other machine settings.
    """
    places = {}
    for (role, side), points in _read(path).items():
        flank = Flank.from_file(file, role, side)
        if file.pair.pinion_hand == "left":
            points = points * MIRROR
        fit = fit_points(flank, points)
        worst = math.inf if fit is None else float(np.max(np.abs(fit.distance)))
        if fit is None or worst > FURTHEST:
            raise ParameterError(
                f"{path}: the nominal points of the {role}'s {side} flank must lie within "
                f"{1e6 * FURTHEST:g} um of the flank of {file.name}, after one rotation and one "
                f"axial shift, they are up to {1e6 * worst:.4g} um off. "
                f"{_cause(file, flank, points)}"
            )
        s, t = fit.s.mean(axis=1), fit.t.mean(axis=0)
        spread = max(np.abs(fit.s - s[:, None]).max(), np.abs(fit.t - t[None, :]).max())
        if spread > _SPREAD or np.any(np.diff(s) <= 0.0) or np.any(np.diff(t) <= 0.0):
            raise ParameterError(
                f"{path}: rows of the {role}'s {side} flank must rise from root to tip at one "
                "height, columns from toe to heel at one place, but they do not. Check their "
                "order."
            )
        places[role, side] = GridPlaces(s=s, t=t)
    return places


def _cause(file: HypoidGearFile, flank: Flank, points: Array) -> str:
    """Return what explains points that do not lie on a flank."""
    other: Side = "coast" if flank.side == "drive" else "drive"
    mirrored, backwards = points * MIRROR, points * [1.0, -1.0, -1.0]
    hand = "left" if file.pair.pinion_hand == "right" else "right"
    for one, what in (
        (
            fit_points(Flank.from_file(file, flank.role, other), points),
            f"They fit the {other} flank",
        ),
        (
            fit_points(flank, mirrored),
            f"Their mirror image fits: set pair.pinion_hand to {hand} in the gear file",
        ),
        (fit_points(flank, backwards), "They fit with z the other way round"),
        (fit_points(flank, points * 25.4), "They fit as inches"),
        (fit_points(flank, points * 1e-3), "They fit as micrometres"),
    ):
        if one is not None and one.rms < _ROUGH:
            return f"{what}."
    return "Check the machine settings of the gear file against those of the measuring machine."


def _unwound(sine: Array, cosine: Array) -> Array:
    """Return angles over a grid without jumps [rad]."""
    return np.asarray(np.unwrap(np.unwrap(np.arctan2(sine, cosine), axis=1), axis=0))


def _read(path: str | Path) -> dict[tuple[Role, Side], Array]:
    """Return the points of each flank in the file [m], (m, n, 3)."""
    values: dict[tuple[Role, Side], dict[tuple[int, int], list[float]]] = {}
    for row in read_table(path, COLUMNS):
        role = role_of(row)
        found = values.setdefault((role, side_of(row, role)), {})
        place = row.whole("row", 1, MOST_POINTS), row.whole("column", 1, MOST_POINTS)
        if place in found:
            raise ParameterError(
                f"{row.where}: the point {place[0]}, {place[1]} occurs twice. Keep one."
            )
        found[place] = [
            row.number(name, -_FARTHEST, _FARTHEST, "mm") for name in ("x_mm", "y_mm", "z_mm")
        ]
    grids = {}
    for (role, side), points in sorted(values.items()):
        rows, columns = (max(place[k] for place in points) for k in (0, 1))
        if len(points) != rows * columns:
            raise ParameterError(
                f"{path}: all {rows} x {columns} nominal points of the {role}'s {side} flank must "
                f"be in the file, but {rows * columns - len(points)} are missing."
            )
        grid = [[points[i + 1, j + 1] for j in range(columns)] for i in range(rows)]
        grids[role, side] = MILLIMETRE * np.array(grid)
    return grids
