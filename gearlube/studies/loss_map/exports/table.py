"""The map as a table: one row for each point, every column with its unit."""

from __future__ import annotations

from collections.abc import Iterator

import xarray as xr

from gearlube.output.csv_text import number_text
from gearlube.studies.loss_map.datasets import GRID

_COLUMNS = {
    "loss_torque": "loss_torque_n_m",
    "loss_torque_low": "loss_torque_low_n_m",
    "loss_torque_high": "loss_torque_high_n_m",
    "efficiency": "efficiency",
    "wheel_torque": "wheel_torque_n_m",
    "film_ratio": "film_ratio",
    "flank_temperature": "flank_temperature_degc",
    "share_outside": "share_outside",
    "rollers_outside": "rollers_outside",
    "range_exceeded": "range_exceeded",
}
_STEADY = {
    "steady_temperature": "steady_oil_temperature_degc",
    "steady_loss_torque": "steady_loss_torque_n_m",
}  # of speed and torque alone


def table_rows(dataset: xr.Dataset) -> tuple[tuple[str, ...], Iterator[tuple[str, ...]]]:
    """Return the names of the columns and the rows; a point that failed says why."""
    kept = {name: column for name, column in _COLUMNS.items() if name in dataset}
    steady = {name: column for name, column in _STEADY.items() if name in dataset}
    sources = [str(one) for one in dataset["source"].values]
    head = (
        "oil_temperature_degc",
        "pinion_speed_rpm",
        "pinion_torque_n_m",
        *kept.values(),
        *(f"loss_{one}_w" for one in sources),
        *steady.values(),
        "reason",
    )
    return head, _rows(dataset, tuple(kept), tuple(steady))


def _rows(
    dataset: xr.Dataset, names: tuple[str, ...], steady: tuple[str, ...]
) -> Iterator[tuple[str, ...]]:
    reasons = dict(part.split(": ", 1) for part in dataset.attrs["reasons"].split("; "))
    values = [dataset[name].values for name in names]
    at_rest = [dataset[name].transpose(*GRID[1:]).values for name in steady]
    losses, statuses = dataset["loss"].values, dataset["status"].values
    temperatures, speeds, torques = (dataset[name].values for name in GRID)
    for i, temperature in enumerate(temperatures):
        for j, speed in enumerate(speeds):
            for k, torque in enumerate(torques):
                yield (
                    f"{temperature:.10g}",
                    f"{speed:.10g}",
                    f"{torque:.10g}",
                    *(number_text(one[i, j, k]) for one in values),
                    *(number_text(one) for one in losses[i, j, k]),
                    *(number_text(one[j, k]) for one in at_rest),
                    reasons.get(str(int(statuses[i, j, k])), ""),
                )
