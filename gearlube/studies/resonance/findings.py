"""Findings of a resonance study as sentences with numbers."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.studies.resonance.settings import MODELS
from gearlube.studies.resonance.summary import (
    ModelSummary,
    path_over_range,
    single_branches,
    summaries,
    visited,
)

_MICRO = 1e6
_JUMP = 0.05  # of the larger amplitude: a smaller step is none that one hears
_LARGE = 2.0  # times the static deflection
_SIMPLER = {
    "two_dof": "without friction",
    "one_dof": "with one degree of freedom",
    "two_dof_mean_radii": "with constant contact radii",
}


class Jump(NamedTuple):
    """Where a slow sweep leaves one motion for another; p-p errors before and after [m]."""

    direction: str
    relative_frequency: float
    before: float
    after: float


def jumps(dataset: xr.Dataset, model: str) -> list[Jump]:
    """Return the jumps of slow sweeps of a model up and down, in the order of each sweep."""
    path = path_over_range(single_branches(dataset.sel(model=model)))
    relative, size = path["relative_frequency"].values, path["peak_to_peak"].values
    found = []
    for direction in ("up", "down"):
        rows = visited(relative, path["stable"].values, direction)
        for here, there in pairwise(rows):
            step = abs(size[there] - size[here])
            if abs(int(there) - int(here)) > 1 and step > _JUMP * max(size[here], size[there]):
                found.append(
                    Jump(direction, float(relative[here]), float(size[here]), float(size[there]))
                )
    return found


def unstable_ranges(dataset: xr.Dataset, model: str) -> list[tuple[float, float]]:
    """Return where motions of one mesh period are unstable: mesh over natural frequency."""
    found = []
    for branch in single_branches(dataset.sel(model=model)):
        loose = branch["stable"].values < 0.5
        edges = np.flatnonzero(np.diff(np.concatenate([[0], loose.astype(int), [0]])))
        for first, last in edges.reshape(-1, 2):
            places = branch["relative_frequency"].values[first:last]
            found.append((float(places.min()), float(places.max())))
    return sorted(found)


def leading_model(dataset: xr.Dataset) -> str:
    """Return the model that findings speak of: two degrees of freedom, lubricated if it is there.

    The first model of a stopped study.
    """
    models = [str(one) for one in dataset["model"].values]
    for name in ("two_dof_lubricated", "two_dof"):
        if name in models:
            return name
    return models[0]


def findings(response: xr.Dataset, load: xr.Dataset | None = None) -> list[Finding]:
    """Return the findings of a resonance study, the most important first.

    Parameters
    ----------
    response : xarray.Dataset
        See `resonance_dataset`.
    load : xarray.Dataset, optional
        See `load_response`.

    Examples
    --------
    >>> findings(xr.load_dataset("gearlube_resonance/resonance.nc"))[0].headline  # doctest: +SKIP
    'The largest response is 26.1 µm peak to peak, at 0.859 of the natural frequency.'
    """
    stopped = Finding(
        WARNING, "The study was stopped early: the remaining results are missing.", "Run it again."
    )
    said = [stopped] if response.attrs.get("interrupted") else []
    if "model" not in response:
        return said
    every = {one.model: one for one in summaries(response)}
    model = leading_model(response)
    found = [
        _largest(response, every[model]),
        _jumped(response, model),
        _parted(response, every[model]),
        *_unstable(response, model),
        *_beside(every, model),
    ]
    found += [
        Finding(WARNING, f"{MODELS[one.model]}: {sentence}")
        for one in every.values()
        for sentence in one.remarks
    ]
    if load is not None:
        found.append(_over_load(load))
    return [*said, *found]


def pinion_rpm(response: xr.Dataset, relative: float) -> float:
    """Return the pinion speed [rpm] at a mesh over natural frequency."""
    attributes = response.attrs
    return float(60.0 * relative * attributes["natural_frequency"] / attributes["pinion_teeth"])


def _largest(response: xr.Dataset, one: ModelSummary) -> Finding:
    times = one.peak / float(response.attrs["static_deflection"])
    return Finding(
        WARNING if times > _LARGE else NOTE,
        f"The largest response is {quantity_text(_MICRO * one.peak, 'µm')} peak to peak, at "
        f"{one.peak_at:.3f} of the natural frequency.",
        f"That is {times:.1f} times the static deflection under the mean torque, at "
        f"{pinion_rpm(response, one.peak_at):.0f} rpm of the pinion; the natural frequency is "
        f"{response.attrs['natural_frequency']:.0f} Hz. Model: {MODELS[one.model]}.",
    )


def _jumped(response: xr.Dataset, model: str) -> Finding:
    found = jumps(response, model)
    if not found:
        return Finding(
            GOOD, "The amplitude has no jumps: slow sweeps up and down pass without a step."
        )
    words = {"up": "rising", "down": "falling"}
    listed = "; ".join(
        f"with {words[one.direction]} speed at {one.relative_frequency:.3f} "
        f"({pinion_rpm(response, one.relative_frequency):.0f} rpm) from "
        f"{quantity_text(_MICRO * one.before, 'µm')} to {quantity_text(_MICRO * one.after, 'µm')}"
        for one in found
    )
    count = {1: "once", 2: "twice"}.get(len(found), f"{len(found)} times")
    return Finding(
        WARNING,
        f"The amplitude jumps {count}: {listed}.",
        "Peak to peak, at parts of the natural frequency. Between a jump up and a jump down two "
        "stable motions exist: which one runs depends on where the speed came from.",
    )


def _parted(response: xr.Dataset, one: ModelSummary) -> Finding:
    part = response.sel(model=one.model)
    share = np.where(part["stable"].values > 0.5, part["separation_share"].values, 0.0)
    if not one.separated_up and not one.separated_down:
        return Finding(GOOD, "The teeth never separate in slow sweeps up and down.")
    return Finding(
        WARNING,
        f"The teeth separate: with rising speed {_ranges(one.separated_up)}, with falling speed "
        f"{_ranges(one.separated_down)} of the natural frequency.",
        f"For at most {100.0 * float(np.nanmax(share)):.0f} % of the time there is no contact; "
        "each return is an impact. More mean torque, or a smaller transmission error, keeps the "
        "flanks together.",
    )


def _ranges(ranges: list[tuple[float, float]]) -> str:
    return ", ".join(f"from {a:.3f} to {b:.3f}" for a, b in ranges) or "nowhere"


def _unstable(response: xr.Dataset, model: str) -> list[Finding]:
    ranges = unstable_ranges(response, model)
    if not ranges:
        return [
            Finding(
                GOOD,
                f"All motions of one mesh period are stable from {response.attrs['first']:g} to "
                f"{response.attrs['last']:g} of the natural frequency.",
            )
        ]
    part = response.sel(model=model)
    longer = sorted({int(one) for one in part["periods"].values if one > 1.0})
    detail = "An unstable motion does not persist; it separates the stable ones. "
    if longer:
        periods = " and ".join(map(str, longer))
        detail += f"Motions that repeat after {periods} mesh periods exist: orders between mesh "
        detail += "orders appear."
    return [
        Finding(
            NOTE,
            f"Motions of one mesh period are unstable {_ranges(ranges)} of the natural frequency.",
            detail.strip(),
        )
    ]


def _beside(every: dict[str, ModelSummary], model: str) -> list[Finding]:
    own = every[model].peak
    listed = [
        f"{words} {quantity_text(_MICRO * every[name].peak, 'µm')} "
        f"({100.0 * (every[name].peak / own - 1.0):+.0f} %)".replace("-", "−")
        for name, words in _SIMPLER.items()
        if name in every and name != model
    ]
    if not listed:
        return []
    return [
        Finding(
            NOTE,
            f"The largest response of simpler models is {', '.join(listed)}.",
            f"Compared with {quantity_text(_MICRO * own, 'µm')}, {MODELS[model]}.",
        )
    ]


def _over_load(load: xr.Dataset) -> Finding:
    part = load.isel(form=0)
    at = f"{load.attrs['relative_frequency']:g} of the natural frequency"
    apart = (part["separation_share"].values > 0.0) & (part["stable"].values > 0.5)
    torque = np.broadcast_to(part["torque"].values, apart.shape)
    if not apart.any():
        return Finding(GOOD, f"Over the torque, at {at}, no stable motion has teeth apart.")
    return Finding(
        WARNING,
        f"Over the torque, at {at}, stable motions with teeth apart exist from "
        f"{torque[apart].min():.0f} to {torque[apart].max():.0f} N·m.",
    )


def numbers(response: xr.Dataset) -> list[Number]:
    """Return the key numbers of a resonance study, with the same names in every run."""
    if "model" not in response:
        return []
    found = [Number("natural frequency", float(response.attrs["natural_frequency"]), "Hz", 4)]
    first = leading_model(response)
    for one in sorted(summaries(response), key=lambda one: one.model != first):
        label = MODELS[one.model]
        apart = [abs(b - a) for a, b in (*one.separated_up, *one.separated_down)]
        found += [
            Number(f"largest response, {label}", _MICRO * one.peak, "µm"),
            Number(f"mesh over natural frequency there, {label}", one.peak_at),
            Number(f"jumps, {label}", float(len(jumps(response, one.model))), digits=1),
            Number(f"widest range of parted teeth, {label}", max(apart, default=0.0)),
        ]
    return found
