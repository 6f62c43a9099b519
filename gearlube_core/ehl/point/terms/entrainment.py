"""Entrainment speed on a grid: one for the whole problem, or one for each row."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array


@dataclass(frozen=True, slots=True)
class UniformEntrainment:
    """All rows have the entrainment of the problem."""

    rows: Array  # entrainment over that of the problem, (ny,) [-]; all 1

    @classmethod
    def of(cls, count: int) -> UniformEntrainment:
        """Return that of a number of rows."""
        return cls(np.ones(count))

    def carried(self, values: Array) -> Array:
        """Return nodal values times the entrainment of their row, shape (ny, nx)."""
        return values


@dataclass(frozen=True, slots=True)
class RowEntrainment:
    """Every row has an entrainment of its own."""

    rows: Array  # entrainment over that of the problem, (ny,) [-]

    def carried(self, values: Array) -> Array:
        """Return nodal values times the entrainment of their row, shape (ny, nx)."""
        return self.rows[:, None] * values


Entrainment = UniformEntrainment | RowEntrainment
