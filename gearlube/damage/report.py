"""The report of a damage run: verdicts, warnings, maps, worst bins."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.damage.summary import SUMMARY_HEAD, TOO_DEEP
from gearlube.plotting.drawn_tooth import ToothWords
from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import (
    GOOD,
    NOTE,
    WARNING,
    Column,
    Figure,
    Finding,
    Input,
    Number,
    Report,
    Table,
)

_TITLES = {
    "maps_drive": "Drive side of the teeth",
    "maps_coast": "Coast side of the teeth",
    "under_surface": "Under the surface",
    "bins": "The bins that matter most",
    "wear_steps": "Wear in steps",
}
_WORST, _LEAST_PECLET = 3, 5.0
_SETTLED = 1.0  # percent by which the rate of wear changes with a micrometre
_MUCH = 0.05  # share of the load at an edge, or outside a model, that is worth a word
_LIMITS = (
    "Calculated by the formulas of the standards as implemented here, not certified. Check a "
    "design against the standard itself.",
    "Each bin is steady running: no vibration, no shock. Give an application factor for them.",
    "The local pitting damage takes the solved pressure in the strength line of the standard. That "
    "line is made for the stress of the standard: the damage ranks places and bins, no more.",
    "The wear depth is the rate of the new flank times the cycles; its coefficient scatters by 40 "
    "to 60 % in one test, and the share of the load on asperities differs 30 times between laws of "
    "friction.",
)
_CAPTIONS = {
    "under_surface": "At the place of the greatest number of each kind. The method of flank "
    "fracture holds from the half width of the contact on, the number of Dang Van is known down to "
    "8 of them. Residual stress is left out.",
    "bins": "The bins that do most, at most ten, with torque, speed and oil temperature.",
    "wear_steps": "The side that wears most. The contact is solved again after each step on the "
    "worn flanks; the pressure is of the highest torque, the maps are of the end.",
}
_CAPTION = (
    "Each place shows its worst bin; wear and damage are sums over all bins. White: no contact, or "
    "no damage."
)


def damage_report(dataset: xr.Dataset, figures: Path, inputs: Sequence[Input] = ()) -> Report:
    """Return the report of `run_damage`, with the pictures in the folder `figures`."""
    hours = number_text(float(dataset["hours"].sum()))
    drawn = ToothWords(*json.loads(dataset.attrs["drawn"]))
    pictures = {path.stem: path.read_bytes() for path in figures.glob("*.png")}
    return Report(
        study="damage",
        title=f"Damage of {dataset.attrs['name']}",
        subtitle=f"{dataset.attrs['duty']}: {dataset.sizes['bin']} bins, {hours} h",
        findings=findings(dataset),
        numbers=_numbers(dataset),
        figures=[
            Figure(
                name=name,
                title=title,
                caption=_CAPTIONS.get(name, f"{_CAPTION} {drawn.where}"),
                picture=pictures[name],
            )
            for name, title in _TITLES.items()
            if name in pictures
        ],
        tables=[
            Table(
                title="Summary",
                columns=[Column(one) for one in SUMMARY_HEAD],
                rows=json.loads(dataset.attrs["summary"]),
                caption="Safety of gears: the factor on all torques at which the damage is 1.",
            )
        ],
        inputs=inputs,
        limits=(*_LIMITS, *dataset.attrs["limits"].splitlines()),
        files=("damage.nc", "damage.csv", "summary.csv"),
    )


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return what the run says: whether it lasts, then all else."""
    rows = json.loads(dataset.attrs["summary"])
    failed = [row for row in rows if row[5] == "fails" or row[5].startswith("high risk")]
    bad = [*failed, *(row for row in rows if row[5] == TOO_DEEP)]
    outside = "; ".join(dataset.attrs["outside"].splitlines())
    return [
        _answer(dataset, rows, failed),
        *(Finding(WARNING, f"{row[0]}: {row[5]}, {row[1]}.", f"By {row[6]}.") for row in bad),
        *_strength(dataset),
        *(Finding(NOTE, *words) for words in json.loads(dataset.attrs["notes"])),
        *_worst(dataset),
        *_worn(dataset),
        *_warnings(dataset),
        *_not_given(dataset),
        *([Finding(WARNING, f"Ratings are outside the standard: {outside}.")] if outside else []),
    ]


def _answer(
    dataset: xr.Dataset, rows: Sequence[Sequence[str]], failed: Sequence[Sequence[str]]
) -> Finding:
    """Say whether it lasts, as far as there are limits for it."""
    hot, film = float(dataset["contact_temperature"].max()), float(dataset["film_ratio"].min())
    loads = (
        f"Largest Hertz pressure {quantity_text(float(dataset['pressure'].max()), 'GPa')}, "
        f"thinnest film {number_text(film)} of the roughness, hottest contact {hot:.0f} °C."
    )
    if failed:
        words = "; ".join(row[0] + (f" (safety {row[3]})" if row[3] else "") for row in failed)
        return Finding(WARNING, f"It does not last by {words}.", loads)
    judged = [row for row in rows if row[3]]
    if not judged:
        asked = "No mode of failure has a limit, so it is not known whether it lasts."
        return Finding(NOTE, asked, f"{loads} A finding below says which data it takes.")
    least = min(judged, key=lambda row: math.inf if row[3] == "∞" else float(row[3]))
    outside = dataset.attrs["outside"]
    doubt = ", with ratings outside the range of the standard" if outside else ""
    return Finding(
        NOTE if outside else GOOD,
        f"It lasts by all {len(judged)} checks that have a limit{doubt}; the least safety is "
        f"{least[3]}: {least[0]}.",
        f"By {least[6]}. The formulas are not certified. {loads}",
    )


def _not_given(dataset: xr.Dataset) -> list[Finding]:
    """Return which modes of failure have no limit, and which data give one."""
    of = dataset.attrs
    lacking = (
        (
            not json.loads(of["torque_factors"]) and not of["withheld"],
            "pitting and breakage (--contact-limit-mpa and --bending-limit-mpa; 1500 and 430 MPa "
            "are an example of case-hardened steel of medium quality)",
        ),
        (
            "permissible_film" not in of,
            "micropitting (--micropitting-torque-nm, of the failure stage of the oil's C-GF test; "
            "265.1 N·m is stage 10)",
        ),
        (
            "depth" not in dataset,
            "damage under the surface (--surface-hv, --core-hv and --case-depth-mm, or "
            "--torsion-limit-mpa and --bending-fatigue-mpa)",
        ),
        (
            "wear_map" not in dataset,
            "wear (--wear-coefficient, of your own tests; for an order of size 5e-18 1/Pa, mild "
            "wear of FZG gears in oil, a number from memory)",
        ),
    )
    found = [words for holds, words in lacking if holds]
    modes = ", ".join(one.partition(" (")[0] for one in found)
    return (
        [Finding(NOTE, f"Not given: data for {modes}.", f"Options for them: {'; '.join(found)}.")]
        if found
        else []
    )


def _strength(dataset: xr.Dataset) -> list[Finding]:
    factors = json.loads(dataset.attrs["torque_factors"])
    if not factors:
        withheld = dataset.attrs["withheld"]
        return [Finding(WARNING, f"No strength: {withheld}.")] if withheld else []
    each = {f"{mode}, {role}": pair[i] for mode, pair in factors.items()
            for i, role in enumerate(("pinion", "gear"))}  # fmt: skip
    mode = min(each, key=lambda one: each[one])
    stress, local = dataset["contact_stress"].max("member").values, dataset["pressure"].values
    i = int(np.nanargmax(stress))
    return [
        Finding(
            GOOD if each[mode] >= 1.0 else WARNING,
            f"The damage is 1 at {number_text(each[mode])} times all torques: {mode}.",
            f"By {dataset.attrs['standard']}, with Miner's sum.",
        ),
        Finding(
            NOTE,
            f"The standard's contact stress is {number_text(1e-3 * stress[i] / local[i])} times "
            "the solved pressure.",
            f"In the bin {_bins(dataset)[i]}: {stress[i]:.0f} MPa with all factors, beside "
            f"{1e3 * local[i]:.0f} MPa. Divide the pressure by this factor before you compare "
            "local damage with that of the standard.",
        ),
    ]


def _bins(dataset: xr.Dataset) -> list[str]:
    return list(json.loads(dataset.attrs["bins"]))


def _worst(dataset: xr.Dataset) -> list[Finding]:
    ranked = {"contact_damage": "pitting damage", "local_damage": "local damage", "wear": "wear"}
    name = next((one for one in ranked if one in dataset and dataset[one].any()), None)
    if name is None:
        return []
    values = dataset[name].max("member").values
    shares = 100.0 * values / max(float(values.sum()), 1e-300)
    order = np.argsort(values)[::-1][:_WORST]
    parts = "; ".join(f"{_bins(dataset)[i]} ({shares[i]:.0f} %)" for i in order if shares[i] > 0.5)
    return [Finding(NOTE, f"These bins do most of the {ranked[name]}: {parts}.")]


def _worn(dataset: xr.Dataset) -> list[Finding]:
    """Return the effect of steps of wear on contact and noise."""
    if "worn_life" not in dataset:
        return []
    steps, life = dataset.sizes["step"] - 1, float(dataset["worn_life"][-1])
    side = int(dataset["worn_depth"].values[-1].max(axis=1).argmax())
    pinion, gear = dataset["worn_depth"].values[-1, side]
    pressure, error = (dataset[one].values[:, side] for one in ("worn_pressure", "worn_error"))
    rate = dataset["worn_rate"].values[:, side].max(axis=1)
    depth = rate[-2] * float(np.diff(dataset["worn_life"])[-1])  # of the last step
    falls = 100.0 * (1.0 - rate[-1] / rate[-2]) / depth if depth > 0.0 else 0.0
    left = ""
    if 0.0 < life < 1.0:
        left = f" A whole life takes about {steps / life:.0f} steps: give --wear-steps."
    return [
        Finding(
            NOTE if life >= 1.0 else WARNING,
            f"After {steps} steps, {100.0 * life:.3g} % of the life, the "
            f"{dataset['side'].values[side]} flanks have lost {number_text(pinion)} µm of the "
            f"pinion and {number_text(gear)} µm of the gear.",
            f"Largest Hertz pressure: from {pressure[0]:.3g} to {pressure[-1]:.3g} GPa. Loaded "
            f"transmission error: from {error[0]:.3g} to {error[-1]:.3g} µm, peak to peak. "
            f"At the end the rate of wear falls by {falls:.2g} % with each µm: the pattern "
            f"{'has settled' if abs(falls) < _SETTLED else 'still changes'}.{left}",
        )
    ]


def _warnings(dataset: xr.Dataset) -> list[Finding]:
    """Return the limits of the solved numbers."""
    hours, edge = dataset["hours"].values, dataset["at_edge"].values
    time = hours / hours.sum()
    thin = 100.0 * time[dataset["film_ratio"].values < 1.0].sum()
    outside = 100.0 * time[dataset["outside"].values > _MUCH].sum()
    least = dataset.attrs.get("permissible_film", math.nan)
    asked = "permissible_film" in dataset.attrs
    below = 100.0 * time[dataset["film_ratio"].values < least].sum()
    slow = int((dataset["peclet"].values < _LEAST_PECLET).sum())
    beyond = int((np.abs(dataset["torque"].values) > dataset.attrs["table_torque_n_m"]).sum())
    listed = (
        (
            edge.max() > _MUCH, WARNING,
            f"Edges of teeth press: up to {100.0 * edge.max():.0f} % of the load, in the bin "
            f"{_bins(dataset)[int(edge.argmax())]}.",
            "The maps do not show this pressure. Tip relief or crowning takes it away.",
        ),
        (
            beyond > 0, WARNING,
            f"{beyond} bins are beyond the torques of the mesh table, "
            f"{dataset.attrs['table_torque_n_m']:g} N·m.",
            "Shares of the load are those at its end. Analyse the contact at higher torques.",
        ),
        (
            thin > 0.0, NOTE,
            f"The film is thinner than the roughness in {thin:.0f} % of the time.",
            f"The least film ratio is {number_text(float(dataset['film_ratio'].min()))}.",
        ),
        (
            dataset.attrs["film"] == "solved" and outside > 0.0, WARNING,
            f"In {outside:.0f} % of the time load is outside the model of solved films.",
            "Film and friction go over into those of the formulas there.",
        ),
        (
            math.isnan(least) and asked, NOTE,
            "No limit of micropitting: the test gear is outside the model of solved films.",
            "A limit by formulas does not hold for solved films. Use formulas for both.",
        ),
        (
            below > 0.0, NOTE,
            f"The film is below the permissible one in {below:.2g} % of the time.",
            "It may micropit there. The permissible film is 1.4 times that of the test gear.",
        ),
        (
            slow > 0, NOTE, f"Bins with slow surfaces, Peclet number below 5: {slow}.",
            "The rise of temperature there is less than shown.",
        ),
    )  # fmt: skip
    return [Finding(level, *words) for holds, level, *words in listed if holds]


def _numbers(dataset: xr.Dataset) -> list[Number]:
    found = [
        Number("largest Hertz pressure", float(dataset["pressure"].max()), "GPa"),
        Number("least film over roughness", float(dataset["film_ratio"].min())),
        Number("greatest contact temperature", float(dataset["contact_temperature"].max()), "°C"),
    ]
    for i, role in enumerate(("pinion", "gear")):
        if "wear_map" in dataset:
            deepest = float(dataset["wear_map"][:, i].max())
            found.append(Number(f"wear depth, {role}", deepest, "µm"))
        for mode, pair in json.loads(dataset.attrs["torque_factors"]).items():
            factor = float(pair[i]) if math.isfinite(pair[i]) else math.nan  # without such loads
            found.append(Number(f"torque factor, {mode}, {role}", factor))
    return found
