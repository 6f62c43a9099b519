"""The map of one temperature as the table of Modelica.Mechanics.Rotational.Components.LossyGear."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError


@dataclass(frozen=True, slots=True, kw_only=True)
class LossyGearTable:
    """Rows of `lossTable` and what a loss that is linear in torque leaves.

    Parameters
    ----------
    rows : ndarray of shape (speeds, 5)
        abs(speed) [rad/s], mesh efficiency with the pinion driving and with the gear driving,
        bearing friction torque at the pinion in both cases [N.m].
    misfit : float
        Largest difference of the loss torque from that of the map [N.m].
    """

    rows: Array
    misfit: float


def lossy_gear_table(dataset: xr.Dataset) -> LossyGearTable:
    """Return the table that is nearest to the map, by least squares at each speed.

    The gear loses the torque (1 - eta1) T + tau1 with the pinion driving and (1 - 1/eta2) T + tau2
    with the gear driving, T being the torque on the pinion. A side with fewer than two points
    takes the line of the other; a speed without either has no row.
    """
    torque = dataset["torque"].values
    loss = dataset["loss_torque"].transpose("speed", "torque").values
    rows, misfit = [], 0.0
    for speed, lost in zip(dataset["speed"].values, loss, strict=True):
        lines: list[tuple[float, float] | None] = [None, None]
        for side, chosen in enumerate((torque >= 0.0, torque <= 0.0)):
            here = chosen & np.isfinite(lost)
            if here.sum() < 2:
                continue
            slope, base = lines[side] = _line(torque[here], lost[here], rising=side == 0)
            misfit = max(misfit, float(np.abs(slope * torque[here] + base - lost[here]).max()))
        drive, coast = lines[0] or _mirrored(lines[1]), lines[1] or _mirrored(lines[0])
        if drive is not None and coast is not None:
            driven = 1.0 / (1.0 - coast[0])
            rows.append([speed * np.pi / 30.0, 1.0 - drive[0], driven, drive[1], coast[1]])
    return LossyGearTable(rows=np.array(rows).reshape(-1, 5), misfit=misfit)


def _mirrored(line: tuple[float, float] | None) -> tuple[float, float] | None:
    return None if line is None else (-line[0], line[1])


def _line(x: Array, y: Array, *, rising: bool) -> tuple[float, float]:
    """Return slope and base; a slope of the wrong sign, an efficiency above 1, becomes 0."""
    slope, base = (float(one) for one in np.polyfit(x, y, 1))
    if slope < 0.0 if rising else slope > 0.0:
        slope, base = 0.0, float(y.mean())
    return slope, max(base, 0.0)


def lossy_gear_text(dataset: xr.Dataset) -> str:
    """Return a Modelica record with the table; its comment has the misfit.

    Raises
    ------
    ParameterError
        No speed has two points on one side: the table would have no row.
    """
    table = lossy_gear_table(dataset)
    if not len(table.rows):
        raise ParameterError(
            "A lossTable needs at least two computed torques on one side at one speed, got none. "
            "Take more torques, or see the reasons in map.csv."
        )
    name = f"AxleLosses{float(dataset['temperature']):.0f}degC".replace("-", "minus")
    lines = ",\n    ".join(", ".join(f"{value:.7g}" for value in row) for row in table.rows)
    lines = lines.replace(",\n", ";\n")
    return (
        f"record {name}\n"
        f'  "Losses of an axle; flange_a is the pinion. Linear in torque: up to '
        f'{table.misfit:.3g} N.m off"\n'
        "  extends Modelica.Icons.Record;\n"
        f"  parameter Real ratio = {float(dataset.attrs['ratio']):.9g};\n"
        "  parameter Real lossTable[:, 5] = [\n"
        f"    {lines}];\n"
        f"end {name};\n"
    )
