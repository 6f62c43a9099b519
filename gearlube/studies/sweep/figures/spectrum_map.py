"""Which spectra of a sweep are drawn, and over which frequencies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr


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
