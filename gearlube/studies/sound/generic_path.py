"""A generic transfer path, for comparisons where none was measured."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gearlube.studies.sound.transfer_path import TransferPath

PLATEAU = 1e-4  # Pa/N
FIRST_MODES, FALL = 100.0, 1500.0  # Hz
BAND = (20.0, 16000.0)  # Hz
_GOLDEN = 0.381966  # of a turn between two paths
_POLES, _SPACING, _LOWEST_POLE = 10, 4.0, 1.0  # of the all-pass networks; Hz
WORDS = (
    "generic path, not measured: 1e-4 Pa/N between 100 and 1500 Hz, 12 dB per octave lower on "
    "either side; levels are for comparison, not a prediction"
)


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
