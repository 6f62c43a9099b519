"""Sound pressure level over time, with and without A-weighting."""

from __future__ import annotations

import numpy as np

from gearlube.studies.sound.a_weighting import REFERENCE
from gearlube_core.arrays import Array

FAST = 0.125  # s, time weighting F
SILENCE = 1e-9  # Pa, -86 dB: what silence counts as


def decibels(pressure: Array | float) -> Array:
    """Return the level of an rms pressure [dB re 20 uPa].

    Examples
    --------
    >>> float(decibels(1.0).round(2))
    93.98
    """
    return np.asarray(20.0 * np.log10(np.maximum(pressure, SILENCE) / REFERENCE))


def fast_level(pressure: Array, rate: float, times: Array) -> Array:
    """Return the level with time weighting F [dB re 20 uPa] at `times` [s from the first sample].

    The weighting is exponential with 0.125 s [iec_61672_1], and starts at the mean of the first
    0.125 s.
    """
    from scipy.signal import lfilter

    decay = np.exp(-1.0 / (FAST * rate))
    square = pressure**2
    start = float(np.mean(square[: max(1, int(FAST * rate))]))
    smooth, _ = lfilter([1.0 - decay], [1.0, -decay], square, zi=[decay * start])
    at = np.clip(np.round(times * rate).astype(int), 0, pressure.size - 1)
    return decibels(np.sqrt(np.maximum(smooth[at], 0.0)))
