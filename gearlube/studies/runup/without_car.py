"""The loudest mesh order of a run-up at held speed, without the car around the axle."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.studies.runup import levels
from gearlube.studies.runup.dataset import block_spectra
from gearlube.studies.runup.record import record_ramp
from gearlube.studies.runup.settings import BENCH, LEAST_BLOCKS, RunupSettings
from gearlube_core.dynamics.hypoid_axle.model import torque_limits

HELD = "bearing_force_order_held"
_APART = 0.01  # of the speed, over a ramp that hardly changes it
_SETTLING = 0.5  # s
_COARSE = 0.5  # orders: no engine has lines between those of the mesh
_SPARE = 1.2


def force_without_car(
    settings: RunupSettings, dataset: xr.Dataset, *, folder: Path | None = None
) -> float:
    """Return the bearing forces of the loudest mesh order without the car, at held speed [N rms].

    Parameters
    ----------
    settings : RunupSettings
        Of the run-up.
    dataset : Dataset
        Its tracks; the loudest order, its speed and its torque are taken from them.
    folder : path, optional
        Where the record is kept, should the run be stopped.
    """
    track = levels.total_force(dataset, "bearing_force_track").values
    block, place = np.unravel_index(int(np.argmax(track)), track.shape)
    speed, time = (float(dataset[f"block_{name}"][block]) for name in ("speed", "time"))
    limits = torque_limits(settings.car_axle.axle)
    torque = np.interp(time, dataset["torque_time"], dataset["pinion_torque"])
    held = replace(
        settings,
        driver=BENCH,
        pinion_torque=float(np.clip(torque, limits.pinion_low, limits.pinion_high)),
        start_speed=(1.0 - 0.5 * _APART) * speed,
        end_speed=(1.0 + 0.5 * _APART) * speed,
        duration=max(0.2, _SPARE * LEAST_BLOCKS * 2.0 * math.pi / (_COARSE * speed)),
        order_resolution=_COARSE,
        settling_time=_SETTLING,
    )
    record = record_ramp(held, folder=folder)
    signals = np.stack([record.channels[name] for name in record.force_names], axis=1)
    blocks = block_spectra(held, record, signals)
    order = levels.teeth(dataset) * int(dataset["mesh_order"][place])
    forces = np.abs(blocks.amplitude[len(blocks.time) // 2, round(order * held.revolutions)])
    return float(math.sqrt(0.5 * np.sum(forces**2)))
