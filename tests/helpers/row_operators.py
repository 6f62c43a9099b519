"""An operator of rows of nodes, and the dense matrices of its rows."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix

from gearlube_core.ehl.point.newton.galerkin import SparseOperator

Entries = dict[tuple[int, int, int, int], complex]  # at (j, i), by pressure and film at (jj, ii)


def operator_of(entries: Entries, free: np.ndarray) -> SparseOperator:
    """Return the operator with these entries."""
    nx = free.shape[1]
    rows = [j * nx + i for j, i, _, _ in entries]
    columns = [jj * nx + ii for _, _, jj, ii in entries]
    matrix = csr_matrix((list(entries.values()), (rows, columns)), shape=(free.size, free.size))
    matrix.sort_indices()
    return SparseOperator(matrix, free, np.zeros(free.shape))


def some_entries(free: np.ndarray) -> Entries:
    """Return entries of neighbours up to six rows and three columns away."""
    rng = np.random.default_rng(9)
    entries: Entries = {}
    near = [(b, a) for b in range(-6, 7) for a in range(-3, 4) if abs(a) + abs(b) <= 6]
    for j, i in np.argwhere(free):
        for b, a in near:
            jj, ii = j + b, i + a
            inside = 0 <= jj < free.shape[0] and 0 <= ii < free.shape[1]
            if inside and (rng.random() < 0.5 or (a, b) == (0, 0)):
                by_pressure = rng.normal() + 9.0 * ((a, b) == (0, 0))
                if not free[jj, ii]:
                    by_pressure = 0.0
                entries[int(j), int(i), int(jj), int(ii)] = complex(by_pressure, rng.normal())
    return entries


def dense_row(
    entries: Entries, free: np.ndarray, local: np.ndarray, across: np.ndarray, j: int,
    columns: int = 99, reach: int = 99,
) -> np.ndarray:  # fmt: skip
    """Return the matrix (nx, nx) of row j, whose neighbours' pressure goes with its own.

    Entries up to `columns` away count, and the deflection up to `reach` nodes from a cell.
    """
    matrix = np.diag(np.where(free[j], 0.0, 1.0))
    for (row, i, jj, ii), entry in entries.items():
        if row != j or abs(ii - i) > columns:
            continue
        if jj == j:
            matrix[i, ii] += entry.real
        near = np.abs(np.arange(free.shape[1]) - ii) <= reach
        matrix[i] += entry.imag * across[min(abs(jj - j), 4)] * local[ii] * near * free[j]
    return matrix
