"""A generic transfer path, for comparisons where none was measured."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gearlube.studies.sound.transfer_path import TransferPath

PLATEAU = 1e-3  # Pa/N
FIRST_MODES, FALL = 100.0, 1500.0  # Hz
BAND = (20.0, 16000.0)  # Hz
_FIRST_DELAY, _DELAY_STEP = 1.0e-3, 0.618034 * 1.7e-3  # s
_LARGEST_DELAY = 6.0e-3  # s
WORDS = (
    "generic path, not measured: 1e-3 Pa/N between 100 and 1500 Hz, 12 dB per octave lower on "
    "either side; levels are for comparison, not a prediction"
)


def generic_path(paths: Sequence[str]) -> TransferPath:
    """Return the generic path: the same smooth magnitude for every force, each with its own delay.

    H_j(f) = H_0 (f/f_1)^2 / D(f/f_1) / D(f/f_2) exp(-2 pi i f tau_j),
    D(r) = 1 - r^2 + i sqrt(2) r

    with H_0 = 1e-3 Pa/N, f_1 = 100 Hz, f_2 = 1500 Hz. tau_j lies between 1 and 6 ms.

    Parameters
    ----------
    paths : sequence of str
        "bearing.direction" of every force.

    Notes
    -----
    Where many damped modes overlap, the response of a structure tends to the smooth curve of an
    endless one, the mean-value curve of [skudrzyk_1980]; a constant number of modes per Hz
    gives a plateau. Below f_1 a body has no modes; above f_2 bushings and trim isolate. The three
    numbers are assumed, not taken from a car. Delays let paths add in changing phase, so that
    they neither cancel nor add throughout; without them opposite forces on a shaft would be
    silent. Range: 20 Hz to 16 kHz. The response is causal.
    """
    low, high = BAND
    f = low * (high / low) ** np.linspace(0.0, 1.0, 2001)

    def second_order(ratio: np.ndarray) -> np.ndarray:
        return 1.0 - ratio**2 + 1j * np.sqrt(2.0) * ratio

    rise, fall = f / FIRST_MODES, f / FALL
    # (i f/f_1)^2 of a high-pass filter: the sign belongs to it, or the response is not causal
    shape = -PLATEAU * rise**2 / second_order(rise) / second_order(fall)
    span = _LARGEST_DELAY - _FIRST_DELAY
    responses = {}
    for j, path in enumerate(paths):
        delay = _FIRST_DELAY + (j * _DELAY_STEP) % span
        responses[path] = shape * np.exp(-2j * np.pi * f * delay)
    return TransferPath(source=WORDS, frequency=f, responses=responses, generic=True)
