"""A drive cycle as tables: a row for each step, and the energies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import xarray as xr

from gearlube.plotting.range_words import range_words
from gearlube.plotting.words import source_words
from gearlube.report.cycle import WH, step_rows

SUMMARY_HEAD = ("quantity", "value", "unit", "low", "high")
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


def range_sentence(dataset: xr.Dataset) -> str:
    """Return what share of the cycle is outside which ranges; empty where none is left."""
    parts = []
    named = dataset.attrs["ranges_left"].split("; ") if dataset.attrs["ranges_left"] else []
    for words in named:
        output = words[words.rindex("(") + 1 : -1]
        time, energy = (
            100.0 * float(dataset[f"{name}_outside_range"].sel(range=output))
            for name in ("time", "energy")
        )
        parts.append(
            f"{range_words(output)}: {time:.2g} % of the running time, {energy:.2g} % of the "
            "energy lost"
        )
    return f"What left it: {'; '.join(parts)}." if parts else ""


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
