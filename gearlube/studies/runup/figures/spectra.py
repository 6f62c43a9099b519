"""Spectra of the bearing forces at some speeds of a run-up."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, VERMILLION, house_style, new_figure
from gearlube.studies.runup import levels

_SPEEDS = 3
_SHOWN = 80.0  # dB
_FLOOR = -200.0  # dB, below any axis
_MOST_ORDERS = 4.3  # mesh orders


def bearing_spectra(dataset: xr.Dataset) -> Any:
    """Return order spectra of the forces on both shafts at three speeds of the ramp."""
    speed = levels.rpm(dataset)
    wanted = np.linspace(speed.min(), speed.max(), _SPEEDS + 2)[1:-1]
    blocks = [int(np.argmin(np.abs(speed - one))) for one in wanted]
    order = dataset["order"].values
    teeth = levels.teeth(dataset)
    keep = (order > 0.0) & (order <= _MOST_ORDERS * teeth)
    directions = dataset["direction"].values
    with house_style():
        figure = new_figure(11.0, 7.2)
        axes = figure.subplots(_SPEEDS, len(directions), sharex=True, sharey=True)
        top = -np.inf
        for row, block in zip(axes, blocks, strict=True):
            for ax, direction in zip(row, directions, strict=True):
                for bearing, colour, width in (("pinion", BLUE, 3.5), ("gear", VERMILLION, 1.2)):
                    where = {"bearing": bearing, "direction": direction}
                    force = dataset["bearing_force_orders"].sel(where).values[block, keep]
                    values = levels.level(force * 0.5**0.5, levels.FORCE)
                    top = max(top, float(values.max()))
                    axis = str(dataset["axis"].sel(where).values)
                    ax.vlines(
                        order[keep],
                        _FLOOR,
                        np.maximum(values, _FLOOR),
                        color=colour,
                        lw=width,
                        label=f"{bearing} ({axis})",
                    )
                if block == blocks[0]:
                    ax.set_title(str(direction))
                    ax.legend(loc="upper right", fontsize=7.5)
            frequency = speed[block] / 60.0 * teeth
            row[0].set_ylabel(
                f"{speed[block]:.0f} rpm, H1 = {frequency:.0f} Hz\n[{levels.FORCE_TEXT}]",
                fontsize=8.5,
            )
        top = 5.0 * np.ceil(top / 5.0)
        axes[0, 0].set_ylim(top - _SHOWN, top)
        axes[0, 0].set_xlim(0.0, _MOST_ORDERS * teeth)
        for ax in axes[-1]:
            ax.set_xlabel("order: cycles per pinion revolution [-]")
        for ax in axes[0]:
            above = ax.secondary_xaxis("top", functions=(lambda x: x / teeth, lambda x: x * teeth))
            above.set_xlabel("mesh order [-]", fontsize=8)
            above.tick_params(labelsize=7.5)
        figure.suptitle(f"Spectra of the bearing forces: {levels.heading(dataset)}")
    return figure
