"""Measured frequency responses from a CSV file with units in its headings."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from gearlube.studies.sound.transfer_path import Complex, TransferPath, generic_path
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.table import read_table

AXLE_FORCES = tuple(
    f"{bearing}.{direction}"
    for bearing in ("pinion", "gear")
    for direction in ("axial", "radial 1", "radial 2")
)
_HEADING = re.compile(r"^\s*(?P<what>.+?)\s*\[(?P<unit>[^\]]*)\]\s*$")
_PARTS: dict[str, dict[str, float | None]] = {
    "real": {"Pa/N": 1.0},
    "imag": {"Pa/N": 1.0},
    "magnitude": {"Pa/N": 1.0, "dB re 20 uPa/N": None, "dB re 1 Pa/N": None},
    "phase": {"deg": np.pi / 180.0, "rad": 1.0},
}
_REFERENCE = {"dB re 20 uPa/N": 20e-6, "dB re 1 Pa/N": 1.0}
_CURE = (
    "Headings: 'frequency [Hz]', then for every path either 'pinion.axial real [Pa/N]' and "
    "'pinion.axial imag [Pa/N]', or 'pinion.axial magnitude [Pa/N]' and 'pinion.axial phase [deg]'."
)


def read_csv_path(file: Path) -> TransferPath:
    """Return the transfer path in a CSV file; `docs/sound.md` describes its headings.

    Raises
    ------
    ParameterError
        The file cannot be read, see `read_table`; a heading has no unit or is not known, or half
        of a pair is missing.
    """
    table = read_table(file, fewest=2, cure=_CURE)
    columns: dict[tuple[str, str], Array] = {}
    frequency = None
    for heading in table.names:
        path, part, unit = _meaning(heading, file)
        values = table.column(heading)
        if part == "frequency":
            frequency = values
        elif unit in _REFERENCE:
            columns[path, part] = _REFERENCE[unit] * 10.0 ** (values / 20.0)
        else:
            columns[path, part] = values * (_PARTS[part][unit] or 1.0)
    if frequency is None:
        raise ParameterError(f"{file} must have a column 'frequency [Hz]', got none. {_CURE}")
    paths = list(dict.fromkeys(path for path, _ in columns))
    responses = {path: _response(path, columns, file) for path in paths}
    return TransferPath(source=file.name, frequency=frequency, responses=responses)


def example_text() -> str:
    """Return the generic path of the hypoid axle's six bearing forces as the text of a CSV file."""
    path = generic_path(AXLE_FORCES)
    low, high = path.band
    count = round(12.0 * np.log2(high / low))  # 12 in an octave
    frequency = low * (high / low) ** np.linspace(0.0, 1.0, count + 1)
    head, columns = ["frequency [Hz]"], [frequency]
    for name in AXLE_FORCES:
        response = path.at(name, frequency)
        head += [f"{name} magnitude [dB re 20 uPa/N]", f"{name} phase [deg]"]
        columns += [20.0 * np.log10(np.abs(response) / 20e-6), np.angle(response, deg=True)]
    rows = "".join(",".join(f"{one:.6g}" for one in row) + "\n" for row in np.column_stack(columns))
    return f"# {path.source}. Put measured values in place.\n{','.join(head)}\n{rows}"


def _meaning(heading: str, file: Path) -> tuple[str, str, str]:
    """Return path, part and unit of a heading."""
    found = _HEADING.match(heading)
    if found is None:
        raise ParameterError(f"The heading {heading!r} of {file} must contain its unit. {_CURE}")
    what, unit = found["what"], found["unit"].strip().replace("µ", "u").replace("μ", "u")
    if what.lower() == "frequency":
        if unit != "Hz":
            raise ParameterError(f"The frequency in {file} must be in Hz, got [{unit}]. {_CURE}")
        return "", "frequency", unit
    path, _, part = what.rpartition(" ")
    part = part.lower()
    if not path or part not in _PARTS:
        raise ParameterError(
            f"The heading {heading!r} of {file} must name a path and real, imag, magnitude or "
            f"phase. {_CURE}"
        )
    if unit not in _PARTS[part]:
        raise ParameterError(
            f"The unit of {heading!r} in {file} must be {' or '.join(_PARTS[part])}, got "
            f"[{unit}]. {_CURE}"
        )
    return path, part, unit


def _response(path: str, columns: dict[tuple[str, str], Array], file: Path) -> Complex:
    parts = {part for name, part in columns if name == path}
    if parts == {"real", "imag"}:
        return np.asarray(columns[path, "real"] + 1j * columns[path, "imag"])
    if parts == {"magnitude", "phase"}:
        return np.asarray(columns[path, "magnitude"] * np.exp(1j * columns[path, "phase"]))
    raise ParameterError(
        f"{path} in {file} must have real and imag, or magnitude and phase, got "
        f"{', '.join(sorted(parts))}. {_CURE}"
    )
