"""The map of one temperature as rows of an axle test, [epa_2016]."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube_core.errors import ParameterError

HEAD = ("wheel_speed_rpm", "output_torque_n_m", "power_loss_kw")


def gem_text(dataset: xr.Dataset) -> str:
    """Return speed of the wheels, torque of both wheels and power loss, as GEM rounds them.

    Points that failed are left out.

    Raises
    ------
    ParameterError
        No point is left.
    """
    ratio = float(dataset.attrs["ratio"])
    rows = []
    for speed in dataset["speed"].values:
        for torque in dataset["torque"].values:
            point = dataset.sel(speed=speed, torque=torque)
            if np.isfinite(float(point["loss_torque"])):
                lost = float(point["loss"].sum())
                rows.append(
                    (
                        f"{speed / ratio:.1f}",
                        f"{float(point['wheel_torque']):.2f}",
                        f"{1e-3 * lost:.4f}",
                    )
                )
    if not rows:
        raise ParameterError(
            "A table for GEM needs at least one computed point, got none. map.csv gives the "
            "reasons."
        )
    return csv_text(HEAD, rows)
