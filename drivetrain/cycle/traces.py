"""A drive cycle: speed over time, or pinion speed and torque as measured."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError
from gearlube_core.extras import extra_package
from gearlube_core.input_file.table import TABLES

_KMH = 1.0 / 3.6
_COLD_PHASE = 505  # s, that a hot start repeats
_WLTC_SUM = 83758.6  # km/h, of all 1801 speeds of class 3b
_FTP75_DISTANCE = 17_769.0  # m

# Seconds and the speed at their end [km/h]; between the ends the speed is a straight line.
# [unece_2012 Annex 4a, tables 1 and 2]; while gears are changed the speed is held.
URBAN = (
    (11, 0), (4, 15), (8, 15), (2, 10), (3, 0),
    (21, 0), (5, 15), (2, 15), (5, 32), (24, 32), (8, 10), (3, 0),
    (21, 0), (5, 15), (2, 15), (9, 35), (2, 35), (8, 50), (12, 50), (8, 35), (13, 35), (2, 35),
    (7, 10), (3, 0), (7, 0),
)  # fmt: skip

EXTRA_URBAN = (
    (20, 0), (5, 15), (2, 15), (9, 35), (2, 35), (8, 50), (2, 50), (13, 70), (50, 70),
    (8, 50), (69, 50), (13, 70), (50, 70), (35, 100), (30, 100), (20, 120), (10, 120),
    (16, 80), (8, 50), (10, 0), (20, 0),
)  # fmt: skip


def nedc() -> tuple[Array, Array]:
    """Return time [s] and speed [m/s] at 1 Hz: four urban cycles and one extra-urban.

    Notes
    -----
    1180 s, up to 120 km/h [unece_2012 Annex 4a]. Straight lines between the ends make 11.028 km;
    the regulation states 4.052 and 6.955 km, 0.2 % less.

    Examples
    --------
    >>> time, speed = nedc()
    >>> time[-1], round(float(np.trapezoid(speed, time)))  # s, m
    (np.float64(1180.0), 11028)
    """
    seconds, ends = np.array((*URBAN,) * 4 + EXTRA_URBAN, dtype=float).T
    corners = np.concatenate([[0.0], np.cumsum(seconds)])
    time = np.arange(corners[-1] + 1.0)
    return time, np.interp(time, corners, np.concatenate([[0.0], ends])) / 3.6


def ftp75() -> tuple[Array, Array]:
    """Return time [s] and speed [m/s] of FTP-75 [epa_2014], from the UDDS of `fastsim`.

    Notes
    -----
    The UDDS, then its first 505 s again. The soak of 10 min between them is left out.

    Raises
    ------
    ParameterError
        The package is missing, or its trace is not the one of the regulation.
    """
    module = _package("fastsim", "ftp75")
    held = _read("fastsim", lambda: module.Cycle.from_resource("udds.csv").to_dict())
    time = np.array(_read("fastsim", lambda: held["time_seconds"]), dtype=float)
    speed = np.array(_read("fastsim", lambda: held["speed_meters_per_second"]), dtype=float)
    if not np.array_equal(time, np.arange(1370.0)) or speed.size != time.size:
        raise _wrong("fastsim", f"{time.size} speeds", "1370, one each second")
    whole = np.concatenate([speed, speed[1 : _COLD_PHASE + 1]])
    seconds = np.arange(float(whole.size))
    distance = float(np.trapezoid(whole, seconds))
    if abs(distance - _FTP75_DISTANCE) > 5.0:
        raise _wrong("fastsim", f"{distance:.0f} m", f"{_FTP75_DISTANCE:.0f} m")
    return seconds, whole


def wltc() -> tuple[Array, Array]:
    """Return time [s] and speed [m/s] of the WLTC of class 3b [unece_2014], from `wltp`.

    Raises
    ------
    ParameterError
        The package is missing, or its trace is not the one of the regulation.
    """
    module = _package("wltp.cycles.class3", "wltc")
    kmh = np.array(_read("wltp", lambda: module.class_data_b()["cycle"]), dtype=float)
    total = float(kmh.sum())
    if kmh.size != 1801 or abs(total - _WLTC_SUM) > 0.05:
        raise _wrong("wltp", f"{kmh.size} speeds with sum {total:.1f} km/h", f"1801, {_WLTC_SUM}")
    return np.arange(1801.0), kmh * _KMH


def _read(package: str, held: Callable[[], Any]) -> Any:
    try:
        return held()
    except (AttributeError, KeyError, TypeError, OSError) as reason:
        raise ParameterError(
            f"The package {package} does not hold its trace where it should: {reason!r}. Install "
            "the version that gearlube asks for: pip install 'gearlube[cycles]'."
        ) from None


def _package(module: str, cycle: str) -> Any:
    instead = (
        "Or give the trace as a CSV file with the columns time_s and speed_kmh, or take nedc, "
        "which needs no package."
    )
    return extra_package(module, "cycles", f"The cycle {cycle} is held", instead)


def _wrong(package: str, got: str, limit: str) -> ParameterError:
    return ParameterError(
        f"The trace of the package {package} must have {limit}; got {got}. Install the version "
        "that gearlube asks for: pip install 'gearlube[cycles]', or give a CSV file."
    )


NAMED: dict[str, Callable[[], tuple[Array, Array]]] = {"nedc": nedc, "wltc": wltc, "ftp75": ftp75}
MOST_ROWS = 200_000
FASTEST = 90.0  # m/s
PER_M_S = {"m/s": 1.0, "km/h": 3.6, "mph": 1.0 / 0.44704}  # units of speed in files
_LONGEST_STEP, _SHORTEST_GAP = 5.0, 2.0  # s
_USUAL_STEPS = 10.0  # that a gap lasts
HARDEST = 8.0, 12.0  # m/s2: two driven tyres on dry road; four that brake
_STEEPEST = 0.5
# sensor noise around rest: below half of the 1 km/h under which a car stands in tests of real
# driving (Regulation (EU) 2017/1151, Annex IIIA, 6.8); 0.5 km/h is about 15 rpm of a pinion
_NOISE = {"speed": (0.5 / 3.6, 3.6, "km/h"), "pinion_speed": (1.6, 30.0 / np.pi, "rpm")}


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveCycle:
    """A drive cycle: vehicle speed over time, or pinion speed and torque as measured.

    All quantities are linear between two rows.

    Parameters
    ----------
    name : str
    time : ndarray of shape (n,)
        Times [s], rising. No step is longer than 5 s, or longer than ten usual steps if it is above
        2 s.
    speed : ndarray of shape (n,), optional
        Vehicle speed, 0 to 90 [m/s]. It rises by at most 8 m/s2 and falls by at most 12 m/s2.
    grade : ndarray of shape (n,), optional
        Slope of the road, rise over horizontal distance [-], -0.5 to 0.5. Default: that of the
        vehicle.
    pinion_speed, pinion_torque : ndarray of shape (n,), optional
        Measured pinion speed and torque, instead of speed and grade [rad/s], [N.m]; torque below 0:
        coast.
    lines : ndarray of shape (n,), optional
        Line of each row in its file, for errors. Default: rows are counted from 1.
    speed_unit : str
        Unit of the speed in its file for errors, km/h or mph. Default: m/s.
    notes : tuple of str
        What was done to the trace, in sentences. Speeds down to -0.5 km/h and pinion speeds down to
        -15 rpm are noise of a sensor at rest: they become 0, with a note.

    Raises
    ------
    ParameterError
        A row is wrong; the message says which.

    Examples
    --------
    >>> cycle = DriveCycle.named("nedc")
    >>> round(cycle.distance), cycle.duration  # m, s
    (11028, 1180.0)
    """

    name: str
    time: Array
    speed: Array | None = None
    grade: Array | None = None
    pinion_speed: Array | None = None
    pinion_torque: Array | None = None
    lines: Array | None = None
    speed_unit: str = "m/s"
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        check_option("speed_unit", self.speed_unit, PER_M_S)
        measured = self.pinion_speed is not None and self.pinion_torque is not None
        partly = self.pinion_speed is not None or self.pinion_torque is not None
        if measured == (self.speed is not None) or partly != measured:
            raise ParameterError(
                f"{self.name} must have either speed, or pinion speed and pinion torque; got "
                f"{', '.join(self._given()) or 'none of them'}. Give one kind of trace."
            )
        if measured and self.grade is not None:
            raise ParameterError(
                f"{self.name} has a measured torque, which includes the effect of the grade, but "
                "got a grade too. Remove the grade."
            )
        for name in ("time", *self._given(), "grade"):
            values = getattr(self, name)
            if values is not None:
                object.__setattr__(self, name, self._checked(name, values))
        self._check_time()
        self._check_values()

    def _given(self) -> list[str]:
        names = ("speed", "pinion_speed", "pinion_torque")
        return [name for name in names if getattr(self, name) is not None]

    def _place(self, row: int) -> str:
        """Return where a row, counted from 0, stands."""
        return f"row {row + 1}" if self.lines is None else f"line {self.lines[row]} of its file"

    def _checked(self, name: str, values: Array) -> Array:
        found = np.array(values, dtype=float)
        rows = np.size(self.time)
        if found.ndim != 1 or found.size != rows or not 2 <= rows <= MOST_ROWS:
            raise ParameterError(
                f"{name} of {self.name} must be a list of 2 to {MOST_ROWS} numbers, as many as "
                f"times; got shape {found.shape}, and {rows} times. Give each row a time and a "
                "value."
            )
        bad = np.flatnonzero(~np.isfinite(found))
        if bad.size:
            raise ParameterError(
                f"{name} of {self.name} must be finite, got {found[bad[0]]} in "
                f"{self._place(bad[0])}, and {bad.size} such rows in all. Fill them from their "
                "neighbours, or remove them."
            )
        found.flags.writeable = False
        return found

    def _check_time(self) -> None:
        steps = np.diff(self.time)
        if np.any(steps <= 0.0):
            row = int(np.argmax(steps <= 0.0)) + 1
            raise ParameterError(
                f"The time of {self.name} must rise, got {self.time[row]:g} s in "
                f"{self._place(row)} after {self.time[row - 1]:g} s. Sort the rows, or cut the "
                "file where the clock starts again."
            )
        usual = float(np.median(steps))
        limit = min(_LONGEST_STEP, max(_SHORTEST_GAP, _USUAL_STEPS * usual))
        if np.any(steps > limit):
            row = int(np.argmax(steps > limit)) + 1
            raise ParameterError(
                f"A step of {self.name} must be at most {limit:g} s, got {steps[row - 1]:g} s "
                f"before {self._place(row)}. Fill the gap, or cut the file there; a cycle given "
                "by its corners needs rows between, such as one a second. Times are in seconds."
            )

    def _rest_is_zero(self, name: str) -> None:
        """Take the noise of a sensor at rest as 0; refuse a car that drives backwards."""
        values = getattr(self, name)
        noise, factor, unit = _NOISE[name]
        back = np.flatnonzero(values < -noise)
        if back.size:
            raise ParameterError(
                f"{name} of {self.name} must be at least {-factor * noise:.3g} {unit}, got "
                f"{factor * values[back[0]]:.3g} {unit} in {self._place(back[0])}, and "
                f"{back.size} such rows in all. Driving backwards is not modelled: cut these rows "
                "out, or write 0 there. If the car drives forwards, change the sign of the column."
            )
        below = np.flatnonzero(values < 0.0)
        if below.size:
            object.__setattr__(self, name, np.maximum(values, 0.0))
            note = (
                f"{below.size} of {values.size} rows have a {name.replace('_', ' ')} from "
                f"{factor * values.min():.3g} {unit} to 0: noise of a sensor at rest, taken as 0."
            )
            object.__setattr__(self, "notes", (*self.notes, note))

    def _check_values(self) -> None:
        from gearlube_core.dynamics.ranges import MAX_SPEED  # imports what computes

        self._rest_is_zero("pinion_speed" if self.speed is None else "speed")
        if self.speed is None:
            self._within(
                "pinion_speed", 0.0, MAX_SPEED, "rad/s", "Name the column pinion_speed_rpm?"
            )
            return
        cure, each = "Are these km/h? Then name the column speed_kmh.", "m/s2"
        unit, factor = self.speed_unit, PER_M_S[self.speed_unit]
        if unit != "m/s":
            cure, each = "Correct the rows, or the unit of the column.", f"{unit} per s"
        self._within("speed", 0.0, FASTEST, unit, cure)
        if self.grade is not None:
            self._within(
                "grade", -_STEEPEST, _STEEPEST, "", "5 % is 0.05, or name it grade_percent."
            )
        gained = np.diff(self.speed) / np.diff(self.time)
        bad = (gained > HARDEST[0]) | (gained < -HARDEST[1])
        if np.any(bad):
            row = int(np.argmax(bad)) + 1
            raise ParameterError(
                f"The acceleration of {self.name} must be within {-factor * HARDEST[1]:.3g} to "
                f"{factor * HARDEST[0]:.3g} {each}, the most that tyres can transmit; got "
                f"{factor * gained[row - 1]:.3g} {each} before {self._place(row)}. Smooth the "
                f"speed if it is noise. {cure} Times are in seconds."
            )

    def _within(self, name: str, low: float, high: float, unit: str, cure: str) -> None:
        values, factor = getattr(self, name), PER_M_S.get(unit, 1.0)
        shown = f" {unit}" if unit else ""
        bad = np.flatnonzero((values < low) | (values > high))
        if bad.size:
            raise ParameterError(
                f"{name} of {self.name} must be within {factor * low:g} to {factor * high:g}"
                f"{shown}, got {factor * values[bad[0]]:g}{shown} in {self._place(bad[0])}. {cure}"
            )

    @property
    def measured(self) -> bool:
        """Whether speed and torque of the pinion are given."""
        return self.speed is None

    @property
    def duration(self) -> float:
        """From the first row to the last [s]."""
        return float(self.time[-1] - self.time[0])

    @property
    def distance(self) -> float:
        """Way of the vehicle [m]; NaN where the speed of the pinion is given."""
        return float("nan") if self.speed is None else float(np.trapezoid(self.speed, self.time))

    @classmethod
    def named(cls, name: str) -> DriveCycle:
        """Return nedc, wltc (class 3b) or ftp75.

        nedc is built from its definition. The others are read from packages:
        `pip install 'gearlube[cycles]'`.
        """
        if name not in NAMED:
            raise ParameterError(
                f"A cycle must be one of {', '.join(NAMED)}, got {name!r}. A trace of your own "
                "is a table (CSV) or a cycle of VECTO (.vdri)."
            )
        time, speed = NAMED[name]()
        return cls(name=name, time=time, speed=speed)

    @classmethod
    def read(cls, path: str | Path) -> DriveCycle:
        """Return the cycle of a table or of VECTO (.vdri), see `trace_file.read_trace`."""
        from drivetrain.cycle.trace_file import read_trace

        return cls(name=Path(path).stem, **read_trace(Path(path)))

    @classmethod
    def given(cls, text: str) -> DriveCycle:
        """Return the cycle of a name, or of a file if the text ends like one or is a path."""
        if text.lower() in NAMED:
            return cls.named(text.lower())
        if text.lower().endswith((*TABLES, ".vdri")) or Path(text).exists():
            return cls.read(text)
        return cls.named(text)
