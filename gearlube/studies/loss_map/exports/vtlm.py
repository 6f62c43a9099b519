"""The map of one temperature as a torque loss map of VECTO."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr

from gearlube.studies.loss_map.regulation import RegulationMap
from gearlube_core.errors import ParameterError

HEAD = "Input Speed [rpm],Input Torque [Nm],Torque Loss [Nm]"
_LEAST_ROWS = 4


def vtlm_text(dataset: xr.Dataset) -> str:
    """Return the lines of a .vtlm file: input is the pinion, coast torque negative, loss positive.

    The torque of the wheels is (torque - loss) times the ratio. Points that failed are left out.
    Rows at 0 rpm repeat the lowest speed, as in VECTO's generic axles: VECTO starts from rest, and
    friction from rest is not computed.

    Raises
    ------
    ParameterError
        Fewer than four points are left; VECTO refuses such a map.
    """
    loss = dataset["loss_torque"].transpose("speed", "torque").values
    rows = [
        (float(speed), float(torque), float(loss[j, k]))
        for j, speed in enumerate(dataset["speed"].values)
        for k, torque in enumerate(dataset["torque"].values)
        if np.isfinite(loss[j, k])
    ]
    if len(rows) >= _LEAST_ROWS and rows[0][0] > 0.0:
        lowest = rows[0][0]
        rows = [(0.0, torque, lost) for speed, torque, lost in rows if speed == lowest] + rows
    return _text(rows)


def regulation_text(found: RegulationMap) -> str:
    """Return the lines of a .vtlm file of a map over speeds and torques of the wheels."""
    return _text(zip(found.speed, found.torque, found.loss, strict=True))


def _text(rows: Iterable[tuple[float, float, float]]) -> str:
    lines = [HEAD]
    lines += [f"{speed:.4f},{torque:.4f},{loss:.4f}" for speed, torque, loss in rows]
    if len(lines) <= _LEAST_ROWS:
        raise ParameterError(
            f"A .vtlm map must have at least {_LEAST_ROWS} points, got {len(lines) - 1}. Take more "
            "torques or speeds."
        )
    return "\n".join(lines) + "\n"
