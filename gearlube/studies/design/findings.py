"""Findings of a design: targets, results and warnings, as numbers and sentences."""

from __future__ import annotations

import json
import math
import re
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import ASSUMED, GOOD, NOTE, WARNING, Finding, Number
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.refusal import pair_warnings
from gearlube_core.hypoid_design.design import Design, misses
from gearlube_core.hypoid_design.flank_target import MeanContact
from gearlube_core.hypoid_design.pinion_fit import SIDES
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.flank.tooth_form import ToothForm
from gearlube_core.input_file.input_file import InputNote
from gearlube_core.units import DEGREE, MILLIMETRE

# what a design may miss before the report says so
ERROR_LIMIT: dict[Side, float] = {"drive": 0.10, "coast": 0.15}
PATH_LIMIT = 2.0 * DEGREE
CENTRE_LIMIT = 0.5 * MILLIMETRE
LENGTH_LIMIT = 0.25
_MICRO = 1e-6
_TORQUE = "0.2 N/mm2 times the cube of the gear's outer diameter, on the gear"
_PATH = "44 deg from the normal of the lines of contact; 30 or 15 if that fails"
_UNITS = {"urad": "µrad", "um": "µm", "deg": "°"}


class AskedAndFound(NamedTuple):
    """One number of the contact of one side, as a table shows it."""

    side: str
    what: str
    asked: str
    found: str


def asked_and_found(design: Design) -> list[AskedAndFound]:
    """Return the numbers of the unloaded contact on both sides; none of a side without."""
    rows = []
    for side in SIDES:
        target, found = design.targets[side], design.measured[side]
        if isinstance(found, str):
            continue
        _, _, centre, _ = misses(target, found, design.designed)
        for what, asked, value in (
            ("transmission error [urad]", target.error / _MICRO, found.error / _MICRO),
            ("path direction [deg]", target.path_angle / DEGREE, found.path_angle / DEGREE),
            ("ellipse length [mm]", target.length / MILLIMETRE, found.length / MILLIMETRE),
        ):
            rows.append(AskedAndFound(side, what, f"{asked:.1f}", f"{value:.1f}"))
        relieved = design.relieved[side]
        text = "no extreme" if isinstance(relieved, str) else f"{relieved.error / _MICRO:.1f}"
        what = "transmission error with relief [urad]"
        rows.insert(-2, AskedAndFound(side, what, "", text))
        places = [f"s {one.s:.3f}, t {one.t:.3f}" for one in (target, found)]
        off = f"{places[1]} ({centre / MILLIMETRE:.2f} mm off)"
        rows.append(AskedAndFound(side, "mean contact", places[0], off))
        rows.append(
            AskedAndFound(side, "contact ratio of the path", "", f"{found.contact_ratio:.2f}")
        )
    return rows


def unmet_targets(design: Design) -> list[str]:
    """Return how near a design came to each target that it missed, and what to relax."""
    said = []
    for side in SIDES:
        target, found = design.targets[side], design.measured[side]
        pair = FlankPair.from_file(design.file, side)
        across = MeanContact.at(pair, target.s, target.t).path_angle(0.0) / DEGREE
        cure = (
            f"Relax: a larger contact.{side}_error_urad, a longer contact.ellipse_length_mm, or "
            f"contact.{side}_path_angle_deg nearer to {across:.0f} deg, the normal of the lines of "
            "contact."
        )
        denied = design.designed.file.machine.denied
        if denied:
            cure += f" Or allow {denied}."
        if isinstance(found, str):
            gap = design.fit.rms[side] / _MICRO
            said.append(
                f"The {side} flanks have no parabolic transmission error; their gap came within "
                f"{gap:.1f} um (rms) of the wanted one. {found} {cure}"
            )
            continue
        error, turned, centre, length = misses(target, found, design.designed)
        if abs(error) > ERROR_LIMIT[side]:
            said.append(
                f"The transmission error of the {side} flanks came to {found.error / _MICRO:.0f} "
                f"urad, wanted {target.error / _MICRO:.0f} urad. {cure}"
            )
        if abs(turned) > PATH_LIMIT:
            said.append(
                f"The path of contact of the {side} flanks came to {found.path_angle / DEGREE:.1f} "
                f"deg, wanted {target.path_angle / DEGREE:.1f} deg. {cure}"
            )
        if centre > CENTRE_LIMIT:
            said.append(
                f"The mean contact of the {side} flanks came within {centre / MILLIMETRE:.2f} mm "
                f"of the wanted place. {cure}"
            )
        if abs(length) > LENGTH_LIMIT:
            if found.length < target.length:
                cure = cure.replace("a longer contact.ellipse", "a shorter contact.ellipse")
            said.append(
                f"The contact ellipse of the {side} flanks came to {found.length / MILLIMETRE:.1f} "
                f"mm, wanted {target.length / MILLIMETRE:.1f} mm. {cure}"
            )
    return said


def design_warnings(design: Design, forms: dict[str, ToothForm]) -> dict[str, list[str]]:
    """Return warnings about a design: sentences on its blank, contact, pair and teeth."""
    teeth = [line for form in forms.values() for line in form.report()]
    said = [one for one in design.measured.values() if isinstance(one, str)]
    pair = [
        # no setting is mistyped here: what would be most likely wrong in a given file is not said
        one.partition(" Most likely wrong:")[0]
        for one in pair_warnings(design.file)
        if not any(one.startswith(reason) for reason in said)
    ]
    contact = unmet_targets(design) + design.relief.warnings()
    return {"blank": list(design.warnings), "contact": contact, "pair": pair, "teeth": teeth}


def design_inputs(design: Design) -> list[InputNote]:
    """Return the numbers of the blank file, and those of the contact that it leaves open."""
    notes = design.designed.file.inputs()
    named = {note.field for note in notes}
    drive, coast = design.targets["drive"], design.targets["coast"]
    for key, value, unit, why in (
        ("ellipse_length_mm", drive.length / MILLIMETRE, "mm", "a third of the face width"),
        ("profile_position", drive.s, "", "the middle of the working depth"),
        ("drive_path_angle_deg", drive.path_angle / DEGREE, "deg", _PATH),
        ("coast_path_angle_deg", coast.path_angle / DEGREE, "deg", _PATH),
    ):
        if f"contact.{key}" not in named:
            notes.append(InputNote(f"contact.{key}", value, unit, "assumed", why))
    return notes + _relief_notes(design, named)


def _relief_notes(design: Design, named: set[str]) -> list[InputNote]:
    chosen = design.relief
    found = [InputNote("relief.torque_n_m", chosen.torque, "N.m", "assumed", _TORQUE)]
    why = f"no edge carries at {chosen.torque:g} N.m"
    for key, edges in (("tip_relief_um", ("pinion tip", "gear tip")), ("end_relief_um", ("ends",))):
        amounts = [chosen.amounts[side][edge] for side in SIDES for edge in edges]
        low, high = min(amounts), max(amounts)
        text = f"{low:g}" if low == high else f"{low:g} to {high:g}"
        found.append(InputNote(f"relief.{key}", text, "um", "assumed", why))
    return [one for one in found if one.field not in named]


def design_settings(design: Design) -> list[tuple[str, str, str]]:
    """Return field, value and origin of every setting and cutter dimension of the gear file."""
    origins = {"table": "given", "inferred": "follows", "completed": "chosen"}
    rows = []
    data = design.file.model_dump(exclude_defaults=True)
    for role in ("gear", "pinion"):
        for section in ("cutter", "machine"):
            for key, value in data[role][section].items():
                field = f"{role}.{section}.{key}"
                rows.append((field, f"{value:.6g}", origins[design.file.origin(field)]))
    return rows


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a design, the most important first.

    Examples
    --------
    >>> findings(xr.load_dataset("gearlube_design/design.nc"))[0].headline  # doctest: +SKIP
    'With relief the transmission error without load is 64.1 µrad (drive) and 119 µrad (coast). ...'
    """
    said = json.loads(dataset.attrs["warnings"])
    return [
        _finished(dataset, sound=not any("flanks carry" in one for one in said["contact"])),
        *(_contact(dataset.sel(side=side), side) for side in SIDES),
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
    name = f"{side.capitalize()} flanks as cut, before relief"
    if math.isnan(float(part["found_error"])):
        return Finding(WARNING, f"{name}: no parabolic transmission error was found.")
    listed = [
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
    return Finding(
        WARNING if missed else GOOD,
        f"{name}, {verdict}: {', '.join(listed)}, mean contact {centre} off.",
    )


def _finished(dataset: xr.Dataset, *, sound: bool) -> Finding:
    """Say what the teeth with relief do; the pressure only where it is known."""

    def both(name: str, unit: str, scale: float) -> str:
        values = {side: float(dataset[name].sel(side=side)) / scale for side in SIDES}
        return " and ".join(
            f"{'not parabolic' if math.isnan(one) else quantity_text(one, unit)} ({side})"
            for side, one in values.items()
        )

    errors = both("relieved_error", "µrad", _MICRO)
    said = f"With relief the transmission error without load is {errors}"
    if not bool(np.isnan(dataset["relief_pressure"]).any()):
        said += (
            f", the highest pressure at {float(dataset.attrs['relief_torque']):g} N·m of the "
            f"pinion {both('relief_pressure', 'GPa', 1e9)}"
        ) + (", and no edge carries" if sound else "")
    amounts = "; ".join(
        f"{side}: "
        + ", ".join(
            f"{edge} {1e6 * float(dataset['relief'].sel(side=side, edge=edge)):.0f} µm"
            for edge in dataset["edge"].values
        )
        for side in SIDES
    )
    return Finding(
        GOOD if sound else NOTE,
        f"{said}.",
        f"Relief, {amounts}. Give relief.torque_n_m to choose it for another torque.",
    )


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
    listed = ", ".join(
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
            f"The smallest toplands are {listed}{words}.",
            f"Blade points may be as wide as the slot at its narrowest: {points}.",
        )
    ]


def _path(dataset: xr.Dataset) -> Finding:
    ratios = {side: float(dataset["path_contact_ratio"].sel(side=side)) for side in SIDES}
    listed = ", ".join(f"{ratio:.2f} on the {side} flanks" for side, ratio in ratios.items())
    low = min(ratios.values()) < 1.0
    return Finding(
        WARNING if low else NOTE,
        f"The contact ratio is {listed}.",
        "Below 1 the next pair starts contact at an edge: lengthen the path, or make deeper teeth."
        if low
        else "Above 1 the next pair is in contact before the last one leaves.",
    )


def _chosen(dataset: xr.Dataset) -> list[Finding]:
    notes = json.loads(dataset.attrs["inputs"])
    chosen = [one for one in notes if one[3] == ASSUMED]
    if not chosen:
        return [Finding(GOOD, "All fields of the blank were given.")]
    return [
        Finding(
            NOTE,
            f"{len(chosen)} of {len(notes)} fields were chosen, not given.",
            "Give the values that you know better: the table of inputs has all of them.",
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
