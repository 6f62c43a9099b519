"""Small constant matrices by their entries that are not zero: kernels of linear motions."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel


class MatrixEntries(NamedTuple):
    """Entries that are not zero, all of shape (entries,)."""

    row: np.ndarray[Any, np.dtype[np.int64]]
    column: np.ndarray[Any, np.dtype[np.int64]]
    value: Array


def matrix_entries(matrix: Array) -> MatrixEntries:
    """Return the entries of a matrix."""
    row, column = np.nonzero(matrix)
    return MatrixEntries(
        row.astype(np.int64), column.astype(np.int64), np.ascontiguousarray(matrix[row, column])
    )


@kernel
def add_product(factor: float, matrix: MatrixEntries, x: Array, out: Array) -> None:
    """Add factor times matrix times x to `out`; x and `out` have any number of columns."""
    columns = x.shape[1]
    for entry in range(matrix.value.size):
        row, column, value = matrix.row[entry], matrix.column[entry], factor * matrix.value[entry]
        for j in range(columns):
            out[row, j] += value * x[column, j]
