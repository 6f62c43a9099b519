"""How VECTO reads a torque loss map, after its source: TransmissionLossMapReader and DelaunayMap.

An own reading of the rules, not its code: columns by name, at least four rows, triangles over input
speed and input torque less loss; where it extends a map, at each speed a least-squares line over
the points of no coast, at 2, 3, ... times the largest torque and at their negatives.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.interpolate import LinearNDInterpolator

MOST = 4  # multiples of the largest torque, to which a map is extended


class VectoMap:
    """A torque loss map: loss at the input over speed and torque of the output."""

    def __init__(self, path: Path, ratio: float, *, extended: bool = False) -> None:
        head, *lines = path.read_text().splitlines()
        names = [one.split("[")[0].strip() for one in head.split(",")]
        assert names == ["Input Speed", "Input Torque", "Torque Loss"]
        rows = np.array([[float(x) for x in line.split(",")] for line in lines])
        assert len(rows) >= 4
        assert np.all((rows[:, 0] >= 0.0) & (rows[:, 0] <= 10_000.0))
        assert np.all(np.abs(rows[:, 1]) <= 1e5)
        assert np.all((rows[:, 2] >= 0.0) & (rows[:, 2] <= 1e5))
        self.ratio = ratio
        self.lines = {speed: _line(rows[rows[:, 0] == speed]) for speed in np.unique(rows[:, 0])}
        if extended:
            rows = np.concatenate([rows, self._extension(rows)])
        speed, torque, loss = rows.T
        self.ends = speed.max(), np.abs(torque - loss).max()
        self.inside = LinearNDInterpolator(
            np.column_stack([speed / self.ends[0], (torque - loss) / self.ends[1]]), loss
        )

    def _extension(self, rows: np.ndarray) -> np.ndarray:
        highest, found = rows[:, 1].max(), []
        for speed, (slope, base) in self.lines.items():
            for i in range(2, MOST + 1):
                torque = i * highest
                here = rows[(rows[:, 0] == speed) & (rows[:, 1] >= 0.0)]
                loss = slope * torque + base if slope > 0.0 else here[-1, 2]
                found += [(speed, torque, loss), (speed, -torque, loss)]
        return np.array(found)

    def loss(self, wheel_speed: float, wheel_torque: float) -> float:
        """Return the loss [N.m] at speed [rpm] and torque [N.m] of the output; NaN: outside."""
        x, y = wheel_speed * self.ratio, wheel_torque / self.ratio
        return float(self.inside(x / self.ends[0], y / self.ends[1]))


def _line(rows: np.ndarray) -> tuple[float, float]:
    drive = rows[rows[:, 1] >= 0.0]
    slope, base = np.polyfit(drive[:, 1], drive[:, 2], 1)
    return float(slope), float(base)
