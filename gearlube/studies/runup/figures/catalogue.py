"""The figures of a run-up, in reading order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, VERMILLION, house_style, name_levels, new_figure
from gearlube.plotting.words import source_colour, source_words
from gearlube.report.numbers import quantity_text
from gearlube.studies.runup import levels
from gearlube.studies.runup.figures.maps import frequency_map, order_map
from gearlube.studies.runup.figures.moving.words import AXES, RINGS
from gearlube.studies.runup.figures.tracks import (
    ORDER_LOOKS,
    bearing_tracks,
    mode_shapes,
    operating_shape,
    order_tracks,
)
from gearlube_core.arrays import Array
from gearlube_core.units import rads_to_rpm

_HUB = 0.45  # inner radius of the drawn ring, over the largest bar
_WIDTH = 0.55  # of a bar over the pitch of the rollers
_SPEEDS = 3
_SHOWN = 80.0  # dB
_FLOOR = -200.0  # dB, below any axis
_MOST_ORDERS = 4.3  # mesh orders

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


CATALOGUE = (
    Entry(
        name="order_tracks",
        title="Order tracks",
        caption="Mesh orders 1 to 4 and everything together, of the bearing forces (above) and of "
        "the dynamic transmission error (below). Dotted: speeds at which a mesh order meets a "
        f"natural frequency. A peak on a dotted line is that resonance. {_ALL}",
        draw=order_tracks,
    ),
    Entry(
        name="waterfall",
        title="Waterfall: speed and frequency",
        caption="Level of all bearing forces. H1, H2 and so on: mesh orders, which rise with the "
        "speed. Dotted: natural frequencies, which are constant. Look where they cross. "
        f"{_ALL}",
        draw=frequency_map,
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
        caption="Natural frequencies of the axle, in its car those of both together, named after "
        "the part with most of the kinetic energy, and the orders that may excite them. Circles: "
        "critical speeds of the mesh orders.",
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
        caption="Displacements of pinion (red) and gear (olive) in each natural mode, the largest "
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
