"""Which order one hears: the loudness that goes when an order is taken out of the sound."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.studies.sound.force_record import ForceRecord
from gearlube.studies.sound.metrics import steady_loudness
from gearlube.studies.sound.order_tracks import OrderTracks, order_signal, pinion_angle
from gearlube.studies.sound.pressure import RATE, Pressure
from gearlube.studies.sound.transfer_path import TransferPath
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
