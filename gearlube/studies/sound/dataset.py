"""The sound of a run as a dataset: levels, metrics and orders over time and speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.sound.force_record import ForceRecord
from gearlube.studies.sound.metrics import METRICS, Curve
from gearlube.studies.sound.order_tracks import OrderTracks
from gearlube.studies.sound.pressure import RATE, REFERENCE, Pressure, a_weighted, a_weighting
from gearlube.studies.sound.settings import SoundSettings
from gearlube.studies.sound.transfer_path import TransferPath
from gearlube_core import __version__
from gearlube_core.arrays import Array

FAST = 0.125  # s, time weighting F

_SILENCE = 1e-9  # Pa, -86 dB: what silence counts as

STEP = 0.05  # s between two rows


def sound_dataset(
    record: ForceRecord,
    path: TransferPath,
    pressure: Pressure,
    tracks: OrderTracks,
    curves: Mapping[str, Curve],
    audible: tuple[Array, Array, Array] | None,
    settings: SoundSettings,
) -> xr.Dataset:
    """Return everything but the pressure itself, which is in the WAV."""
    end = pressure.signal.size / RATE
    time = np.arange(0.5 * STEP, end, STEP)
    since = record.time - record.time[0]
    variables: dict[str, Any] = {}

    def put(name: str, dims: Any, values: Array, unit: str, words: str) -> None:
        variables[name] = (dims, values, {"units": unit, "long_name": words})

    put(
        "pinion_speed",
        "time",
        np.interp(time, since, record.speed),
        "rad/s",
        "speed of the pinion",
    )
    if record.vehicle_speed is not None:
        speeds = np.interp(time, since, record.vehicle_speed)
        put("vehicle_speed", "time", speeds, "m/s", "speed of the car")
    level = fast_level(pressure.signal, RATE, time)
    weighted = a_weighted(pressure.signal, RATE)
    put("level", "time", level, "dB", "sound pressure level re 20 uPa, time weighting F")
    put("level_a", "time", fast_level(weighted, RATE, time), "dB", "A-weighted level, F")
    for name, curve in curves.items():
        metric = METRICS[name]
        values = np.interp(time, curve.time, curve.value)
        put(name, "time", values, metric.unit, f"{metric.words}, {curve.standard}")
        put(f"{name}_single", (), np.array(curve.single), metric.unit, _single(name))
    order_level = decibels(tracks.rms)
    columns = [_on(time, tracks.time, order_level[:, q]) for q in range(tracks.order.size)]
    put("order_level", ("order", "time"), np.array(columns), "dB", "level of an order re 20 uPa")
    if audible is not None:
        at, contribution, whole = audible
        rows = [_on(time, at, row) for row in contribution]
        words = "loudness that goes without the order"
        put("order_contribution", ("order", "time"), np.array(rows), "sone", words)
        put("steady_loudness", "time", _on(time, at, whole), "sone", "loudness of pieces of 0.4 s")
    teeth = record.teeth or 0
    return xr.Dataset(
        variables,
        {
            "time": ("time", time, {"units": "s", "long_name": "since the first sample"}),
            "order": ("order", tracks.order, {"units": "1", "long_name": "per turn of the pinion"}),
        },
        {
            "name": record.name,
            "transfer_path": path.source,
            "transfer_path_generic": int(path.generic),
            "early_share": pressure.early,
            "band_hz": list(pressure.band),
            "peak_pa": float(np.max(np.abs(pressure.signal))),
            "level_mean_db": float(decibels(np.sqrt(np.mean(pressure.signal**2)))),
            "level_a_mean_db": float(decibels(np.sqrt(np.mean(weighted**2)))),
            "pinion_teeth": teeth,
            "field": settings.field,
            "standards": "; ".join(f"{n}: {c.standard}" for n, c in curves.items()) or "none",
            "gearlube_version": __version__,
        },
    )


def _single(name: str) -> str:
    return {
        "loudness": "N5, exceeded for 5 % of the time",
        "tonality": "mean of what is above 0.02 tu",
    }.get(name, "90th percentile")


def _on(time: Array, at: Array, values: Array) -> Array:
    """Return values on the rows; NaN beyond the ends by more than a row."""
    known = np.isfinite(values)
    if not known.any():
        return np.full(time.size, np.nan)
    found = np.interp(time, at[known], values[known])
    if at.size > 1 and not known.all():  # an order that leaves the band
        found = np.where(np.interp(time, at, known.astype(float)) > 0.5, found, np.nan)
    return np.where((time < at[0] - STEP) | (time > at[-1] + STEP), np.nan, found)


def order_name(order: float, teeth: int) -> str:
    """Return the name of an order.

    Examples
    --------
    >>> order_name(26.0, 13), order_name(2.0, 13), order_name(4.5, 0)
    ('mesh order 2', 'pinion order 2', 'pinion order 4.5')
    """
    if teeth > 0 and abs(order / teeth - round(order / teeth)) < 1e-6 and order > 0.0:
        return f"mesh order {round(order / teeth)}"
    return f"pinion order {order:g}"


def speed_axis(dataset: xr.Dataset) -> tuple[Array, str, str]:
    """Return speed over time, its unit and its name: of the car if known, else of the pinion."""
    if "vehicle_speed" in dataset:
        return 3.6 * dataset["vehicle_speed"].values, "km/h", "vehicle speed"
    return dataset["pinion_speed"].values * 30.0 / np.pi, "rpm", "pinion speed"


def is_ramp(dataset: xr.Dataset) -> bool:
    """Return whether the speed changes by more than 5 % in the run."""
    speed = dataset["pinion_speed"].values
    return bool(np.ptp(speed) > 0.05 * np.mean(speed))


_RANGE = 60.0  # dB below the loudest, the most that is drawn


def level_names(dataset: xr.Dataset) -> list[str]:
    """Return the names of the levels of a run: the whole sound and the tracked orders."""
    teeth = int(dataset.attrs["pinion_teeth"])
    return ["whole sound", *(order_name(float(q), teeth) for q in dataset["order"])]


def level_values(dataset: xr.Dataset, i: int) -> Array | None:
    """Return level `i` of `level_names` over time [dB(A)]; None where the run has fewer orders."""
    if i == 0:
        return np.asarray(dataset["level_a"].values)
    return weighted_order(dataset, i - 1) if i <= dataset.sizes["order"] else None


def weighted_order(dataset: xr.Dataset, place: int) -> Array:
    """Return the A-weighted level of the tracked order at a place, over time [dB(A)]."""
    one = dataset.isel(order=place)
    frequency = float(one["order"]) * one["pinion_speed"].values / (2.0 * np.pi)
    factor = a_weighting(np.maximum(frequency, 1.0))
    return np.asarray(one["order_level"].values + 20.0 * np.log10(factor))


def level_range(datasets: Sequence[xr.Dataset]) -> tuple[float, float]:
    """Return the ends of an axis that shows the levels of all runs [dB(A)]."""
    found = [level_values(one, i) for one in datasets for i in range(1 + one.sizes["order"])]
    high = max(float(np.nanmax(one)) for one in found if one is not None)
    low = min(float(np.nanpercentile(one, 2.0)) for one in found if one is not None)
    return max(high - _RANGE, low - 5.0), high + 4.0


def decibels(pressure: Array | float) -> Array:
    """Return the level of an rms pressure [dB re 20 uPa].

    Examples
    --------
    >>> float(decibels(1.0).round(2))
    93.98
    """
    return np.asarray(20.0 * np.log10(np.maximum(pressure, _SILENCE) / REFERENCE))


def fast_level(pressure: Array, rate: float, times: Array) -> Array:
    """Return the level with time weighting F [dB re 20 uPa] at `times` [s from the first sample].

    The weighting is exponential with 0.125 s [iec_61672_1], and starts at the mean of the first
    0.125 s.
    """
    from scipy.signal import lfilter

    decay = np.exp(-1.0 / (FAST * rate))
    square = pressure**2
    start = float(np.mean(square[: max(1, int(FAST * rate))]))
    smooth, _ = lfilter([1.0 - decay], [1.0, -decay], square, zi=[decay * start])
    at = np.clip(np.round(times * rate).astype(int), 0, pressure.size - 1)
    return decibels(np.sqrt(np.maximum(smooth[at], 0.0)))
