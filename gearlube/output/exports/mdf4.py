"""Time histories as a measurement file, ASAM MDF 4."""

from __future__ import annotations

import logging
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.exports.packages import needed
from gearlube.output.exports.records import Record, record_names, records
from gearlube_core.errors import ParameterError
from gearlube_core.storage.atomic_file import atomic_write

logger = logging.getLogger("gearlube")

_VERSION = "4.10"
_PLAIN = ("1", "not stated")  # units that are left empty


def write_mdf4(dataset: xr.Dataset, path: Path) -> list[Path]:
    """Write a channel for each time history, a group for each time axis; return the path.

    Values keep their type. A value that is not there is marked as invalid.

    Raises
    ------
    FileError
        The package asammdf is missing.
    ParameterError
        There is no time history, or a time axis does not rise.
    """
    asammdf = needed("asammdf", "export", "A measurement file (MDF 4)")
    found = [record for name in record_names(dataset) for record in records(dataset, name)]
    groups: dict[str, list[Record]] = {}
    for record in found:
        if record.axis_unit == "s":
            groups.setdefault(record.axis, []).append(record)
    if not groups:
        raise ParameterError(
            "A measurement file (MDF 4) must hold time histories, got "
            f"{', '.join(map(str, dataset.data_vars)) or 'none'}. Choose another format, such as "
            "csv or mat."
        )
    held = {record.name for group in groups.values() for record in group}
    if others := [str(name) for name in dataset.data_vars if name not in held]:
        logger.info("No time history, left out: %s", ", ".join(others))
    for axis, group in groups.items():
        if np.any(np.diff(group[0].x) <= 0.0):
            raise ParameterError(
                f"The time of a measurement file must rise, got {axis} that does not. Leave out "
                f"{', '.join(sorted({record.name for record in group}))} with --variable."
            )
    with TemporaryDirectory() as folder, asammdf.MDF(version=_VERSION) as file:
        file.header.comment = str(dataset.attrs.get("title") or dataset.attrs.get("name") or "")
        for axis, group in groups.items():
            signals = [_signal(asammdf, dataset, record) for record in group]
            file.append(signals, acq_name=axis, comment=axis, common_timebase=True)
        made = file.save(Path(folder, "made.mf4"), overwrite=True)
        with atomic_write(path) as partial:
            shutil.copyfile(made, partial)
    return [path]


def _signal(asammdf: Any, dataset: xr.Dataset, record: Record) -> Any:
    lacking = np.isnan(record.y)
    return asammdf.Signal(
        samples=record.y.astype(dataset[record.name].dtype),
        timestamps=record.x,
        name=channel_name(record),
        unit="" if record.unit in _PLAIN else record.unit,
        comment=record.meaning,
        invalidation_bits=lacking if lacking.any() else None,
    )


def channel_name(record: Record) -> str:
    """Return the name of a history: the variable, then names and numbers of its place."""
    places = (
        str(value) if isinstance(value, str) else f"{name}_{value:g}"
        for name, _, value, _ in record.places
    )
    return ".".join((record.name, *places))
