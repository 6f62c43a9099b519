"""Levels in decibel of what a run-up holds, and the speed axis that its figures share."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.units import rads_to_rpm

FORCE, LENGTH = 1.0, 1e-9  # N, m: rms of 0 dB
FORCE_TEXT, LENGTH_TEXT = "dB re 1 N rms", "dB re 1 nm rms"
_LEAST = 1e-9  # of the reference
_RMS = 0.5**0.5  # of a sinusoid over its amplitude


def level(rms: Array, reference: float) -> Array:
    """Return 20 log10(rms / reference) [dB]."""
    return np.asarray(20.0 * np.log10(np.maximum(rms / reference, _LEAST)))


def total_force(dataset: xr.Dataset, name: str) -> xr.DataArray:
    """Return the rms of all bearing forces together [N]: the root of the sum of squares.

    `name` is bearing_force_track, bearing_force_orders or bearing_force_waterfall (amplitudes), or
    bearing_force_overall (rms).
    """
    total = (dataset[name] ** 2).sum(("bearing", "direction")) ** 0.5
    return total if name.endswith("_overall") else _RMS * total


def track_rms(dataset: xr.Dataset, name: str) -> xr.DataArray:
    """Return the rms of order tracks that are stored as amplitudes."""
    return _RMS * dataset[name]


def rpm(dataset: xr.Dataset, name: str = "block_speed") -> Array:
    """Return pinion speeds [rpm]."""
    return np.asarray(rads_to_rpm(1.0) * dataset[name].values)


def teeth(dataset: xr.Dataset) -> int:
    """Return the teeth of the pinion: cycles of the mesh per pinion revolution."""
    return int(dataset.attrs["pinion_teeth"])


def kmh_per_rpm(dataset: xr.Dataset) -> float:
    """Return the vehicle speed [km/h] at 1 rpm of the pinion, wheels rolling without slip."""
    ratio = dataset.attrs["gear_teeth"] / dataset.attrs["pinion_teeth"]
    return float(3.6 * dataset.attrs["rolling_radius"] / ratio * np.pi / 30.0)


def speed_axis(ax: Any, dataset: xr.Dataset, *, label: bool = True, top: bool = True) -> None:
    """Limit the speed axis to the ramp [rpm], with the vehicle speed above."""
    speeds = rpm(dataset, "mode_speed")
    ax.set_xlim(speeds[0], speeds[-1])
    if label:
        ax.set_xlabel("pinion speed [rpm]")
    if top:
        factor = kmh_per_rpm(dataset)
        above = ax.secondary_xaxis("top", functions=(lambda x: factor * x, lambda v: v / factor))
        above.set_xlabel("vehicle speed [km/h]", fontsize=8.5)
        above.tick_params(labelsize=8.0)


def heading(dataset: xr.Dataset) -> str:
    """Return a label of the run, "run-up, 80 N·m at the pinion"."""
    torque = float(dataset.attrs["setting_pinion_torque"])
    words = f"{torque:g} N·m at the pinion"
    if dataset.attrs.get("setting_driver") == "vehicle":
        words = f"car with engine, gear {dataset.attrs['engine_gear']}"
    elif np.isnan(torque):
        words = "torque that the car needs"
    return f"{dataset.attrs['ramp']}, {words}"
