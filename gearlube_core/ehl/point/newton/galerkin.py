"""Linearised Reynolds operators of coarse grids, as means of the fine one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.newton.transfer import Transfer
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.kernels.jit import kernel

LEAST_FREE = 0.25  # share of free fine nodes around a free coarse node


@kernel
def stencil_entries(
    order: np.ndarray,
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    free: np.ndarray,
    reach: np.ndarray,
    start: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
) -> int:
    """Write the stencils of all free nodes as compressed rows; return the number of entries.

    Parameters
    ----------
    order : ndarray of int, shape (n,)
        Indices of neighbours by rising column.
    offsets : ndarray of int, shape (m, 2), m >= n
        Steps to the neighbours along y and x.
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Real and imaginary part of the entries.
    free : ndarray of bool, shape (ny, nx)
        Other nodes have no row and no pressure.
    reach : ndarray of int, shape (ny + 2,)
        Of the sides: rows that hold those from one before the first to one behind the last.
    start, column, entry : ndarray
        Result, of size ny nx + 1 and at least n times the free nodes.

    Returns
    -------
    int
    """
    _, ny, nx = by_pressure.shape
    count = 0
    for j in range(ny):
        for i in range(nx):
            start[j * nx + i] = count
            if not free[j, i]:
                continue
            for k in order:
                jj, ii = j + offsets[k, 0], i + offsets[k, 1]
                p, h = by_pressure[k, j, i], by_film[k, j, i]
                if (p == 0.0 and h == 0.0) or ii < 0:
                    continue
                jj = reach[jj + 1]
                if not free[jj, ii]:
                    p = 0.0
                column[count] = jj * nx + ii
                entry[count] = complex(p, h)
                count += 1
    start[ny * nx] = count
    return count


@kernel
def multiply_rows(
    start: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
    pressure: np.ndarray,
    film: np.ndarray,
    result: np.ndarray,
) -> None:
    """Write Re(entry) pressure + Im(entry) film of all rows; arrays one-dimensional."""
    for row in range(result.size):
        total = 0.0
        for k in range(start[row], start[row + 1]):
            total += entry[k].real * pressure[column[k]] + entry[k].imag * film[column[k]]
        result[row] = total


@dataclass(slots=True)
class SparseOperator:
    """Derivatives with respect to pressure (real) and film (imaginary part) of one grid."""

    matrix: csr_matrix
    free: Flags
    by_approach: Array

    def apply(self, pressure: Array, film: Array, approach: float) -> Array:
        """Return the change of the residual, shape (ny, nx)."""
        film = np.ascontiguousarray(film)
        result = np.empty(film.shape)
        multiply_rows(
            self.matrix.indptr,
            self.matrix.indices,
            self.matrix.data,
            np.ascontiguousarray(pressure).ravel(),
            film.ravel(),
            result.ravel(),
        )
        if approach != 0.0:
            result += approach * self.by_approach
        return result


def sparse_operator(linear: Linearisation) -> SparseOperator:
    """Return the operator of the finest grid."""
    size, neighbours = linear.free.size, linear.by_pressure.shape[0]
    most = neighbours * int(linear.free.sum())
    order = np.lexsort(linear.offsets[:neighbours].T[::-1])
    start = np.empty(size + 1, dtype=np.int32)
    column = np.empty(most, dtype=np.int32)
    entry = np.empty(most, dtype=np.complex128)
    count = stencil_entries(
        order,
        linear.offsets,
        linear.by_pressure,
        linear.by_film,
        linear.free,
        linear.sides.reach(linear.free.shape[0]),
        start,
        column,
        entry,
    )
    matrix = csr_matrix((entry[:count], column[:count], start), shape=(size, size))
    matrix = linear.transport.added_to(
        matrix, linear.offsets, linear.by_pressure, linear.by_film, linear.free
    )
    return SparseOperator(matrix, linear.free, linear.by_approach)


def coarse_operator(fine: SparseOperator, transfer: Transfer) -> SparseOperator:
    """Return the Galerkin operator: restriction, fine operator, interpolation."""
    share = transfer.down(fine.free.astype(np.float64))
    free = share > LEAST_FREE
    free[[0, -1]] = False
    free[:, [0, -1]] = False
    matrix = (transfer.restriction @ fine.matrix @ transfer.interpolation).tocsr()
    matrix.sort_indices()
    return SparseOperator(matrix, free, transfer.down(fine.by_approach))
