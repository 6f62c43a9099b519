"""Rows of a CSV file of measured values, each with its line."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gearlube_core.errors import ParameterError, why
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Role, Side

_SHOWN = 60  # characters of a wrong line
_ROLES: tuple[Role, Role] = ("pinion", "gear")


@dataclass(frozen=True, slots=True)
class Row:
    """One line of a CSV file.

    Parameters
    ----------
    where : str
        File and line, for errors.
    entries : mapping of str to str
        By column.
    """

    where: str
    entries: Mapping[str, str]

    def role(self) -> Role:
        """Return the member: "pinion" or "gear"."""
        given = self.entries["member"].lower()
        for role in _ROLES:
            if given == role:
                return role
        raise ParameterError(
            f"{self.where}: member must be pinion or gear, got {given!r}. The gear is the larger "
            "one, also called wheel or ring gear."
        )

    def side(self, role: Role) -> Side:
        """Return the flank: "drive" or "coast"; "convex" and "concave" are turned into these."""
        given = self.entries["flank"].lower()
        for (member, side), curve in CURVES.items():
            if member == role and given in (side, curve):
                return side
        raise ParameterError(
            f"{self.where}: flank must be drive, coast, convex or concave, got {given!r}. Left and "
            "right depend on who looks; the drive flank of the gear is convex, that of the pinion "
            "concave."
        )

    def whole(self, name: str, low: int, high: int) -> int:
        """Return a whole number of a column, `low` to `high`."""
        given = self.entries[name]
        try:
            value = int(given)
        except ValueError:
            value = low - 1
        if not low <= value <= high:
            raise ParameterError(
                f"{self.where}: {name} must be a whole number from {low} to {high}, got {given!r}. "
                "Count from 1."
            )
        return value

    def number(self, name: str, low: float, high: float, cure: str) -> float:
        """Return a number of a column, `low` to `high` in the column's unit."""
        given = self.entries[name]
        try:
            value = float(given)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise ParameterError(
                f"{self.where}: {name} must be a number from {low:g} to {high:g}, got {given!r}. "
                f"{cure}"
            )
        return value


def read_rows(path: str | Path, columns: tuple[str, ...]) -> list[Row]:
    """Return the rows of a CSV file with these columns; lines that begin with # are left out.

    Raises
    ------
    ParameterError
        The file is missing, has other columns or a line with too few or too many entries.
    """
    try:
        lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as reason:
        raise ParameterError(f"{path} is not a readable CSV file: {why(reason)}.") from None
    found = [
        (number, [entry.strip() for entry in row])
        for number, row in enumerate(csv.reader(lines), 1)
        if row and not row[0].lstrip().startswith("#")
    ]
    head = ",".join(columns)
    if not found or found[0][1] != list(columns):
        got = ",".join(found[0][1])[:_SHOWN] if found else "an empty file"
        raise ParameterError(
            f"{path} must begin with the line {head}, got {got!r}. Lines before it begin with #."
        )
    rows = []
    for number, entries in found[1:]:
        if len(entries) != len(columns):
            raise ParameterError(
                f"{path}, line {number}: must have {len(columns)} entries ({head}), got "
                f"{len(entries)}: {','.join(entries)[:_SHOWN]!r}. Write a point as decimal mark "
                "and a comma between entries."
            )
        row = dict(zip(columns, entries, strict=True))
        rows.append(Row(f"{path}, line {number}", row))
    if not rows:
        raise ParameterError(f"{path} has no values under its first line. Add them.")
    return rows
