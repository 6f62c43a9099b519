"""Orders of the sound: their level over speed, the sound without one, which of them one hears."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from gearlube.studies.sound.force_record import ForceRecord
from gearlube.studies.sound.metrics import steady_loudness
from gearlube.studies.sound.pressure import RATE, Pressure
from gearlube.studies.sound.transfer_path import TransferPath
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.spectra.order_spectrum import OrderBlocks, order_blocks, samples_for

HARMONICS = 4  # mesh orders that are tracked
_OTHERS = 4  # orders that are tracked where the teeth are not known
_MOST_ORDER = 400.0
FRAME = 0.4  # s, long enough for the lowest third octaves
_MOST_FRAMES = 40
# A step of 1 dB is just heard; 10 dB double the loudness, so 1 dB is 7 % of it.
AUDIBLE_SHARE = 2.0**0.1 - 1.0
METHOD = (
    "An order's contribution is the loudness (ISO 532-1, stationary, pieces of 0.4 s) of the whole "
    "sound less that of the sound without the order, so what the rest masks does not count. It is "
    "heard if that is more than 7 % of the loudness, the step that 1 dB makes."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class OrderTracks:
    """Orders of the pressure along a run.

    Parameters
    ----------
    order : array
        Per turn of the pinion [-], shape (orders,).
    time : array
        Middles of the blocks, from the first sample [s], shape (blocks,).
    amplitude : array of complex
        Peak amplitude and phase against the pinion angle [Pa], shape (blocks, orders); NaN where
        the order lies above the band.
    """

    order: Array
    time: Array
    amplitude: NDArray[np.complex128]

    @property
    def rms(self) -> Array:
        """Effective pressure of every order [Pa], shape (blocks, orders)."""
        return np.asarray(np.abs(self.amplitude) / np.sqrt(2.0))


def pinion_angle(record: ForceRecord, time: Array) -> Array:
    """Return the pinion angle [rad] at times from the first sample [s]."""
    from scipy.interpolate import CubicSpline

    return np.asarray(CubicSpline(record.time - record.time[0], record.angle)(time))


def track_orders(
    record: ForceRecord, pressure: Pressure, orders: Sequence[float], revolutions: int
) -> OrderTracks:
    """Return the orders of a pressure; without `orders` the first mesh orders of the run.

    Raises
    ------
    ParameterError
        An order lies above the band at every speed, or the run is too short.
    """
    per_turn = np.array([record.speed.min(), record.speed.max()]) / (2.0 * np.pi)
    top = min(_MOST_ORDER, pressure.band[1] / per_turn[0])
    blocks = order_blocks(
        pressure.time,
        pinion_angle(record, pressure.time),
        pressure.signal,
        revolutions=revolutions,
        samples_per_revolution=samples_for(pressure.band[1], float(record.speed.min())),
        highest_order=top,
    )
    wanted = np.array(sorted(orders) if orders else _usual(record, blocks, top))
    for order in wanted:
        if order > top:
            raise ParameterError(
                f"The order {order:g} must lie in the band at some speed: it begins at "
                f"{order * per_turn[0]:.4g} Hz, the band ends at {pressure.band[1]:.4g} Hz. Leave "
                "the order out, or take a wider band."
            )
    nearest = np.array([int(np.argmin(np.abs(blocks.order - order))) for order in wanted])
    wanted = blocks.order[nearest]  # an order between two bins is read at the nearer
    amplitude = blocks.amplitude[:, nearest].copy()
    frequency = blocks.speed[:, None] / (2.0 * np.pi) * wanted[None, :]
    amplitude[frequency > pressure.band[1]] = np.nan
    return OrderTracks(order=wanted, time=blocks.time, amplitude=amplitude)


def order_signal(tracks: OrderTracks, index: int, angle: Array, time: Array) -> Array:
    """Return the part of the pressure that one order makes [Pa], at angles [rad] and times [s]."""
    amplitude = np.where(np.isnan(tracks.amplitude[:, index]), 0.0, tracks.amplitude[:, index])
    if tracks.time.size == 1:
        envelope = np.full(time.size, amplitude[0])
    else:
        real, imaginary = (
            np.interp(time, tracks.time, part) for part in (amplitude.real, amplitude.imag)
        )
        envelope = real + 1j * imaginary
    return np.asarray(np.real(envelope * np.exp(1j * tracks.order[index] * angle)))


def _usual(record: ForceRecord, blocks: OrderBlocks, top: float) -> list[float]:
    """Return the mesh orders, or the strongest orders where the teeth are not known."""
    if record.teeth is not None:
        found = [k * float(record.teeth) for k in range(1, HARMONICS + 1)]
        return [order for order in found if order <= top] or found[:1]
    strength = np.mean(np.abs(blocks.amplitude) ** 2, axis=0)
    strength[blocks.order < 1.0] = 0.0
    chosen: list[float] = []
    for i in np.argsort(strength)[::-1]:
        order = float(blocks.order[i])
        if all(abs(order - other) >= 1.0 for other in chosen):
            chosen.append(order)
        if len(chosen) == _OTHERS:
            break
    return sorted(chosen)


@dataclass(frozen=True, slots=True, kw_only=True)
class HeardRun:
    """The sound of one run.

    Parameters
    ----------
    dataset : xarray.Dataset
        Levels, metrics and orders over time.
    pressure : Pressure
        At the listener.
    path : TransferPath
    wav : str
        Name of its WAV; says the full scale.
    """

    dataset: xr.Dataset
    pressure: Pressure
    path: TransferPath
    wav: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sound:
    """The sound of a run, and of another beside it.

    Parameters
    ----------
    runs : tuple of HeardRun
        One or two.
    full_scale : float
        Pressure at the full scale of every WAV [Pa].
    findings : tuple of str
        What is heard of the first run; with two, first the difference.
    limits : tuple of str
        What the results hold for.
    missing : tuple of str
        Metrics that were asked for and cannot be computed here, and why.
    files : mapping
        Written files by name.
    """

    runs: tuple[HeardRun, ...]
    full_scale: float
    findings: tuple[str, ...]
    limits: tuple[str, ...]
    missing: tuple[str, ...] = ()
    files: Mapping[str, Path] = field(default_factory=dict)

    @property
    def dataset(self) -> xr.Dataset:
        """Levels, metrics and orders of the first run."""
        return self.runs[0].dataset


def contributions(
    record: ForceRecord,
    pressure: Pressure,
    tracks: OrderTracks,
    field: str,
    progress: Progress = no_progress,
) -> tuple[Array, Array, Array]:
    """Return times [s], contribution of every order (orders, frames) and loudness [sone].

    See `METHOD`. The order is taken out of the pressure with the amplitude and phase of its track.
    """
    size = min(int(FRAME * RATE), pressure.signal.size)
    count = max(1, min(_MOST_FRAMES, int(2 * pressure.signal.size / size)))
    starts = np.linspace(0, pressure.signal.size - size, count).astype(int)
    time = pressure.time
    angle = pinion_angle(record, time)
    parts = [order_signal(tracks, q, angle, time) for q in range(tracks.order.size)]
    whole = np.empty(count)
    without = np.empty((tracks.order.size, count))
    for i, start in enumerate(starts):
        piece = slice(start, start + size)
        whole[i] = steady_loudness(pressure.signal[piece], field)
        for q, part in enumerate(parts):
            without[q, i] = steady_loudness((pressure.signal - part)[piece], field)
        progress((i + 1) / count, "finding the order that is heard")
    return (starts + 0.5 * size) / RATE, np.maximum(whole - without, 0.0), whole


def heard_order(contribution: Array, loudness: Array) -> Array:
    """Return the index of the order that is heard in each frame, -1 for none, shape (frames,)."""
    known = np.nan_to_num(contribution)
    best, top = np.argmax(known, axis=0), np.max(known, axis=0)
    return np.where((loudness > 0.0) & (top > AUDIBLE_SHARE * loudness), best, -1)
