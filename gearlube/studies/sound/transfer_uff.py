"""Measured frequency responses from a universal file, dataset 58."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from gearlube.studies.sound.transfer_path import Complex, TransferPath
from gearlube_core.arrays import Array
from gearlube_core.errors import FileError, ParameterError, unread

_RESPONSE_FUNCTION = 4  # function type of a frequency response
_PRESSURE, _FORCE = (15,), (9, 13)  # specific data types: pressure; reaction and excitation force
_CURE = (
    "In every record of type 58 the reference is the force: its entity name is the bearing, or its "
    "node is the number of the bearing in the run; direction 1, 2, 3 is the direction in the run."
)


def read_uff_path(file: Path, bearings: Sequence[str], directions: Sequence[str]) -> TransferPath:
    """Return the transfer path in a UFF58 file.

    Parameters
    ----------
    file : Path
    bearings, directions : sequence of str
        Names in the run: the reference of a record is found by name, or by number from 1.

    Raises
    ------
    FileError
        The file cannot be read, or the package pyuff is missing.
    ParameterError
        No frequency response of pressure over force, or one whose reference is no force of the
        run.
    """
    responses: dict[str, Complex] = {}
    frequency: Array | None = None
    for record in _records(file):
        if record.get("type") != 58 or record.get("func_type") != _RESPONSE_FUNCTION:
            continue
        _check_units(record, file)
        path, sign = _path_of(record, bearings, directions, file)
        x = np.asarray(record["x"], dtype=np.float64)
        if frequency is not None and (x.shape != frequency.shape or not np.allclose(x, frequency)):
            raise ParameterError(
                f"All responses in {file} must have the same frequencies, got others for {path}. "
                "Export them with one resolution."
            )
        if path in responses:
            raise ParameterError(
                f"{file} must hold one response for each force, got two for {path}. Keep the one "
                "at the listener's ear."
            )
        frequency = x
        responses[path] = sign * np.asarray(record["data"], dtype=np.complex128)
    if frequency is None:
        raise ParameterError(
            f"{file} must hold frequency responses (dataset 58, function type 4), got none. {_CURE}"
        )
    return TransferPath(source=file.name, frequency=frequency, responses=responses)


def _records(file: Path) -> list[dict[str, Any]]:
    try:
        import pyuff
    except ImportError:
        raise FileError(
            f"{file} is read by the package pyuff, which is not installed. Install it: "
            "pip install 'gearlube[sound]'. Or give the responses as CSV."
        ) from None
    try:
        with file.open("rb"):
            pass
        found = pyuff.UFF(str(file)).read_sets()
    except OSError as reason:
        raise FileError(f"{unread('transfer path', file, reason)}.") from None
    except Exception as reason:  # pyuff raises plain Exception, ValueError and others
        raise FileError(f"{file} must be a universal file, it is not: {reason}.") from None
    return [found] if isinstance(found, dict) else list(found)


def _check_units(record: dict[str, Any], file: Path) -> None:
    above, below = (
        int(record.get(name, 0)) for name in ("ordinate_spec_data_type", "orddenom_spec_data_type")
    )
    labels = [
        str(record.get(name, "")).strip()
        for name in ("ordinate_axis_units_lab", "orddenom_axis_units_lab")
    ]
    typed = above in _PRESSURE and below in _FORCE
    labelled = labels[0] == "Pa/N" or labels == ["Pa", "N"]
    if labels[0] not in ("", "NONE", "Pa", "Pa/N") or labels[1] not in ("", "NONE", "N"):
        typed = labelled = False
    if not (typed or labelled):
        raise ParameterError(
            f"The responses in {file} must be pressure over force in Pa/N, got data types "
            f"{above} over {below} with the labels {labels[0] or 'none'!r} and "
            f"{labels[1] or 'none'!r}. Set the types to 15 (pressure) and 13 (force), or the label "
            "to Pa/N."
        )


def _path_of(
    record: dict[str, Any], bearings: Sequence[str], directions: Sequence[str], file: Path
) -> tuple[str, float]:
    name, node = str(record.get("ref_ent_name", "")).strip(), int(record.get("ref_node", 0))
    way = int(record.get("ref_dir", 0))
    bearing = name if name in bearings else ""
    if not bearing and 1 <= node <= len(bearings):
        bearing = bearings[node - 1]
    if not bearing or not 1 <= abs(way) <= len(directions):
        raise ParameterError(
            f"The reference of a response in {file} must be a force of the run, got entity "
            f"{name or 'none'!r}, node {node}, direction {way}; the run has the bearings "
            f"{', '.join(bearings)} and {len(directions)} directions. {_CURE}"
        )
    return f"{bearing}.{directions[abs(way) - 1]}", 1.0 if way > 0 else -1.0
