"""Time histories and spectra as universal file, dataset 58."""

from __future__ import annotations

import logging
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.exports.records import Record, record_count, record_names, records
from gearlube_core.errors import ParameterError
from gearlube_core.extras import extra_package
from gearlube_core.storage.atomic_file import atomic_write

logger = logging.getLogger("gearlube")

RECORD_LIMIT = 10_000
_GENERAL, _TIME_RESPONSE = 0, 1  # function types; pyuff writes no 12, spectrum
_AXES = {"s": 17, "Hz": 18}  # specific data types: time, frequency
_ORDER = 20
_ORDINATES = {"m": 8, "N": 9, "m/s": 11, "m/s2": 12, "Pa": 15}  # displacement, reaction force ...
_LINE, _LABEL, _ENTITY = 80, 20, 10  # characters of the format
_EVEN = 1e-5  # of a step: float32 axes


def write_uff58(dataset: xr.Dataset, path: Path) -> list[Path]:
    """Write a record for each time history and spectrum, in SI units; return the path.

    Raises
    ------
    ParameterError
        The package pyuff is missing. No such variable, too many records, or a value that is not
        there within a record.
    """
    pyuff = extra_package("pyuff", "sound", "A universal file is written")
    names = record_names(dataset)
    others = [str(name) for name in dataset.data_vars if name not in names]
    if not names:
        raise ParameterError(
            "A universal file (dataset 58) must hold time histories or spectra, got "
            f"{', '.join(others) or 'none'}. Choose another format, such as csv or mat."
        )
    if others:
        logger.info(
            "Left out, because they are no time histories or spectra: %s", ", ".join(others)
        )
    count = sum(record_count(dataset, name) for name in names)
    if count > RECORD_LIMIT:
        raise ParameterError(
            f"A universal file must have at most {RECORD_LIMIT} records, got {count} of "
            f"{', '.join(names)}. Choose variables with --variable, or a part with --span."
        )
    title = str(dataset.attrs.get("title") or dataset.attrs.get("name") or "gearlube")
    units: dict[str, Any] = {"type": 164, "units_code": 1, "units_description": "SI"}
    units |= {"temp_mode": 1, "length": 1.0, "force": 1.0, "temp": 1.0, "temp_offset": 273.15}
    with (
        atomic_write(path) as partial,
        partial.open("wb") as whole,
        TemporaryDirectory() as folder,
    ):
        one = Path(folder, "record.uff")

        def add(record: dict[str, Any]) -> None:  # pyuff reads the whole file at each record
            one.touch()
            pyuff.UFF(str(one)).write_sets(record, "overwrite")
            whole.write(one.read_bytes())

        add(units)
        written = 0
        for name in names:
            for record in records(dataset, name):
                add(_set(record, title))
                written += 1
        if not written:
            raise ParameterError(
                f"A universal file must hold values, got none in {', '.join(names)}. Check whether "
                "all points were computed."
            )
    if written < count:
        logger.warning("%d of %d records have no value and were left out", count - written, count)
    return [path]


def _set(record: Record, title: str) -> dict[str, Any]:
    _check(record)
    steps = np.diff(record.x)
    even = bool(np.abs(steps - steps.mean()).max() <= _EVEN * abs(steps.mean()))
    x = np.linspace(record.x[0], record.x[-1], record.x.size) if even else record.x
    index = {dim: k for dim, k, _, _ in record.places}
    names = [str(value) for _, _, value, _ in record.places if isinstance(value, str)]
    numbers = [place for place in record.places if not isinstance(place[2], str)]
    z = numbers[-1] if numbers else None
    entity = next((str(value) for dim, _, value, _ in record.places if dim == "bearing"), "NONE")
    node = index.get("bearing", 0) + 1
    direction = index.get("direction", index.get("axis", -1)) + 1
    return {
        "type": 58,
        "func_type": _TIME_RESPONSE if record.axis_unit == "s" else _GENERAL,
        "id1": " ".join([record.name, *names])[:_LINE],
        "id2": (record.meaning or "NONE")[:_LINE],
        "id3": (", ".join(_words(place) for place in numbers) or "NONE")[:_LINE],
        "id4": title[:_LINE],
        "id5": "gearlube",
        "rsp_ent_name": entity[:_ENTITY],
        "rsp_node": node,
        "rsp_dir": direction,
        "ref_node": 0,
        "ref_dir": 0,
        "abscissa_spacing": int(even),
        "abscissa_spec_data_type": _ORDER
        if record.axis == "order"
        else _AXES.get(record.axis_unit, 0),
        "abscissa_axis_lab": record.axis[:_LABEL],
        "abscissa_axis_units_lab": record.axis_unit[:_LABEL] or "NONE",
        "ordinate_spec_data_type": _ORDINATES.get(record.unit, 0),
        "ordinate_axis_lab": record.name[:_LABEL],
        "ordinate_axis_units_lab": record.unit[:_LABEL] or "NONE",
        "orddenom_spec_data_type": 0,
        "z_axis_spec_data_type": 0,
        "z_axis_value": 0.0 if z is None else float(z[2]),  # type: ignore[arg-type]
        "z_axis_axis_lab": "NONE" if z is None else z[0][:_LABEL],
        "z_axis_axis_units_lab": "NONE" if z is None else z[3][:_LABEL] or "NONE",
        "x": x,
        "data": record.y,
    }


def _words(place: tuple[str, int, object, str]) -> str:
    name, _, value, unit = place
    return f"{name} {value:.6g} {unit if unit != '1' else ''}".rstrip()


def _check(record: Record) -> None:
    if record.x.size < 2:
        raise ParameterError(
            f"A record of a universal file must have at least two points, got {record.x.size} of "
            f"{record.name}. Take a longer --span, or leave it out with --variable."
        )
    lacking = int(np.count_nonzero(~np.isfinite(record.y)))
    if lacking:
        raise ParameterError(
            f"A universal file must have a number at each point, got none at {lacking} of "
            f"{record.y.size} points of {record.name}. Choose a --span without them."
        )
