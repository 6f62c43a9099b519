"""Transfer path: frequency responses from bearing forces to sound pressure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

Complex = NDArray[np.complex128]


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
