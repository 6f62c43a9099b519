"""The figures of a run-up, in reading order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.loss_words import source_colour, source_words
from gearlube.plotting.style import BLUE, house_style, name_levels, new_figure
from gearlube.report.numbers import quantity_text
from gearlube.studies.runup import levels
from gearlube.studies.runup.figures.charts import map_chart, track_chart
from gearlube.studies.runup.figures.maps import frequency_map, order_map
from gearlube.studies.runup.figures.rollers import roller_loads
from gearlube.studies.runup.figures.shapes import mode_shapes, operating_shape
from gearlube.studies.runup.figures.spectra import bearing_spectra
from gearlube.studies.runup.figures.tracks import ORDER_LOOKS, bearing_tracks, order_tracks
from gearlube_core.units import rads_to_rpm

_ALL = (
    "All forces: root of the sum of squares over pinion and gear and their three directions. "
    "Levels are of rms values; +120 dB gives dB re 1 µN (ISO 1683)."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """A figure, its file name, a few words and what to see in it."""

    name: str
    title: str
    caption: str
    draw: Callable[[xr.Dataset], Any]
    chart: Callable[[xr.Dataset], Any] | None = None  # of plotly, for the report
    needs: str = "time"  # drawn where the dataset has this variable


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


def overview(dataset: xr.Dataset) -> Any:
    """Return pinion speed, torque and stacked losses over the time of the ramp."""
    with house_style():
        figure = new_figure(9.4, 6.6)
        speed, torque, loss = figure.subplots(3, 1, sharex=True, height_ratios=[1, 1, 1.6])
        speed.plot(dataset["block_time"], levels.rpm(dataset), color=BLUE)
        speed.set_ylabel("pinion speed\n[rpm]")
        torque.plot(dataset["torque_time"], dataset["pinion_torque"], color=BLUE)
        torque.set_ylabel("torque on the\npinion [N·m]")
        low, high = torque.get_ylim()
        torque.set_ylim(min(low, 0.0), max(high, 0.0) * 1.05)
        names = [str(name) for name in dataset["source"].values]
        powers = dataset["loss"].values.T
        losing = [i for i in range(len(names)) if float(np.abs(powers[i]).max()) > 0.0]
        loss.stackplot(
            dataset["slow_time"],
            powers[losing],
            labels=[
                f"{source_words(names[i])}, up to {quantity_text(float(powers[i].max()), 'W')}"
                for i in losing
            ],
            colors=[source_colour(names[i]) for i in losing],
            lw=0.0,
        )
        loss.set_ylabel("power lost [W]")
        loss.set_xlabel("time [s]")
        loss.set_xlim(0.0, float(dataset.attrs["setting_duration"]))
        loss.legend(loc="upper left", ncols=2)
        figure.suptitle(f"Course of the {levels.heading(dataset)}")
    return figure


CATALOGUE = (
    Entry(
        name="order_tracks",
        title="Order tracks",
        caption="Mesh orders 1 to 4 and everything together, of the bearing forces (above) and of "
        "the dynamic transmission error (below). Dotted: speeds at which a mesh order meets a "
        f"natural frequency. A peak on a dotted line is that resonance. {_ALL}",
        draw=order_tracks,
        chart=track_chart,
    ),
    Entry(
        name="waterfall",
        title="Waterfall: speed and frequency",
        caption="Level of all bearing forces. H1, H2 and so on: mesh orders, which rise with the "
        "speed. Dotted: natural frequencies, which are constant. Look where they cross. "
        f"{_ALL}",
        draw=frequency_map,
        chart=map_chart,
    ),
    Entry(
        name="waterfall_orders",
        title="Waterfall: speed and order",
        caption="The same over orders: orders of the shaft are horizontal lines, natural "
        "frequencies are the dotted curves.",
        draw=order_map,
    ),
    Entry(
        name="campbell",
        title="Campbell diagram",
        caption="Natural frequencies of the axle, named after the coordinate with most of the "
        "kinetic energy, and the orders that may excite them. Circles: critical speeds of the "
        "mesh orders.",
        draw=campbell,
    ),
    Entry(
        name="operating_shape",
        title="Operating deflection shape",
        caption="Motion of pinion and gear at the speed and mesh order with the largest bearing "
        "forces, at two instants a quarter of a period apart. Rotation counts as "
        "displacement at the contact. Right: how much of its kinetic energy each natural "
        "mode has.",
        draw=operating_shape,
    ),
    Entry(
        name="mode_shapes",
        title="Mode shapes",
        caption="Displacements of pinion (blue) and gear (red) in each natural mode, the largest "
        "is 1; rotation as displacement at the contact. Axes of the fixed frame: x is "
        "axial for the pinion, z for the gear.",
        draw=mode_shapes,
    ),
    Entry(
        name="bearing_tracks",
        title="Bearing forces by direction",
        caption="Mesh orders 1 to 4 and everything together of the force on each shaft: which "
        "bearing and which direction shakes the housing.",
        draw=bearing_tracks,
    ),
    Entry(
        name="bearing_spectra",
        title="Spectra of the bearing forces",
        caption="Order spectra at three speeds of the ramp. Mesh orders above. Lines "
        "between them are far lower: rollers that pass the loaded zone, and sidebands of mesh "
        "orders by them; where they are modelled, errors of single teeth and the engine.",
        draw=bearing_spectra,
    ),
    Entry(
        name="roller_loads",
        title="Loads of the rollers",
        caption="Load of every roller where the bearing forces are largest, as bars outwards from "
        "a ring; black marks: the largest of each over one turn of the pinion. Each "
        "bearing has its own scale. A roller without a bar carries no load. `--animate` "
        "shows them in motion.",
        draw=roller_loads,
        needs="roller_load",
    ),
    Entry(
        name="overview",
        title="Course of the ramp",
        caption="Speed and torque of the run, and the power lost by source, as means over 20 ms.",
        draw=overview,
    ),
)
