"""Transfer paths from bearing forces to sound pressure: measured ones, or a generic one."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.table import read_table

Complex = NDArray[np.complex128]
PLATEAU = 1e-4  # Pa/N
FIRST_MODES, FALL = 100.0, 1500.0  # Hz
BAND = (20.0, 16000.0)  # Hz
_GOLDEN = 0.381966  # of a turn between two paths
_POLES, _SPACING, _LOWEST_POLE = 10, 4.0, 1.0  # of the all-pass networks; Hz
WORDS = (
    "generic path, not measured: 1e-4 Pa/N between 100 and 1500 Hz, 12 dB per octave lower on "
    "either side; levels are for comparison, not a prediction"
)
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


@dataclass(frozen=True, slots=True, kw_only=True)
class TransferPath:
    """Pressure per force of every path, time factor exp(+i omega t).

    Parameters
    ----------
    source : str
        File or formula, in words.
    frequency : array
        Rising [Hz], shape (m,).
    responses : mapping of arrays
        Pressure per force of each path "bearing.direction" [Pa/N], complex, shape (m,).
    generic : bool
        Not measured: levels are for comparison only.
    """

    source: str
    frequency: Array
    responses: Mapping[str, Complex]
    generic: bool = False

    def __post_init__(self) -> None:
        f = self.frequency
        if f.ndim != 1 or f.size < 2 or not np.all(np.diff(f) > 0.0) or f[0] < 0.0:
            raise ParameterError(
                f"The frequencies of {self.source} must rise from 0 Hz or above, at least two of "
                f"them, got {f.size}. Sort the rows and remove repeated ones."
            )
        for path, response in self.responses.items():
            if response.shape != f.shape or not np.all(np.isfinite(response)):
                raise ParameterError(
                    f"The response {path} of {self.source} must be finite at all {f.size} "
                    "frequencies. Fill the gaps, or leave the rows out."
                )

    @property
    def band(self) -> tuple[float, float]:
        """Lowest frequency above 0 and highest frequency [Hz]."""
        above = self.frequency[self.frequency > 0.0]
        return float(above[0]), float(self.frequency[-1])

    def check_paths(self, paths: Sequence[str]) -> None:
        """Raise ParameterError unless there is a response for every force of a run."""
        missing = [path for path in paths if path not in self.responses]
        if missing:
            raise ParameterError(
                f"The transfer path {self.source} must have a response for every force of the run; "
                f"missing: {', '.join(missing)}; got {', '.join(self.responses) or 'none'}. Name "
                "the columns like this; give zeros for a path that was not measured."
            )

    def at(self, path: str, frequency: Array) -> Complex:
        """Return the response at other frequencies within the band [Pa/N].

        Magnitude in dB and unwrapped phase are interpolated linearly, so that a delay stays one;
        a response that is zero at a neighbour is interpolated by real and imaginary part.
        """
        response = self.responses[path]
        size = np.abs(response)
        if np.any(size == 0.0):
            real, imaginary = (
                np.interp(frequency, self.frequency, part)
                for part in (response.real, response.imag)
            )
            return np.asarray(real + 1j * imaginary)
        phase = np.interp(frequency, self.frequency, np.unwrap(np.angle(response)))
        level = np.interp(frequency, self.frequency, np.log(size))
        return np.asarray(np.exp(level + 1j * phase))


def generic_path(paths: Sequence[str]) -> TransferPath:
    """Return the generic path: the same smooth magnitude for every force, phases apart.

    H_j(f) = -H_0 (f/f_1)^2 / D(f/f_1) / D(f/f_2) A_j(f),   D(r) = 1 - r^2 + i sqrt(2) r
    A_j(f) = prod_k (1 - i f/p_jk) / (1 + i f/p_jk),   p_jk = 4^(k + 2 s_j) Hz, k = 0 ... 9

    with H_0 = 1e-4 Pa/N, f_1 = 100 Hz, f_2 = 1500 Hz and s_j the fraction of 0.382 j.

    Parameters
    ----------
    paths : sequence of str
        "bearing.direction" of every force.

    Notes
    -----
    Where many damped modes overlap, the response of a structure tends to the smooth curve of an
    endless one, the mean-value curve of [skudrzyk_1980]; a constant number of modes per Hz
    gives a plateau. Below f_1 a body has no modes; above f_2 bushings and trim isolate. The three
    numbers are assumed, not taken from a car. The all-pass networks A_j keep the phases of any
    two paths a nearly constant angle apart, the golden angle from one to the next. So opposite
    forces on a shaft do not cancel, and no speed is favoured. Range: 20 Hz to 16 kHz. The response
    is causal.
    """
    low, high = BAND
    f = low * (high / low) ** np.linspace(0.0, 1.0, 2001)

    def second_order(ratio: np.ndarray) -> np.ndarray:
        return 1.0 - ratio**2 + 1j * np.sqrt(2.0) * ratio

    rise, fall = f / FIRST_MODES, f / FALL
    # (i f/f_1)^2 of a high-pass filter: the sign belongs to it, or the response is not causal
    shape = -PLATEAU * rise**2 / second_order(rise) / second_order(fall)
    responses = {}
    for j, path in enumerate(paths):
        shift = _SPACING ** (2.0 * ((j * _GOLDEN) % 1.0))
        poles = _LOWEST_POLE * shift * _SPACING ** np.arange(_POLES)
        turn = np.prod((1.0 - 1j * f[:, None] / poles) / (1.0 + 1j * f[:, None] / poles), axis=1)
        responses[path] = shape * turn
    return TransferPath(source=WORDS, frequency=f, responses=responses, generic=True)


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
