"""Findings on the sound of a run, and on the audible difference between two runs."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.studies.sound.dataset import is_ramp, order_name, speed_axis
from gearlube.studies.sound.metrics import METRICS
from gearlube.studies.sound.order_tracks import AUDIBLE_SHARE, heard_order
from gearlube_core.arrays import Array, Flags
from gearlube_core.errors import ParameterError

_ALWAYS = 0.95  # of the time
STEP_HEARD = 1.0  # dB, just heard
_POINTS = 200
_FAINT = 20.0  # dB
_LEAST_SHARE = 0.05  # of the common speeds
_LEAST_CHANGE = 0.07  # of loudness: 1 dB
# smallest differences of the other metrics that are named; a tenth of their unit sounds
_NAMED = {"tonality": 0.1, "roughness": 0.1, "fluctuation_strength": 0.1}


def sound_sentences(dataset: xr.Dataset) -> list[str]:
    """Return findings of one run, the most important first."""
    sentences = [_loudest(dataset)]
    if "order_contribution" in dataset:
        sentences.append(_heard(dataset))
    for name in ("tonality", "roughness", "fluctuation_strength"):
        if name in dataset:
            unit, words = METRICS[name].unit, METRICS[name].words
            single = float(dataset[f"{name}_single"])
            where = _where(dataset, int(np.nanargmax(dataset[name].values)))
            sentences.append(
                f"The {words} is {single:.2g} {unit}; largest {where}."
                if single > 0.0
                else f"There is no {words} to speak of."
            )
    return sentences


def limit_sentences(dataset: xr.Dataset) -> list[str]:
    """Return the scope of the results and what they leave out."""
    low, high = dataset.attrs["band_hz"]
    sentences = [
        f"Sound between {low:.0f} and {high:.0f} Hz; one listener, one ear.",
        "Only the axle is heard: no road, wind or engine noise masks it here, as they would in a "
        "car.",
    ]
    if int(dataset.attrs["transfer_path_generic"]):
        sentences.insert(
            0,
            "The transfer path is generic, not measured: levels, loudness and which order is heard "
            "serve to compare runs; they do not predict what is heard in a car.",
        )
    return sentences


def _loudest(dataset: xr.Dataset) -> str:
    level = dataset["level_a"].values
    at = int(np.argmax(level))
    text = f"Loudest {_where(dataset, at)}: {level[at]:.0f} dB(A)"
    if "loudness" in dataset:
        single = float(dataset["loudness_single"])
        text += f". The loudness exceeds {single:.2g} sone for 5 % of the time"
    return text + "."


def _heard(dataset: xr.Dataset) -> str:
    contribution = dataset["order_contribution"].values
    heard = heard_order(contribution, dataset["steady_loudness"].values)
    teeth = int(dataset.attrs["pinion_teeth"])
    names = [order_name(float(q), teeth) for q in dataset["order"].values]
    known = np.isfinite(dataset["steady_loudness"].values)
    shares = [float(np.mean(heard[known] == q)) for q in range(len(names))]
    best = int(np.argmax(shares))
    if shares[best] == 0.0:
        return "No order of those tracked is heard above the rest."
    when = f" for {100.0 * shares[best]:.0f} % of the time"
    where = _range(dataset, heard == best)
    if shares[best] > _ALWAYS:
        when, where = " all the way", ""
    most = float(np.nanmax(contribution[best]))
    text = (
        f"One hears {names[best]} most{when}{where}: without it the loudness would fall by up to "
        f"{most:.2g} sone"
    )
    others = [
        f"{names[q]} for {100.0 * shares[q]:.0f} %"
        for q in np.argsort(shares)[::-1]
        if q != best and shares[q] >= 0.05
    ]
    return f"{text}; then {', '.join(others)}." if others else f"{text}."


def _where(dataset: xr.Dataset, at: int) -> str:
    if not is_ramp(dataset):
        return f"at {float(dataset['time'][at]):.2g} s"
    speed, unit, _ = speed_axis(dataset)
    return f"at {speed[at]:.0f} {unit}"


def _range(dataset: xr.Dataset, chosen: Flags) -> str:
    if not is_ramp(dataset):
        return ""
    speed, unit, _ = speed_axis(dataset)
    ends = longest_range(chosen, speed)
    return f", longest between {ends[0]:.0f} and {ends[1]:.0f} {unit}"


def longest_range(chosen: Flags, speed: Array) -> tuple[float, float]:
    """Return lowest and highest speed of the longest unbroken stretch of chosen rows.

    Examples
    --------
    >>> longest_range(np.array([1, 0, 1, 1, 0], dtype=bool), np.arange(5.0))
    (2.0, 3.0)
    """
    best, start = (0, 0), 0
    for i in range(chosen.size + 1):
        if i == chosen.size or not chosen[i]:
            if i - start > best[1] - best[0]:
                best = (start, i)
            start = i + 1
    part = speed[best[0] : max(best[1], best[0] + 1)]
    return float(part.min()), float(part.max())


def common_speeds(a: xr.Dataset, b: xr.Dataset) -> Array:
    """Return speeds that both runs have, rising, in the unit of `speed_axis`.

    Raises
    ------
    ParameterError
        The runs share no speed, or only one of them knows the car's speed.
    """
    if ("vehicle_speed" in a) != ("vehicle_speed" in b):
        a, b = (one.drop_vars("vehicle_speed", errors="ignore") for one in (a, b))
    (first, unit, words), (second, _, _) = speed_axis(a), speed_axis(b)
    low, high = max(first.min(), second.min()), min(first.max(), second.max())
    if low > high * 1.001:
        raise ParameterError(
            f"Runs that are compared must share speeds, got {words} {first.min():.4g} to "
            f"{first.max():.4g} {unit} against {second.min():.4g} to {second.max():.4g} {unit}. "
            "Give two runs over the same speeds."
        )
    return np.linspace(low, max(high, low), _POINTS)


def over_speed(dataset: xr.Dataset, values: Array, speeds: Array, unit: str) -> Array:
    """Return values over time read at speeds; where the speed repeats, its mean."""
    speed = speed_axis(dataset)[0]
    if unit == "rpm":
        speed = dataset["pinion_speed"].values * 30.0 / np.pi
    known = np.isfinite(values)
    if not known.any():
        return np.full(speeds.size, np.nan)
    if not is_ramp(dataset):
        return np.full(speeds.size, np.nanmean(values))
    order = np.argsort(speed[known])
    found = np.interp(speeds, speed[known][order], values[known][order])
    inside = (speeds >= speed[known].min() - 1e-9) & (speeds <= speed[known].max() + 1e-9)
    return np.where(inside, found, np.nan)


def difference_sentences(a: xr.Dataset, b: xr.Dataset) -> list[str]:
    """Return the differences of B as a listener hears them, the clearest first."""
    speeds = common_speeds(a, b)
    unit = "km/h" if "vehicle_speed" in a and "vehicle_speed" in b else "rpm"
    ramp = is_ramp(a) and is_ramp(b)
    name_a, name_b = str(a.attrs["name"]), str(b.attrs["name"])
    found = []
    if "loudness" in a and "loudness" in b:
        found.append(_loudness(a, b, name_b) + (_most_different(a, b, speeds, unit) * ramp))
    found += _orders(a, b, speeds, unit, name_b, ramp)
    mean = float(b.attrs["level_a_mean_db"]) - float(a.attrs["level_a_mean_db"])
    if abs(mean) >= STEP_HEARD:
        found.append(f"Over the whole run {name_b} is {_by(mean)} in dB(A).")
    for name, least in _NAMED.items():
        if name in a and name in b:
            first, second = (float(one[f"{name}_single"]) for one in (a, b))
            if abs(second - first) >= least:
                way = "rises" if second > first else "falls"
                words, sort = METRICS[name].words, METRICS[name].unit
                found.append(f"The {words} {way} from {first:.2g} to {second:.2g} {sort}.")
    if not found:
        found.append(
            f"{name_a} and {name_b} sound alike: no order differs by {STEP_HEARD:g} dB or more "
            f"over {100 * _LEAST_SHARE:g} % of the speeds."
        )
    return found


def _loudness(a: xr.Dataset, b: xr.Dataset, name_b: str) -> str:
    first, second = float(a["loudness_single"]), float(b["loudness_single"])
    if abs(second - first) < _LEAST_CHANGE * max(first, second):
        return f"{name_b} is about as loud: {first:.3g} and {second:.3g} sone (N5)."
    way = "rises" if second > first else "falls"
    return f"With {name_b} the loudness {way} from {first:.3g} to {second:.3g} sone (N5)."


def _most_different(a: xr.Dataset, b: xr.Dataset, speeds: Array, unit: str) -> str:
    """Return where the loudness of two ramps differs most, "" if nowhere by a step of 1 dB."""
    first, second = (over_speed(one, one["loudness"].values, speeds, unit) for one in (a, b))
    change = np.nan_to_num(np.abs(second - first))
    at = int(np.argmax(change))
    if change[at] < _LEAST_CHANGE * max(first[at], second[at]):
        return ""
    return (
        f" The difference is largest at {speeds[at]:.0f} {unit}: {first[at]:.2g} and "
        f"{second[at]:.2g} sone."
    )


def _orders(
    a: xr.Dataset, b: xr.Dataset, speeds: Array, unit: str, name_b: str, ramp: bool
) -> list[str]:
    """Return a sentence on every order that both have and that differs, the loudest first."""
    teeth = int(a.attrs["pinion_teeth"])
    found, silent = [], []
    for place, order in enumerate(a["order"].values):
        other = _match(order, place, a, b)
        if other is None:
            continue
        levels = [
            over_speed(one, one["order_level"].values[q], speeds, unit)
            for one, q in ((a, place), (b, other))
        ]
        same = teeth and teeth == int(b.attrs["pinion_teeth"])
        name = order_name(float(order), teeth) if same or not teeth else f"mesh order {place + 1}"
        stretches = _stretches(levels[1] - levels[0], speeds, unit if ramp else "")
        if not stretches:
            continue
        if _heard_change(a, place) or _heard_change(b, other):
            loud = float(np.nanmax(np.fmax(*levels)))
            found.append((loud, f"At {name} {name_b} is {' and '.join(stretches)}."))
        else:
            silent.append(name)
    listed = [text for _, text in sorted(found, key=lambda one: -one[0])]
    if silent:
        listed.append(f"Also different, but not heard above the rest: {', '.join(silent)}.")
    return listed


def _stretches(change: Array, speeds: Array, unit: str) -> list[str]:
    """Return where B is louder and where it is quieter, the longest stretch of each."""
    found = []
    for sign in (1.0, -1.0):
        above = np.isfinite(change) & (sign * np.nan_to_num(change) >= STEP_HEARD)
        low, high = longest_range(above, speeds)
        inside = above & (speeds >= low) & (speeds <= high)
        if np.mean(inside) < _LEAST_SHARE:
            continue
        where = f" between {low:.0f} and {high:.0f} {unit}" if unit else ""
        found.append((float(np.mean(inside)), f"{_by(float(np.mean(change[inside])))}{where}"))
    return [text for _, text in sorted(found, key=lambda one: -one[0])]


def _heard_change(dataset: xr.Dataset, place: int) -> bool:
    """Return whether an order is heard anywhere; without loudness, whether it is above 20 dB."""
    if "order_contribution" not in dataset:
        return bool(np.nanmax(dataset["order_level"].values[place]) > _FAINT)
    contribution = np.nan_to_num(dataset["order_contribution"].values[place])
    return bool(np.any(contribution > AUDIBLE_SHARE * dataset["steady_loudness"].values))


def _match(order: float, place: int, a: xr.Dataset, b: xr.Dataset) -> int | None:
    """Return the place of the same order in B: mesh orders by number, others by value."""
    teeth = int(a.attrs["pinion_teeth"]), int(b.attrs["pinion_teeth"])
    wanted = order / teeth[0] * teeth[1] if all(teeth) else order
    distance = np.abs(b["order"].values - wanted)
    nearest = int(np.argmin(distance))
    return nearest if distance[nearest] < 0.01 * max(wanted, 1.0) else None


def _by(change: float) -> str:
    size = abs(change)
    text = f"{size:.1f}" if size < 3.0 else f"{size:.0f}"
    return f"{text} dB {'louder' if change > 0.0 else 'quieter'}"
