"""A-weighting of sound pressure."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array

REFERENCE = 20e-6  # Pa
_F1, _F2, _F3, _F4 = 20.60, 107.7, 737.9, 12194.0  # Hz
_AT_1_KHZ = 10.0 ** (2.000 / 20.0)


def a_weighting(frequency: Array) -> Array:
    """Return the factor on pressure of the A-weighting [-], 1 at 1 kHz: [iec_61672_1].

    Examples
    --------
    >>> (20.0 * np.log10(a_weighting(np.array([100.0, 1000.0, 10000.0])))).round(1)
    array([-19.1,   0. ,  -2.5])
    """
    square = np.asarray(frequency, dtype=np.float64) ** 2
    rest = (square + _F1**2) * (square + _F4**2)
    rest = rest * np.sqrt((square + _F2**2) * (square + _F3**2))
    return np.asarray(_AT_1_KHZ * _F4**2 * square**2 / rest)


def a_weighted(pressure: Array, rate: float) -> Array:
    """Return a signal with A-weighted magnitude and unchanged phase [Pa], shape (n,)."""
    from scipy.fft import irfft, next_fast_len, rfft

    size = next_fast_len(2 * pressure.size, real=True)
    f = np.fft.rfftfreq(size, 1.0 / rate).astype(np.float64)
    return np.asarray(irfft(rfft(pressure, size) * a_weighting(f), size)[: pressure.size])
