"""A run with bearing forces that are sums of known orders."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gearlube.studies.sound.transfer_path import TransferPath

TURN = 2.0 * np.pi
F = np.arange(10.0, 7001.0, 10.0)  # Hz
RATE = 16384.0
TEETH = 13
NAMES = {"bearing": ["pinion", "gear"], "direction": ["axial", "radial 1"]}


def made_run(
    orders: Mapping[float, float],
    *,
    start: float = 200.0,
    end: float = 200.0,
    duration: float = 1.0,
    rate: float = RATE,
    mean: float = 1500.0,
    name: str = "made",
) -> xr.Dataset:
    """Return a run whose first force has `orders`, order: amplitude [N]; the others are constant.

    The pinion speeds up from `start` to `end` [rad/s]; the car drives 0.1 m for each radian.
    """
    time = np.arange(round(duration * rate)) / rate
    acceleration = (end - start) / duration
    angle = start * time + 0.5 * acceleration * time**2
    force = np.full((time.size, 2, 2), mean)
    force[:, 0, 0] += sum(size * np.cos(order * angle) for order, size in orders.items())
    speed = start + acceleration * time
    return xr.Dataset(
        {
            "bearing_force": (("time", "bearing", "direction"), force, {"units": "N"}),
            "pinion_speed": ("time", speed, {"units": "rad/s"}),
            "pinion_angle": ("time", angle, {"units": "rad"}),
            "vehicle_speed": ("time", 0.1 * speed, {"units": "m/s"}),
        },
        {"time": ("time", time, {"units": "s"}), **NAMES},
        {"pinion_teeth": TEETH, "name": name},
    )


def one_path(gain: float, delay: float = 0.0, phase: float = 0.0) -> TransferPath:
    """Return a path of constant gain [Pa/N] and delay [s] for the first force; the rest is zero."""
    heard = gain * np.exp(-1j * (TURN * F * delay + phase))
    names = ("pinion.axial", "pinion.radial 1", "gear.axial", "gear.radial 1")
    responses = {name: np.zeros(F.size, dtype=complex) for name in names}
    return TransferPath(source="made", frequency=F, responses={**responses, "pinion.axial": heard})
