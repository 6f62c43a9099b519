"""Figures of a drive cycle."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.cycle import cycle_panels
from gearlube.plotting.style import BLUE, house_style
from gearlube.plotting.words import source_colour, source_words


def cycle_figure(dataset: xr.Dataset) -> Any:
    """Return speed, torque, power lost by source and oil temperature over time."""
    energy, power = dataset["energy_lost"].values, dataset["loss"].values
    names = [str(one) for one in dataset["source"].values]
    sources = [
        (source_words(one), power[:, i], float(energy[i]), source_colour(one))
        for i, one in enumerate(names)
    ]
    with house_style():
        figure, (below,) = cycle_panels(dataset, "pinion_torque", sources, below=1)
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
