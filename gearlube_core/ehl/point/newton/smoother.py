"""Line solutions with a local deflection, along and across the rows: assembly and smoothing."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.linalg.lapack import sgbtrf

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.newton.galerkin import SparseOperator
from gearlube_core.ehl.point.newton.row_factors import (
    BELOW,
    LARGEST_SHARE,
    factor_side_by_side,
    fill_side_by_side,
    solve_side_by_side,
)
from gearlube_core.ehl.point.newton.single_stencil import Single, SingleStencil
from gearlube_core.ehl.point.newton.wave import TransposedGrid, unresolved_wave, wave_deflection
from gearlube_core.kernels.jit import row_kernel
from gearlube_core.kernels.row_workers import RowWorkers

# nodes over which the local deflection acts to each side; of the waves that rows solve it falls to
# a tenth or less by then
REACH = 2
_BELOW = REACH + 2  # the far upstream neighbour
_ABOVE = REACH + 2
_DIAGONAL = _BELOW + _ABOVE  # its place in the band of factors


@row_kernel
def fill_rows(
    start: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
    free: np.ndarray,
    local: np.ndarray,
    across: np.ndarray,
    period: int,
    rows: tuple[int, int],
    band: np.ndarray,
) -> None:
    """Fill the LAPACK band of all rows of nodes, uncoupled from each other.

    Parameters
    ----------
    start, column, entry : ndarray
        Compressed rows of the operator.
    free : ndarray of bool, shape (ny, nx)
        Other nodes get the identity.
    local : ndarray, shape (nx, nx)
        Deflection at the nodes of a row per unit pressure on its cells.
    across : ndarray, shape (5,)
        Share of it that neighbours 0 to 4 rows away see.
    period
        Rows after which the film repeats; 0: it does not.
    rows
        First row of nodes that is filled and the one behind the last.
    band : ndarray, shape (ny nx, 2 _BELOW + _ABOVE + 1)
        Result, transposed band storage; zero on entry.
    """
    nx = free.shape[1]
    diagonal = _BELOW + _ABOVE
    for j in range(rows[0], rows[1]):
        for i in range(nx):
            row = j * nx + i
            if not free[j, i]:
                band[row, diagonal] = 1.0
                continue
            for k in range(start[row], start[row + 1]):
                jj = column[k] // nx
                ii = column[k] - jj * nx
                if abs(ii - i) > 2:
                    continue  # oil that came through broken film: beyond the band
                if jj == j and free[jj, ii]:
                    band[row + ii - i, diagonal - ii + i] += entry[k].real
                apart = abs(jj - j)
                if period > 0:
                    apart = min(apart, period - apart)
                slope = entry[k].imag * across[min(apart, 4)]
                for m in range(-REACH, REACH + 1):
                    offset = ii - i + m
                    if 0 <= i + offset < nx and free[j, i + offset]:
                        band[row + offset, diagonal - offset] += slope * local[ii, i + offset]


@row_kernel
def solve_bands(
    factors: np.ndarray,
    pivots: np.ndarray,
    free: np.ndarray,
    scale: float,
    begin: int,
    end: int,
    values: np.ndarray,
) -> None:
    """Solve with the factors of `sgbtrf`, in place, and scale; LAPACK calls BLAS for every node.

    Parameters
    ----------
    factors : ndarray, shape (n, 2 _BELOW + _ABOVE + 1)
        Transposed band storage of L and U, the reciprocal of the diagonal in its place.
    pivots : ndarray of int, shape (n,)
        Numbers of the exchanged rows.
    free : ndarray of bool, shape (n,)
        Other nodes have zero on the right and in the result.
    scale
        Factor that scales the result.
    begin, end
        First node of the rows that are solved and the one behind their last; rows do not feel
        each other.
    values : ndarray, shape (n,)
        Right-hand side on entry.
    """
    for j in range(begin, end):
        if not free[j]:
            values[j] = 0.0
    for j in range(begin, end):
        other = pivots[j]
        value = values[other]
        values[other] = values[j]
        values[j] = value
        below = min(_BELOW, end - 1 - j)
        rest, shares = values[j + 1 : j + 1 + below], factors[j, _DIAGONAL + 1 :]
        for m in range(below):
            rest[m] -= shares[m] * value
    for j in range(end - 1, begin + _DIAGONAL - 1, -1):
        value = values[j] * factors[j, _DIAGONAL]
        values[j] = value
        rest, shares = values[j - _DIAGONAL : j], factors[j]
        for m in range(_DIAGONAL):
            rest[m] -= shares[m] * value
    for j in range(min(end, begin + _DIAGONAL) - 1, begin - 1, -1):
        value = values[j] * factors[j, _DIAGONAL]
        values[j] = value
        rest, shares = values[begin:j], factors[j, _DIAGONAL - j + begin :]
        for m in range(j - begin):
            rest[m] -= shares[m] * value
    for j in range(begin, end):
        values[j] *= scale


class Equations(NamedTuple):
    """Arguments of `fill_rows`."""

    start: np.ndarray
    column: np.ndarray
    entry: np.ndarray
    free: np.ndarray
    local: np.ndarray
    across: np.ndarray
    period: int


class _ExchangedRows:
    """Rows of nodes factored one after the other, with exchange of equations."""

    def __init__(self, equations: Equations, workers: RowWorkers) -> None:
        self._free, self._workers = equations.free, workers
        ny, nx = equations.free.shape
        band = np.zeros((ny * nx, 2 * _BELOW + _ABOVE + 1), dtype=np.float32)
        workers.share(lambda rows: fill_rows(*equations, rows, band), ny, nx)
        factors, self._pivots, _ = sgbtrf(band.T, _BELOW, _ABOVE, overwrite_ab=True)
        self._factors = np.ascontiguousarray(factors.T)
        self._factors[:, _DIAGONAL] = 1.0 / self._factors[:, _DIAGONAL]

    def solve(self, residual: Array, damping: Any) -> Any:
        """Return the solution times a factor, shape (ny, nx)."""
        values = np.array(residual, dtype=Single, order="C")
        flat, (ny, nx) = values.reshape(-1), values.shape
        given = self._factors, self._pivots, self._free.reshape(-1), damping
        self._workers.share(
            lambda rows: solve_bands(*given, rows[0] * nx, rows[1] * nx, flat), ny, nx
        )
        return values


class _SideBySide:
    """Rows of nodes factored all at once, without exchange of equations.

    Attributes
    ----------
    sound : bool
        None would have had to be exchanged with one of a tenth of its weight.
    """

    def __init__(self, stencil: SingleStencil, equations: Equations, workers: RowWorkers) -> None:
        self._free, self._workers = equations.free, workers
        ny, nx = equations.free.shape
        self._band = band = np.zeros((nx, 2 * BELOW + 1, ny), dtype=np.float32)
        largest = np.empty(ny, dtype=np.float32)
        slopes = stencil.offsets, stencil.by_pressure, stencil.film_offsets, stencil.by_film
        local, across = (one.astype(np.float32) for one in (equations.local, equations.across))

        def factor(rows: tuple[int, int]) -> None:
            fill_side_by_side(*slopes, equations.free, local, across, rows, band)
            factor_side_by_side(rows, band, largest)

        workers.share(factor, ny, nx)
        self.sound = bool((largest <= LARGEST_SHARE).all())

    def solve(self, residual: Array, damping: Any) -> Any:
        """Return the solution times a factor, shape (ny, nx)."""
        values = np.where(self._free, residual, Single(0.0)).T.astype(Single, order="C")
        nx, ny = values.shape
        self._workers.share(lambda rows: solve_side_by_side(rows, self._band, values), ny, nx)
        return np.multiply(values.T, damping, order="C")


class RowSmoother:
    """Factored rows of one linearisation; float32 is enough for a preconditioner.

    Parameters
    ----------
    grid, operator
        Grid and its derivatives.
    stencil
        The same as stencils; None where one reaches too far.
    halved
        Whether the next coarser grid has fewer rows, and fewer columns.
    damping
        Factor of the solution.
    """

    def __init__(
        self,
        grid: PointGrid | TransposedGrid,
        operator: SparseOperator,
        stencil: SingleStencil | None,
        halved: tuple[bool, bool],
        damping: float,
    ) -> None:
        wave_number = unresolved_wave(grid, halved)
        shortest = min(wave_number * grid.dy, 0.55 * np.pi)
        matrix = operator.matrix
        equations = Equations(
            matrix.indptr,
            matrix.indices,
            matrix.data,
            operator.free,
            wave_deflection(grid, wave_number),
            np.cos(shortest * np.arange(5.0)),
            grid.sides.period(grid.shape[0]),
        )
        self._damping = Single(damping)
        side_by_side = None if stencil is None else _SideBySide(stencil, equations, grid.workers)
        self._rows: _SideBySide | _ExchangedRows
        if side_by_side is not None and side_by_side.sound:
            self._rows = side_by_side
        else:
            self._rows = _ExchangedRows(equations, grid.workers)

    def __call__(self, residual: Array) -> Array:
        """Return a pressure that removes the short waves of a residual, shape (ny, nx)."""
        return np.asarray(self._rows.solve(residual, self._damping))


class ColumnSmoother:
    """Factored columns of one linearisation, on a uniform grid: rows of the transposed operator."""

    def __init__(
        self, grid: PointGrid, operator: SparseOperator, halved: tuple[bool, bool], damping: float
    ) -> None:
        ny, nx = grid.shape
        order = np.arange(ny * nx).reshape(ny, nx).T.ravel()
        matrix = operator.matrix[order][:, order].tocsr()
        matrix.sort_indices()
        transposed = SparseOperator(
            matrix, np.ascontiguousarray(operator.free.T), operator.by_approach.T
        )
        stencil = SingleStencil.of(matrix, (nx, ny), 0, grid.own_deflection[:, 0])
        self._rows = RowSmoother(
            TransposedGrid.of(grid), transposed, stencil, halved[::-1], damping
        )

    def __call__(self, residual: Array) -> Array:
        """Return a pressure that removes the short waves of a residual, shape (ny, nx)."""
        return np.ascontiguousarray(self._rows(residual.T).T)
