"""The panels of a drive cycle: what it asks, and the power lost on top of each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, new_figure
from gearlube_core.arrays import Array

LEAST_SHARE = 0.002  # of the energy lost, below which a source is not drawn


def cycle_panels(
    dataset: xr.Dataset,
    torque: str,
    lost: Sequence[tuple[str, Array, float, str]],
    *,
    below: int = 0,
) -> tuple[Any, list[Any]]:
    """Return a figure of speed, `torque` and power lost over `step`, and its `below` empty panels.

    `lost` has name, power over time [W], energy [kJ] and colour of each source.
    """
    heights = 0.7, 0.7, 1.0, *(1.0,) * below
    figure = new_figure(8.6, 2.7 * sum(heights))
    speed, asked, middle, *others = figure.subplots(
        len(heights), 1, sharex=True, height_ratios=heights
    )
    time = dataset["step"].values
    for ax, name, unit in ((speed, "vehicle_speed", "km/h"), (asked, torque, "N·m")):
        ax.plot(time, dataset[name].values, color=BLUE, lw=1.2)
        ax.set_ylabel(f"{name.replace('_', ' ')}\n[{unit}]")
    speed.set_ylim(bottom=0.0)
    asked.axhline(0.0, color="#606060", lw=0.9, ls=":")
    whole = sum(energy for *_, energy, _ in lost)
    drawn = [one for one in lost if one[2] > LEAST_SHARE * whole]
    middle.stackplot(
        time,
        [power for _, power, *_ in drawn],
        labels=[
            f"{name}, {energy:{'.0f' if energy >= 10.0 else '.2g'}} kJ"
            for name, _, energy, _ in drawn
        ],
        colors=[colour for *_, colour in drawn],
        alpha=0.85,
        lw=0.0,
    )
    middle.set_ylabel("power lost [W]")
    top = float(np.sum([power for _, power, *_ in lost], axis=0).max())
    middle.set_ylim(0.0, (1.3 if below else 1.05) * top if top > 0.0 else 1.0)
    if drawn and below:
        middle.legend(loc="upper left", ncols=3)
    elif drawn:
        figure.legend(loc="outside lower center", ncols=3)
    return figure, others
