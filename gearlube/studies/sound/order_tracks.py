"""Orders of the sound: their level over speed, and the sound without one of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube.studies.sound.force_record import ForceRecord
from gearlube.studies.sound.pressure import Pressure
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.spectra.order_track import OrderBlocks, order_blocks, samples_for

HARMONICS = 4  # mesh orders that are tracked
_OTHERS = 4  # orders that are tracked where the teeth are not known
_MOST_ORDER = 400.0


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
