"""Text that the command prints about bearing friction: error bar first, main numbers, warnings."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube_core.bearings.losses.laws import CATALOGUE_LAWS, MATERIAL_LIMIT_WORDS
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm

MOST_ROWS = 24
_THIN = 1.0  # film over roughness, below which raceways are no longer in full film


class BearingRow(NamedTuple):
    """One condition of the first law, SI."""

    speed: float
    axial_load: float
    radial_load: float
    temperature: float
    parts: dict[str, float]  # [N m]
    torque: float
    power: float


def error_sentences(dataset: xr.Dataset) -> list[str]:
    """Return the error bar of each law and its reason."""
    groups: dict[float, list[str]] = {}
    for law in dataset["law"].values:
        factor = round(20.0 * float(dataset["factor"].sel(law=law).max())) / 20.0
        groups.setdefault(factor, []).append(str(law))
    return [
        f"Error bar: torque within a factor of {factor:g}, k = 2, by {', '.join(laws)}, "
        + (
            "calibrated with a measured torque of this bearing."
            if dataset.attrs.get("calibrated") and laws[0] not in CATALOGUE_LAWS
            else "not calibrated: it is not known how much oil reaches the contacts and how warm "
            "it is."
        )
        for factor, laws in sorted(groups.items())
    ]


def bearing_summary(dataset: xr.Dataset) -> list[BearingRow]:
    """Return up to MOST_ROWS conditions of the first law, spread over all."""
    first = dataset.isel(law=0)
    shape = first["torque"].shape
    places = list(np.ndindex(*shape))
    chosen = np.unique(np.linspace(0, len(places) - 1, MOST_ROWS).round().astype(int))
    rows = []
    for i in chosen:
        s, a, r, t = places[i]
        at = first.isel(speed=s, axial_load=a, radial_load=r, temperature=t)
        parts = {
            str(part): float(value)
            for part, value in zip(at["part"].values, at["part_torque"].values, strict=True)
            if np.isfinite(value)
        }
        rows.append(
            BearingRow(
                float(at["speed"]),
                float(at["axial_load"]),
                float(at["radial_load"]),
                float(at["temperature"]),
                parts,
                float(at["torque"]),
                float(at["power"]),
            )
        )
    return rows


def bearing_warnings(dataset: xr.Dataset) -> list[str]:
    """Return warnings about the results, one sentence each."""
    found = []
    for law in dataset["law"].values:
        at = dataset.sel(law=law)
        out = float(at["out_of_range"].max())
        if out > 0.0:
            others = [name for name in at["out_of_range"].dims if name != "speed"]
            beyond = (at["out_of_range"] > 0.0).any(others).values
            worst = rads_to_rpm(float(at["speed"].values[int(np.argmax(beyond))]))
            usable = "at no speed" if beyond[0] else "below that speed"
            what = f"the range of the fit ({MATERIAL_LIMIT_WORDS})"
            rest = "the torque is still computed."
            if law == "solved_films":
                what = "the domain of the film model"
                rest = "formulas are used there."
            found.append(
                f"{law}: raceway contacts leave {what} from {worst:.4g} rpm on, up to "
                f"{100 * out:.2g} % of them; fully usable {usable}: beyond, {rest}"
            )
        if str(law) in CATALOGUE_LAWS:
            continue
        moving = at.where(at["speed"] > 0.0)
        ratio = float(moving["film_ratio"].min())
        if ratio < _THIN:
            coldest = kelvin_to_celsius(float(at["temperature"].max()))
            found.append(
                f"{law}: the film of the raceways falls to {ratio:.2g} of the roughness (oil up to "
                f"{coldest:.4g} degC); below 1 asperities rub on the raceways, which no law here "
                "counts."
            )
    return found
