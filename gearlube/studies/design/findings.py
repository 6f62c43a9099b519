"""What a design says, in sentences with numbers."""

from __future__ import annotations

import json
import math
import re

import numpy as np
import xarray as xr

from gearlube.report.numbers import number_text, quantity_text, unit_words
from gearlube.report.parts import ASSUMED, GOOD, NOTE, WARNING, Finding, Number
from gearlube.studies.design.summary import (
    CENTRE_LIMIT,
    ERROR_LIMIT,
    LENGTH_LIMIT,
    PATH_LIMIT,
)
from gearlube_core.hypoid_design.pinion_fit import SIDES
from gearlube_core.units import DEGREE, MILLIMETRE

_MICRO = 1e-6
_UNITS = {"urad": "µrad", "um": "µm", "deg": "°"}


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a design, the most important first.

    Examples
    --------
    >>> findings(xr.load_dataset("gearlube_design/design.nc"))[0].headline  # doctest: +SKIP
    'Drive flanks: found what was asked: transmission error 49.6 µrad (50.0 asked), ...'
    """
    said = json.loads(dataset.attrs["warnings"])
    return [
        *(_contact(dataset.sel(side=side), side) for side in SIDES),
        *_relief(dataset, sound=not any("flanks carry" in one for one in said["contact"])),
        *_sentences(said["contact"]),
        *_sentences([*said["teeth"], *said["blank"], *said["pair"]]),
        *_teeth(dataset, sound=not said["teeth"]),
        _path(dataset),
        *_chosen(dataset),
    ]


def missed_targets(part: xr.Dataset, side: str) -> list[str]:
    """Return which targets one side missed by more than a design may miss."""
    limits = {
        "error": ("transmission error", ERROR_LIMIT["drive" if side == "drive" else "coast"]),
        "path_angle": ("direction of the path", PATH_LIMIT),
        "centre": ("mean contact", CENTRE_LIMIT),
        "length": ("contact ellipse", LENGTH_LIMIT),
    }
    return [
        words
        for name, (words, limit) in limits.items()
        if abs(float(part[f"missed_{name}"])) > limit
    ]


def _contact(part: xr.Dataset, side: str) -> Finding:
    name = f"{side.capitalize()} flanks"
    if math.isnan(float(part["found_error"])):
        return Finding(WARNING, f"{name}: no parabolic transmission error was found.")
    told = [
        f"{words} {number_text(float(part[f'found_{key}']) / scale)} {unit} "
        f"({number_text(float(part[f'asked_{key}']) / scale)} wanted)"
        for key, words, scale, unit in (
            ("error", "transmission error", _MICRO, "µrad"),
            ("path_angle", "path at", DEGREE, "°"),
            ("length", "ellipse", MILLIMETRE, "mm"),
        )
    ]
    centre = quantity_text(float(part["missed_centre"]) / MILLIMETRE, "mm", 2)
    missed = missed_targets(part, side)
    verdict = f"missed: {', '.join(missed)}" if missed else "as wanted"
    relieved = float(part["relieved_error"]) / _MICRO
    relief = (
        "no extreme" if math.isnan(relieved) else f"an error of {quantity_text(relieved, 'µrad')}"
    )
    return Finding(
        WARNING if missed else GOOD,
        f"{name}, {verdict}: {', '.join(told)}, mean contact {centre} off.",
        f"Flanks as cut, without load. With relief there is {relief}.",
    )


def _relief(dataset: xr.Dataset, *, sound: bool) -> list[Finding]:
    """Say the pressure at the torque of the relief; nothing where it is not known."""
    pressure = 1e-9 * dataset["relief_pressure"]
    if bool(np.isnan(pressure).any()):
        return []
    torque = float(dataset.attrs["relief_torque"])
    told = " and ".join(f"{float(pressure.sel(side=side)):.2f} GPa ({side})" for side in SIDES)
    amounts = "; ".join(
        f"{side}: "
        + ", ".join(
            f"{edge} {1e6 * float(dataset['relief'].sel(side=side, edge=edge)):.0f} µm"
            for edge in dataset["edge"].values
        )
        for side in SIDES
    )
    return [
        Finding(
            GOOD if sound else NOTE,
            f"At {torque:g} N·m of the pinion the highest pressure is {told}"
            f"{', and no edge carries' if sound else ''}.",
            f"Relief, {amounts}. Give relief.torque_n_m to choose it for another torque.",
        )
    ]


def _sentences(said: list[str]) -> list[Finding]:
    found = []
    for one in said:
        text = _with_signs(one[:1].upper() + one[1:])
        head, stop, rest = text.partition(". ")
        found.append(Finding(WARNING, head + stop.strip(), rest))
    return found


def _with_signs(text: str) -> str:
    return re.sub(r"(?<= )(urad|um|deg)\b", lambda found: _UNITS[found[1]], text)


def _teeth(dataset: xr.Dataset, *, sound: bool) -> list[Finding]:
    top, slot = (dataset[name].min("face") / MILLIMETRE for name in ("topland", "slot"))
    told = ", ".join(
        f"{member} {quantity_text(float(top.sel(member=member)), 'mm')}"
        for member in dataset["member"].values
    )
    points = ", ".join(
        f"{member} {quantity_text(float(slot.sel(member=member)), 'mm')}"
        for member in dataset["member"].values
    )
    undercut = bool(np.isfinite(dataset["undercut"].values).any())
    words = "" if undercut else "; no flank is undercut"
    return [
        Finding(
            GOOD if sound else NOTE,
            f"The smallest toplands are {told}{words}.",
            f"Blade points may be as wide as the slot at its narrowest: {points}.",
        )
    ]


def _path(dataset: xr.Dataset) -> Finding:
    ratios = {side: float(dataset["path_contact_ratio"].sel(side=side)) for side in SIDES}
    told = ", ".join(f"{ratio:.2f} on the {side} flanks" for side, ratio in ratios.items())
    low = min(ratios.values()) < 1.0
    return Finding(
        WARNING if low else NOTE,
        f"The contact ratio is {told}.",
        "Below 1 the next pair starts contact at an edge: lengthen the path, or make deeper teeth."
        if low
        else "Above 1 the next pair is in contact before the last one leaves.",
    )


def _chosen(dataset: xr.Dataset) -> list[Finding]:
    notes = json.loads(dataset.attrs["inputs"])
    chosen = [one for one in notes if one[3] == ASSUMED]
    if not chosen:
        return [Finding(GOOD, "All fields of the blank were given.")]
    told = "; ".join(
        f"{field} {value} {unit_words(unit)}".strip() for field, value, unit, *_ in chosen
    )
    return [
        Finding(
            NOTE,
            f"{len(chosen)} of {len(notes)} fields were chosen, not given.",
            f"Give the values that you know better: {told}.",
        )
    ]


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a design, with the same names in every run."""
    found = []
    for side in SIDES:
        part = dataset.sel(side=side)
        error, ratio = float(part["found_error"]) / _MICRO, float(part["path_contact_ratio"])
        length = float(part["found_length"]) / MILLIMETRE
        found += [
            Number(f"transmission error as cut, {side}", error, "µrad"),
            Number(f"contact ellipse, {side}", length, "mm"),
            Number(f"path of contact, {side}", ratio, "pitches"),
            Number(f"highest pressure, {side}", 1e-9 * float(part["relief_pressure"]), "GPa"),
        ]
    for member in dataset["member"].values:
        part = dataset.sel(member=member)
        top, slot = (float(part[name].min()) / MILLIMETRE for name in ("topland", "slot"))
        found += [
            Number(f"least topland, {member}", top, "mm"),
            Number(f"least slot at the root, {member}", slot, "mm"),
        ]
    return found
