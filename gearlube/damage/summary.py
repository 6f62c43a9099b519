"""The summary of a damage run: each mode of failure with value, limit, safety and verdict."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence

import numpy as np
import xarray as xr

from gearlube.damage.settings import DamageSettings
from gearlube.damage.teeth import Row, safety_row
from gearlube.report.numbers import number_text
from gearlube_core.rating.contact_temperature import scuffing_probability
from gearlube_core.rating.subsurface import OFFSET
from gearlube_core.units import ZERO_CELSIUS

SUMMARY_HEAD = ("failure mode", "value", "limit", "safety", "required", "verdict", "by")
_MODES = {
    "pitting, drive": "contact_damage", "pitting, coast": "contact_damage",
    "breakage": "bending_damage",
}  # fmt: skip
_NO_LIMIT = "no limit given"
_FATIGUE = "Dang Van with the limits given, at all depths; safety: of stress"
_FRACTURE = (
    "shear of a passing Hertz line, hardness after Lang, in the manner of ISO/TS 6336-4; safety: "
    "of stress"
)
_WEAR_LIMIT = 2.0  # um; beyond, the contact must be solved on the worn flank
TOO_DEEP = "too deep for the rate of a new flank"
_RISKS = ((0.1, "low risk"), (0.3, "moderate risk"), (1.01, "high risk"))


def summary_rows(
    dataset: xr.Dataset, settings: DamageSettings, more: Sequence[Row] = ()
) -> list[Row]:
    """Return the rows of the summary, in the order of `SUMMARY_HEAD`; `more` are by standards."""
    rows: list[Row] = []
    torque = dataset["torque"].values
    sides = {"pitting, drive": torque > 0.0, "pitting, coast": torque < 0.0}
    by = f"{dataset.attrs['standard']}; Miner's sum by ISO 6336-6"
    for mode, pair in json.loads(dataset.attrs["torque_factors"]).items():
        side = sides.get(mode, np.full(torque.shape, True))
        if side.any():
            sums = dataset[_MODES[mode]].values[side].sum(axis=0)
            for role, total, factor in zip(("pinion", "gear"), sums, pair, strict=True):
                value = number_text(total)
                rows.append(safety_row(f"{mode}, {role}", value, "1", factor, "1", "safe", by))
    rows += more
    for i, side_name in enumerate(("drive", "coast")):
        for j, role in enumerate(("pinion", "gear")):
            local = dataset["local_damage_map"].values[i, j].max()
            if local > 0.0:
                name = f"local pitting damage, {side_name}, {role}"
                how = "solved pressure in the standard's strength line; no safety"
                rows.append((name, number_text(local), "", "", "", "ranks places alone", how))
    hot = float(dataset["contact_temperature"].max())
    limit, verdict, scuffing = "", _NO_LIMIT, settings.scuffing_temperature
    if scuffing is not None:
        limit = f"{scuffing - ZERO_CELSIUS:.0f} °C"
        chance = scuffing_probability(hot + ZERO_CELSIUS, scuffing)
        risk = next(words for level, words in _RISKS if chance < level)
        verdict = f"{risk}: {100.0 * chance:.2g} %"
    by = "Blok's integral with the friction of the flanks; probability as AGMA 925, not checked"
    rows.append(("scuffing: contact temperature", f"{hot:.0f} °C", limit, "", "", verdict, by))
    rows += [_film_row(dataset), *_under_surface_rows(dataset)]
    whose, thin = "load on asperities", "ranks places alone"
    if settings.wear_of_all_load:
        whose, thin = "all load", "shallow"
    for j, role in enumerate(("pinion", "gear")):
        if settings.wear_coefficient is None:
            break
        depth = float(dataset["wear_map"].values[:, j].max())
        verdict = thin if depth <= _WEAR_LIMIT else TOO_DEEP
        by = f"Archard, k = {settings.wear_coefficient:g} 1/Pa, {whose}, the new flank's rate"
        if verdict == TOO_DEEP:
            verdict = "see the steps" if "worn_life" in dataset else TOO_DEEP
            by += "" if settings.car is None else "; --wear-steps solves the contact again"
        limit = f"{_WEAR_LIMIT:g} µm"
        rows.append((f"wear, {role}", f"{number_text(depth)} µm", limit, "", "", verdict, by))
    for j, role in enumerate(("pinion", "gear") if "worn_life" in dataset else ()):
        steps, life = dataset.sizes["step"] - 1, float(dataset["worn_life"][-1])
        depth = float(dataset["worn_depth"][-1, :, j].max())
        verdict = f"{100.0 * life:.0f} % of the life"
        by = f"Archard, {whose}, the contact solved again after each step"
        name = f"wear after {steps} steps, {role}"
        rows.append((name, f"{number_text(depth)} µm", "", "", "", verdict, by))
    for name, words, by in (
        ("bearing_damage", "basic life", "ISO/TS 16281:2008, load of each roller"),
        ("bearing_damage_modified", "modified life", "the same with a_ISO"),
    ):
        if name not in dataset:
            break
        for k, place in enumerate(dataset["bearing"].values):
            used = dataset[name].values[:, k]
            asked = name == "bearing_damage" or settings.cleanliness is not None
            if settings.bearings[k // 2] is None or not asked:
                continue
            total, label = float(used.sum()), f"bearing, {place}: {words} used"
            if np.isnan(total):
                why = "withheld: C_0 is missing, or kappa below 0.1"
                rows.append((label, "", "", "", "", why, by))
                continue
            life = 1.0 / total if total > 0.0 else np.inf
            value, how = number_text(total), f"{by}; safety: of life"
            rows.append(safety_row(label, value, "1", life, "1", "lasts", how))
    return rows


def _film_row(dataset: xr.Dataset) -> Row:
    film, name = float(dataset["film_ratio"].min()), "micropitting: least film ratio"
    least, law = dataset.attrs.get("permissible_film", math.nan), dataset.attrs["film"]
    if math.isnan(least):
        by = f"film: {law}; a limit must be solved with the same film"
        return name, number_text(film), "", "", "", _NO_LIMIT, by
    by = f"our own film on both ({law}), in the manner of ISO/TS 6336-22, method A"
    return safety_row(name, number_text(film), number_text(least), film / least, "", "safe", by)


def _under_surface_rows(dataset: xr.Dataset) -> list[Row]:
    fatigue, rows = "fatigue under the surface, {}: compression ", []
    for name, words, offset, by in (
        ("fracture_profile", "flank fracture, {}: A_FF", OFFSET, _FRACTURE),
        ("fatigue_profile", fatigue + "helps", 0.0, _FATIGUE),
        ("fatigue_bound_profile", fatigue + "does not help", 0.0, _FATIGUE),
    ):
        for side in dataset["side"].values if name in dataset else ():
            used = dataset[name].sel(side=side).values
            if not np.isnan(used).all():
                most, depth = np.nanmax(used), dataset["depth"].values[np.nanargmax(used)]
                safety = (1.0 - offset) / (most - offset) if most > offset else math.inf
                value = f"{number_text(most)}, {depth:.2f} mm deep"
                rows.append(safety_row(words.format(side), value, "1", safety, "1", "safe", by))
    return rows
