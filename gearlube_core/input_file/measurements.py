"""Measurements with their uncertainty: tables whose columns name every unit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_units import field_unit
from gearlube_core.input_file.table import Table, read_table

_RELATIVE = "uncertainty_percent"
_EFFICIENCY = "efficiency_percent"
_NAMED = 5  # points that are named one by one


@dataclass(frozen=True, slots=True)
class Kind:
    """Quantity that a table measures, and the study that predicts it."""

    words: str  # with their article
    values: tuple[str, ...]  # columns of what was measured, of which a table has one
    # columns that say where, with their limits; without its unit each names a dimension of results
    conditions: Mapping[str, tuple[float, float]]
    command: str
    file: str  # of results; "": it is computed at each point
    variable: str  # in it
    unit: str = "N.m"
    uncertainty: str = "uncertainty_n_m"  # column of it in that unit


_SPEED, _DEGC = {"speed_rpm": (0.1, 47_000.0)}, {"temperature_degc": (-60.0, 250.0)}
_TORQUE, _LOAD = {"torque_n_m": (-1e5, 1e5)}, (0.0, 1e8)
KINDS = MappingProxyType(
    {
        "axle_loss": Kind(
            "the loss torque of an axle",
            ("torque_loss_n_m", _EFFICIENCY),
            _SPEED | _TORQUE | _DEGC,
            *("gearlube map", "map.nc", "loss_torque"),
        ),
        "bearing_torque": Kind(
            "the friction torque of a bearing",
            ("friction_torque_n_m",),
            _SPEED | dict.fromkeys(("axial_load_n", "radial_load_n"), _LOAD) | _DEGC,
            *("gearlube bearing", "bearing.nc", "torque"),
        ),
        "transmission_error": Kind(
            "the transmission error by order of the mesh frequency",
            ("transmission_error_urad",),
            _TORQUE | {"order": (1.0, 100.0)},
            *("gearlube contact", "contact.nc", "amplitude", "urad", "uncertainty_urad"),
        ),
        "film": Kind(
            "the central film of a point contact",
            ("central_film_nm",),
            {"entrainment_m_s": (1e-6, 200.0), "load_n": (1e-3, 1e6)} | _DEGC,
            *("gearlube ehl point", "", "", "nm", "uncertainty_nm"),
        ),
    }
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Measurements:
    """Measured values with their uncertainty and where they were measured.

    Parameters
    ----------
    path : str
        Path of the measured table.
    kind : str
        Key of `KINDS`.
    lines : ndarray of int, shape (n,)
        Lines of the table.
    conditions : mapping of str to ndarray of shape (n,)
        By the names of the columns, in their units.
    value, uncertainty : ndarray of shape (n,)
        In the unit of the kind; with 95 % the true value is within `uncertainty` (k = 2).
    """

    path: str
    kind: str
    lines: Array
    conditions: Mapping[str, Array]
    value: Array
    uncertainty: Array

    def where(self, k: int) -> str:
        """Return line and conditions of point k, for errors and tables."""
        words = []
        for name, values in self.conditions.items():
            unit, ending = field_unit(name)
            words.append(f"{name.removesuffix(ending)} {values[k]:g} {unit}".strip())
        return f"line {self.lines[k]} ({', '.join(words).replace('_', ' ')})"

    def chosen(self, points: Flags) -> Measurements:
        """Return the points that are true in an array of shape (n,)."""
        return replace(
            self,
            lines=self.lines[points],
            conditions={name: values[points] for name, values in self.conditions.items()},
            value=self.value[points],
            uncertainty=self.uncertainty[points],
        )

    def named(self, points: Flags) -> str:
        """Return a list of points in words; the rest as a number."""
        places = np.flatnonzero(points)
        more = f" and {places.size - _NAMED} more" if places.size > _NAMED else ""
        return "; ".join(self.where(int(k)) for k in places[:_NAMED]) + more


def read_measurements(path: str | Path, *, fewest: int = 1) -> Measurements:
    r"""Return the measurements of a table; its columns say what was measured.

    Parameters
    ----------
    path
        A table as of `read_table` with the columns of one of `KINDS`: all its conditions, one of
        its values, and its uncertainty (k = 2) in the unit of the value, or uncertainty_percent of
        the value. An efficiency is in percent, and its uncertainty in points of percent.
    fewest
        Points that are needed.

    Raises
    ------
    ParameterError
        No column says what was measured, or its unit; no uncertainty; a value out of its limits;
        fewer points than needed.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "loss.csv"
    ...     _ = file.write_text(
    ...         "speed_rpm,torque_n_m,temperature_degc,torque_loss_n_m,uncertainty_percent\n"
    ...         "1000,50,60,2.5,4\n"
    ...     )
    ...     found = read_measurements(file)
    >>> found.kind, found.uncertainty.round(3).tolist()  # N.m
    ('axle_loss', [0.1])
    """
    listed = {value: kind for kind, one in KINDS.items() for value in one.values}
    columns = "; ".join(
        f"for {one.words} {', '.join(one.conditions)} and {' or '.join(one.values)}"
        for one in KINDS.values()
    )
    cure = "The end of a name is the unit, such as _n_m or _degc."
    table = read_table(path, fewest=fewest, cure=f"Give the columns {columns}. {cure}")
    measured = [name for name in listed if name in table.places]
    if len(measured) != 1:
        raise ParameterError(
            f"{path} must have one column of what was measured, got "
            f"{', '.join(measured) or 'none of them'} among {', '.join(table.names)}. Give the "
            f"columns {columns}. {cure}"
        )
    kind = KINDS[listed[measured[0]]]
    uncertainty = [name for name in (kind.uncertainty, _RELATIVE) if name in table.places]
    if len(uncertainty) != 1:
        raise ParameterError(
            f"{path} must have one column {kind.uncertainty} or {_RELATIVE}, got "
            f"{' and '.join(uncertainty) or 'none'}. Give the uncertainty with k = 2: the true "
            "value is within it with 95 %."
        )
    table = read_table(path, tuple(kind.conditions), cure=cure)
    conditions = {
        name: table.column(name, low, high, field_unit(name)[0])
        for name, (low, high) in kind.conditions.items()
    }
    for row in table if "order" in conditions else ():
        row.whole("order", 1, 100)
    value, expanded = _measured(table, measured[0], uncertainty[0], conditions)
    return Measurements(
        path=str(path),
        kind=listed[measured[0]],
        lines=np.array(table.lines),
        conditions=conditions,
        value=value,
        uncertainty=expanded,
    )


def _measured(
    table: Table, name: str, uncertainty: str, conditions: Mapping[str, Array]
) -> tuple[Array, Array]:
    """Return values and their uncertainties; of an efficiency those of the loss torque."""
    unit = "%" if uncertainty == _RELATIVE else field_unit(uncertainty)[0]
    given = table.column(
        uncertainty, 1e-9, 1e6, unit, "No measurement is exact: the uncertainty must be above 0."
    )
    if name != _EFFICIENCY:
        value = table.column(name, -1e6, 1e6)
        if unit == "%" and not value.all():
            raise ParameterError(
                f"{table.path}, line {table.lines[int(np.argmin(np.abs(value)))]}: {name} must not "
                f"be 0 with {uncertainty}, got 0. Give the uncertainty in the unit of the value."
            )
        return value, 0.01 * np.abs(value) * given if unit == "%" else given
    torque = np.abs(conditions["torque_n_m"])
    if not torque.all():
        idle = table.lines[int(np.argmin(torque))]
        raise ParameterError(
            f"{table.path}, line {idle}: {name} must be of a torque other than 0 N.m, got 0 N.m. "
            "Give torque_loss_n_m: without torque there is no efficiency."
        )
    share = 0.01 * table.column(name, 1.0, 100.0, "%")
    drives = conditions["torque_n_m"] > 0.0  # else the wheels drive, and the torque is the output
    loss = np.where(drives, torque * (1.0 - share), torque * (1.0 / share - 1.0))
    if unit != "%":
        return loss, given
    return loss, np.where(drives, torque, torque / share**2) * 0.01 * given
