"""Where mesh orders meet natural frequencies of the axle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

ORDERS = (1, 2, 3)


@dataclass(frozen=True, slots=True, kw_only=True)
class Crossing:
    """A mesh order and a natural frequency.

    Parameters
    ----------
    order : int
        Multiple of the mesh frequency.
    mode : str
    preload : float
        [N].
    frequency : float
        Of the mode [Hz].
    speed_kmh : float
        Vehicle speed at which they are equal [km/h].
    margin : float
        By what share of that speed it lies outside the swept speeds [-]; 0 inside.
    """

    order: int
    mode: str
    preload: float
    frequency: float
    speed_kmh: float
    margin: float


def crossings(dataset: xr.Dataset) -> list[Crossing]:
    """Return every mesh order of `ORDERS` with every natural frequency, by rising speed.

    The mesh frequency grows in proportion to the speed. Without natural frequencies, or without a
    finished point, there are none.
    """
    if "mode_frequency" not in dataset or "mesh_frequency" not in dataset:
        return []
    speeds = dataset["speed_kmh"].values
    per_kmh = dataset["mesh_frequency"].values / speeds  # Hz
    if not np.any(np.isfinite(per_kmh)):
        return []
    slope = float(np.nanmean(per_kmh))
    found = []
    for row, preload in enumerate(dataset["preload"].values):
        frequencies = dataset["mode_frequency"].values[row]
        for mode, frequency in zip(dataset["mode"].values, frequencies, strict=True):
            if not np.isfinite(frequency):
                continue
            for order in ORDERS:
                speed = float(frequency) / (order * slope)
                outside = max(speeds[0] - speed, speed - speeds[-1], 0.0)
                found.append(
                    Crossing(
                        order=order,
                        mode=str(mode),
                        preload=float(preload),
                        frequency=float(frequency),
                        speed_kmh=speed,
                        margin=float(outside) / speed,
                    )
                )
    return sorted(found, key=lambda one: one.speed_kmh)
