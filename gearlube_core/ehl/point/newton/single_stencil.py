"""Stencils of an operator in single precision, neighbour by neighbour: for preconditioners."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.kernels.jit import kernel, row_kernel
from gearlube_core.kernels.row_workers import ALONE, RowWorkers

_REACH = 2  # nodes that a stencil reaches to each side
_WIDTH = 2 * _REACH + 1
_LEAST = 1.0e-3  # mean weight of a neighbour that is kept, over that of the heaviest one

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
def weigh_offsets(
    start: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
    own: np.ndarray,
    period: int,
    weight: np.ndarray,
) -> int:
    """Add up how much neighbours weigh; return the number of rows, -1 where one reaches too far.

    Parameters
    ----------
    start, column, entry : ndarray
        Compressed rows; pressure in the real part.
    own : ndarray, shape (nx,)
        Deflection of the nodes of a row under unit pressure on their own cell.
    period
        Rows after which neighbours repeat; 0: never.
    weight : ndarray, shape (2, 5, 5)
        Result, zero on entry: by pressure and by film, for the offsets along y and x. The
        neighbour that weighs most in its row adds 1.
    """
    nx, rows = own.size, 0
    for row in range(start.size - 1):
        j = row // nx
        i = row - j * nx
        most = 0.0
        for k in range(start[row], start[row + 1]):
            most = max(most, abs(entry[k].real), own[i] * abs(entry[k].imag))
        if most == 0.0:
            continue
        rows += 1
        for k in range(start[row], start[row + 1]):
            jj = column[k] // nx
            dj = _offset(jj - j, period) + _REACH
            di = column[k] - jj * nx - i + _REACH
            if not (0 <= dj < _WIDTH and 0 <= di < _WIDTH):
                return -1
            weight[0, dj, di] += abs(entry[k].real) / most
            weight[1, dj, di] += own[i] * abs(entry[k].imag) / most
    return rows


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
    places : ndarray of int, shape (2, 5, 5)
        Numbers of the offsets along y and x, by pressure and by film.
    by_pressure, by_film : ndarray, shapes (n, ny, nx) and (m, ny, nx)
        Result; zero on entry.
    """
    nx = by_film.shape[2]
    for row in range(start.size - 1):
        j = row // nx
        i = row - j * nx
        for k in range(start[row], start[row + 1]):
            jj = column[k] // nx
            dj = _offset(jj - j, period) + _REACH
            di = column[k] - jj * nx - i + _REACH
            by_pressure[places[0, dj, di], j, i] += entry[k].real
            by_film[places[1, dj, di], j, i] += entry[k].imag


@kernel
def _subtract(
    offsets: np.ndarray,
    slopes: np.ndarray,
    period: int,
    values: np.ndarray,
    j: int,
    row: np.ndarray,
) -> None:
    # take what neighbours' values make at the nodes of row j off
    ny, nx = values.shape
    for k in range(offsets.shape[0]):
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
        total, of, value = row[low:high], slopes[k, j, low:high], values[jj, low + di : high + di]
        for i in range(total.size):
            total[i] -= of[i] * value[i]


@row_kernel
def subtract_stencil(
    right: np.ndarray,
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    pressure: np.ndarray,
    film_offsets: np.ndarray,
    by_film: np.ndarray,
    film: np.ndarray,
    period: int,
    rows: tuple[int, int],
    rest: np.ndarray,
) -> None:
    """Write what is left of a right-hand side when pressure and film change.

    Parameters
    ----------
    right : ndarray, shape (ny, nx)
        Right-hand side of the equations.
    offsets, film_offsets : ndarray of int, shapes (n, 2) and (m, 2)
        Steps to the neighbours along y and x.
    by_pressure, by_film : ndarray, shapes (n, ny, nx) and (m, ny, nx)
        Derivatives by pressure and film.
    pressure, film : ndarray, shape (ny, nx)
        Changes of pressure and film.
    period
        Rows after which neighbours repeat; 0: never. Row 0 is then a copy.
    rows
        First row that is written and the one behind the last.
    rest : ndarray, shape (ny, nx)
        Result: right side minus product.
    """
    for j in range(rows[0], rows[1]):
        row = rest[j]
        for i in range(row.size):  # not row[:] = right[j]: numba compiles the text of its error
            row[i] = right[j, i]
        _subtract(offsets, by_pressure, period, pressure, j, row)
        _subtract(film_offsets, by_film, period, film, j, row)


@dataclass(slots=True)
class SingleStencil:
    """Derivatives of all nodes by the neighbours that weigh something, float32.

    Memory traffic dominates the cost, and most of the 25 neighbours on coarse grids of a sheared
    film have small entries. Neglected entries are added to the node itself, so that the effect of
    even changes of pressure and film stays the same.
    """

    offsets: np.ndarray  # (n, 2)
    by_pressure: np.ndarray  # (n, ny, nx)
    film_offsets: np.ndarray  # (m, 2)
    by_film: np.ndarray  # (m, ny, nx)
    period: int

    @classmethod
    def of(
        cls, matrix: Any, shape: tuple[int, int], period: int, own: np.ndarray
    ) -> SingleStencil | None:
        """Return the stencils of compressed rows; None where one reaches too far.

        `own`, shape (nx,), is the deflection of nodes under unit pressure on their own cell.
        """
        weight = np.zeros((2, _WIDTH, _WIDTH))
        compressed = matrix.indptr, matrix.indices, matrix.data
        rows = weigh_offsets(*compressed, np.ascontiguousarray(own), period, weight)
        if rows < 0:
            return None
        used = weight > _LEAST * rows
        used[:, _REACH, _REACH] = True
        offsets, slopes = [], []
        places = np.empty(used.shape, dtype=np.int64)
        for k in range(2):
            offsets.append(np.argwhere(used[k]) - _REACH)
            places[k][used[k]] = np.arange(len(offsets[k]))
            places[k][~used[k]] = places[k][_REACH, _REACH]
            slopes.append(np.zeros((len(offsets[k]), *shape), dtype=Single))
        spread_entries(*compressed, period, places, *slopes)
        return cls(offsets[0], slopes[0], offsets[1], slopes[1], period)

    def rest(
        self, right: np.ndarray, pressure: np.ndarray, film: np.ndarray, workers: RowWorkers = ALONE
    ) -> np.ndarray:
        """Return the residual of a right-hand side under changes of pressure and film, (ny, nx)."""
        right, pressure, film = (
            np.ascontiguousarray(one, dtype=Single) for one in (right, pressure, film)
        )
        rest = np.empty(right.shape, dtype=Single)
        by_pressure = self.offsets, self.by_pressure, pressure
        by_film = self.film_offsets, self.by_film, film
        workers.share(
            lambda rows: subtract_stencil(right, *by_pressure, *by_film, self.period, rows, rest),
            *rest.shape,
        )
        return rest
