"""Direct solution of a linearised point contact on a coarse grid."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from gearlube_core.ehl.point_galerkin import SparseOperator
from gearlube_core.ehl.point_level import Linearisation, PointLevel
from gearlube_core.jit import kernel

Array = np.ndarray[Any, np.dtype[np.float64]]


@kernel
def fill_matrix(
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    by_approach: np.ndarray,
    coefficients: np.ndarray,
    rows: np.ndarray,
    columns: np.ndarray,
    number: np.ndarray,
    load: float,
    matrix: np.ndarray,
) -> None:
    """Fill the matrix of the free nodes, bordered by approach and load.

    Parameters
    ----------
    by_pressure, by_film : ndarray, shape (7, ny, nx)
        Derivatives of the residual.
    by_approach : ndarray, shape (ny, nx)
        Their sum over the film.
    coefficients : ndarray, shape (ny, nx)
        Deflection at all offsets per unit pressure.
    rows, columns : ndarray of int, shape (n,)
        Free nodes.
    number : ndarray of int, shape (ny, nx)
        Number of a free node, else -1.
    load : float
        Load of one node at unit pressure, relative to the load.
    matrix : ndarray, shape (n + 1, n + 1)
        Result.
    """
    ny, nx = number.shape
    n = rows.size
    down = (0, 0, 0, 0, -1, 1, -2)
    right = (0, -1, 1, -2, 0, 0, 0)
    for a in range(n):
        j, i = rows[a], columns[a]
        for b in range(n):
            matrix[a, b] = 0.0
        for k in range(7):
            slope = by_film[k, j, i]
            if slope != 0.0:
                jj, ii = j + down[k], i + right[k]
                for b in range(n):
                    matrix[a, b] += slope * coefficients[abs(rows[b] - jj), abs(columns[b] - ii)]
        for k in range(7):
            jj, ii = j + down[k], i + right[k]
            if by_pressure[k, j, i] != 0.0 and 0 <= jj < ny and 0 <= ii < nx:
                if number[jj, ii] >= 0:
                    matrix[a, number[jj, ii]] += by_pressure[k, j, i]
        matrix[a, n] = by_approach[j, i]
        matrix[n, a] = load
    matrix[n, n] = 0.0


class DirectSolution:
    """Factored matrix of pressure and approach at the free nodes."""

    def __init__(self, level: PointLevel, linear: Linearisation, single: bool = False) -> None:
        self._rows, self._columns = np.nonzero(linear.free)
        n = self._rows.size
        number = np.full(level.shape, -1)
        number[self._rows, self._columns] = np.arange(n)
        matrix = np.empty((n + 1, n + 1), dtype=np.float32 if single else np.float64)
        fill_matrix(
            linear.by_pressure,
            linear.by_film,
            linear.by_approach,
            level.coefficients,
            self._rows,
            self._columns,
            number,
            level.cell / level.scales.load,
            matrix,
        )
        # rows lie along memory: the transpose is what LAPACK calls contiguous
        self._factors = lu_factor(matrix.T, overwrite_a=True, check_finite=False)
        self._shape = level.shape

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach with the residual and the load given."""
        right = np.append(residual[self._rows, self._columns], load_residual)
        solution = lu_solve(self._factors, right, trans=1, check_finite=False)
        pressure = np.zeros(self._shape)
        pressure[self._rows, self._columns] = solution[:-1]
        return pressure, float(solution[-1])


class CoarseSolution:
    """Factored matrix of pressure and approach at the free nodes of a Galerkin operator."""

    def __init__(self, level: PointLevel, operator: SparseOperator) -> None:
        free = operator.free.ravel()
        self._nodes = np.flatnonzero(free)
        n = self._nodes.size
        matrix = np.empty((n + 1, n + 1), order="F")
        rows = operator.matrix[self._nodes]
        matrix[:n, :n] = rows.imag @ level.dense_deflection()[:, self._nodes]
        matrix[:n, :n] += rows.real[:, self._nodes].toarray()
        matrix[:n, n] = operator.by_approach.ravel()[self._nodes]
        matrix[n, :n] = level.cell / level.scales.load
        matrix[n, n] = 0.0
        self._factors = lu_factor(matrix, overwrite_a=True, check_finite=False)
        self._shape = level.shape

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach with the residual and the load given."""
        right = np.append(residual.ravel()[self._nodes], load_residual)
        solution = lu_solve(self._factors, right, check_finite=False)
        pressure = np.zeros(self._shape)
        pressure.ravel()[self._nodes] = solution[:-1]
        return pressure, float(solution[-1])
