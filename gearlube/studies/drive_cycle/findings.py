"""What a drive cycle says, in sentences with numbers."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.plotting.loss_words import source_words
from gearlube.report.churning import regime_findings
from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.report.solved_films import (
    bearing_drag,
    covered_share,
    flank_friction,
    model_of,
    points_beyond,
    solved_films,
    solved_rollers,
)
from gearlube.studies.drive_cycle.tables import range_sentence
from gearlube_core.film_model.model import FLANK, ROLLER

_NAMED, _LEAST_SHARE = 3, 0.005  # sources of loss that are told, if they are not smaller
_DRAWN = "efficiency_low"  # a variable of cycles with draws of all uncertain data
_WH = 1.0 / 3.6  # Wh in a kJ


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a drive cycle, the most important first."""
    return [
        _lost(dataset),
        _temperature(dataset),
        *_brakes(dataset),
        *_solved(dataset),
        *_rollers(dataset),
        *_churning(dataset),
        _ranges(dataset),
        *(Finding(WARNING, note) for note in dataset.attrs.get("trace_notes", "").splitlines()),
        Finding(NOTE, f"Not modelled: {dataset.attrs['not_modelled']}."),
    ]


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a drive cycle."""
    oil = dataset["oil_temperature"].values
    return [
        Number("energy lost in the axle", float(dataset["energy_lost"].sum()), "kJ", 4),
        Number(
            "energy lost in the axle, in Wh", _WH * float(dataset["energy_lost"].sum()), "Wh", 4
        ),
        Number("energy lost in the axle, low end", float(dataset["energy_lost_low"]), "kJ", 4),
        Number("energy lost in the axle, high end", float(dataset["energy_lost_high"]), "kJ", 4),
        Number("energy into the axle", float(dataset["energy_in"]), "kJ", 4),
        Number("efficiency over the cycle", 100.0 * float(dataset["efficiency"]), "%", 4),
        Number("oil at the end", float(oil[-1]), "°C"),
        Number("warmest oil", float(oil.max()), "°C"),
        *(
            Number(f"lost by {source_words(str(one['source'].values))}", float(one), "kJ")
            for one in dataset["energy_lost"]
            if float(one) > _LEAST_SHARE * float(dataset["energy_lost"].sum())
        ),
    ]


def _lost(dataset: xr.Dataset) -> Finding:
    energy = dataset["energy_lost"].values
    lost, put_in = float(energy.sum()), float(dataset["energy_in"])
    names = [source_words(str(one)) for one in dataset["source"].values]
    parts = ", ".join(
        f"{names[i]} {100.0 * energy[i] / lost:.0f} %"
        for i in np.argsort(energy)[::-1][:_NAMED]
        if energy[i] > _LEAST_SHARE * lost
    )
    share = f", {100.0 * lost / put_in:.1f} % of the energy put in" if put_in > 0.0 else ""
    low, high = (float(dataset[f"energy_lost_{end}"]) for end in ("low", "high"))
    return Finding(
        NOTE,
        f"The axle loses {quantity_text(lost, 'kJ')} ({quantity_text(_WH * lost, 'Wh')}) in the "
        f"cycle{share}{': ' + parts if parts else ''}.",
        f"{_whose(dataset)} it is {number_text(low)} to {quantity_text(high, 'kJ')}.",
    )


def _whose(dataset: xr.Dataset) -> str:
    """Return what the ends of the energy and of the last temperature hold."""
    if _DRAWN in dataset:
        return "With the uncertain data of axle and heat (95 % of the draws)"
    return "With heat capacity and conductances at the ends of their assumed intervals"


def _temperature(dataset: xr.Dataset) -> Finding:
    oil = dataset["oil_temperature"].values
    low, high = (
        float(
            dataset[f"end_temperature_{end}"]
            if _DRAWN in dataset
            else dataset[f"oil_temperature_{end}"].values[-1]
        )
        for end in ("low", "high")
    )
    return Finding(
        NOTE,
        f"The oil goes from {oil[0]:.0f} to {oil[-1]:.0f} °C.",
        f"{_whose(dataset)} it ends between {low:.0f} and {high:.0f} °C; air is at "
        f"{dataset.attrs['air_temperature_degc']:g} °C.",
    )


def _brakes(dataset: xr.Dataset) -> list[Finding]:
    brakes = float(dataset["energy_brakes"])
    if brakes <= 0.0:
        return []
    return [
        Finding(
            NOTE,
            f"The friction brakes take {quantity_text(brakes, 'kJ')}.",
            f"Share of the braking that goes through the axle: {dataset.attrs['regeneration']:g}.",
        )
    ]


def _solved(dataset: xr.Dataset) -> list[Finding]:
    """Say how far the model of solved films is to be trusted, where the axle took it."""
    if "energy_lost_bound" not in dataset:
        return []
    lost = float(dataset["energy_lost_bound"])
    if not float(flank_friction(dataset["energy_lost"])) > 0.0:
        return []
    friction = flank_friction(dataset["loss"]) * dataset["duration"]
    outside = float((friction * dataset["share_outside"]).sum() / friction.sum())
    effect = f"That is {quantity_text(lost, 'kJ', 2)} of energy lost"
    doubt = float(dataset["efficiency_bound"])
    if np.isfinite(doubt):
        effect += f" and {quantity_text(100.0 * doubt, '%', 2)} of efficiency over the cycle"
    words = f"with {100.0 * outside:.1f} % of the flanks' friction loss"
    words += points_beyond(dataset["share_outside"], "steps")
    bound = covered_share(dataset["friction_bound"] * dataset["duration"], friction)
    return [solved_films(bound, outside, words, f"{effect}.", model_of(dataset, FLANK))]


def _rollers(dataset: xr.Dataset) -> list[Finding]:
    """Say the same of the model of rollers."""
    if "drag_bound" not in dataset:
        return []
    lost = float(dataset["energy_drag_bound"])
    if not float(bearing_drag(dataset["energy_lost"])) > 0.0:
        return []
    drag = bearing_drag(dataset["loss"]) * dataset["duration"]
    outside = float((drag * dataset["rollers_outside"]).sum() / drag.sum())
    effect = f"That is {quantity_text(lost, 'kJ', 2)} of energy lost."
    words = f"with {100.0 * outside:.1f} % of the bearings' drag loss"
    words += points_beyond(dataset["rollers_outside"], "steps")
    bound = covered_share(dataset["drag_bound"] * dataset["duration"], drag)
    return [solved_rollers(bound, outside, words, effect, model_of(dataset, ROLLER))]


def _churning(dataset: xr.Dataset) -> list[Finding]:
    if "churning_regime" not in dataset:
        return []
    oil = dataset["oil_temperature"].values
    return regime_findings(
        dataset["churning_regime"].values,
        dataset["pinion_speed"].values,
        "rpm",
        dataset["loss"].sel(source="churning").values,
        0.5 * (oil[1:] + oil[:-1]),
    )


def _ranges(dataset: xr.Dataset) -> Finding:
    left = range_sentence(dataset)
    if not left:
        return Finding(GOOD, "No step left the range of a formula or table.")
    share = 100.0 * float(dataset["energy_outside_range"].max())
    return Finding(
        WARNING,
        f"Up to {number_text(share, 2)} % of the energy is lost outside the range of a formula or "
        "table.",
        f"It is extrapolated there. {left}",
    )
