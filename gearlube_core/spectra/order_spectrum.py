"""Amplitude spectrum over orders of a shaft."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.spectra.angle_grid import AngleWindow


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
