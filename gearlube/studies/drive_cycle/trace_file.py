"""Traces in CSV files: the names of the columns carry the units."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

# column: quantity, and what a number is times in SI units
COLUMNS = {
    "time_s": ("time", 1.0),
    "speed_kmh": ("speed", 1.0 / 3.6),
    "speed_m_s": ("speed", 1.0),
    "speed_mph": ("speed", 0.44704),
    "grade": ("grade", 1.0),
    "grade_percent": ("grade", 0.01),
    "pinion_speed_rpm": ("pinion_speed", math.pi / 30.0),
    "pinion_speed_rad_s": ("pinion_speed", 1.0),
    "pinion_torque_n_m": ("pinion_torque", 1.0),
}
_LARGEST = 100_000_000  # bytes


def read_trace(path: Path) -> dict[str, Array]:
    """Return time [s] and the other quantities of a CSV file in SI units.

    Commas, semicolons or tabs stand between the columns; lines that begin with # are skipped. Units
    are in the names of the columns, see `COLUMNS`.

    Raises
    ------
    ParameterError
        The file is missing, a column is unknown or stands twice, or a field is no number.
    """
    lines = _lines(path)
    mark = max((",", ";", "\t"), key=lines[0].count)
    rows = list(csv.reader(lines, delimiter=mark))
    head = [one.strip().lower() for one in rows[0]]
    _check_head(path, head)
    values: dict[str, Array] = {}
    for place, column in enumerate(head):
        quantity, unit = COLUMNS[column]
        numbers = [
            _number(path, column, i, row, place, len(head)) for i, row in enumerate(rows[1:])
        ]
        values[quantity] = unit * np.array(numbers)
    return values


def _lines(path: Path) -> list[str]:
    try:
        if path.stat().st_size > _LARGEST:
            raise ParameterError(
                f"A trace must be at most {_LARGEST / 1e6:g} MB, got {path}. Take longer steps."
            )
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise ParameterError(
            f"A trace must be text in UTF-8, got {path}. Save it as CSV, not as a workbook."
        ) from None
    except OSError as reason:
        why = (reason.strerror or str(reason)).lower()
        raise ParameterError(
            f"The trace {path} cannot be read: {why}. Give a CSV file with the columns time_s and "
            "speed_kmh, or the name of a cycle."
        ) from None
    lines = [one for one in text.splitlines() if one.strip() and not one.startswith("#")]
    if len(lines) < 3:
        raise ParameterError(
            f"The trace {path} must have a line of names and at least 2 rows, got {len(lines)} "
            "lines in all. Write for instance time_s,speed_kmh and the rows below it."
        )
    return lines


def _check_head(path: Path, head: list[str]) -> None:
    unknown = [one for one in head if one not in COLUMNS]
    if unknown:
        raise ParameterError(
            f"The columns of {path} must be among {', '.join(COLUMNS)}; got "
            f"{', '.join(repr(one) for one in unknown)}. Rename or remove them: the name says "
            "the unit."
        )
    quantities = [COLUMNS[one][0] for one in head]
    twice = {one for one in quantities if quantities.count(one) > 1}
    if twice:
        raise ParameterError(
            f"{path} must give each quantity once, got {', '.join(sorted(twice))} in several "
            "columns. Keep one of them."
        )
    if "time" not in quantities:
        raise ParameterError(
            f"{path} must have the column time_s, got {', '.join(head)}. Add the time in seconds."
        )


def _number(path: Path, column: str, i: int, row: list[str], place: int, width: int) -> float:
    where = f"row {i + 1} of {path}"
    if len(row) != width:
        raise ParameterError(
            f"{where} must have {width} fields, got {len(row)}. Separate columns by one character, "
            "and write decimal numbers with a point."
        )
    try:
        return float(row[place])
    except ValueError:
        raise ParameterError(
            f"{column} in {where} must be a number, got {row[place]!r}. Write 3.5, not 3,5, and "
            "leave no field empty."
        ) from None
