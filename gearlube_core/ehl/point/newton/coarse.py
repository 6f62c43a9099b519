"""Direct solution of a linearised point contact on a coarse grid."""

from __future__ import annotations

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.newton.galerkin import SparseOperator
from gearlube_core.ehl.point.newton.single_stencil import Single


class CoarseSolution:
    """Factored matrix of pressure and approach at the free nodes of a Galerkin operator, float32.

    Parameters
    ----------
    grid, operator
        Coarse grid and its derivatives.
    load
        Integral of the pressure that balances the load [-].
    """

    def __init__(self, grid: PointGrid, operator: SparseOperator, load: float) -> None:
        free = operator.free.ravel()
        self._nodes = np.flatnonzero(free)
        n = self._nodes.size
        matrix = np.empty((n + 1, n + 1), dtype=Single, order="F")
        rows = operator.matrix[self._nodes].astype(np.complex64)
        matrix[:n, :n] = rows.imag @ grid.dense_deflection().astype(Single)[:, self._nodes]
        matrix[:n, :n] += rows.real[:, self._nodes].toarray()
        matrix[:n, n] = operator.by_approach.ravel()[self._nodes]
        matrix[n, :n] = grid.cells[self._nodes % grid.shape[1]] / load
        matrix[n, n] = 0.0
        # fluidity falls by many orders of magnitude: every equation over its largest coefficient
        size = np.abs(matrix).max(axis=1)
        self._scale = 1.0 / np.where(size > 0.0, size, 1.0)
        matrix *= self._scale[:, None]
        self._factors = lu_factor(matrix, overwrite_a=True, check_finite=False)
        self._shape = grid.shape

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach with the residual and the load given."""
        right = np.append(residual.ravel()[self._nodes], load_residual)
        right = (right * self._scale).astype(Single)
        solution = lu_solve(self._factors, right, overwrite_b=True, check_finite=False)
        pressure = np.zeros(self._shape, dtype=Single)
        pressure.ravel()[self._nodes] = solution[:-1]
        return pressure, float(solution[-1])
