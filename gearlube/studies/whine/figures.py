"""Figure of a whine study: orders over the speed, and what each setting changes."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from gearlube.plotting.style import SERIES, cell_edges, house_style, new_figure
from gearlube.plotting.words import parameter_words, tolerance_words
from gearlube_core.arrays import Array
from gearlube_core.units import rads_to_rpm

_MOST = 16  # parameters that the map shows


def order_changes(dataset: xr.Dataset) -> Array:
    """Return changes of the force of order 1 by each tolerance [N], shape (speeds, parameters)."""
    return np.asarray(dataset["force_rate"].isel(order=0).values * dataset["tolerance"].values)


def most_moving(dataset: xr.Dataset) -> NDArray[np.intp]:
    """Return the parameters that change order 1 most on the mean of the speeds, the most last."""
    largest = np.nanmean(np.abs(order_changes(dataset)), axis=0)
    return np.argsort(-largest)[:_MOST][::-1]


def whine_figure(dataset: xr.Dataset) -> Any:
    """Return amplitudes of the orders of the mesh force, and a map of changes of order 1."""
    speed = dataset["pinion_speed"].values * rads_to_rpm(1.0)
    first, shown = order_changes(dataset), most_moving(dataset)
    labels = [
        f"{parameter_words(str(part['parameter'].values))}  "
        f"+{tolerance_words(float(part['tolerance']), str(part['unit'].values))}"
        for part in (dataset.isel(parameter=int(k)) for k in shown)
    ]
    with house_style():
        figure = new_figure(9.5, 4.4 + 0.26 * len(labels))
        top, below = figure.subplots(
            2, 1, sharex=True, height_ratios=(3.0, 1.0 + 0.26 * len(labels))
        )
        for row, order in enumerate(dataset["order"].values):
            top.plot(
                speed,
                dataset["force"].sel(order=order).values,
                color=SERIES[row % len(SERIES)],
                label=f"mesh order {order}",
            )
        top.set(yscale="log", ylabel="mesh force, amplitude [N]")
        top.legend(ncols=3)
        limit = float(np.nanmax(np.abs(first[:, shown])))
        edges = cell_edges(speed), np.arange(len(labels) + 1) - 0.5
        image = below.pcolormesh(
            *edges, first[:, shown].T, cmap="RdBu_r", vmin=-limit, vmax=limit, rasterized=True
        )
        below.set_yticks(np.arange(len(labels)), labels)
        below.grid(False)
        below.set_title(
            "change of mesh order 1 by each error alone; red: louder, blue: quieter",
            loc="left",
            fontsize=9.5,
        )
        below.set_xlabel("pinion speed [rpm]")
        figure.colorbar(image, ax=below, label="change of mesh order 1 [N]")
        figure.suptitle(
            f"{dataset.attrs['name']}, {dataset.attrs['torque']:g} N·m: orders of the mesh force, "
            "and what small errors change",
            fontsize=11.5,
        )
    return figure
