"""Bins of torque, speed and temperature of a life: of a drive cycle, and of a table."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from gearlube.studies.drive_cycle.run import run_cycle
from gearlube.studies.drive_cycle.settings import DriveCycleSettings
from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.table import TABLES, read_table
from gearlube_core.progress import Progress, no_progress
from gearlube_core.rating.spectrum import DutyBins, duty_bins
from gearlube_core.units import ZERO_CELSIUS, celsius_to_kelvin, rpm_to_rads

WIDTHS = 20.0, rpm_to_rads(500.0), 20.0  # of a bin [N.m], [rad/s], [K]
# limits, unit and cure
_COLUMNS: dict[str, tuple[float, float, str, str]] = {
    "torque_n_m": (-1e7, 1e7, "N.m", "Below 0 it loads the coast flanks."),
    "speed_rpm": (0.01, 47000.0, "rpm", "The sign of the torque says which flank is loaded."),
    "temperature_degc": (-100.0, 300.0, "degC", "It is that of the oil; 363 K are 90 degC."),
    "hours": (1e-9, 1e7, "h", "They are of the whole life; 3600 s are 1 h. Leave out empty bins."),
}
_HEAD = 2000  # characters in which the names of the columns stand
_LEAST_SPEED = 1.0  # rad/s; below, a step counts as standstill


def cycle_bins(
    settings: DriveCycleSettings,
    distance: float,
    *,
    widths: tuple[float, float, float] = WIDTHS,
    progress: Progress = no_progress,
) -> DutyBins:
    """Return the bins of a drive cycle that is repeated over a distance.

    Parameters
    ----------
    settings
        Car, cycle and temperatures; each repeat begins at the start temperature.
    distance
        Of the life [m].
    widths
        Of a bin [N.m], [rad/s], [K].
    progress
        Called with the share that is done and a sentence.

    Examples
    --------
    >>> import gearlube as gl
    >>> speed = np.full(60, 20.0)  # m/s
    >>> trace = gl.studies.DriveCycle(name="drive", time=np.arange(60.0), speed=speed)
    >>> driven = gl.DriveCycleSettings(car=gl.read_axle("mohammadpour_2015"), cycle=trace)
    >>> round(float(cycle_bins(driven, 72e3).time.sum()))  # s, of 72 km
    3600
    """
    check_positive("distance", distance, "m", "300 000 km are usual.")
    cycle = run_cycle(replace(settings, draws=0), progress=progress)
    seconds = cycle["duration"].values
    length = float(seconds @ cycle["vehicle_speed"].values) / 3.6
    check_positive("distance of the cycle", length, "m", "Give a table of bins with hours.")
    speed = rpm_to_rads(1.0) * cycle["pinion_speed"].values
    oil = cycle["oil_temperature"].values + ZERO_CELSIUS
    turns = speed > _LEAST_SPEED
    return duty_bins(
        distance / length * seconds[turns], cycle["pinion_torque"].values[turns],
        speed[turns], (0.5 * (oil[1:] + oil[:-1]))[turns], widths=widths,
    )  # fmt: skip


def is_bins(name: str) -> bool:
    """Return whether a file is a table of bins, with hours or torques, and no drive cycle."""
    path = Path(name)
    if path.suffix.lower() not in TABLES or not path.is_file():
        return False
    head = path.read_text(encoding="utf-8", errors="replace")[:_HEAD].lower()
    return "speed_kmh" not in head and ("hours" in head or "torque_n_m" in head)


def read_bins(path: Path | str) -> DutyBins:
    r"""Return the bins of a table: torque_n_m, speed_rpm of the pinion, temperature_degc, hours.

    Raises
    ------
    ParameterError
        The file is missing, or a column or a number is wrong.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> text = "torque_n_m, speed_rpm, temperature_degc, hours\n250, 600, 90, 20"
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "bins.csv"
    ...     _ = path.write_text(text)
    ...     bins = read_bins(path)
    >>> bins.revolutions.round()
    array([720000.])
    """
    table = read_table(
        Path(path), fewest=1, cure=f"Give a table with the columns {', '.join(_COLUMNS)}."
    )
    missing = [name for name in _COLUMNS if name not in [one.lower() for one in table.names]]
    if missing:
        raise ParameterError(
            f"{path} must have the columns {', '.join(_COLUMNS)}; missing: {', '.join(missing)}. "
            "The torque is that on the pinion, below 0 for the coast flanks; hours are of the "
            "whole life."
        )
    torque, speed, temperature, hours = (
        table.column(name, *limits) for name, limits in _COLUMNS.items()
    )
    return DutyBins(torque, rpm_to_rads(1.0) * speed, celsius_to_kelvin(0.0) + temperature,
                    3600.0 * hours)  # fmt: skip


def joined(*parts: DutyBins) -> DutyBins:
    """Return the bins of several spectra, one behind the other."""
    return DutyBins(*(np.concatenate(values) for values in zip(*parts, strict=True)))


def bin_words(bins: DutyBins, place: int) -> str:
    """Return a bin in words.

    >>> bins = DutyBins(*(np.array([one]) for one in (90.0, 100.0, 353.15, 3600.0)))
    >>> bin_words(bins, 0)
    '90 N·m, 955 rpm, 80 °C'
    """
    torque, speed, temperature, _ = (float(one[place]) for one in bins)
    rpm, load = speed * 30.0 / math.pi, f"{torque:{'.3g' if abs(torque) < 999.5 else '.0f'}}"
    return f"{load} N·m, {rpm:.0f} rpm, {temperature - ZERO_CELSIUS:.0f} °C"
