"""Loads of all rollers of the four bearings at one instant, with their range over a turn."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, VERMILLION, house_style, new_figure
from gearlube.studies.runup import levels
from gearlube.studies.runup.figures.moving.words import AXES, RINGS
from gearlube_core.arrays import Array
from gearlube_core.units import rads_to_rpm

_HUB = 0.45  # inner radius of the drawn ring, over the largest bar
_WIDTH = 0.55  # of a bar over the pitch of the rollers


def roller_loads(dataset: xr.Dataset, frame: int = 0) -> Any:
    """Return the load of every roller at an instant, with its range over the turn."""
    load = dataset["roller_load"].values
    with house_style():
        figure = new_figure(11.0, 3.9)
        axes = figure.subplots(1, load.shape[1], subplot_kw={"projection": "polar"})
        for ring, ax in enumerate(axes):
            number = int(dataset["ring"][ring])
            known = np.isfinite(load[frame, ring])
            _ring(
                ax,
                dataset["roller_angle"].values[frame, ring][known],
                load[:, ring][:, known],
                frame,
                BLUE if number <= 2 else VERMILLION,
            )
            ax.set_title(RINGS[number], fontsize=10)
            first, second = AXES[number]
            ax.set_xticks([0.0, 0.5 * np.pi], [first, second])
        speed = rads_to_rpm(float(dataset["shape_speed"]))
        turned = np.degrees(float(dataset["frame_angle"][frame]))
        figure.suptitle(
            f"Load of each roller [N] at {speed:.0f} rpm, pinion turned by {turned:.0f}°: "
            f"{levels.heading(dataset)}"
        )
    return figure


def _ring(ax: Any, angle: Array, load: Array, frame: int, colour: str) -> None:
    """Draw rollers as bars outwards; a black mark is the largest load over the turn."""
    top = float(load.max())
    ax.set_yticks([])
    if top == 0.0:  # the thrust of the mesh unloads this bearing
        ax.text(0.5, 0.5, "no load", transform=ax.transAxes, ha="center", va="center")
        return
    hub = _HUB * top
    width = _WIDTH * 2.0 * np.pi / angle.size
    ax.bar(angle, load[frame], width, bottom=hub, color=colour)
    ax.bar(
        angle, np.zeros(angle.size), width, bottom=hub + load.max(axis=0), edgecolor="black", lw=0.8
    )
    circle = np.linspace(0.0, 2.0 * np.pi, 121)
    ax.plot(circle, np.full(circle.size, hub), color="#808080", lw=0.8)
    ax.set_ylim(0.0, hub + 1.05 * top)
    ax.set_yticks([hub + top], [""])
    ax.annotate(
        f"{top:.0f} N",
        (0.25 * np.pi, hub + 1.05 * top),
        xytext=(4, 4),
        textcoords="offset points",
        fontsize=7.5,
        annotation_clip=False,
    )
    ax.tick_params(axis="x", labelsize=8.5, pad=-1)
