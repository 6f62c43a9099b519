"""Deflection of a grid whose rows repeat, with the copied rows of its arrays."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.half_space_periodic import PeriodicDeflection
from gearlube_core.ehl.point.sides import Sides
from gearlube_core.kernels.row_workers import ALONE, RowWorkers


class ClosedDeflection:
    """Deflection of solids that repeat along y; those beside closed sides without flow as well.

    Parameters
    ----------
    modes : ndarray, shape (nx, rows//2 + 1)
        From `periodic_modes`.
    sides
        Of the rows.
    rows
        Without copied ones.
    single
        In float32, for preconditioners.
    workers
        Threads that share it; results do not depend on it.
    """

    def __init__(
        self,
        modes: Array,
        sides: Sides,
        rows: int,
        *,
        single: bool = False,
        workers: RowWorkers = ALONE,
    ) -> None:
        self._sides = sides
        self._convolution = PeriodicDeflection(modes, rows, "first", single=single, workers=workers)
        kind: Any = np.float32 if single else np.float64
        self._result: Any = np.zeros((rows + 2, modes.shape[0]), dtype=kind)

    def __call__(self, pressure: Array) -> Array:
        """Return the deflection, (rows + 2, nx), under a pressure whose copied rows do not count.

        The result is overwritten by the next call.
        """
        self._result[1:-1] = self._convolution(pressure[1:-1])
        self._sides.fill(self._result)
        return np.asarray(self._result)
