"""Torque ripple and radial pull of a motor by order, over speed and torque: from a table."""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib.resources import files
from os.path import isfile
from pathlib import Path
from typing import Self

import numpy as np
import numpy.typing as npt

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.table import Row, Table, read_table
from gearlube_core.units import rpm_to_rads

_PREFIX = "ripple_"  # of the shipped files' names
_POINT = ("speed_rpm", "torque_Nm", "order")
_SHARE = "T_amp_share"
_AMPLITUDES = ("T_amp_Nm", _SHARE, "F_amp_N")
_KNOWN = (*_POINT, *_AMPLITUDES, "T_phase_deg", "F_phase_deg")
_CURE = (
    f"Columns are {', '.join(_POINT)}, T_amp_Nm or {_SHARE} with T_phase_deg, and F_amp_N with "
    "F_phase_deg."
)
MOST_ORDER = 10_000.0
_MOST_SPEED, _MOST_TORQUE, _MOST_PULL = 1e5, 1e5, 1e7  # rpm, N.m, N
_MOST_POINTS = 100_000


def skew_factor(order: float, angle: float, steps: int = 0) -> float:
    """Return the share of torque ripple of an order that skew leaves [-].

    |sin(nu e / 2) / (nu e / 2)|, or in K steps |sin(nu e / 2) / (K sin(nu e / (2 K)))|

    Parameters
    ----------
    order : float
        Order nu, ripples a revolution [-].
    angle : float
        e, over the whole length; that of K steps is K times the angle from one to the next [rad].
    steps : int
        K; 0 for a skew without steps, 1 for none.

    Examples
    --------
    >>> slot = math.radians(7.5)
    >>> round(skew_factor(24, slot), 6), round(skew_factor(24, slot, steps=2), 6)
    (0.63662, 0.707107)
    """
    half = 0.5 * order * angle
    if steps == 0:
        return abs(float(np.sinc(half / math.pi)))
    below = steps * math.sin(half / steps)
    # where all steps are in phase again both are zero
    return abs(math.sin(half) / below) if abs(below) > 1e-9 else 1.0


@dataclass(frozen=True, eq=False, kw_only=True)
class RippleTable:
    """Amplitudes of a motor by order, at the points of a grid of speed and torque.

    Parameters
    ----------
    speeds : ndarray of shape (n,)
        Rising [rad/s].
    torques : ndarray of shape (m,)
        Rising [N.m].
    orders : ndarray of shape (k,)
        Per revolution of the rotor.
    torque : ndarray of shape (k, n, m)
        Complex amplitudes: the torque is the real part of a exp(i order angle) [N.m].
    pull : ndarray of shape (k, n, m)
        Likewise of the force on the rotor, which turns: x + i y = a exp(i order angle) [N].

    Examples
    --------
    >>> table = RippleTable.named("48_slots_8_poles")
    >>> table.orders.tolist()
    [0.0, 1.0, 24.0, 48.0, 72.0]
    """

    speeds: Array
    torques: Array
    orders: Array
    torque: npt.NDArray[np.complex128]
    pull: npt.NDArray[np.complex128]

    @classmethod
    def named(cls, name: str) -> Self:
        """Return a shipped table, of an assumed machine: 48_slots_8_poles."""
        path = files("gearlube_core.dynamics.train") / "data" / f"{_PREFIX}{name}.csv"
        if not isfile(str(path)):  # false for a name that no file can have
            raise ParameterError(
                f"No ripple table of the name {name!r} is shipped. Known: 48_slots_8_poles. A file "
                "of your own ends with .csv."
            )
        return cls.read(str(path))

    @classmethod
    def read(cls, path: str | Path) -> Self:
        """Return the table of a CSV file.

        Columns are speed_rpm, torque_Nm and order; T_amp_Nm, or T_amp_share of torque_Nm, with
        T_phase_deg; F_amp_N with F_phase_deg. All orders have rows for all speeds and torques.

        Raises
        ------
        ParameterError
            A column is unknown or missing, a number is out of range, or a row is missing or twice.
        """
        table = read_table(path, _POINT, cure=_CURE)
        _check_columns(table)
        rows: dict[tuple[float, float, float], Row] = {}
        for row in table:
            order = row.number("order", 0.0, MOST_ORDER, "", "Give the absolute value.")
            speed = row.number("speed_rpm", 0.0, _MOST_SPEED, "rpm", "Give the absolute value.")
            torque = row.number("torque_Nm", 0.0, _MOST_TORQUE, "N.m", "Give the absolute value.")
            if (order, speed, torque) in rows:
                raise ParameterError(
                    f"{row.where}: order {order:g} at {speed:g} rpm and {torque:g} N.m is there "
                    "twice. Keep one row."
                )
            rows[order, speed, torque] = row
        orders, speeds, torques = (sorted({key[i] for key in rows}) for i in range(3))
        shape = len(orders), len(speeds), len(torques)
        if math.prod(shape) > _MOST_POINTS:
            raise ParameterError(
                f"{path} must have at most {_MOST_POINTS} points of orders, speeds and torques, "
                f"got {' x '.join(map(str, shape))}. Leave some out."
            )
        found = np.zeros((2, *shape), dtype=complex)
        for i, order in enumerate(orders):
            for j, speed in enumerate(speeds):
                for k, torque in enumerate(torques):
                    one = rows.get((order, speed, torque))
                    if one is None:
                        raise ParameterError(
                            f"{path}: order {order:g} lacks the row of {speed:g} rpm and "
                            f"{torque:g} N.m. All orders must have rows for all speeds and "
                            "torques; give 0 where one does not act."
                        )
                    found[:, i, j, k] = _amplitudes(one, table.places, torque)
        return cls(
            speeds=np.array([rpm_to_rads(one) for one in speeds]),
            torques=np.array(torques),
            orders=np.array(orders),
            torque=found[0],
            pull=found[1],
        )

    @classmethod
    def given(cls, text: str) -> Self:
        """Return the table of a file, or the shipped one where `text` is no path."""
        is_file = bool(Path(text).suffix) or len(Path(text).parts) > 1
        return cls.read(text) if is_file else cls.named(text)


def _check_columns(table: Table) -> None:
    there, known = table.places, [one.casefold() for one in _KNOWN]
    unknown = [name for name in table.names if name.casefold() not in known]
    if unknown:
        raise ParameterError(f"{table.path} has the unknown column {unknown[0][:60]!r}. {_CURE}")
    given = [one for one in _AMPLITUDES if one.casefold() in there]
    if not given or given[:2] == list(_AMPLITUDES[:2]):
        raise ParameterError(
            f"{table.path} must have amplitudes of torque in one column, or of pull, got "
            f"{', '.join(given) or 'none'}. {_CURE}"
        )


def _amplitudes(row: Row, there: dict[str, int], torque: float) -> tuple[complex, complex]:
    """Return the complex amplitudes of torque [N.m] and pull [N] of a row."""

    def number(name: str, most: float, unit: str, least: float = 0.0) -> float:
        return row.number(name, least, most, unit) if name.casefold() in there else 0.0

    phases = [math.radians(number(f"{c}_phase_deg", 3600.0, "deg", -3600.0)) for c in "TF"]
    size = number("T_amp_Nm", _MOST_TORQUE, "N.m") + torque * number(_SHARE, 1.0, "")
    pull = number("F_amp_N", _MOST_PULL, "N")
    return (complex(size * np.exp(1j * phases[0])), complex(pull * np.exp(1j * phases[1])))
