"""Amplitude spectra over orders of a shaft, waterfalls, and extremes of a signal."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.spectra.angle_grid import AngleWindow

_END = 6  # intervals after which the end condition of the spline has decayed to (sqrt(3) - 2)^6


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Extremes:
    """Smallest, largest and mean value of a signal, in the unit of the signal."""

    minimum: float
    maximum: float
    mean: float

    @property
    def peak_to_peak(self) -> float:
        """Difference between the largest and the smallest value."""
        return self.maximum - self.minimum


def extremes(signal: Array, refine: int = 1) -> Extremes:
    """Return the extremes of equally spaced samples, between the samples when `refine` > 1.

    With s samples per cycle the largest sample lies up to 1 - cos(pi/s) below the crest (19 % at
    s = 5); reading a cubic spline at `refine` points per sample divides s accordingly. Use 1 for
    signals with kinks such as contact loads, where a spline overshoots. The first and last few
    intervals, where the spline feels its ends, count with their samples only.

    Parameters
    ----------
    signal : array
        Samples, shape (n,).
    refine : int
        Points read per sample [-].
    """
    check_positive("refine", refine)
    values = np.asarray(signal, dtype=np.float64)
    mean = float(np.mean(values))
    if refine > 1:
        from scipy.interpolate import CubicSpline  # slow to import, also where nothing is refined

        interior = np.arange(_END * refine, (values.size - 1 - _END) * refine + 1) / refine
        between = CubicSpline(np.arange(values.size), values)(interior)
        values = np.concatenate([values, between])
    return Extremes(minimum=float(np.min(values)), maximum=float(np.max(values)), mean=mean)


@dataclass(frozen=True, slots=True, kw_only=True)
class OrderSpectrum:
    """One-sided amplitude spectrum over shaft orders.

    Parameters
    ----------
    order : array
        Cycles per shaft revolution [-], shape (bins,).
    amplitude : array
        Half the peak-to-peak value of each sinusoid, in the unit of the signal, shape (bins,)
        or (bins, channels); the first row is the mean.
    mean_speed : float
        Mean shaft speed over the window [rad/s].
    """

    order: Array
    amplitude: Array
    mean_speed: float

    @property
    def frequency(self) -> Array:
        """Frequency of every bin at the mean speed [Hz]: f = order * mean_speed / (2 pi)."""
        return self.order * self.mean_speed / (2.0 * math.pi)

    def below(self, frequency: float) -> OrderSpectrum:
        """Return the part of the spectrum up to `frequency` [Hz]."""
        check_positive("frequency", frequency, "Hz")
        keep = self.frequency <= frequency
        return OrderSpectrum(
            order=self.order[keep], amplitude=self.amplitude[keep], mean_speed=self.mean_speed
        )


def order_spectrum(samples: Array, window: AngleWindow) -> OrderSpectrum:
    """Return the amplitude spectrum of equal-angle samples, without a weighting window.

    The window spans whole revolutions, so every integer order falls on a bin and does not leak:

        A_k = (2 / N) |sum_j x_j exp(-2 pi i j k / N)|,   order_k = k / revolutions

    (factor 1/N for the mean and for the last bin of an even N).

    Parameters
    ----------
    samples : array
        Equal-angle samples, shape (window.size,) or (window.size, channels).
    window : AngleWindow
        The grid they lie on.

    Returns
    -------
    OrderSpectrum
        Bins of width 1/revolutions from order 0 to samples_per_revolution/2.
    """
    size = window.size
    if samples.shape[0] != size:
        raise ParameterError(
            f"samples must have {size} rows, one for every point of the window, "
            f"got {samples.shape[0]}. Resample onto the same window first."
        )
    amplitude = np.abs(np.fft.rfft(samples, axis=0)) * (2.0 / size)
    amplitude[0] *= 0.5
    if size % 2 == 0:
        amplitude[-1] *= 0.5
    order = np.arange(amplitude.shape[0]) / window.revolutions
    return OrderSpectrum(order=order, amplitude=amplitude, mean_speed=window.mean_speed)


def order_cut(spectrum: OrderSpectrum, order: float, half_width: float = 0.0) -> float:
    """Return the largest amplitude within `order` +- `half_width` [orders].

    With `half_width` = 0 the nearest bin is read. A channel axis is not allowed.
    """
    distance = np.abs(spectrum.order - order)
    nearest = float(np.min(distance))
    bin_width = float(spectrum.order[1] - spectrum.order[0])
    if nearest > 0.5 * bin_width * (1.0 + 1e-9):
        raise ParameterError(
            f"order must be within 0 to {spectrum.order[-1]:g}, the range of the spectrum, "
            f"got {order:g}."
        )
    chosen = distance <= max(half_width, nearest) * (1.0 + 1e-12)
    return float(np.max(spectrum.amplitude[chosen]))
