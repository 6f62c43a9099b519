"""Stencils of an operator in single precision, neighbour by neighbour: for preconditioners."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.kernels.jit import kernel, row_kernel
from gearlube_core.kernels.row_workers import ALONE, RowWorkers

_REACH = 2  # nodes that a stencil reaches to each side
_WIDTH = 2 * _REACH + 1

Single: Any = np.float32


@kernel
def _offset(rows: int, period: int) -> int:
    """Return the shortest way of so many rows around a period; 0: no period."""
    if period > 0:
        if 2 * rows > period:
            return rows - period
        if 2 * rows < -period:
            return rows + period
    return rows


@kernel
def mark_offsets(
    start: np.ndarray, column: np.ndarray, nx: int, period: int, used: np.ndarray
) -> bool:
    """Set which of the offsets occur, shape (5, 5); return False where one reaches farther."""
    for row in range(start.size - 1):
        j = row // nx
        i = row - j * nx
        for k in range(start[row], start[row + 1]):
            jj = column[k] // nx
            dj = _offset(jj - j, period) + _REACH
            di = column[k] - jj * nx - i + _REACH
            if not (0 <= dj < _WIDTH and 0 <= di < _WIDTH):
                return False
            used[dj, di] = True
    return True


@kernel
def spread_entries(
    start: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
    period: int,
    places: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Write compressed rows as stencils.

    Parameters
    ----------
    start, column, entry : ndarray
        Compressed rows; pressure in the real part.
    period
        Rows after which neighbours repeat; 0: never.
    places : ndarray of int, shape (5, 5)
        Numbers of the offsets along y and x.
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Result; zero on entry.
    """
    nx = by_film.shape[2]
    for row in range(start.size - 1):
        j = row // nx
        i = row - j * nx
        for k in range(start[row], start[row + 1]):
            jj = column[k] // nx
            dj = _offset(jj - j, period) + _REACH
            place = places[dj, column[k] - jj * nx - i + _REACH]
            by_pressure[place, j, i] += entry[k].real
            by_film[place, j, i] += entry[k].imag


@row_kernel
def multiply_stencil(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    period: int,
    pressure: np.ndarray,
    film: np.ndarray,
    rows: tuple[int, int],
    result: np.ndarray,
) -> None:
    """Write what stencils make of changes of pressure and film.

    Parameters
    ----------
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x.
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Derivatives.
    period
        Rows after which neighbours repeat; 0: never. Row 0 is then a copy.
    pressure, film : ndarray, shape (ny, nx)
        Changes.
    rows
        First row that is written and the one behind the last.
    result : ndarray, shape (ny, nx)
    """
    count, ny, nx = by_film.shape
    for j in range(rows[0], rows[1]):
        row = result[j]
        row[:] = 0.0
        for k in range(count):
            jj = j + offsets[k, 0]
            if period > 0:
                if jj < 1:
                    jj += period
                elif jj > period:
                    jj -= period
            if not 0 <= jj < ny:
                continue
            di = offsets[k, 1]
            low, high = max(0, -di), min(nx, nx - di)
            # slices from 0 on: then the compiler takes many columns at once
            total = row[low:high]
            p, h = pressure[jj, low + di : high + di], film[jj, low + di : high + di]
            of_p, of_h = by_pressure[k, j, low:high], by_film[k, j, low:high]
            for i in range(total.size):
                total[i] += of_p[i] * p[i] + of_h[i] * h[i]


@dataclass(slots=True)
class SingleStencil:
    """Derivatives of all nodes by their neighbours, float32."""

    offsets: np.ndarray  # (n, 2)
    by_pressure: np.ndarray  # (n, ny, nx)
    by_film: np.ndarray  # (n, ny, nx)
    period: int

    @classmethod
    def of(cls, matrix: Any, shape: tuple[int, int], period: int) -> SingleStencil | None:
        """Return the stencils of compressed rows; None where one reaches too far."""
        used = np.zeros((_WIDTH, _WIDTH), dtype=np.bool_)
        if not mark_offsets(matrix.indptr, matrix.indices, shape[1], period, used):
            return None
        offsets = np.argwhere(used) - _REACH
        places = np.full(used.shape, -1)
        places[used] = np.arange(len(offsets))
        by_pressure, by_film = (np.zeros((len(offsets), *shape), dtype=Single) for _ in range(2))
        spread_entries(
            matrix.indptr, matrix.indices, matrix.data, period, places, by_pressure, by_film
        )
        return cls(offsets, by_pressure, by_film, period)

    def multiply(
        self, pressure: np.ndarray, film: np.ndarray, workers: RowWorkers = ALONE
    ) -> np.ndarray:
        """Return the change of the residual under changes of pressure and film, (ny, nx)."""
        result = np.empty(self.by_film.shape[1:], dtype=Single)
        stencil = self.offsets, self.by_pressure, self.by_film, self.period
        pressure, film = (np.ascontiguousarray(one, dtype=Single) for one in (pressure, film))
        workers.share(
            lambda rows: multiply_stencil(*stencil, pressure, film, rows, result), *result.shape
        )
        return result
