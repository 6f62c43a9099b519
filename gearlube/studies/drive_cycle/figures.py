"""Figures of a drive cycle."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, house_style, new_figure
from gearlube.plotting.words import source_colour, source_words
from gearlube_core.storage.atomic_file import write_figure

LEAST_SHARE = 0.002  # of the energy lost, below which a source is not drawn


def save_cycle_figures(dataset: xr.Dataset, folder: Path) -> None:
    """Write the figure as PNG."""
    folder.mkdir(parents=True, exist_ok=True)
    write_figure(cycle_figure(dataset), folder / "drive_cycle.png")


def cycle_figure(dataset: xr.Dataset) -> Any:
    """Return speed, torque, power lost by source and oil temperature over time."""
    with house_style():
        figure = new_figure(8.6, 9.2)
        speed, torque, middle, below = figure.subplots(
            4, 1, sharex=True, height_ratios=(0.7, 0.7, 1.0, 1.0)
        )
        _demand(speed, dataset, "vehicle_speed", "vehicle speed\n[km/h]")
        _demand(torque, dataset, "pinion_torque", "pinion torque\n[N·m]")
        speed.set_ylim(bottom=0.0)
        torque.axhline(0.0, color="#606060", lw=0.9, ls=":")
        _losses(middle, dataset)
        _temperature(below, dataset)
        below.set_xlabel("time [s]")
        below.set_xlim(float(dataset["time"][0]), float(dataset["time"][-1]))
        lost, share = float(dataset["energy_lost"].sum()), float(dataset["efficiency"])
        words = [f"{lost:.0f} kJ", f"{100.0 * share:.1f} %"]
        if "efficiency_low" in dataset:
            ends = [float(dataset[f"energy_lost_{end}"]) for end in ("low", "high")]
            shares = [100.0 * float(dataset[f"efficiency_{end}"]) for end in ("low", "high")]
            words[0] += f" ({ends[0]:.0f} to {ends[1]:.0f})"
            words[1] += f" ({shares[0]:.1f} to {shares[1]:.1f})"
        figure.suptitle(
            f"Cycle {dataset.attrs['cycle']}: {words[0]} lost in the axle, efficiency {words[1]}"
        )
        drawn = ""
        if "efficiency_low" in dataset:
            drawn = "In brackets: 95 % of the draws of uncertain data.\n"
        figure.supxlabel(
            f"{drawn}Not modelled: {dataset.attrs['not_modelled']}.", fontsize=8.5, color="#555555"
        )
    return figure


def _demand(ax: Any, dataset: xr.Dataset, name: str, label: str) -> None:
    ax.plot(dataset["step"].values, dataset[name].values, color=BLUE, lw=1.2)
    ax.set_ylabel(label)


def _losses(ax: Any, dataset: xr.Dataset) -> None:
    energy = dataset["energy_lost"].values
    names = [str(one) for one in dataset["source"].values]
    drawn = [i for i in range(len(names)) if energy[i] > LEAST_SHARE * energy.sum()]
    ax.stackplot(
        dataset["step"].values,
        dataset["loss"].values.T[drawn],
        labels=[f"{source_words(names[i])}, {energy[i]:.0f} kJ" for i in drawn],
        colors=[source_colour(names[i]) for i in drawn],
        alpha=0.85,
        lw=0.0,
    )
    ax.set_ylabel("power lost [W]")
    top = float(dataset["loss"].sum("source").max())
    ax.set_ylim(0.0, 1.3 * top if top > 0.0 else 1.0)
    if drawn:
        ax.legend(loc="upper left", ncols=3)


def _temperature(ax: Any, dataset: xr.Dataset) -> None:
    time = dataset["time"].values
    low, high = (dataset[f"oil_temperature_{end}"].values for end in ("low", "high"))
    if np.any(high > low):
        ax.fill_between(
            time, low, high, color=BLUE, alpha=0.2, lw=0.0, label="range by the assumed heat data"
        )
    ax.plot(time, dataset["oil_temperature"].values, color=BLUE, label="oil and housing")
    air = dataset.attrs["air_temperature_degc"]
    ax.axhline(air, color="#606060", lw=0.9, ls=":", label="air")
    ax.set_ylabel("temperature [°C]")
    ax.legend(loc="upper left")
