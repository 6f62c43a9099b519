"""Transfer paths from bearing forces to sound pressure: measured, or a generic one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

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
