"""Grids of normal deviations of a member's flanks, from CSV."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Role, Side
from gearlube_core.input_file.table import Row, read_table

_ROLES: tuple[Role, Role] = ("pinion", "gear")
COLUMNS = ("member", "flank", "tooth", "row", "column", "deviation_um")
MOST_POINTS = 99  # rows or columns of a grid
_MOST = 500.0  # um
_LEAST = 0.1  # um, largest deviation of a grid that can be meant
_ZERO = 0.05  # um, of a middle point
_NAMED = 5  # missing points in an error


def role_of(row: Row) -> Role:
    """Return the member of a row: "pinion" or "gear"."""
    given = row.text("member").lower()
    for role in _ROLES:
        if given == role:
            return role
    raise ParameterError(
        f"{row.where}: member must be pinion or gear, got {given!r}. The gear is the larger "
        "one, also called wheel or ring gear."
    )


def side_of(row: Row, role: Role) -> Side:
    """Return the flank of a row: "drive" or "coast", for which it may say convex or concave."""
    given = row.text("flank").lower()
    for (member, side), curve in CURVES.items():
        if member == role and given in (side, curve):
            return side
    raise ParameterError(
        f"{row.where}: flank must be drive, coast, convex or concave, got {given!r}. Left and "
        "right depend on who looks; the drive flank of the gear is convex, that of the pinion "
        "concave."
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class GridPlaces:
    """Where the points of a grid lie on the flank.

    Parameters
    ----------
    s : ndarray of shape (m,)
        Profile positions of the rows, root line 0 to tip 1 [-].
    t : ndarray of shape (n,)
        Face positions of the columns, toe 0 to heel 1 [-].
    """

    s: Array
    t: Array

    @classmethod
    def inset(
        cls,
        rows: int,
        columns: int,
        *,
        height: float,
        width: float,
        root: float,
        tip: float,
        toe: float,
        heel: float,
    ) -> GridPlaces:
        """Return evenly spaced rows and columns, the outer ones inset from the edges.

        Parameters
        ----------
        rows, columns : int
        height, width : float
            Of the flank: from root line to tip, and along the pitch cone [m].
        root, tip, toe, heel : float
            Insets of the first and last row and column [m].
        """
        for names, pair, whole in (
            ("root_inset_mm and tip_inset_mm", (root, tip), height),
            ("toe_inset_mm and heel_inset_mm", (toe, heel), width),
        ):
            if sum(pair) > 0.5 * whole:
                raise ParameterError(
                    f"{names} must be at most half of the flank together, {500.0 * whole:.4g} mm, "
                    f"got {1e3 * pair[0]:g} and {1e3 * pair[1]:g} mm. Give them from the edges."
                )
        return cls(
            s=np.linspace(root / height, 1.0 - tip / height, rows),
            t=np.linspace(toe / width, 1.0 - heel / width, columns),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class DeviationGrid:
    """Normal deviations of one flank of some teeth.

    Parameters
    ----------
    role : {"pinion", "gear"}
    side : {"drive", "coast"}
    places : GridPlaces
        Of m rows and n columns.
    teeth : tuple of int
        Numbers of the k measured teeth.
    deviation : ndarray of shape (k, m, n)
        Along the outward normal [m], above 0 with more material than the nominal flank.
    """

    role: Role
    side: Side
    places: GridPlaces
    teeth: tuple[int, ...]
    deviation: Array

    @property
    def name(self) -> str:
        """Such as "gear drive"."""
        return f"{self.role} {self.side}"


def read_deviation_grids(
    path: str | Path, places: Mapping[tuple[Role, Side], GridPlaces], *, middle_is_zero: bool
) -> dict[tuple[Role, Side], DeviationGrid]:
    """Return the grids of a CSV file with the columns of `COLUMNS`, in any order of lines.

    Parameters
    ----------
    path
        Rows count from the root to the tip, columns from the toe to the heel, both from 1.
        Deviations in micrometres along the outward normal, plus for more material.
    places : mapping of (role, side) to GridPlaces
    middle_is_zero
        Whether the middle point of each grid must be zero, as after turning the member for it.

    Raises
    ------
    ParameterError
        A point is missing, given twice or out of range; a member has no places; a grid looks as
        if it were in another unit, or its middle point is not zero though it should be.
    """
    values: dict[tuple[Role, Side], dict[int, Array]] = {}
    for row in read_table(path, COLUMNS):
        role = role_of(row)
        side = side_of(row, role)
        if (role, side) not in places:
            raise ParameterError(
                f"{row.where}: the file has points of the {role}'s {side} flank, whose grid is not "
                f"described. Add the section [{role}.grid], or its nominal points."
            )
        tooth = row.whole("tooth", 1, 400)
        at = places[role, side]
        shape = at.s.size, at.t.size
        i, j = row.whole("row", 1, shape[0]) - 1, row.whole("column", 1, shape[1]) - 1
        value = row.number("deviation_um", -_MOST, _MOST, "um", "Plus for material.")
        grid = values.setdefault((role, side), {}).setdefault(tooth, np.full(shape, np.nan))
        if np.isfinite(grid[i, j]):
            raise ParameterError(
                f"{row.where}: the point {i + 1}, {j + 1} of the {role}'s tooth {tooth}, {side} "
                "flank, occurs twice. Keep one, or check flank and tooth."
            )
        grid[i, j] = value
    found = {}
    for (role, side), teeth in sorted(values.items()):
        for tooth, grid in sorted(teeth.items()):
            _check(f"{path}: {role}, {side} flank, tooth {tooth}", grid, middle_is_zero)
        stacked = np.stack([grid for _, grid in sorted(teeth.items())])
        largest = float(np.max(np.abs(stacked)))
        if 0.0 < largest < _LEAST:
            raise ParameterError(
                f"{path}: the largest deviation of the {role}'s {side} flank must be 0 or at least "
                f"{_LEAST:g} um, got {largest:g} um. Is it in mm? {largest:g} mm is "
                f"{1e3 * largest:g} um."
            )
        found[role, side] = DeviationGrid(
            role=role,
            side=side,
            places=places[role, side],
            teeth=tuple(sorted(teeth)),
            deviation=1e-6 * stacked,
        )
    return found


def _check(where: str, grid: Array, middle_is_zero: bool) -> None:
    missing = np.argwhere(np.isnan(grid)) + 1
    if missing.size:
        named = "; ".join(f"{i}, {j}" for i, j in missing[:_NAMED].tolist())
        more = f" and {len(missing) - _NAMED} more" if len(missing) > _NAMED else ""
        raise ParameterError(
            f"{where}: all {grid.shape[0]} x {grid.shape[1]} points must be in the file, but "
            f"{len(missing)} are missing: row, column {named}{more}. Measure them, or leave this "
            "tooth out."
        )
    if middle_is_zero:
        if grid.shape[0] % 2 == 0 or grid.shape[1] % 2 == 0:
            raise ParameterError(
                f"{where}: a grid of {grid.shape[0]} x {grid.shape[1]} points has no middle point. "
                'Set middle_point = "measured".'
            )
        middle = float(grid[grid.shape[0] // 2, grid.shape[1] // 2])
        if abs(middle) > _ZERO:
            raise ParameterError(
                f"{where}: the middle point must be 0 within {_ZERO:g} um, got {middle:g} um. Set "
                'middle_point = "measured", or check the order of rows and columns.'
            )
