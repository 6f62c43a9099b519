"""The figures of a sweep report, in reading order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import xarray as xr

from gearlube.studies.sweep.figures import bubbles, charts, orders
from gearlube.studies.sweep.figures.charts import efficiency
from gearlube.studies.sweep.figures.orders import BEARING_CUTS, order_cuts
from gearlube.studies.sweep.figures.waveforms import (
    film_over_mesh_cycle,
    operating_points,
    roller_zone,
    waveforms,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """A figure, its file name and a hint for the reader.

    Parameters
    ----------
    name, title, caption : str
        File name; a few words; what is drawn, and what to see in it.
    draw : callable
        From the dataset to a picture of matplotlib.
    essential : bool
        Answers the question of a sweep: drawn with --quick, and open in the report.
    """

    name: str
    title: str
    caption: str
    draw: Callable[[xr.Dataset], Any]
    essential: bool = False


def _map(channel: orders.MapChannel, top: float | None = None) -> Callable[..., Any]:
    return partial(bubbles.spectrum_bubbles, channel=channel, highest_frequency=top)


def _band(channel: charts.ExtremesChannel) -> Callable[..., Any]:
    return partial(charts.extremes_against_speed, channel=channel)


_PAPER = "Mohammadpour et al. 2015,"
_BUBBLES = (
    "A bubble is a line of the spectrum, the larger the higher its level. Dotted: natural "
    "frequencies. Engine orders of the coupled car stay near 50 Hz, because the gear is chosen for "
    "each speed."
)
_CAGE_TOP = 80.0  # Hz, shows the cage frequency, its multiples and the pinion rotation


CATALOGUE = (
    Entry(
        name="bearing_force_orders",
        title="Mesh orders of a bearing force",
        essential=True,
        caption="Amplitudes of the first three mesh orders of the force of pinion bearing 1 along "
        "y, which shakes the housing. `gearlube runup` shows all bearings and directions.",
        draw=partial(order_cuts, channel=BEARING_CUTS),
    ),
    Entry(
        name="bearing_force_map",
        title="Spectra of a bearing force",
        essential=True,
        caption=f"Spectra of the force of pinion bearing 1 along y. {_BUBBLES}",
        draw=_map(orders.BEARING),
    ),
    Entry(
        name="dte_orders",
        title="Mesh orders of the transmission error",
        essential=True,
        caption="Amplitudes of the first three mesh orders of the transmission error. A peak is a "
        "resonance or a change of the contact.",
        draw=order_cuts,
    ),
    Entry(
        name="dte_extremes",
        title="Extremes of the transmission error",
        essential=True,
        caption=f"Extremes of the dynamic transmission error ({_PAPER} figure 5). Below zero the "
        "drive flanks separate; the strip names the kind of separation.",
        draw=_band(charts.DTE),
    ),
    Entry(
        name="roller_extremes",
        title="Extremes of the load of one roller",
        essential=True,
        caption=f"Extremes of the load of one roller ({_PAPER} figure 11). A roller that reaches "
        "zero has left its races: the preload is too low.",
        draw=_band(charts.ROLLER),
    ),
    Entry(
        name="efficiency",
        title="Efficiency and losses",
        essential=True,
        caption=f"Efficiency of the gear mesh (flank friction only; {_PAPER} figure 12) and of the "
        "axle with all modelled losses, above the losses themselves.",
        draw=efficiency,
    ),
    Entry(
        name="film",
        title="Films while tooth pairs pass the mesh",
        essential=True,
        caption="Load, central film thickness, film ratio and film temperature of the tooth pairs "
        "in mesh, from entry to exit, mean over the record.",
        draw=film_over_mesh_cycle,
    ),
    Entry(
        name="operating_points",
        title="Operating points",
        caption="Mean torques that the road load asks for, and the mesh orders against the natural "
        "frequencies; a grey bar spans the preloads. The engine's order stays within a band, "
        "because the gear is chosen for each speed.",
        draw=operating_points,
    ),
    Entry(
        name="dte_map",
        title="Spectra of the transmission error",
        caption=f"Spectra of the dynamic transmission error ({_PAPER} figures 3 and 4). {_BUBBLES}",
        draw=_map(orders.DTE),
    ),
    Entry(
        name="dte_waveforms",
        title="Transmission error over one turn",
        caption="Dynamic transmission error about its mean over one pinion revolution, on one "
        "scale. Equal waves are the mesh; what changes from wave to wave is the engine or errors "
        "of single teeth.",
        draw=waveforms,
    ),
    Entry(
        name="radial_map",
        title="Spectra of the radial displacement of the pinion",
        caption="Spectra of the radial displacement of the pinion, which excites the casing "
        f"({_PAPER} figures 6 and 7). {_BUBBLES}",
        draw=_map(orders.RADIAL),
    ),
    Entry(
        name="radial_extremes",
        title="Extremes of the radial displacement of the pinion",
        caption="Extremes of the radial displacement of the pinion, sqrt(y2 + z2) from the "
        f"preloaded rest position ({_PAPER} figure 8).",
        draw=_band(charts.RADIAL),
    ),
    Entry(
        name="roller_map",
        title="Spectra of the load of one roller",
        caption=f"Spectra of the load of one roller ({_PAPER} figures 9 and 10). Beside a mesh "
        "order lie its sidebands: the roller moves through the loaded zone while the force swings. "
        f"{_BUBBLES}",
        draw=_map(orders.ROLLER),
    ),
    Entry(
        name="roller_map_cage",
        title="The same at low frequencies",
        caption="The same at low frequencies: cage frequency, pinion rotation and what the engine "
        "orders of the coupled vehicle modulate.",
        draw=_map(orders.ROLLER_LOW, _CAGE_TOP),
    ),
    Entry(
        name="roller_zone",
        title="Loaded zone of the bearing",
        caption="Mean (line) and range (band) of the load of one roller over its place around the "
        "shaft. A flat line is a bearing that its preload loads evenly; zero is a "
        "roller that has left its races. Each preload has its own scale.",
        draw=roller_zone,
    ),
)
ESSENTIAL = tuple(entry for entry in CATALOGUE if entry.essential)
