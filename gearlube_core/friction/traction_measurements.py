"""Measured traction of a rolling and sliding contact, from a table."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError
from gearlube_core.friction.traction_curve import CONTACTS, MAX_OVER_MEAN
from gearlube_core.input_file.table import Table, read_table
from gearlube_core.units import celsius_to_kelvin

FEWEST_POINTS = 5
# column: low, high, unit, cure
_COLUMNS = {
    "slide_roll_ratio": (-2.0, 2.0, "", "It is sliding speed over mean speed; 5 % is 0.05."),
    "sliding_speed_m_s": (-200.0, 200.0, "m/s", "It is the difference of the surface speeds."),
    "entrainment_speed_m_s": (0.001, 200.0, "m/s", "It is the mean of the surface speeds."),
    "mean_pressure_gpa": (0.05, 5.0, "GPa", "500 MPa is 0.5 GPa."),
    "hertz_pressure_gpa": (0.05, 5.0, "GPa", "500 MPa is 0.5 GPa."),
    "temperature_degc": (-60.0, 250.0, "degC", "Of the oil at the inlet; 333 K is 60 degC."),
    "traction_coefficient": (-0.5, 0.5, "", "Traction over load; 5 % is 0.05."),
}
_ALWAYS = ("entrainment_speed_m_s", "temperature_degc", "traction_coefficient")
_EITHER = (
    ("slide_roll_ratio", "sliding_speed_m_s"),
    ("mean_pressure_gpa", "hertz_pressure_gpa"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionMeasurements:
    """Measured points, arrays of shape (n,).

    Parameters
    ----------
    sliding_speed, entrainment_speed : ndarray
        Difference, without sign, and mean of the surface speeds [m/s].
    mean_pressure : ndarray
        [Pa].
    temperature : ndarray
        Of the oil at the inlet [K].
    traction : ndarray
        Coefficient, without sign [-].
    """

    sliding_speed: Array
    entrainment_speed: Array
    mean_pressure: Array
    temperature: Array
    traction: Array

    def __len__(self) -> int:
        return self.traction.size

    @property
    def curve(self) -> npt.NDArray[np.intp]:
        """Number of the curve of each point: equal speed, pressure and temperature."""
        conditions = np.column_stack([self.entrainment_speed, self.mean_pressure, self.temperature])
        return np.unique(np.round(conditions, 6), axis=0, return_inverse=True)[1].reshape(-1)


def read_traction(path: str | Path, contact: str) -> TractionMeasurements:
    """Return the measurements of a table, see `read_table`.

    Parameters
    ----------
    path : path
        Columns `slide_roll_ratio` or `sliding_speed_m_s`,
        `entrainment_speed_m_s`, `mean_pressure_gpa` or `hertz_pressure_gpa` (the largest),
        `temperature_degc`, `traction_coefficient`. Other columns are not read.
    contact : {"point", "line"}
        From which follows the mean of a largest Hertz pressure.

    Raises
    ------
    ParameterError
        The file cannot be read, a column is missing or there twice, or a number is wrong.
    """
    check_option("contact", contact, CONTACTS)
    table = read_table(path, _ALWAYS, fewest=FEWEST_POINTS)
    needed = (*_ALWAYS, *(_either(path, table, pair) for pair in _EITHER))
    slip, pressure = needed[len(_ALWAYS) :]
    data = {name: table.column(name, *_COLUMNS[name]) for name in needed}
    speed = data["entrainment_speed_m_s"]
    sliding = data[slip] * speed if slip == "slide_roll_ratio" else data[slip]
    if not np.any(sliding):
        raise ParameterError(f"{path} must have points with sliding, got none.")
    # without the sign of braking or driving, if traction has that of sliding
    sign = np.where(sliding < 0.0, -1.0, 1.0) if np.any(data["traction_coefficient"] < 0.0) else 1.0
    mean = data[pressure] * 1e9
    if pressure == "hertz_pressure_gpa":
        mean = mean / MAX_OVER_MEAN[contact]
    return TractionMeasurements(
        sliding_speed=np.abs(sliding),
        entrainment_speed=speed,
        mean_pressure=mean,
        temperature=np.array([celsius_to_kelvin(t) for t in data["temperature_degc"]]),
        traction=sign * data["traction_coefficient"],
    )


def _either(path: str | Path, table: Table, pair: tuple[str, str]) -> str:
    found = [name for name in pair if name in table.places]
    if len(found) != 1:
        raise ParameterError(
            f"{path} must have one of the columns {pair[0]} and {pair[1]}, got "
            f"{'both' if found else f'none of them among {chr(44).join(table.names)}'}."
        )
    return found[0]
