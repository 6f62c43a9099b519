"""Order tracks of a run-up as a table."""

from __future__ import annotations

import math
from collections.abc import Sequence

import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.studies.runup import levels

_DIGITS = 5


def summary_csv(datasets: Sequence[xr.Dataset]) -> str:
    """Return rms levels along ramps as CSV, units in the heads: one row a block."""
    orders = [int(one) for one in datasets[0]["mesh_order"].values]
    heads = [
        "ramp",
        "time_s",
        "pinion_speed_rpm",
        "vehicle_speed_kmh",
        "bearing_forces_rms_n",
        *(f"bearing_forces_h{order}_rms_n" for order in orders),
        "dte_rms_um",
        *(f"dte_h{order}_rms_um" for order in orders),
    ]
    return csv_text(heads, [row for one in datasets for row in _rows(one)])


def _rows(dataset: xr.Dataset) -> list[list[object]]:
    speed = levels.rpm(dataset)
    force = levels.total_force(dataset, "bearing_force_track").values
    error = levels.track_rms(dataset, "dte_track").values
    overall = levels.total_force(dataset, "bearing_force_overall").values
    name = str(dataset.attrs["ramp"])
    found: list[list[object]] = []
    for i in range(speed.size):
        values = [
            float(dataset["block_time"][i]),
            float(speed[i]),
            levels.kmh_per_rpm(dataset) * float(speed[i]),
            float(overall[i]),
            *map(float, force[i]),
            1e6 * float(dataset["dte_overall"][i]),
            *(1e6 * float(one) for one in error[i]),
        ]
        found.append([name, *map(_rounded, values)])
    return found


def _rounded(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else value
