"""A drive cycle as tables: a row for each step, and the energies."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.plotting.range_words import range_words
from gearlube.plotting.words import source_words
from gearlube.report.cycle import WH, step_rows
from gearlube_core.units import rads_to_rpm

SUMMARY_HEAD = ("quantity", "value", "unit", "low", "high")
_LEAST_SHARE = 0.001  # below which only this is said
_NOTHING = 1e-6  # kJ, Wh


def series_rows(dataset: xr.Dataset) -> tuple[Sequence[str], Iterator[list[str]]]:
    """Return the names of the columns and a row for each step, at its middle."""
    oil = {"oil_temperature_at_end_degc": dataset["oil_temperature"].values[1:]}
    return step_rows(dataset, "pinion", oil)


def summary_rows(dataset: xr.Dataset) -> list[tuple[str, ...]]:
    """Return energies in kJ and Wh, efficiency and the temperature at the end.

    Low and high hold 95 % of the draws of all uncertain data; without draws they are those of
    the assumed heat capacity and conductances alone.
    """
    lost = dataset["energy_lost"]
    rows = [
        *_energy("energy into the axle", dataset["energy_in"]),
        *_energy("of this by the pinion", dataset["energy_in_pinion"]),
        *_energy(
            "energy lost",
            lost.sum(),
            dataset["energy_lost_low"],
            dataset["energy_lost_high"],
        ),
    ]
    for source in lost["source"].values:
        rows += _energy(f"lost by {source_words(str(source))}", lost.sel(source=source))
    rows += _energy("energy to the friction brakes", dataset["energy_brakes"])
    drawn = "efficiency_low" in dataset
    end = [float(dataset["oil_temperature"][-1])]
    end += [
        float(dataset[f"end_temperature_{one}"] if drawn else dataset[f"oil_temperature_{one}"][-1])
        for one in ("low", "high")
    ]
    bars = [
        f"{float(dataset[f'efficiency_{one}']):.6g}" if drawn else "" for one in ("low", "high")
    ]
    rows.append(("efficiency", f"{float(dataset['efficiency']):.6g}", "1", *bars))
    rows.append(("efficiency as one number", f"{constant_efficiency(dataset):.6g}", "1", "", ""))
    rows.append(
        ("oil temperature at the end", f"{end[0]:.5g}", "degC", *(f"{t:.5g}" for t in end[1:]))
    )
    for name, words in (("time", "running time"), ("energy", "energy lost")):
        for one in dataset[f"{name}_outside_range"]:
            output = str(one["range"].values)
            rows.append(
                (f"share of the {words} outside {output}", _number(float(one)), "1", "", "")
            )
    return rows


def constant_efficiency(dataset: xr.Dataset) -> float:
    """Return the one efficiency [-] with which an axle loses the energy of a cycle.

    FASTSim and CO2MPAS take one number: the power of the shaft is that of the wheels divided by it
    in driving and times it in braking. So lost = a (1/eta - 1) + b (1 - eta), with the energy a to
    the wheels and b from them. NaN where more is lost than goes through.
    """
    speed = dataset["pinion_speed"].values / rads_to_rpm(1.0)
    to_wheels = speed * dataset["pinion_torque"].values - dataset["loss"].values.sum(axis=-1)
    energy = 1e-3 * dataset["duration"].values * to_wheels
    a, b = float(energy[energy > 0.0].sum()), -float(energy[energy < 0.0].sum())
    rest = float(dataset["energy_lost"].sum()) + a - b
    root = math.hypot(rest, 2.0 * math.sqrt(a * b))
    eta = 2.0 * a / (rest + root) if rest > 0.0 else (root - rest) / (2.0 * b) if b > 0.0 else 0.0
    return eta if eta > 0.0 else math.nan


def fastsim_text(efficiency: float, cycle: str) -> str:
    """Return `transmission` of a vehicle file of FASTSim 3: [fastsim_2026]."""
    return (
        f"# Losses of the axle alone over {cycle}. Multiply by the efficiency of a gearbox.\n"
        f"transmission:\n  eff_interp: {efficiency:.6f}\n  save_interval: 1\n"
    )


def co2mpas_text(efficiency: float, ratio: float) -> str:
    """Return the inputs of the final drive of CO2MPAS by their names there: [jrc_2025]."""
    values = {"final_drive_ratio": f"{ratio:.9g}", "final_drive_efficiency": f"{efficiency:.6f}"}
    return csv_text(("parameter", "value"), values.items())


def range_sentence(dataset: xr.Dataset) -> str:
    """Return what share of the cycle is outside which ranges; empty where none is left."""
    parts = []
    named = dataset.attrs["ranges_left"].split("; ") if dataset.attrs["ranges_left"] else []
    for words in named:
        output = words[words.rindex("(") + 1 : -1]
        time, energy = (
            _percent(float(dataset[f"{name}_outside_range"].sel(range=output)))
            for name in ("time", "energy")
        )
        parts.append(f"{range_words(output)}: {time} of the running time, {energy} of the loss")
    return f"What left it: {'; '.join(parts)}." if parts else ""


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %" if share > _LEAST_SHARE else f"below {100.0 * _LEAST_SHARE:g} %"


def _energy(
    words: str,
    value: xr.DataArray,
    low: xr.DataArray | None = None,
    high: xr.DataArray | None = None,
) -> list[tuple[str, ...]]:
    numbers = [None if one is None else float(one) for one in (value, low, high)]
    return [
        (words, text[0], unit, *text[1:])
        for unit, factor in (("kJ", 1.0), ("Wh", WH))
        for text in [["" if one is None else _number(factor * one) for one in numbers]]
    ]


def _number(value: float) -> str:
    return f"{value:.6g}" if abs(value) >= _NOTHING else "0"
