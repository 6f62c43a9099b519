"""Orders of a shaft that changes its speed: spectra of blocks of whole revolutions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError

_MOST_SAMPLES = 16384  # per revolution


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
    window = 0.5 - 0.5 * np.cos(turn * np.arange(size) / size)
    columns = signals[:, None] if signals.ndim == 1 else signals
    amplitude = np.empty((count, bins, columns.shape[1]), dtype=np.complex128)
    rms = np.empty((count, columns.shape[1]))
    at = turn * (
        first + np.arange((last - first) * samples_per_revolution) / samples_per_revolution
    )
    for channel in range(columns.shape[1]):
        even = CubicSpline(angle, columns[:, channel])(at)
        for block in range(count):
            part = even[block * samples_per_revolution :][:size]
            part = part - np.mean(part)
            spectrum = np.fft.rfft(window * part)[:bins]
            amplitude[block, :, channel] = spectrum * (2.0 / window.sum())
            rms[block, channel] = math.sqrt(float(np.dot(window, part**2) / window.sum()))
    edges = np.interp(turn * (first + np.arange(last - first + 1)), angle, time)
    middles = turn * (first + np.arange(count) + 0.5 * revolutions)
    whole = signals.ndim > 1
    return OrderBlocks(
        time=np.interp(middles, angle, time),
        speed=turn * revolutions / (edges[revolutions:] - edges[:count]),
        order=np.arange(bins) / revolutions,
        amplitude=amplitude if whole else amplitude[..., 0],
        rms=rms if whole else rms[:, 0],
    )
