"""Measured heights along a line or over a plane, and files of measuring instruments."""

from __future__ import annotations

import logging
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import spsolve

from gearlube_core.arrays import Array
from gearlube_core.checks import check_file
from gearlube_core.errors import FileError, ParameterError, why
from gearlube_core.input_file.table import read_table
from gearlube_core.storage.atomic_file import DAMAGED, open_dataset, read_arrays
from gearlube_core.units import MILLIMETRE

_MICROMETRE = 1e-6  # m
_FEWEST = 4  # points of a cubic spline
_HEAD = ("x_mm", "height_um")
_ROUNDING = 1e-6  # of an interval or a range
LARGEST = 100_000_000  # bytes of a file of heights
_MOST_MISSING = 0.2  # share of points that may be filled
logger = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class MeasuredProfile:
    """Heights at places along x, between them a cubic spline.

    Parameters
    ----------
    x
        (n,) [m], rising.
    height
        (n,) [m].
    name
        Name used in error messages.

    Raises
    ------
    ParameterError
        Places do not rise, a number is not finite, or there are fewer than four.
    """

    x: Array
    height: Array
    name: str = "profile"
    _spline: CubicSpline = field(init=False, repr=False)

    def __post_init__(self) -> None:
        _check_axis(self.name, "x", self.x)
        _check_heights(self.name, self.height, (self.x.size,))
        object.__setattr__(self, "_spline", CubicSpline(self.x, self.height))

    def __call__(self, x: Array) -> Array:
        """Return the heights [m] at x [m]."""
        return np.asarray(self._spline(x))

    def check_serves(self, x: Array) -> None:
        """Refuse a grid x (m,) [m] that goes beyond the places or is finer than they are."""
        _check_serves(self.name, "x", self.x, x)


@dataclass(frozen=True, eq=False)
class MeasuredMap:
    """Heights over a rectangle, between the points a bicubic spline.

    Parameters
    ----------
    x, y
        (nx,), (ny,) [m], rising.
    height
        (nx, ny) [m].
    name
        Name used in error messages.

    Raises
    ------
    ParameterError
        As for a profile, or the shape is another one.
    """

    x: Array
    y: Array
    height: Array
    name: str = "height map"
    _spline: RectBivariateSpline = field(init=False, repr=False)

    def __post_init__(self) -> None:
        _check_axis(self.name, "x", self.x)
        _check_axis(self.name, "y", self.y)
        _check_heights(self.name, self.height, (self.x.size, self.y.size))
        object.__setattr__(self, "_spline", RectBivariateSpline(self.x, self.y, self.height))

    def __call__(self, x: Array, y: Array) -> Array:
        """Return the heights [m] at points (x, y) [m], shaped as both together."""
        return np.asarray(self._spline.ev(*np.broadcast_arrays(x, y)))

    def check_serves(self, x: Array, y: Array) -> None:
        """Refuse a grid x, y [m] that goes beyond the map or is finer than it is."""
        _check_serves(self.name, "x", self.x, x)
        _check_serves(self.name, "y", self.y, y)


def read_profile(path: str | Path) -> MeasuredProfile:
    """Read a table with the columns x_mm and height_um, see `read_table`.

    Raises
    ------
    ParameterError
        The file is missing or not such a file.
    """
    table = read_table(path, _HEAD)
    x, height = (table.column(name) for name in _HEAD)
    return MeasuredProfile(x * MILLIMETRE, height * _MICROMETRE, name=f"profile {path}")


def read_map(path: str | Path) -> MeasuredMap:
    """Read heights over a plane: `x`, `y` [mm] and `height` [um] from NetCDF or an .npz file.

    In NetCDF the dimensions are called x and y, in any order; in an .npz file `height` has the
    shape (x, y). Missing heights (nan) are filled, see `filled`.

    Raises
    ------
    ParameterError
        The file is missing or not such a file.
    """
    where = Path(path)
    check_file(where, "height map", largest=LARGEST)
    try:
        x, y, height = _from_npz(where) if where.suffix == ".npz" else _from_netcdf(where)
    except KeyError as missing:
        raise ParameterError(
            f"{path} must hold x and y in mm and height in um, {missing} is missing."
        ) from None
    except (*DAMAGED, FileError) as reason:
        raise ParameterError(
            f"{path} is not a readable NetCDF or npz file: {why(reason)}."
        ) from None
    name = f"height map {path}"
    return MeasuredMap(
        x * MILLIMETRE, y * MILLIMETRE, filled(height * _MICROMETRE, name), name=name
    )


def filled(height: Array, name: str) -> Array:
    """Return heights (n,) or (nx, ny) with missing points (nan) filled; log how many there were.

    Each missing point gets the mean of its neighbours along the sides (Laplace's equation), so that
    it never leaves the heights around the hole: a line across a gap of a profile.

    Raises
    ------
    ParameterError
        More than a fifth of the points are missing.
    """
    missing = np.isnan(height)
    count = int(missing.sum())
    if not count:
        return height
    if count > _MOST_MISSING * height.size:
        raise ParameterError(
            f"{name}: at most {_MOST_MISSING:.0%} of the points may be missing, got {count} of "
            f"{height.size}. Cut out a part with fewer gaps, or measure again."
        )
    places = np.arange(height.size).reshape(height.shape)
    sides = [
        (places.take(range(n - 1), axis).ravel(), places.take(range(1, n), axis).ravel())
        for axis, n in enumerate(height.shape)
    ]
    one = np.concatenate([part for pair in sides for part in pair])
    other = np.concatenate([part for pair in sides for part in reversed(pair)])
    holes, level = missing.ravel(), height.ravel().copy()
    one, other = one[holes[one]], other[holes[one]]
    row = np.cumsum(holes) - 1  # number of a missing point
    known = ~holes[other]
    given = np.bincount(row[one[known]], level[other[known]], count)
    links = (np.ones(int((~known).sum())), (row[one[~known]], row[other[~known]]))
    matrix = diags_array(np.bincount(row[one], minlength=count).astype(float)) - coo_array(
        links, (count, count)
    )
    level[holes] = spsolve(matrix.tocsc(), given)
    logger.warning(
        "%s: %d of %d points (%.2g %%) were not measured and are filled: each has the mean of its "
        "neighbours, smoother than the surface.",
        name,
        count,
        height.size,
        100.0 * count / height.size,
    )
    return level.reshape(height.shape)


def _from_npz(path: Path) -> tuple[Array, Array, Array]:
    stored = read_arrays(path)
    x, y, height = (np.asarray(stored[name], dtype=float) for name in ("x", "y", "height"))
    return x, y, height


def _from_netcdf(path: Path) -> tuple[Array, Array, Array]:
    with open_dataset(path) as stored:
        height = stored["height"].transpose("x", "y")
        x, y = stored["x"], stored["y"]
        return tuple(np.asarray(one.values, dtype=float) for one in (x, y, height))  # type: ignore[return-value]


def _check_axis(name: str, axis: str, places: Array) -> None:
    if places.ndim != 1 or places.size < _FEWEST:
        raise ParameterError(
            f"{name} must have at least {_FEWEST} places along {axis}, got shape {places.shape}."
        )
    _check_finite(name, axis, places)
    steps = np.diff(places)
    if not (steps > 0.0).all():
        k = int(np.argmax(steps <= 0.0))
        raise ParameterError(
            f"{name}: {axis} must rise from point to point, got {places[k] / MILLIMETRE:g} mm and "
            f"then {places[k + 1] / MILLIMETRE:g} mm. Sort the points and leave out repeated ones."
        )


def _check_heights(name: str, height: Array, shape: tuple[int, ...]) -> None:
    if height.shape != shape:
        raise ParameterError(
            f"{name}: heights must have the shape {shape} of their places, got {height.shape}."
        )
    _check_finite(name, "height", height)


def _check_finite(name: str, what: str, values: Array) -> None:
    wrong = int((~np.isfinite(values)).sum())
    if wrong:
        first = tuple(int(k) for k in np.argwhere(~np.isfinite(values))[0])
        where = first[0] if len(first) == 1 else first
        raise ParameterError(
            f"{name}: {what} must be finite, {wrong} of {values.size} numbers are not, the first "
            f"at index {where}. Fill the gaps of the measurement first."
        )


def _check_serves(name: str, axis: str, places: Array, grid: Array) -> None:
    slack = _ROUNDING * (grid[-1] - grid[0])
    if places[0] > grid[0] + slack or places[-1] < grid[-1] - slack:
        first, last, low, high = (
            v / MILLIMETRE for v in (places[0], places[-1], grid[0], grid[-1])
        )
        raise ParameterError(
            f"{name} must cover the domain {low:.5g} to {high:.5g} mm along {axis}, got "
            f"{first:.5g} to {last:.5g} mm. Measure a larger part, or give a smaller [domain]."
        )
    near = (places[1:] > grid[0]) & (places[:-1] < grid[-1])
    widest, step = float(np.diff(places)[near].max()), float(np.diff(grid).min())
    if widest > step * (1.0 + _ROUNDING):
        enough = int((grid[-1] - grid[0]) * (1.0 + _ROUNDING) / widest) + 1
        raise ParameterError(
            f"{name} must be at least as fine as the grid along {axis}, {step / _MICROMETRE:.4g} "
            f"um, got places up to {widest / _MICROMETRE:.4g} um apart. Take at most {enough} "
            "nodes, or resample the heights if they are smooth between their places."
        )
