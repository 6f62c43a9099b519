"""Pressure, film and load of a contact line over its meshing cycle."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from drivetrain.figures.style import BLUE, GREEN, GREY, VERMILLION, house_style, new_figure

_PANELS = (
    ("max_pressure", 1e-9, "largest pressure [GPa]", BLUE),
    ("min_film", 1e6, "smallest film [µm]", VERMILLION),
    ("load", 1e-3, "load [kN]", GREEN),
    ("loaded_length", 1e3, "loaded length [mm]", GREEN),
)


def cycle_curves(dataset: xr.Dataset) -> Any:
    """Return largest pressure, smallest film, load and loaded length over the position.

    Steps that did not converge are marked.
    """
    with house_style():
        figure = new_figure(8.6, 9.0)
        position = 1e3 * dataset["position"].values
        failed = dataset["converged"].values == 0.0
        axes = figure.subplots(len(_PANELS), 1, sharex=True)
        for ax, (name, factor, label, colour) in zip(axes, _PANELS, strict=True):
            values = factor * dataset[name].values
            ax.plot(position, values, color=colour)
            if failed.any():
                ax.plot(position[failed], values[failed], "x", color=GREY)
            ax.set(ylabel=label, ylim=(0.0, 1.12 * max(float(np.nanmax(values)), 1e-12)))
        axes[-1].set_xlabel("position of the line $s_i$ [mm]")
        of = dataset.attrs
        state = f"{of['failures']} steps NOT CONVERGED (crosses), " if of["failures"] else ""
        figure.suptitle(
            f"{of['name']}: {state}line through its cycle, {dataset.sizes['step']} steps, "
            f"{of['torque']:.4g} N·m",
            fontsize=11.5,
        )
    return figure
