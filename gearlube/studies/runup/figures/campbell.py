"""Campbell diagram of the axle: natural frequencies against mesh and engine orders."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import house_style, name_levels, new_figure
from gearlube.studies.runup import levels
from gearlube.studies.runup.figures.tracks import ORDER_LOOKS
from gearlube_core.units import rads_to_rpm


def campbell(dataset: xr.Dataset) -> Any:
    """Return natural frequencies over pinion speed with mesh orders, engine orders, crossings."""
    speed = levels.rpm(dataset, "mode_speed")
    teeth = levels.teeth(dataset)
    with house_style():
        figure = new_figure(9.4, 6.0)
        ax = figure.subplots()
        top = 1.08 * float(dataset["mode_frequency"].max())
        last = {}
        for mode in dataset["mode"].values:
            values = dataset["mode_frequency"].sel(mode=mode).values
            ax.plot(speed, values, color="#404040", lw=1.3)
            last[str(mode)] = float(values[-1])
        for i, (order, look) in enumerate(
            zip(dataset["mesh_order"].values, ORDER_LOOKS, strict=False)
        ):
            ax.plot(speed, order * teeth * speed / 60.0, label=f"mesh H{order}", **look)
            critical = rads_to_rpm(1.0) * dataset["critical_speed"].values[:, i]
            frequency = order * teeth * critical / 60.0
            ax.plot(
                critical, frequency, "o", ms=7, mfc="none", mec=look["color"], mew=1.4, zorder=4
            )
        engine = np.atleast_1d(dataset.attrs.get("engine_orders", []))
        for i, order in enumerate(engine):
            orders = ", ".join(f"{one:g}" for one in engine)
            gear = dataset.attrs["engine_gear"]
            label = f"engine orders {orders}, gear {gear}" if i == 0 else None
            ax.plot(speed, order * speed / 60.0, color="#909090", lw=0.9, ls="-.", label=label)
        ax.set_ylim(0.0, top)
        levels.speed_axis(ax, dataset)
        ax.set_ylabel("frequency [Hz]")
        name_levels(ax, last)
        handles, labels = ax.get_legend_handles_labels()
        figure.legend(handles, labels, ncols=5, loc="outside lower center", handlelength=3.0)
        figure.suptitle(f"Campbell diagram: {levels.heading(dataset)}")
    return figure
