"""Read a transfer path for a run: a file, or the generic one."""

from __future__ import annotations

from pathlib import Path

from gearlube.studies.sound.force_record import ForceRecord
from gearlube.studies.sound.generic_path import generic_path
from gearlube.studies.sound.transfer_csv import read_csv_path
from gearlube.studies.sound.transfer_path import TransferPath
from gearlube.studies.sound.transfer_uff import read_uff_path
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.table import TABLES

_UFF = (".uff", ".unv", ".uf", ".58")


def read_transfer(file: Path | str | None, record: ForceRecord) -> TransferPath:
    """Return the transfer path of a file for the forces of a run; None: the generic one.

    Raises
    ------
    FileError, ParameterError
        The file cannot be read, is of another kind, or lacks a response.
    """
    if file is None:
        return generic_path(record.paths)
    path = Path(file)
    if path.suffix.lower() in _UFF:
        named = [one.partition(".") for one in record.paths]
        bearings = list(dict.fromkeys(bearing for bearing, _, _ in named))
        directions = list(dict.fromkeys(direction for _, _, direction in named))
        found = read_uff_path(path, bearings, directions)
    elif path.suffix.lower() in TABLES:
        found = read_csv_path(path)
    else:
        raise ParameterError(
            f"A transfer path must be a table ({', '.join(TABLES)}) or a universal file "
            f"({', '.join(_UFF)}), got {path}."
        )
    found.check_paths(record.paths)
    return found
