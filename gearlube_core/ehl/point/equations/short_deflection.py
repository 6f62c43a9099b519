"""Deflection under short waves of pressure: a sum over few neighbours, float32."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.sides import Sides
from gearlube_core.kernels.jit import row_kernel
from gearlube_core.kernels.row_workers import RowWorkers

_SHARPNESS = 16  # power of the cosine
_LEAST = 1.0e-2  # of a node's own deflection, below which a neighbour is left out


@row_kernel
def sum_neighbours(
    offsets: np.ndarray,
    weights: np.ndarray,
    period: int,
    values: np.ndarray,
    rows: tuple[int, int],
    result: np.ndarray,
) -> None:
    """Write weighted sums of the values of neighbours.

    Parameters
    ----------
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x.
    weights : ndarray, shape (n,)
        Of each.
    period
        Rows after which values repeat; 0: never. Row 0 is then a copy.
    values, result : ndarray, shape (ny, nx)
        Values and their sums; nothing is beyond the columns.
    rows
        First row that is written and the one behind the last.
    """
    ny, nx = values.shape
    for j in range(rows[0], rows[1]):
        row = result[j]
        row[:] = 0.0
        for k in range(offsets.shape[0]):
            jj = j + offsets[k, 0]
            if period > 0:
                jj = 1 + (jj - 1) % period
            if not 0 <= jj < ny:
                continue
            di, weight = offsets[k, 1], weights[k]
            low, high = max(0, -di), min(nx, nx - di)
            total, value = row[low:high], values[jj, low + di : high + di]
            for i in range(total.size):
                total[i] += weight * value[i]


class ShortDeflection:
    """Deflection under pressure without the waves that the next coarser grid holds.

    Long waves reach far; without them deflection falls off within a few nodes.

    Parameters
    ----------
    coefficients : ndarray, shape (rows, nx)
        Deflection under unit pressure on a cell so far away; of all rows where they repeat.
    sides
        Of the rows.
    halved
        Whether the next coarser grid has fewer rows, and fewer columns.

    Attributes
    ----------
    offsets, weights : ndarray, shapes (n, 2) and (n,)
        Steps to neighbours along y and x, and the deflection under their pressure.

    Notes
    -----
    The share 1 - (cos(k_x dx/2) cos(k_y dy/2))^16 of the transform of the coefficients is kept,
    with a cosine for each side that is halved. The rest is what means of neighbours have as well.
    """

    def __init__(self, coefficients: Array, sides: Sides, halved: tuple[bool, bool]) -> None:
        self._sides = sides
        self._period = coefficients.shape[0] if sides.closed else 0
        whole = coefficients
        if not sides.closed:
            whole = np.concatenate((whole, whole[-2:0:-1]), axis=0)
        whole = np.concatenate((whole, whole[:, -2:0:-1]), axis=1)
        long = [
            np.cos(np.pi * np.fft.fftfreq(count)) ** _SHARPNESS if half else np.ones(count)
            for count, half in zip(whole.shape, halved, strict=True)
        ]
        short = np.fft.ifft2(np.fft.fft2(whole) * (1.0 - np.outer(*long))).real
        places = np.argwhere(np.abs(short) > _LEAST * short[0, 0])
        self.weights = short[tuple(places.T)].astype(np.float32)
        size = np.array(short.shape)
        self.offsets = np.where(places > size // 2, places - size, places)

    def __call__(self, pressure: Any, workers: RowWorkers) -> Any:
        """Return the deflection, shape (ny, nx), as a new array."""
        result = np.empty(pressure.shape, dtype=np.float32)
        given = self.offsets, self.weights, self._period, np.ascontiguousarray(pressure)
        workers.share(lambda rows: sum_neighbours(*given, rows, result), *result.shape)
        self._sides.fill(result)
        return result
