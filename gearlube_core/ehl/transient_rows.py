"""Multigrid cycle for long contacts: whole rows along the motion, grids that thin out across it.

In a long contact the spacing along the contact is many times that along the motion. A row then
feels its own pressure by far the most, over a good part of its length: rows are solved with the
deflection of a wave across the motion, and coarser grids have fewer of them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from gearlube_core.ehl.point_coarse import CoarseSolution
from gearlube_core.ehl.point_galerkin import SparseOperator, coarse_operator, sparse_operator
from gearlube_core.ehl.point_level import Linearisation, PointLevel
from gearlube_core.ehl.point_preconditioner import Hierarchy
from gearlube_core.jit import kernel

Array = np.ndarray[Any, np.dtype[np.float64]]
Inverse = Callable[[Array, float], tuple[Array, float]]

_DAMPING = 0.9
# a row, of the wave across the motion whose deflection a row takes: longer ones would be amplified
_WAVE = 0.12 * np.pi
_DIRECT_NODES = 1700  # of the grid that is solved directly
_FEWEST_ROWS = 7


def row_shapes(shape: tuple[int, int]) -> list[tuple[int, int]]:
    """Return shapes (ny, nx) from coarse to fine that differ in the number of rows."""
    shapes = [shape]
    while shapes[0][0] * shapes[0][1] > _DIRECT_NODES and shapes[0][0] > _FEWEST_ROWS:
        shapes.insert(0, ((shapes[0][0] - 1) // 2 + 1, shape[1]))
    return shapes


def wave_deflection(level: PointLevel) -> Array:
    """Return the deflection along a row of the longest waves that rows smooth, shape (nx,) [1].

    Inverse transform of 2/(E* sqrt(k_x^2 + k^2)) over nodes.
    """
    count = 4 * level.shape[1]
    wave = _WAVE / level.dy
    n = np.fft.fftfreq(count) * 2.0 * np.pi / level.dx
    symbol = 2.0 / (level.modulus * np.hypot(n, wave))
    return np.asarray(np.fft.ifft(symbol).real[: level.shape[1]])


@kernel
def fill_row_matrices(
    start: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
    free: np.ndarray,
    local: np.ndarray,
    across: np.ndarray,
    first: int,
    matrices: np.ndarray,
) -> None:
    """Fill the matrices of all rows of nodes, uncoupled from each other.

    Parameters
    ----------
    start, column, entry : ndarray
        Compressed rows of the operator; slopes by pressure (real) and film (imaginary).
    free : ndarray of bool, shape (ny, nx)
        Other nodes get the identity.
    local : ndarray, shape (nx,)
        Deflection at a distance along the row per unit pressure.
    across : ndarray, shape (5,)
        Share of it that neighbours 0 to 4 rows away see.
    first : int
        Index of the first node of every row that the matrices hold.
    matrices : ndarray, shape (ny, n, n)
        Result, of n nodes from `first` on; zero on entry.
    """
    ny, nx = free.shape
    n = matrices.shape[1]
    for j in range(ny):
        for i in range(first, first + n):
            row = j * nx + i
            if not free[j, i]:
                matrices[j, i - first, i - first] = 1.0
                continue
            for k in range(start[row], start[row + 1]):
                jj = column[k] // nx
                ii = column[k] - jj * nx
                if jj == j and free[jj, ii]:
                    matrices[j, i - first, ii - first] += entry[k].real
                slope = entry[k].imag * across[min(abs(jj - j), 4)]
                if slope != 0.0:
                    for m in range(n):
                        matrices[j, i - first, m] += slope * local[abs(first + m - ii)]
            for m in range(n):
                if not free[j, first + m]:
                    matrices[j, i - first, m] = 0.0


@kernel
def multiply_matrices(
    transposed: np.ndarray, vectors: np.ndarray, scale: float, products: np.ndarray
) -> None:
    """Write scale times matrix by vector of every row; matrices (ny, nx, nx) are transposed."""
    ny, nx = vectors.shape
    total = np.empty(nx, dtype=np.float32)
    for j in range(ny):
        total[:] = 0.0
        for k in range(nx):
            v = np.float32(vectors[j, k])
            if v != 0.0:
                part = transposed[j, k]
                for i in range(nx):
                    total[i] += v * part[i]
        for i in range(nx):
            products[j, i] = scale * total[i]


class RowInverses:
    """Inverse of every row of one linearisation; float32 is enough for a preconditioner."""

    def __init__(self, level: PointLevel, operator: SparseOperator) -> None:
        ny = level.shape[0]
        # columns without any free node drop out: much of the inlet and of the outlet
        columns = np.flatnonzero(operator.free.any(axis=0))
        first, count = (int(columns[0]), int(np.ptp(columns)) + 1) if columns.size else (0, 1)
        self._held = slice(first, first + count)
        matrices = np.zeros((ny, count, count), dtype=np.float32)
        fill_row_matrices(
            operator.matrix.indptr,
            operator.matrix.indices,
            operator.matrix.data,
            operator.free,
            wave_deflection(level).astype(np.float32),
            np.cos(_WAVE * np.arange(5.0)).astype(np.float32),
            first,
            matrices,
        )
        inverses = np.linalg.inv(matrices)
        self._transposed = np.ascontiguousarray(inverses.transpose(0, 2, 1))
        self._free = operator.free
        self._products = np.empty((ny, count))

    def __call__(self, residual: Array) -> Array:
        """Return a pressure that removes the short waves of a residual, shape (ny, nx)."""
        right = np.where(self._free, residual, 0.0)[:, self._held]
        multiply_matrices(self._transposed, right, _DAMPING, self._products)
        pressure = np.zeros(residual.shape)
        pressure[:, self._held] = self._products
        return pressure


class RowCycle:
    """One V-cycle as an approximate inverse; pressure and approach are found together."""

    def __init__(self, grids: Hierarchy, linear: Linearisation) -> None:
        self._levels, self._transfers = grids.levels, grids.transfers
        self._rows: list[RowInverses] = []
        operator = sparse_operator(linear)
        self._operators = [operator]
        for k in range(len(self._levels) - 1, 0, -1):
            self._rows.insert(0, RowInverses(self._levels[k], operator))
            operator = coarse_operator(operator, self._transfers[k - 1])
            self._operators.insert(0, operator)
        self._direct = CoarseSolution(self._levels[0], operator)

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach that cancel most of a residual."""
        return self._cycle(len(self._levels) - 1, residual, load_residual)

    def _cycle(self, k: int, residual: Array, load_residual: float) -> tuple[Array, float]:
        if k == 0:
            return self._direct(residual, load_residual)
        level, operator, transfer = self._levels[k], self._operators[k], self._transfers[k - 1]
        pressure = self._rows[k - 1](residual)
        share = level.cell / level.scales.load
        rest = residual - operator.apply(level, pressure, 0.0)
        coarse, approach = self._cycle(
            k - 1, transfer.down(rest), load_residual - share * float(pressure.sum())
        )
        correction = transfer.up(coarse)
        correction[~operator.free] = 0.0
        pressure += correction
        rest = residual - operator.apply(level, pressure, approach)
        pressure += self._rows[k - 1](rest)
        return pressure, approach
