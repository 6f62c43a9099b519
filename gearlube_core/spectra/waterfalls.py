"""Spectra over frequency of a signal that changes with time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError


@dataclass(frozen=True, slots=True, kw_only=True)
class Waterfall:
    """Amplitude spectra at times that follow each other.

    Parameters
    ----------
    time : array
        Middle of every slice [s], shape (slices,).
    frequency : array
        [Hz], shape (bins,).
    amplitude : array
        Half of peak-to-peak, in the unit of the signal, shape (slices, bins).
    """

    time: Array
    frequency: Array
    amplitude: Array


def waterfall(
    signal: Array, sample_rate: float, *, resolution: float, highest_frequency: float
) -> Waterfall:
    """Return Hann-weighted spectra of slices that overlap by three quarters.

    Parameters
    ----------
    signal : array
        Equally spaced samples, shape (n,); time 0 is the first.
    sample_rate : float
        [Hz]
    resolution : float
        Distance of the bins [Hz]; a slice is 1/resolution long.
    highest_frequency : float
        End of the spectra [Hz].

    Raises
    ------
    ParameterError
        The signal is shorter than a slice, or the spectra would go beyond half the sample rate.
    """
    from scipy.signal import ShortTimeFFT  # slow to import
    from scipy.signal.windows import hann

    check_positive("resolution", resolution, "Hz")
    check_within("highest_frequency", highest_frequency, resolution, 0.5 * sample_rate, "Hz")
    size = round(sample_rate / resolution)
    if signal.size < size:
        raise ParameterError(
            f"The signal must last {1.0 / resolution:g} s for a resolution of {resolution:g} Hz, "
            f"got {signal.size / sample_rate:g} s. Record for longer."
        )
    transform = ShortTimeFFT(
        hann(size, sym=False),
        hop=max(1, size // 4),
        fs=sample_rate,
        fft_mode="onesided2X",
        scale_to="magnitude",
    )
    inside = slice(
        transform.lower_border_end[1] - transform.p_min,
        transform.upper_border_begin(signal.size)[1] - transform.p_min,
    )
    mean = float(np.mean(signal))
    spectra = np.abs(transform.stft(signal - mean))[:, inside]
    keep = transform.f <= highest_frequency * (1.0 + 1e-12)
    return Waterfall(
        time=transform.t(signal.size)[inside],
        frequency=transform.f[keep],
        amplitude=spectra[keep].T,
    )
