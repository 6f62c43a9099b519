"""Signals at another rate."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from gearlube_core.arrays import Array

_DENOMINATOR = 2000  # rates are ratios of smaller numbers; 32768 Hz is 256/375 of 48 kHz


def resampled(signal: Array, ratio: float) -> Array:
    """Return a signal at `ratio` times its rate, from its Fourier coefficients.

    What the new rate holds keeps its level exactly; the rest is cut off. The signal must be about
    zero at both ends, as it is continued by zeros.

    Examples
    --------
    >>> tone = np.sin(2.0 * np.pi * np.arange(4000) / 8.0) * np.hanning(4000)
    >>> twice = resampled(tone, 2.0)
    >>> twice.size, bool(np.allclose(twice[::2], tone, atol=1e-6))
    (8000, True)
    """
    from scipy.fft import next_fast_len
    from scipy.signal import resample

    exact = Fraction(ratio).limit_denominator(_DENOMINATOR)
    up, down = exact.numerator, exact.denominator
    if up == down:
        return signal
    pieces = next_fast_len(-(-signal.size // down) + 1)
    padded = np.concatenate([signal, np.zeros(pieces * down - signal.size)])
    size = -(-signal.size * up // down)
    return np.asarray(resample(padded, pieces * up)[:size])
