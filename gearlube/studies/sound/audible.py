"""Which order one hears: the loudness that goes when an order is taken out of the sound."""

from __future__ import annotations

import numpy as np

from gearlube.studies.sound.force_record import ForceRecord
from gearlube.studies.sound.metrics import steady_loudness
from gearlube.studies.sound.order_tracks import OrderTracks, order_signal, pinion_angle
from gearlube.studies.sound.pressure import RATE, Pressure
from gearlube_core.arrays import Array
from gearlube_core.progress import Progress, no_progress

FRAME = 0.4  # s, long enough for the lowest third octaves
_MOST_FRAMES = 40
# A step of 1 dB is just heard; 10 dB double the loudness, so 1 dB is 7 % of it.
AUDIBLE_SHARE = 2.0**0.1 - 1.0
METHOD = (
    "An order's contribution is the loudness (ISO 532-1, stationary, pieces of 0.4 s) of the whole "
    "sound less that of the sound without the order, so what the rest masks does not count. It is "
    "heard if that is more than 7 % of the loudness, the step that 1 dB makes."
)


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
