"""Damage of gears over their life: each bin of torque, speed and temperature solved once."""

from __future__ import annotations

import json
import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.damage.bins import bin_words
from gearlube.damage.figures import damage_figures
from gearlube.damage.flank import HIGH, WIDE, flank_damage, places_along, tooth_maps
from gearlube.damage.settings import DamageSettings
from gearlube.damage.summary import SUMMARY_HEAD, summary_rows
from gearlube.damage.teeth import Teeth
from gearlube.damage.under_surface import depth_variables, under_surface
from gearlube.damage.wear_steps import wear_in_steps
from gearlube.output.csv_text import csv_text
from gearlube.plotting.figure_files import save_figure_folder
from gearlube.report.cycle import variables_of
from gearlube.report.result import Result
from gearlube_core.arrays import Array
from gearlube_core.friction.flank_states import BearingStates
from gearlube_core.progress import Progress, no_progress
from gearlube_core.rating.bearing_life import bearing_life
from gearlube_core.rating.life import miner_sum, torque_factor
from gearlube_core.rating.spectrum import DutyBins, Rate, SpectrumDamage, spectrum_damage
from gearlube_core.storage.atomic_file import write_dataset, write_text
from gearlube_core.storage.resumable import ARRAYS, ResultStore
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE
from gearlube_core.units import ZERO_CELSIUS, rads_to_rpm

_LEAST_TORQUE = 1e-3  # N.m; below, the standard rates nothing
_BIN, _MEMBER, _BEARING = ("bin",), ("bin", "member"), ("bin", "bearing")
_BEARINGS = ["pinion, first", "pinion, second", "gear, first", "gear, second"]
_SIDE, _BOTH = ("side", "up", "along"), ("side", "member", "up", "along")
# what each bin has: dimensions, unit, words
_OF_BINS = {
    "pressure": (_BIN, "GPa", "largest Hertz pressure of the flanks"),
    "film_ratio": (_BIN, "1", "least film over roughness"),
    "flash": (_BIN, "K", "greatest rise of temperature in the contact"),
    "contact_temperature": (_BIN, "degC", "greatest temperature in the contact"),
    "peclet": (_BIN, "1", "Peclet number where the rise is greatest"),
    "friction_power": (_BIN, "W", "mean friction power of the flanks"),
    "outside": (_BIN, "1", "share of the load outside the model of solved films"),
    "at_edge": (_BIN, "1", "share of the load with an edge of the tooth in the contact"),
    "fracture": (_BIN, "1", "greatest utilisation A_FF of flank fracture"),
    "fatigue": (_BIN, "1", "greatest number of Dang Van, compression does not help"),
    "wear": (_MEMBER, "um", "wear depth at the worst place"),
    "contact_stress": (_MEMBER, "MPa", "contact stress of the standard"),
    "local_damage": (_MEMBER, "1", "local pitting damage at the worst place"),
    "radial_load": (_BEARING, "N", "radial load of a bearing"),
    "axial_load": (_BEARING, "N", "axial load of a bearing"),
    "bearing_damage": (_BEARING, "1", "share of the basic life L_10 that is used"),
    "bearing_damage_modified": (_BEARING, "1", "share of the modified life L_nm that is used"),
}


def run_damage(
    settings: DamageSettings, *, folder: Path | None = None, progress: Progress = no_progress
) -> Result:
    """Return what the bins of a life do to flanks, roots and bearings of an axle or a pair.

    Parameters
    ----------
    settings
        Axle or pair, bins, materials, bearings.
    folder
        For damage.nc, damage.csv, summary.csv and figures; None: nothing is written. Finished bins
        are kept in its folder `bins` until all are done, so that the same call goes on after a
        stop.
    progress
        Called with the share that is done and a sentence.

    Returns
    -------
    xr.Dataset
        By bin stress, film, temperature, wear and damage; maps on the drawn gear tooth; lives of
        the bearings; in the attribute `summary` a row for each mode of failure.

    Raises
    ------
    ParameterError
        A bin is out of the range of table or oil, or the axle finds no balance there.

    Notes
    -----
    Each bin is steady running: its loads have no dynamics. Local damage takes the Hertz pressure
    in the strength line of the standard: it ranks places and bins, and is no safety. Wear is that
    of the new flank.

    Examples
    --------
    >>> import gearlube as gl
    >>> bins = gl.rating.duty_bins([3600.0], [100.0], [200.0], 353.15, widths=(10.0, 10.0, 10.0))
    >>> settings = gl.studies.DamageSettings(car=gl.read_axle("mohammadpour_2015"), bins=bins)
    >>> round(float(gl.studies.run_damage(settings)["pressure"][0]), 2)  # GPa
    1.01
    """
    teeth, bins, rate = settings.teeth, settings.bins, settings.rate
    ratio = teeth.ratio
    count, part = bins.torque.size, 0.1 if settings.wear_steps else 0.9
    cycles = np.stack([bins.revolutions, bins.revolutions / ratio], axis=1)
    solved, store = [], ResultStore(folder and folder / "bins", ARRAYS)
    keys = [settings.bin_key(i) for i in range(count)]
    for i, key in enumerate(keys):
        progress(part * i / count, f"bin {i + 1} of {count}")
        found = store.read(key)
        if found is None:
            new = _solved(settings, teeth, rate, i, cycles[i])
            found = {name: np.asarray(value) for name, value in new.items()}
            store.keep(key, found)
        solved.append(found)
    values = {name: np.array([one[name] for one in solved]) for name in solved[0]}
    shown = {name: words for name, words in _OF_BINS.items() if name in values}
    if settings.wear_coefficient is None:
        del shown["wear"]
    outside = ""
    factors: dict[str, tuple[float, float]] = {}
    one: dict[str, tuple[Any, ...]] = {
        "torque": (_BIN, bins.torque, "N.m", "torque on the pinion"),
        "speed": (_BIN, rads_to_rpm(1.0) * bins.speed, "rpm", "speed of the pinion"),
        "temperature": (_BIN, bins.temperature - ZERO_CELSIUS, "degC", "temperature of the oil"),
        "hours": (_BIN, bins.time / 3600.0, "h", "time in the life"),
        "cycles": (_MEMBER, cycles, "1", "load cycles of a tooth"),
        **{name: (at, values[name], *words) for name, (at, *words) in shown.items()},
    }
    beside = teeth.beside(bins, settings.gears, settings.load_factors)
    if rate is not None:
        progress(part, "torque factors")
        damage, factors = _torque_factors(bins, rate, ratio)
        outside = "\n".join(dict.fromkeys((*damage.outside, *beside.outside)))
        one["contact_damage"] = _MEMBER, damage.contact, "1", "pitting damage of the standard"
        one["bending_damage"] = _MEMBER, damage.bending, "1", "breakage damage of the standard"
    on = [~values["on_coast"], values["on_coast"]]

    def largest(name: str) -> Array:
        return np.stack([values[name][side].max(axis=0, initial=0.0) for side in on])

    def summed(name: str) -> Array:
        return np.stack([values[name][side].sum(axis=0) for side in on])

    def worst(name: str) -> Array:
        places = ([np.zeros(4), *values[name][side]] for side in on)
        return np.array([max(of_side, key=lambda place: place[0]) for of_side in places])

    thin = largest("thin_map")
    film = np.divide(1.0, thin, out=np.full_like(thin, np.nan), where=thin > 0.0)
    one |= {
        "pressure_map": (_SIDE, largest("pressure_map"), "GPa", "largest Hertz pressure"),
        "film_map": (_SIDE, film, "1", "thinnest film over roughness"),
        "flash_map": (_SIDE, largest("flash_map"), "K", "greatest rise in the contact"),
        "heat_map": (_SIDE, largest("heat_map"), "W/mm2", "greatest friction power over area"),
        "local_damage_map": (_BOTH, summed("local_damage_map"), "1", "local pitting damage"),
    }
    if settings.wear_coefficient is not None:
        one["wear_map"] = _BOTH, summed("wear_map"), "um", "wear depth"
    under = [name for name in ("fracture", "fatigue") if name in values]
    one |= {f"{name}_map": (_SIDE, largest(f"{name}_map"), *_OF_BINS[name][1:]) for name in under}
    one |= depth_variables({name: worst(f"{name}_worst") for name in under}, settings)
    places = {
        name: (name, 1e3 * length * (np.arange(n) + 0.5) / n, {"units": "mm"})
        for name, length, n in zip(("along", "up"), teeth.drawn_size, (WIDE, HIGH), strict=True)
    }
    named = {
        "side": np.array(["drive", "coast"]),
        "member": np.array(["pinion", "gear"]),
    }
    if "radial_load" in values:
        named["bearing"] = np.array(_BEARINGS)
    dataset = xr.Dataset(
        variables_of(one),
        coords={**places, **named},
        attrs={
            "name": teeth.name,
            "oil": teeth.oil.name,
            "film": teeth.film,
            "standard": teeth.standard,
            "limits": "\n".join(teeth.limits),
            "drawn": json.dumps(teeth.drawn),
            "duty": settings.duty,
            "bins": json.dumps([bin_words(bins, i) for i in range(count)]),
            "outside": outside,
            "table_torque_n_m": teeth.solved_torque,
            "torque_factors": json.dumps(factors),
            "withheld": teeth.withheld,
            "notes": json.dumps(beside.notes),
        },
    )
    if settings.test_torque is not None:
        limit = teeth.permissible(settings.test_torque, settings.test_bulk)
        dataset.attrs["permissible_film"] = limit
    if settings.wear_steps:
        dataset = dataset.merge(
            wear_in_steps(
                settings,
                folder=folder,
                progress=lambda done, words: progress(0.1 + 0.9 * done, words),
            )
        )
    dataset.attrs["summary"] = json.dumps(summary_rows(dataset, settings, beside.rows))
    dataset = Result.of(dataset, "damage")
    if folder is not None:
        _write(dataset, folder)
        store.drop(keys)
    progress(1.0, "damage")
    return dataset


def _solved(
    settings: DamageSettings, teeth: Teeth, rate: Rate | None, place: int, cycles: Array
) -> dict[str, Any]:
    """Return the values of a bin, by the names of `_OF_BINS`, and its maps."""
    at = [float(one[place]) for one in settings.bins[:3]]
    states = teeth.states(*at)
    found = flank_damage(
        states, teeth.solid, settings.wear_coefficient or 0.0, all_load=settings.wear_of_all_load
    )
    lines = under_surface(states, settings, places_along(states))
    maps = tooth_maps(
        states, found, teeth.drawn_size, {name: along for name, (along, _) in lines.items()}
    )
    share = states.load / states.load.sum()
    wear = [
        n * 1e6 * maps[f"{role}_wear"] for n, role in zip(cycles, ("pinion", "gear"), strict=True)
    ]
    stress, local = (math.nan, math.nan), [np.zeros((HIGH, WIDE))] * 2
    if rate is not None and abs(at[0]) > _LEAST_TORQUE:
        rating = rate(*at)
        stress = rating.contact_stress
        local = [
            miner_sum(line, maps["pressure"], n)
            for line, n in zip(rating.contact_lines, cycles, strict=True)
        ]
    hottest = int(found.flash.argmax())
    bearings = states.bearings and _bearings(settings, teeth, states.bearings, place, cycles)
    film = maps["film"]
    return {
        "on_coast": states.carried < 0.0,
        "pressure": 1e-9 * found.pressure.max(),
        "film_ratio": found.film.min(),
        "flash": found.flash[hottest],
        "contact_temperature": states.bulk + found.flash[hottest] - ZERO_CELSIUS,
        "peclet": found.peclet[hottest],
        "friction_power": states.friction_power,
        "outside": float(states.outside @ share),
        "at_edge": float((states.table_pressure > EDGE_PRESSURE) @ share),
        **{name: worst[0] for name, (_, worst) in lines.items()},
        **{f"{name}_worst": worst for name, (_, worst) in lines.items()},
        **{f"{name}_map": maps[name] for name in lines},
        "wear": [one.max() for one in wear],
        "contact_stress": [1e-6 * one for one in stress],
        "local_damage": [one.max() for one in local],
        **(bearings or {}),
        "pressure_map": 1e-9 * maps["pressure"],
        "thin_map": np.divide(1.0, film, out=np.zeros_like(film), where=film > 0.0),
        "flash_map": maps["flash"],
        "heat_map": 1e-6 * maps["heat"],
        "wear_map": wear,
        "local_damage_map": local,
    }


def _bearings(
    settings: DamageSettings, teeth: Teeth, bearings: BearingStates, place: int, cycles: Array
) -> dict[str, Any]:
    """Return loads and shares of basic and modified life of the bearings; no number: not known."""
    speed, temperature = (float(one[place]) for one in settings.bins[1:3])
    used = np.full((2, 4), np.nan)
    for k, loads in enumerate(bearings.rollers):
        rated = settings.bearings[k // 2]
        if rated is None:
            continue
        rollers = np.maximum(loads[: rated.elements], 0.0)
        if not rollers.any():
            used[:, k] = 0.0
            continue
        film, rough = float(bearings.film[k]), settings.raceway_roughness or 0.0
        solved = film > 0.0 and rough > 0.0
        life = bearing_life(
            rated, speed=speed / (teeth.ratio if k > 1 else 1.0), element_loads=rollers,
            cleanliness=settings.cleanliness or (0.0, 0.0),
            film_ratio=film / rough if solved else None,
            viscosity=None if solved else float(teeth.oil.state(temperature).nu),
        )  # fmt: skip
        used[:, k] = cycles[k // 2] / life.basic, cycles[k // 2] / life.modified
    if settings.cleanliness is None:
        used[1] = math.nan
    return {
        "radial_load": bearings.radial,
        "axial_load": bearings.axial,
        "bearing_damage": used[0],
        "bearing_damage_modified": used[1],
    }


def _torque_factors(
    bins: DutyBins, rate: Rate, ratio: float
) -> tuple[SpectrumDamage, dict[str, tuple[float, float]]]:
    """Return the damage, and the factor on all torques at which it is 1, by mode and member."""

    @cache
    def damage(factor: float) -> SpectrumDamage:
        return spectrum_damage(bins, rate, ratio=ratio, factor=factor)

    def found(mode: str, member: int) -> float:
        return torque_factor(lambda factor: damage(factor).sums()[mode][member])

    known = damage(1.0)
    return known, {mode: (found(mode, 0), found(mode, 1)) for mode in known.sums()}


def _write(dataset: xr.Dataset, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    write_dataset(dataset, folder / "damage.nc")
    columns: dict[str, Array] = {}
    for name, values in dataset.data_vars.items():
        unit = str(values.attrs["units"]).replace(".", "_").replace("/", "_per_").lower()
        head = f"{name}_{unit}" if unit != "1" else str(name)
        if values.dims == ("bin",):
            columns[head] = values.values
        elif values.dims == ("bin", "member"):
            columns |= {
                f"{role}_{head}": values.values[:, i] for i, role in enumerate(("pinion", "gear"))
            }
    rows = ([f"{float(one):.6g}" for one in row] for row in zip(*columns.values(), strict=True))
    write_text(csv_text(tuple(columns), rows), folder / "damage.csv")
    write_text(csv_text(SUMMARY_HEAD, json.loads(dataset.attrs["summary"])), folder / "summary.csv")
    save_figure_folder(damage_figures(dataset), folder / "figures")
