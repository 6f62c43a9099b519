"""The figures of a run-up, in reading order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import xarray as xr

from gearlube.studies.runup.figures.campbell import campbell
from gearlube.studies.runup.figures.charts import map_chart, track_chart
from gearlube.studies.runup.figures.maps import frequency_map, order_map
from gearlube.studies.runup.figures.overview import overview
from gearlube.studies.runup.figures.rollers import roller_loads
from gearlube.studies.runup.figures.shapes import mode_shapes, operating_shape
from gearlube.studies.runup.figures.spectra import bearing_spectra
from gearlube.studies.runup.figures.tracks import bearing_tracks, order_tracks

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
