"""What a run sounds like, in sentences."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.studies.sound.dataset import is_ramp, order_name, speed_axis
from gearlube.studies.sound.metrics import METRICS
from gearlube.studies.sound.order_tracks import heard_order
from gearlube_core.arrays import Array, Flags

_ALWAYS = 0.95  # of the time


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
    """Return what the results hold for and what is not in them."""
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
