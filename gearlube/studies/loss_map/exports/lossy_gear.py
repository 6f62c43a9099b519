"""The map of one temperature as the table of Modelica.Mechanics.Rotational.Components.LossyGear."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array


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
    with the gear driving, T being the torque on the pinion.
    """
    torque = dataset["torque"].values
    loss = dataset["loss_torque"].transpose("speed", "torque").values
    rows, misfit = [], 0.0
    for speed, lost in zip(dataset["speed"].values, loss, strict=True):
        values = [1.0, 1.0, 0.0, 0.0]
        for side, chosen in enumerate((torque >= 0.0, torque <= 0.0)):
            here = chosen & np.isfinite(lost)
            if here.sum() < 2:
                continue
            slope, base = _line(torque[here], lost[here])
            values[side] = 1.0 - slope if side == 0 else 1.0 / (1.0 - slope)
            values[2 + side] = base
            misfit = max(misfit, float(np.abs(slope * torque[here] + base - lost[here]).max()))
        rows.append([speed * np.pi / 30.0, *values])
    return LossyGearTable(rows=np.array(rows), misfit=misfit)


def _line(x: Array, y: Array) -> tuple[float, float]:
    slope, base = np.polyfit(x, y, 1)
    return float(slope), max(float(base), 0.0)


def lossy_gear_text(dataset: xr.Dataset) -> str:
    """Return a Modelica record with the table; its comment has the misfit."""
    table = lossy_gear_table(dataset)
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
