"""What the friction of a bearing says, in sentences with numbers."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.report.solved_films import model_of
from gearlube.studies.bearing.figures import LAW_NAMES
from gearlube.studies.bearing.summary import bearing_warnings, error_sentences
from gearlube_core.film_model.model import ROLLER
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm

_NAMED, _LEAST_SHARE = 3, 0.005  # parts that are told, if they are not smaller


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a bearing study, the most important first."""
    return [
        _largest(dataset),
        *_laws(dataset),
        *_films(dataset),
        *(Finding(NOTE, *_split(sentence)) for sentence in error_sentences(dataset)),
        *_warmth(dataset),
        *_warned(dataset),
    ]


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a bearing study: those of its first law, and the spread."""
    first = dataset.isel(law=0)
    found = [
        Number("largest torque", float(first["torque"].max()), "N·m"),
        Number("largest power loss", float(first["power"].max()), "W"),
        Number("error bar, factor (k = 2)", float(first["factor"].max()), "", 2),
        Number("mean torque", float(first["torque"].mean()), "N·m"),
    ]
    ratio = float(first["film_ratio"].where(first["speed"] > 0.0).min())
    if np.isfinite(ratio):
        found.append(Number("least film ratio of the raceways", ratio, "", 2))
    if dataset.sizes["law"] > 1:
        found.append(Number("largest over least law, mean", _spread(dataset), "", 2))
    return found


def words_of(point: xr.Dataset) -> str:
    """Return where a condition is."""
    return (
        f"{rads_to_rpm(float(point['speed'])):.4g} rpm, {float(point['axial_load']):g} N axial, "
        f"{float(point['radial_load']):g} N radial and "
        f"{kelvin_to_celsius(float(point['temperature'])):.3g} °C"
    )


def _largest(dataset: xr.Dataset) -> Finding:
    first = dataset.isel(law=0)
    power = first["power"]
    worst = first.isel(power.argmax(list(power.dims)))  # type: ignore[arg-type]
    parts = worst["part_torque"].values
    least = _LEAST_SHARE * float(worst["torque"])
    known = np.flatnonzero(np.isfinite(parts) & (parts > least))
    order = known[np.argsort(parts[known])[::-1]][:_NAMED]
    words = ", ".join(
        f"{worst['part'].values[i]} {100.0 * parts[i] / float(worst['torque']):.0f} %"
        for i in order
    )
    return Finding(
        NOTE,
        f"The bearing loses at most {quantity_text(float(worst['power']), 'W')}, with a torque of "
        f"{quantity_text(float(worst['torque']), 'N·m')}, at {words_of(worst)}.",
        f"By {_name(first)}. Parts of the torque: {words}." if words else f"By {_name(first)}.",
    )


def _laws(dataset: xr.Dataset) -> list[Finding]:
    if dataset.sizes["law"] < 2:
        return []
    mean = dataset["torque"].mean([d for d in dataset["torque"].dims if d != "law"])
    low, high = (mean.isel(law=int(at)) for at in (mean.argmin("law"), mean.argmax("law")))
    return [
        Finding(
            NOTE,
            f"The laws differ by a factor of {_spread(dataset):.2g}: {_name(low)} has the least "
            f"mean torque, {quantity_text(float(low), 'N·m')}, {_name(high)} the largest, "
            f"{quantity_text(float(high), 'N·m')}.",
            "A measured torque in the bearing file removes this uncertainty.",
        )
    ]


def _films(dataset: xr.Dataset) -> list[Finding]:
    model = model_of(dataset, ROLLER)
    if not model:
        return []
    out = dataset["out_of_range"].sel(law="solved_films")
    return [
        Finding(
            NOTE,
            "Rolling force and films of the raceways by solved_films come from a model of solved "
            "films.",
            f"Model: {model}. Up to {100.0 * float(out.max()):.2g} % of the loaded contacts lie "
            "outside its domain, where formulas stand in.",
        )
    ]


def _spread(dataset: xr.Dataset) -> float:
    mean = dataset["torque"].mean([d for d in dataset["torque"].dims if d != "law"]).values
    return float(mean.max() / mean.min())


def _warmth(dataset: xr.Dataset) -> list[Finding]:
    if dataset.sizes["temperature"] < 2:
        return []
    first = dataset["torque"].isel(law=0)
    order = np.argsort(first["temperature"].values)
    cold, warm = first.isel(temperature=order[0]), first.isel(temperature=order[-1])
    change = float(warm.mean() / cold.mean()) - 1.0
    return [
        Finding(
            NOTE,
            f"Warming the oil from {kelvin_to_celsius(float(cold['temperature'])):.3g} to "
            f"{kelvin_to_celsius(float(warm['temperature'])):.3g} °C "
            f"{'lowers' if change < 0.0 else 'raises'} the mean torque by "
            f"{100.0 * abs(change):.0f} %.",
        )
    ]


def _warned(dataset: xr.Dataset) -> list[Finding]:
    said = bearing_warnings(dataset)
    if said:
        return [Finding(WARNING, *_split(one)) for one in said]
    return [Finding(GOOD, "All laws are within their range, and the raceways have a full film.")]


def _name(at: xr.Dataset | xr.DataArray) -> str:
    return LAW_NAMES[str(at["law"].values)]


def _split(sentence: str) -> tuple[str, str]:
    """Return the head of a sentence up to its first semicolon as a sentence, and the rest."""
    head, mark, rest = sentence.partition("; ")
    return (f"{head}.", f"{rest[0].upper()}{rest[1:]}") if mark else (sentence, "")
