"""Numbers read off a tooth contact analysis."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array

LOADED = 1e-3  # share from which a pair counts as carrying
LOAD = 50.0  # N.m, the pinion torque of Karagiannis et al. 2012


def mean(dataset: xr.Dataset, name: str, side: str, torque: float = LOAD) -> float:
    """Return the mean of a variable over a mesh period."""
    return float(dataset[name].sel(side=side, torque=torque).mean())


def variation(dataset: xr.Dataset, name: str, side: str, torque: float = LOAD) -> float:
    """Return peak-to-peak over mean of a variable over a mesh period [-]."""
    values = dataset[name].sel(side=side, torque=torque).values
    return float(np.ptp(values) / values.mean())


def unloaded_span(dataset: xr.Dataset, side: str) -> float:
    """Return the peak-to-peak unloaded transmission error along the line of action [m]."""
    return float(np.ptp(dataset["e"].sel(side=side).values))


def unloaded_mean(dataset: xr.Dataset, side: str) -> float:
    """Return the mean distance of the unloaded error from its extreme [m]."""
    e = dataset["e"].sel(side=side).values * (1.0 if side == "drive" else -1.0)
    return float(e.mean() - e.min())


def loaded_span(dataset: xr.Dataset, side: str, torque: float = LOAD) -> float:
    """Return the peak-to-peak transmission error under load along the line of action [m]."""
    rotation = dataset["rotation"].sel(side=side, torque=torque).values
    return float(np.ptp(rotation)) * mean(dataset, "R_p", side, torque)


def pairs(dataset: xr.Dataset, side: str, torque: float = LOAD) -> tuple[float, int]:
    """Return the mean and the largest number of tooth pairs that carry load."""
    carrying = (dataset["share"].sel(side=side, torque=torque) > LOADED).sum("pair")
    return float(carrying.mean()), int(carrying.max())


def highest_pressure(dataset: xr.Dataset, side: str, torque: float = LOAD) -> float:
    """Return the highest pressure of any pair at any position [Pa]."""
    return float(dataset["pressure_max"].sel(side=side, torque=torque).max())


def pair_course(dataset: xr.Dataset, name: str, side: str, torque: float = LOAD) -> Array:
    """Return a variable over one pair's contact, entry to exit, where the pair carries."""
    state = dataset.sel(side=side, torque=torque)
    phase = (state["phase"].values[:, None] + state["pair"].values).ravel()
    order = np.argsort(phase)
    values = state[name].values.ravel()[order]
    return np.asarray(values[state["share"].values.ravel()[order] > LOADED])


def rises_then_falls(values: Array) -> bool:
    """Tell whether values have one maximum, away from both ends."""
    top = int(np.argmax(values))
    steps = np.diff(values)
    inside = 0 < top < values.size - 1
    return bool(inside and (steps[:top] > 0.0).all() and (steps[top:] < 0.0).all())


def exponent(dataset: xr.Dataset, name: str, side: str, low: float, high: float) -> float:
    """Return d ln(mean) / d ln(torque) between two torques [-]."""
    ratio = mean(dataset, name, side, high) / mean(dataset, name, side, low)
    return float(np.log(ratio) / np.log(high / low))
