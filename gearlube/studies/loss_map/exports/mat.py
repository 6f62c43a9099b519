"""The map as arrays for look-up tables of MATLAB and Simulink."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from gearlube.output.mat_file import write_mat

_ORDER = ("speed", "torque", "temperature")


def write_map_mat(dataset: xr.Dataset, path: Path) -> None:
    """Write breakpoints and tables over (speed, torque, temperature).

    `torque_loss_Nm` for a look-up of the loss; `efficiency` is NaN near zero torque, where a table
    of efficiency cannot hold a drag.
    """
    content = {
        "speed_rpm": dataset["speed"].values,
        "torque_Nm": dataset["torque"].values,
        "temperature_degC": dataset["temperature"].values,
        "torque_loss_Nm": dataset["loss_torque"].transpose(*_ORDER).values,
        "efficiency": dataset["efficiency"].transpose(*_ORDER).values,
        "ratio": float(dataset.attrs["ratio"]),
    }
    write_mat(content, path)
