"""Findings of a loss map as sentences with numbers."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from gearlube.plotting.range_words import RANGE_WORDS, usable_words
from gearlube.plotting.words import largest_losses
from gearlube.report.churning import regime_findings
from gearlube.report.films import (
    MIXED,
    bearing_drag,
    covered_share,
    efficiency_error,
    film_ratio_level,
    flank_friction,
    hot_film,
    model_of,
    points_beyond,
    solved_films,
    solved_rollers,
)
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.studies.loss_map.sampling import input_words, mean_swings
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import FLANK, ROLLER

_NAMED = 3  # uncertain inputs that are named one by one
_FEW_DRAWS = 40  # below them not one of 95 % lies beyond an end


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a loss map, the most important first."""
    failed = int((dataset["status"] != 0).sum())
    points = dataset["status"].size
    found = []
    if failed:
        found.append(
            Finding(
                WARNING,
                f"{failed} of {points} points failed.",
                f"The file map.csv says which. Reasons: {dataset.attrs['reasons']}",
            )
        )
    not_modelled = Finding(NOTE, f"Not modelled: {dataset.attrs['not_modelled']}.")
    if failed < points:
        found = [
            *_answer(dataset),
            *found,
            *_largest(dataset),
            not_modelled,
            *_drag(dataset),
            *_churning(dataset),
            *_warmth(dataset),
            *_film(dataset),
            *_heat(dataset),
            *_solved(dataset),
            *_rollers(dataset),
            *_bulk(dataset),
            *_steady(dataset),
            *_ranges(dataset),
        ]
    return found


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a loss map with a finished point."""
    if not np.isfinite(dataset["loss_torque"].values).any():
        return []
    found = [
        Number("best efficiency", 100.0 * _most(dataset["efficiency"]), "%", 4),
        Number("mean efficiency over the map", 100.0 * float(dataset["efficiency"].mean()), "%", 4),
        Number("largest loss", _most(_power(dataset)), "W"),
        Number("mean loss torque at the pinion", float(dataset["loss_torque"].mean()), "N·m"),
        Number("least film ratio", _least(dataset["film_ratio"]), "", 2),
        Number("films hotter than the oil data", 100.0 * _extrapolated(dataset), "% of points", 2),
        Number(
            "points outside a range", 100.0 * float((dataset["range_exceeded"] > 0).mean()), "%", 2
        ),
    ]
    if "loss_torque_low" in dataset:
        low, high = _band(dataset)
        found += [
            Number("error bar of the loss, low end", 100.0 * low, "%", 2),
            Number("error bar of the loss, high end", 100.0 * high, "%", 2),
        ]
    return found


def words_of(point: xr.Dataset | xr.DataArray) -> str:
    """Return where a point of the map is, "50 N·m, 1000 rpm and 80 °C oil"."""
    return (
        f"{float(point['torque']):.4g} N·m, {float(point['speed']):.4g} rpm and "
        f"{float(point['temperature']):.4g} °C oil"
    ).replace("-", "−")


def _power(dataset: xr.Dataset) -> xr.DataArray:
    return dataset["loss"].sum("source", skipna=False)


def _at(dataset: xr.Dataset, values: xr.DataArray, *, least: bool = False) -> xr.Dataset:
    """Return the point where values are largest, or least."""
    filled = values if not least else -values
    return dataset.isel(filled.argmax(list(filled.dims), skipna=True))  # type: ignore[arg-type]


def _answer(dataset: xr.Dataset) -> list[Finding]:
    """Say how efficient the axle is, and how sure that is."""
    efficiency = dataset["efficiency"]
    if not np.isfinite(efficiency.values).any():
        return []
    best = _at(dataset, efficiency)
    known, why = ".", ""
    if "loss_torque_low" in dataset:
        low, high = (f"{100.0 * end:+.0f}".replace("-", "−") for end in _band(dataset))
        known = f"; its losses are known to {low} to {high} % (95 %)."
        parts = [
            f"{input_words(name)} {100.0 * swing:.0f} %"
            for name, swing in list(mean_swings(dataset).items())[:_NAMED]
        ]
        why = (
            f" The uncertainty comes from: {', '.join(parts)}: change of the loss where this input "
            "alone goes to its 95 % limit."
        )
        if (draws := int(dataset.attrs["draws"])) < _FEW_DRAWS:
            why += f" The ends come from {draws} draws, which is rough: take 60 or more."
    return [
        Finding(
            NOTE,
            f"The mean efficiency of the axle is {100.0 * float(efficiency.mean()):.1f} %{known}",
            f"At best it is {100.0 * float(best['efficiency']):.1f} %, at {words_of(best)}. Points "
            f"that lose over half of their input are left out.{why}",
        )
    ]


def _largest(dataset: xr.Dataset) -> list[Finding]:
    worst = _at(dataset, _power(dataset))
    loss = worst["loss"].values
    parts = largest_losses(dataset["source"].values, loss)
    return [
        Finding(
            NOTE,
            f"The largest loss is {quantity_text(float(loss.sum()), 'W')}, at {words_of(worst)}: "
            f"{parts}.",
        )
    ]


def _drag(dataset: xr.Dataset) -> list[Finding]:
    """Say what turning without load takes, where the map has such torques."""
    torque = dataset["torque"].values
    if not torque[0] <= 0.0 <= torque[-1]:
        return []
    at_rest = dataset.isel(torque=int(np.argmin(np.abs(torque))))
    idle = at_rest["loss_torque"]
    middle = {name: dataset.sizes[name] // 2 for name in ("temperature", "speed")}
    parts = at_rest["loss"].isel(middle).values
    if not np.isfinite(idle.values).any():
        return []
    return [
        Finding(
            NOTE,
            f"Turning without load takes {quantity_text(_least(idle), 'N·m')} to "
            f"{quantity_text(_most(idle), 'N·m')} at the pinion.",
            f"At {float(idle['torque']):.3g} N·m, the torque of the map nearest to zero. Its parts "
            f"in the middle: {largest_losses(dataset['source'].values, parts)}. Give preload and "
            "seals of the axle: they decide it.",
        )
    ]


def _churning(dataset: xr.Dataset) -> list[Finding]:
    """Say where churning changes its formula in the hottest oil, and by how much it rises."""
    if "churning_regime" not in dataset:
        return []
    hot = dataset.isel(temperature=-1)
    loss = hot["loss"].sel(source="churning").max("torque").values
    regime, speed = hot["churning_regime"].values, hot["speed"].values
    return regime_findings(regime, speed, "rpm", loss, float(hot["temperature"]))


def _warmth(dataset: xr.Dataset) -> list[Finding]:
    if dataset.sizes["temperature"] < 2:
        return []
    cold, warm = (
        dataset["loss_torque"].isel(temperature=0),
        dataset["loss_torque"].isel(temperature=-1),
    )
    both = np.isfinite(cold.values) & np.isfinite(warm.values)
    if not both.any():
        return []
    change = float(warm.values[both].mean() / cold.values[both].mean()) - 1.0
    verb = "lowers" if change < 0.0 else "raises"
    return [
        Finding(
            NOTE,
            f"Warming the oil from {float(cold['temperature']):g} to "
            f"{float(warm['temperature']):g} °C {verb} the mean loss torque by "
            f"{100.0 * abs(change):.0f} %.",
        )
    ]


def _band(dataset: xr.Dataset) -> tuple[float, float]:
    """Return the mean ends of the error bar over the map, as shares of the loss less one."""
    loss = dataset["loss_torque"].values
    good = np.isfinite(loss) & (loss > 0.0)
    low, high = (dataset[f"loss_torque_{end}"].values for end in ("low", "high"))
    return float(np.nanmean(low[good] / loss[good])) - 1.0, float(
        np.nanmean(high[good] / loss[good])
    ) - 1.0


def _film(dataset: xr.Dataset) -> list[Finding]:
    ratio = dataset["film_ratio"]
    if not np.isfinite(ratio.values).any():
        return []
    worst = _at(dataset, ratio, least=True)
    least = float(worst["film_ratio"])
    mixed = 100.0 * float((ratio < MIXED).sum() / np.isfinite(ratio.values).sum())
    return [
        Finding(
            film_ratio_level(least),
            f"The smallest film ratio λ of a flank is {quantity_text(least, '', 2)}, at "
            f"{words_of(worst)}.",
            f"It is below {MIXED:g}, where asperities are in contact over much of the flank, at "
            f"{mixed:.0f} % of the points.",
        )
    ]


def _heat(dataset: xr.Dataset) -> list[Finding]:
    """Say what the hottest film's temperature is worth where the oil data end below it."""
    end = dataset.attrs.get("oil_data_high_degc", math.nan)
    return hot_film(dataset["flank_temperature"], end, words_of)


def _extrapolated(dataset: xr.Dataset) -> float:
    """Return the share of finished points whose hottest film is hotter than the oil data."""
    hottest = dataset["flank_temperature"].values
    if "oil_data_high_degc" not in dataset.attrs:
        return float("nan")
    return float((hottest > dataset.attrs["oil_data_high_degc"]).sum() / np.isfinite(hottest).sum())


def _solved(dataset: xr.Dataset) -> list[Finding]:
    """Say how far the model of solved films is to be trusted, where the axle takes it."""
    if "share_outside" not in dataset:
        return []
    outside = dataset["share_outside"]
    bound = covered_share(dataset["friction_bound"], flank_friction(dataset["loss"]))
    worst = _at(dataset, outside)
    most = float(worst["share_outside"])
    words = f"at most {100.0 * most:.0f} % of the flanks' load, at {words_of(worst)}"
    error, model = efficiency_error(dataset), model_of(dataset, FLANK)
    return [solved_films(bound, most, words + points_beyond(outside), error, model)]


def _rollers(dataset: xr.Dataset) -> list[Finding]:
    """Say the same of the model of rollers."""
    if "drag_bound" not in dataset:
        return []
    bound = covered_share(dataset["drag_bound"], bearing_drag(dataset["loss"]))
    worst = _at(dataset, dataset["rollers_outside"])
    most = float(worst["rollers_outside"])
    words = f"at most {100.0 * most:.0f} % of the rollers' load, at {words_of(worst)}"
    words += points_beyond(dataset["rollers_outside"])
    return [solved_rollers(bound, most, words, model=model_of(dataset, ROLLER))]


def _bulk(dataset: xr.Dataset) -> list[Finding]:
    """Say how warm the flanks get, where their own friction warms them."""
    if "bulk_temperature" not in dataset:
        return []
    rise = dataset["bulk_temperature"] - dataset["temperature"]
    if not np.isfinite(rise.values).any():
        return []
    warmest = _at(dataset, rise)
    return [
        Finding(
            NOTE,
            f"The flanks' own friction warms their bulk by up to {_most(rise):.0f} K over the oil, "
            f"at {words_of(warmest)}.",
            "Films and friction of the flanks are those at that temperature "
            "(film.bulk_resistance_k_w).",
        )
    ]


def _steady(dataset: xr.Dataset) -> list[Finding]:
    if "steady_temperature" not in dataset:
        return []
    steady = dataset["steady_temperature"]
    missing, known = int(steady.isnull().sum()), steady.values[np.isfinite(steady.values)]
    found = []
    if known.size:
        found.append(
            Finding(
                NOTE,
                f"The steady oil temperature is between {known.min():.0f} and "
                f"{known.max():.0f} °C, with air of {dataset.attrs['air_temperature_degc']:g} °C.",
            )
        )
    if missing:
        found.append(
            Finding(
                WARNING,
                f"{missing} of {steady.size} torques and speeds reach no steady temperature within "
                "the oil data.",
                "Their steady temperature is empty: the axle would overheat, or the data end too "
                "early.",
            )
        )
    return found


def _ranges(dataset: xr.Dataset) -> list[Finding]:
    if not dataset.attrs["ranges_left"]:
        return [Finding(GOOD, "No point left the range of a formula or table.")]
    axes = (("torque", "N·m"), ("speed", "rpm"), ("temperature", "°C"))
    left = dataset["range_exceeded"].transpose(*(name for name, _ in axes))
    exceeded = np.nan_to_num(left.values).astype(int)
    usable = usable_words(exceeded == 0, [(dataset[name].values, unit) for name, unit in axes])
    shares = [100.0 * float((exceeded >> bit & 1).mean()) for bit in range(len(RANGE_WORDS))]
    by_kind = sorted(zip(shares, RANGE_WORDS.values(), strict=True), reverse=True)
    parts = [
        f"{words} at {'below 1' if share < 1.0 else f'{share:.0f}'} %"
        for share, words in by_kind
        if share > 0.0
    ]
    return [
        Finding(
            WARNING,
            f"{100.0 * float((exceeded > 0).mean()):.0f} % of the points are extrapolated. "
            f"{usable}",
            f"Beyond a formula or table: {'; '.join(parts)} of the points. The error of these "
            "points is not in the error bars. The column range_exceeded of map.csv says which.",
        )
    ]


def _least(values: xr.DataArray | Array) -> float:
    return float(np.fmin.reduce(np.asarray(values), axis=None))  # without nan


def _most(values: xr.DataArray | Array) -> float:
    return float(np.fmax.reduce(np.asarray(values), axis=None))
