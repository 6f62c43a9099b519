"""Measured flanks of a pair: their smooth surfaces, and the gear file that has them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.correction import surface_powers
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role, Side
from gearlube_core.hypoid_geometry.flank.tooth_solid import MIRROR
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import (
    MOST_POINTS,
    DeviationGrid,
    GridPlaces,
    read_deviation_grids,
    role_of,
    side_of,
)
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile
from gearlube_core.hypoid_geometry.measured.tooth_errors import ToothErrors
from gearlube_core.input_file.table import read_table
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.units import MILLIMETRE

EXAMPLE = Path(__file__).parents[1] / "data" / "measured"
COLUMNS = ("member", "flank", "row", "column", "x_mm", "y_mm", "z_mm")

_FURTHEST = 2e-6  # m, of a nominal point from the flank
_ROUGH = 20e-6  # m, rms with which another hand or flank is recognised
_SPREAD = 0.03  # of s or t along a row or column
_FARTHEST = 1e4  # mm


def write_example(folder: Path) -> tuple[Path, ...]:
    """Write the example into a folder; return the files, the measured-gear file first.

    Raises
    ------
    ParameterError
        One of the files is there already. Nothing is written then.
    """
    shipped = sorted(EXAMPLE.iterdir(), key=lambda file: (file.suffix != ".toml", file.name))
    written = tuple(folder / file.name for file in shipped)
    there = [str(path) for path in written if path.exists()]
    if there:
        raise ParameterError(
            f"--example must be a folder without these files, got {', '.join(there)}. Choose "
            "another folder."
        )
    folder.mkdir(parents=True, exist_ok=True)
    for source, path in zip(shipped, written, strict=True):
        write_text(source.read_text(encoding="utf-8"), path)
    return written


@dataclass(frozen=True, slots=True, kw_only=True)
class _PointFit:
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


@dataclass(frozen=True, slots=True, kw_only=True)
class _SmoothSurface:
    """A polynomial over the flank, fitted to the mean of the measured teeth.

    Parameters
    ----------
    removal : tuple of float
        Coefficients of what is removed [m], minus the deviation, as `FlankCorrection.surface`.
    residual : ndarray of shape (m, n)
        Mean deviation of the teeth less the surface [m].
    scatter_rms : float
        Of single teeth about their mean, over all points [m]; 0 of one tooth.
    """

    removal: tuple[float, ...]
    residual: Array
    scatter_rms: float

    @property
    def residual_rms(self) -> float:
        """Root mean square of the residual [m]."""
        return float(np.sqrt(np.mean(self.residual**2)))


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredFlanks:
    """Measured flanks beside the nominal pair.

    Parameters
    ----------
    file : MeasuredFile
    nominal : HypoidGearFile
    grids : mapping of (role, side) to DeviationGrid
    surfaces : mapping of (role, side) to SmoothSurface
    errors : ToothErrors
        How teeth differ from each other.
    """

    file: MeasuredFile
    nominal: HypoidGearFile
    grids: Mapping[tuple[Role, Side], DeviationGrid]
    surfaces: Mapping[tuple[Role, Side], _SmoothSurface]
    errors: ToothErrors

    def gear_file(self) -> HypoidGearFile:
        """Return the nominal gear file with the smooth surfaces laid on its flanks.

        The deviations are those from the flanks of that file, its reliefs included: coefficients
        that a flank already has are added to.
        """
        changes: dict[str, object] = {
            "name": self.file.name,
            "source": f"{self.nominal.source}; measured flanks: {self.file.source}",
        }
        for (role, side), surface in self.surfaces.items():
            before = self.nominal.correction(role, side).surface
            both = zip_longest(before, surface.removal, fillvalue=0.0)
            changes[f"{role}.{side}_flank.surface_um"] = tuple(1e6 * (a + b) for a, b in both)
        return self.nominal.varied(changes)


def read_measured_flanks(path: str | Path) -> MeasuredFlanks:
    """Return the measured flanks of a measured-gear file (TOML) and its CSV files.

    Raises
    ------
    ParameterError
        A file is missing or wrong; the sentence names the line.
    """
    file = MeasuredFile.from_toml(path)
    nominal = file.nominal()
    grids: dict[tuple[Role, Side], DeviationGrid] = {}
    if file.deviations is not None:
        places = file.places(nominal.blank())
        if file.nominal_points is not None:
            places |= check_nominal_points(file.nominal_points, nominal)
        if not places:
            raise ParameterError(
                f"{path}: deviations are given, so a grid must be described. Add the section "
                "[pinion.grid] or [gear.grid], or nominal_points."
            )
        grids = read_deviation_grids(
            file.deviations, places, middle_is_zero=file.middle_point == "zero"
        )
    surfaces = {key: smooth_surface(grid, file.degree) for key, grid in grids.items()}
    return MeasuredFlanks(
        file=file,
        nominal=nominal,
        grids=grids,
        surfaces=surfaces,
        errors=file.tooth_errors(nominal.blank()),
    )


def smooth_surface(grid: DeviationGrid, degree: int = 3) -> _SmoothSurface:
    """Return the least-squares polynomial through the mean of the measured teeth.

    Parameters
    ----------
    grid : DeviationGrid
    degree : int
        Of the polynomial in both positions together [-], 0 to 5.

    Raises
    ------
    ParameterError
        The grid has too few rows, columns or points for the degree.

    Notes
    -----
    A low degree smooths what the probe adds. A surface through all points would follow the noise,
    and curvature and contact would follow it too. The polynomial is used up to the edges, beyond
    the outermost points; with 1 um of noise on 5 x 9 points a cubic is uncertain by 1.7 um in
    the corners, by 0.3 um in the middle.
    """
    check_within("degree", degree, 0, 5, "", "3 is usual.")
    shape = grid.deviation.shape[1:]
    powers = surface_powers((degree + 1) * (degree + 2) // 2)
    if min(shape) <= degree or shape[0] * shape[1] < 2 * len(powers):
        raise ParameterError(
            f"{grid.name}: a surface of degree {degree} must have more than {degree} rows and "
            f"columns and {2 * len(powers)} points, got {shape[0]} x {shape[1]}. Lower the degree."
        )
    x, y = np.meshgrid(2.0 * grid.places.s - 1.0, 2.0 * grid.places.t - 1.0, indexing="ij")
    terms = np.stack([(x**i * y**j).ravel() for i, j in powers], axis=1)
    mean = grid.deviation.mean(axis=0)
    coefficients = np.linalg.lstsq(terms, mean.ravel(), rcond=None)[0]
    return _SmoothSurface(
        removal=tuple((-coefficients).tolist()),
        residual=mean - (terms @ coefficients).reshape(shape),
        scatter_rms=float(np.sqrt(np.mean((grid.deviation - mean) ** 2))),
    )


def fit_points(flank: Flank, points: Array) -> _PointFit | None:
    """Return points (m, n, 3) [m] laid on a flank by one rotation and one axial shift.

    Their frame is right-handed, z along the member's axis and away from the crossing point. None
    where they do not lie near the flank.
    """
    radius, height = np.hypot(points[..., 0], points[..., 1]), points[..., 2]
    azimuth = _unwound(points[..., 1], points[..., 0])
    axis = flank.axis
    first = np.roll(axis, 1)
    second = np.cross(axis, first)

    def laid(shift: float) -> _PointFit:
        s, t = flank.region.position(radius, height + shift)
        sample = flank.sample(s, t)
        own = sample.r - flank.axis_point
        turn = azimuth - _unwound(own @ second, own @ first)
        lever = np.einsum("...i,...i->...", sample.normal, np.cross(axis, own))
        rotation = float(np.sum(turn * lever**2) / np.sum(lever**2))
        return _PointFit(
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
        if fit is None or worst > _FURTHEST:
            raise ParameterError(
                f"{path}: the nominal points of the {role}'s {side} flank must lie within "
                f"{1e6 * _FURTHEST:g} um of the flank of {file.name}, after one rotation and one "
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
    """Return the likely reason of points that do not lie on a flank."""
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
