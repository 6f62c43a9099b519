"""Order spectra of signals over an angle, and tracks of orders over speed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.spectra.angle_grid import AngleWindow

_MOST_SAMPLES = 16384  # per revolution
_END = 6  # intervals after which the end condition of the spline has decayed to (sqrt(3) - 2)^6


@dataclass(frozen=True, slots=True, kw_only=True)
class OrderBlocks:
    """Spectra over shaft orders of blocks that follow each other.

    Parameters
    ----------
    time : array
        At the middle angle of every block [s], shape (blocks,).
    speed : array
        Mean shaft speed over the block [rad/s], shape (blocks,).
    order : array
        Cycles per revolution [-], shape (orders,).
    amplitude : array of complex
        Amplitude (half of peak-to-peak) and phase of each order in the unit of the signal, shape
        (blocks, orders) or (blocks, orders, channels). Phase zero: a cosine that is largest where
        the shaft angle is a multiple of 2 pi.
    rms : array
        Root mean square about the block's mean, all frequencies, shape (blocks,) or (blocks,
        channels).
    """

    time: Array
    speed: Array
    order: Array
    amplitude: NDArray[np.complex128]
    rms: Array


def samples_for(highest_frequency: float, slowest_speed: float) -> int:
    """Return samples per revolution that hold `highest_frequency` [Hz] at the slowest speed.

    A power of two of at least 2.56 samples in a cycle at the slowest speed [rad/s].

    Examples
    --------
    >>> samples_for(4000.0, 50.0)
    2048
    """
    check_positive("highest_frequency", highest_frequency, "Hz")
    check_positive("slowest_speed", slowest_speed, "rad/s")
    wanted = 2.56 * highest_frequency * 2.0 * math.pi / slowest_speed
    return min(1 << max(4, math.ceil(math.log2(wanted))), _MOST_SAMPLES)


def order_blocks(
    time: Array,
    angle: Array,
    signals: Array,
    *,
    revolutions: int,
    samples_per_revolution: int,
    highest_order: float,
    orders: Array | None = None,
) -> OrderBlocks:
    """Return the orders of a record during a run-up or coast-down.

    The signals are read at equal shaft angles by a cubic spline, cut into blocks of `revolutions`
    that begin one revolution apart, weighted with a Hann window and transformed. An order on a
    bin is not smeared by the change of speed, and orders two bins or more apart do not leak into
    each other.

    Parameters
    ----------
    time, angle : array
        Sample times [s] and shaft angles [rad], both increasing, shape (n,).
    signals : array
        Shape (n,) or (n, channels).
    revolutions : int
        Length of a block [rev]; the bins lie 1/revolutions orders apart.
    samples_per_revolution : int
        See `samples_for`. Content above half of it folds back into lower orders.
    highest_order : float
        End of the spectra [-].
    orders : ndarray of shape (n,), optional
        These alone, whole or not, instead of all bins up to `highest_order`.

    Raises
    ------
    ParameterError
        The shaft stops or turns back, or the record is shorter than a block.

    Notes
    -----
    Computed order tracking as in [fyfe_munck_1997], with the exact angle in place of a
    tachometer's pulses.
    """
    from scipy.interpolate import CubicSpline  # slow to import

    check_within("revolutions", revolutions, 1, 1000, "rev")
    check_within("highest_order", highest_order, 1.0, 0.5 * samples_per_revolution)
    if not np.all(np.diff(angle) > 0.0):
        raise ParameterError(
            "angle must increase from sample to sample, got a record in which the shaft stops or "
            "turns back. Start at a higher speed."
        )
    turn = 2.0 * math.pi
    first, last = math.ceil(angle[0] / turn), math.floor(angle[-1] / turn)
    count = last - first - revolutions + 1
    if count < 1:
        raise ParameterError(
            f"The record must hold a block of {revolutions} rev, got {last - first} whole rev. "
            "Record for longer, or take fewer revolutions."
        )
    size = revolutions * samples_per_revolution
    bins = math.floor(highest_order * revolutions + 1e-9) + 1
    wanted = np.arange(bins) / revolutions if orders is None else orders
    window = 0.5 - 0.5 * np.cos(turn * np.arange(size) / size)
    turns = np.arange(size) / samples_per_revolution
    waves = None if orders is None else window * np.exp(-1j * turn * np.outer(orders, turns))
    begun = np.exp(-1j * turn * np.outer(first + np.arange(count), wanted))  # of each block
    columns = signals[:, None] if signals.ndim == 1 else signals
    amplitude = np.empty((count, wanted.size, columns.shape[1]), dtype=np.complex128)
    rms = np.empty((count, columns.shape[1]))
    at = turn * (
        first + np.arange((last - first) * samples_per_revolution) / samples_per_revolution
    )
    for channel in range(columns.shape[1]):
        even = CubicSpline(angle, columns[:, channel])(at)
        for block in range(count):
            part = even[block * samples_per_revolution :][:size]
            part = part - np.mean(part)
            if waves is None:
                spectrum = np.fft.rfft(window * part)[:bins]
                amplitude[block, :, channel] = spectrum * (2.0 / window.sum())
            rms[block, channel] = math.sqrt(float(np.dot(window, part**2) / window.sum()))
        if waves is not None:
            parts = np.lib.stride_tricks.sliding_window_view(even, size)[::samples_per_revolution]
            spectra = (parts - parts.mean(axis=1, keepdims=True)) @ waves.T
            amplitude[..., channel] = spectra * begun * (2.0 / window.sum())
    edges = np.interp(turn * (first + np.arange(last - first + 1)), angle, time)
    middles = turn * (first + np.arange(count) + 0.5 * revolutions)
    whole = signals.ndim > 1
    return OrderBlocks(
        time=np.interp(middles, angle, time),
        speed=turn * revolutions / (edges[revolutions:] - edges[:count]),
        order=wanted,
        amplitude=amplitude if whole else amplitude[..., 0],
        rms=rms if whole else rms[:, 0],
    )


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
        Equally spaced samples, shape (n,).
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
