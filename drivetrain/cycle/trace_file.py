"""Traces in text files: columns with their unit in the name, or with VECTO's identifiers."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.table import COMMENTS, Table, read_table

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
VECTO = ".vdri"
_UNITS = {"t": "s", "s": "m", "v": "km/h", "grad": "%", "stop": "s"}  # that are read
_IDENTIFIER = re.compile(r"<?([^<>\[\]]+?)>?\s*(?:\[(.*)\])?")
# km/h, m/s2, m/s2: speed, acceleration, deceleration of the driver in VECTO's Truck.vacc
_DRIVER = ((0, 25, 50, 60, 120), (1, 1, 0.642857143, 0.5, 0.5), (1, 1, 1, 0.5, 0.5))
_STEP = 2.0  # m, of the driven speed
_CURE = (
    "Give a table with the columns time_s and speed_kmh, a cycle of VECTO (.vdri), or the name of "
    "a cycle."
)


def read_trace(path: Path) -> dict[str, Any]:
    """Return time [s] and the other quantities of a table in SI units, lines and notes on them.

    Units are in the names of the columns, see `COLUMNS`; the file is as `read_table` says. A file
    .vdri or names in <> are a driving cycle of VECTO, over time or distance.

    Raises
    ------
    ParameterError
        The file is missing, a column is unknown or stands twice, or a field is no number.
    """
    vecto = path.suffix.lower() == VECTO
    comments = (*COMMENTS, "c ") if vecto else COMMENTS  # VECTO 2 wrote units after "c "
    table = read_table(path, fewest=2, cure=_CURE, comments=comments)
    if vecto or any(name.startswith("<") for name in table.names):
        return _of_vecto(table) | {"speed_unit": "km/h"}
    head = [name.lower() for name in table.names]
    _check_head(path, head)
    columns = {COLUMNS[name][0]: COLUMNS[name][1] * table.column(name) for name in head}
    unit = "km/h" if "speed_kmh" in head else "mph" if "speed_mph" in head else "m/s"
    return columns | {"lines": np.array(table.lines), "speed_unit": unit}


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


def _of_vecto(table: Table) -> dict[str, Any]:
    """Return the trace of a driving cycle of VECTO: <t> or <s>, <v>, <grad> and <stop>."""
    named: dict[str, str] = {}
    for name in table.names:
        found = _IDENTIFIER.fullmatch(name)
        key, unit = (found[1].lower(), found[2]) if found else (name, None)
        if unit and unit != _UNITS.get(key, unit):
            raise ParameterError(
                f"{table.path}: <{key}> must be in {_UNITS[key]}, got [{unit}]. Convert the column."
            )
        if named.setdefault(key, name) != name:
            raise ParameterError(f"{table.path} must have <{key}> once. Keep one column.")
    if "v" not in named:
        raise ParameterError(
            f"{table.path} must have the column <v>, the speed of the vehicle in km/h, got "
            f"{', '.join(table.names)}. Cycles of engine or wheel power are not read."
        )
    by_distance = "s" in named and "t" not in named
    used = ("s", "v", "grad", "stop") if by_distance else ("t", "v", "grad")
    columns = {key: table.column(name) for key, name in named.items() if key in used}
    left = [named[key] for key in named if key not in used]
    notes = [f"Columns of the cycle that are not used: {', '.join(left)}."] if left else []
    speed, lines = columns["v"] / 3.6, np.array(table.lines)
    grade = {"grade": 0.01 * columns["grad"]} if "grad" in columns else {}
    if not by_distance:
        time = columns.get("t", np.arange(float(speed.size)))  # without <t>: a row each second
        return {"time": time, "speed": speed, **grade, "lines": lines, "notes": tuple(notes)}
    stop = columns.get("stop", np.zeros_like(speed))
    _check_way(table, columns["s"], speed, stop)
    time, speed, rows = _driven(columns["s"], speed, stop)
    notes.append(
        "The cycle gives target speeds over distance. They are driven with the acceleration and "
        "deceleration of VECTO's truck driver, 1 to 0.5 m/s2."
    )
    at_rows = {name: values[rows] for name, values in (grade | {"lines": lines}).items()}
    return {"time": time, "speed": speed, **at_rows, "notes": tuple(notes)}


def _check_way(table: Table, place: Array, target: Array, stop: Array) -> None:
    rule = (
        f"{table.path} must have rising distances <s>, speeds <v> from 0 up, some above 0, and "
        "times <stop> from 0 up"
    )
    wrong = np.flatnonzero((np.diff(place, prepend=-np.inf) <= 0.0) | (target < 0.0) | (stop < 0.0))
    if wrong.size:
        row = wrong[0]
        raise ParameterError(
            f"{rule}; got {place[row]:g} m, {3.6 * target[row]:g} km/h and {stop[row]:g} s in line "
            f"{table.lines[row]}. Sort the rows and remove repeated distances."
        )
    if not np.any(target > 0.0):
        raise ParameterError(f"{rule}; got no speed above 0. Give the target speeds.")


def _driven(place: Array, target: Array, stop: Array) -> tuple[Array, Array, Array]:
    """Return times [s] a second apart, speeds [m/s] and rows of the cycle there.

    A target holds from its row to the next; a stop is a row with speed 0 and a time. Within the
    limits of the driver the speed is the highest that no later target forbids.
    """
    moving = np.flatnonzero(target > 0.0)
    stands = (target == 0.0) & (stop > 0.0)
    asked = target[
        moving[np.searchsorted(moving, np.arange(target.size)).clip(max=moving.size - 1)]
    ]
    nodes = np.unique(
        np.r_[place, 0.5 * (place[1:] + place[:-1]), np.arange(place[0], place[-1], _STEP)]
    )
    before, after = (
        asked[(np.searchsorted(place, nodes, side) - 1).clip(0, place.size - 2)]
        for side in ("left", "right")
    )
    limit = np.minimum(before, after)
    limit[np.searchsorted(nodes, place[stands])] = 0.0
    limit[[0, -1]] *= target[[0, -1]] > 0.0
    speeds, steps = limit.tolist(), np.diff(nodes).tolist()
    knots = np.array(_DRIVER[0]) / 3.6
    for limits, order, ahead in (
        (_DRIVER[1], range(len(steps)), 1),
        (_DRIVER[2], range(len(steps) - 1, -1, -1), 0),
    ):
        for k in order:  # each node from the one before it in the order
            known = speeds[k + 1 - ahead]
            if speeds[k + ahead] > known:
                rate = np.interp(known, knots, limits)
                reached = math.sqrt(known**2 + 2.0 * rate * steps[k])
                speeds[k + ahead] = min(speeds[k + ahead], reached)
    speed = np.array(speeds)
    waits = np.zeros(nodes.size)
    waits[np.searchsorted(nodes, place[stands])] = stop[stands]
    leaves = np.r_[0.0, np.cumsum(2.0 * np.array(steps) / (speed[1:] + speed[:-1]))]
    leaves += np.cumsum(waits)
    clock = np.column_stack([leaves - waits, leaves]).ravel()
    time = np.append(np.arange(0.0, clock[-1] - 0.5), clock[-1])
    rows = np.searchsorted(place, np.interp(time, clock, np.repeat(nodes, 2)), "right") - 1
    return time, np.interp(time, clock, np.repeat(speed, 2)), rows
