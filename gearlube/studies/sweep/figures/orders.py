"""Spectra of a sweep: which are drawn, over which frequencies; mesh harmonics against speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import house_style, new_figure, preload_label, series, speed_limits
from gearlube.studies.sweep.peaks import harmonic_amplitude

HARMONICS = (1, 2, 3)


@dataclass(frozen=True, slots=True, kw_only=True)
class CutChannel:
    """A spectrum in the sweep dataset, its axis label with unit, title and scale to that unit."""

    variable: str
    label: str
    title: str
    scale: float


DTE_CUTS = CutChannel(
    variable="dte_spectrum",
    label="amplitude [µm]",
    title="Order cuts of the dynamic transmission error",
    scale=1e6,
)
BEARING_CUTS = CutChannel(
    variable="bearing_force_spectrum",
    label="amplitude of the force [N]",
    title="Order cuts of the force of pinion bearing 1 along y",
    scale=1.0,
)


def order_cuts(dataset: xr.Dataset, channel: CutChannel = DTE_CUTS) -> Any:
    """Return the amplitudes of the first three mesh orders against vehicle speed."""
    speed = dataset["speed_kmh"].values
    with house_style():
        figure = new_figure(9.6, 4.2)
        axes = figure.subplots(1, len(HARMONICS), sharey=True)
        for ax, harmonic in zip(axes, HARMONICS, strict=True):
            for row, preload in enumerate(dataset["preload"].values):
                ax.semilogy(
                    speed,
                    channel.scale
                    * harmonic_amplitude(dataset.isel(preload=row), harmonic, channel.variable),
                    label=preload_label(preload),
                    **series(row),
                )
            ax.set_title(f"mesh order {harmonic}")
            ax.set_xlabel("vehicle speed [km/h]")
            ax.set_xlim(*speed_limits(dataset))
        axes[0].set_ylabel(channel.label)
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=len(handles), loc="outside lower center")
        figure.suptitle(channel.title, fontsize=11.5)
    return figure


@dataclass(frozen=True, slots=True, kw_only=True)
class MapChannel:
    """Quantity of a colour map.

    Parameters
    ----------
    variable : str
        Spectrum in the sweep dataset.
    title : str
        Name of the quantity.
    reference : float
        Amplitude of 0 dB, in the unit of the variable.
    reference_text : str
        The same, to be printed.
    """

    variable: str
    title: str
    reference: float
    reference_text: str


DTE = MapChannel(
    variable="dte_spectrum",
    title="Dynamic transmission error",
    reference=1e-9,
    reference_text="1 nm",
)
BEARING = MapChannel(
    variable="bearing_force_spectrum",
    title="Force of pinion bearing 1 along y",
    reference=1.0,
    reference_text="1 N",
)
RADIAL = MapChannel(
    variable="radial_spectrum",
    title="Radial displacement of the pinion",
    reference=1e-9,
    reference_text="1 nm",
)
ROLLER_LOW = MapChannel(
    variable="roller_load_spectrum",
    title="Load of one roller, pinion bearing 1, low frequencies",
    reference=1.0,
    reference_text="1 N",
)
ROLLER = MapChannel(
    variable="roller_load_spectrum",
    title="Load of one roller, pinion bearing 1",
    reference=1.0,
    reference_text="1 N",
)


def default_top(dataset: xr.Dataset) -> float:
    """Return the end of the frequency axis [Hz]: above the highest mode, within the spectra."""
    highest = float(np.nanmax(dataset["frequency"])) if "frequency" in dataset else 2500.0
    if "mode_frequency" not in dataset:
        return min(highest, 2500.0)
    modes = dataset["mode_frequency"].values
    modes = modes[np.isfinite(modes)]
    top = 1.15 * float(modes.max()) if modes.size else 2500.0
    return min(highest, 100.0 * np.ceil(top / 100.0))
