"""Speeds at which mesh orders of a run-up meet natural frequencies."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr

from gearlube.studies.runup import levels
from gearlube_core.units import rads_to_rpm

SWEEP_RATE = 3.6  # z^2 f^2 Hz/s, [iso_7626_2]: 216 z^2 f^2 Hz/min


@dataclass(frozen=True, slots=True, kw_only=True)
class Critical:
    """A speed at which a mesh order meets a natural frequency.

    Parameters
    ----------
    mesh_order : int
    mode : str
    speed_rpm, frequency, damping : float
        [rpm], [Hz], ratio [-].
    margin : float
        By what share of that speed it lies outside the ramp [-]; 0 inside, below 0 below the ramp.
    force : float
        Of that order there, all bearings and directions, rms [N]; NaN outside.
    hurry : float
        Rate at which the order passes the mode, divided by the highest rate at which the
        resonance still builds up [-].
    """

    mesh_order: int
    mode: str
    speed_rpm: float
    frequency: float
    damping: float
    margin: float
    force: float
    hurry: float


def critical_speeds(dataset: xr.Dataset) -> list[Critical]:
    """Return all critical speeds that the dataset knows, ascending."""
    speeds = levels.rpm(dataset, "mode_speed")
    low, high = float(speeds[0]), float(speeds[-1])
    total = levels.total_force(dataset, "bearing_force_track").values
    along = np.argsort(levels.rpm(dataset))
    tracks, at = total[along], levels.rpm(dataset)[along]
    teeth = levels.teeth(dataset)
    rate = abs(high - low) / 60.0 / float(dataset.attrs["setting_duration"])
    found = []
    for place, order in enumerate(dataset["mesh_order"].values):
        for k, mode in enumerate(dataset["mode"].values):
            speed = rads_to_rpm(float(dataset["critical_speed"].values[k, place]))
            if not math.isfinite(speed):
                continue
            damping = float(dataset["critical_damping"].values[k, place])
            frequency = float(order * teeth * speed / 60.0)
            inside = low <= speed <= high
            end = high if speed > high else low
            found.append(
                Critical(
                    mesh_order=int(order),
                    mode=str(mode),
                    speed_rpm=speed,
                    frequency=frequency,
                    damping=damping,
                    margin=0.0 if inside else speed / end - 1.0,
                    force=float(np.interp(speed, at, tracks[:, place])) if inside else math.nan,
                    hurry=order * teeth * rate / (SWEEP_RATE * (damping * frequency) ** 2),
                )
            )
    return sorted(found, key=lambda one: one.speed_rpm)
