"""Products of small dense matrices with vectors, as kernels. Sums may be taken in any order."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.columns import add_columns
from gearlube_core.kernels.inlining import inside, summing
from gearlube_core.kernels.jit import kernel

_LEFT = 1e-12  # of the largest entry


@summing
def dot(one: Array, other: Array) -> float:
    """Return the sum of the products of two vectors of one length."""
    total = 0.0
    for i in range(one.size):
        total += one[i] * other[i]
    return total


@summing
def add_products(one: Array, other: Array, out: Array) -> None:
    """Add the products of the numbers of two vectors to those of a third one."""
    for i in range(out.size):
        out[i] += one[i] * other[i]


@summing
def add_scaled(gain: float, one: Array, out: Array) -> None:
    """Add the numbers of a vector times a gain to those of another one."""
    for i in range(out.size):
        out[i] += gain * one[i]


@summing
def times(matrix: Array, rows: int, x: Array, out: Array) -> None:
    """Write a matrix, row by row, times a vector.

    Examples
    --------
    >>> import numpy as np
    >>> out = np.empty(2)
    >>> times(np.array([1.0, 2.0, 3.0, 4.0]), 2, np.array([1.0, 1.0]), out)
    >>> out.tolist()
    [3.0, 7.0]
    """
    n, i = x.size, 0
    while i + 4 <= rows:
        a, b = part(matrix, i * n, n), part(matrix, (i + 1) * n, n)
        c, d = part(matrix, (i + 2) * n, n), part(matrix, (i + 3) * n, n)
        of_a = of_b = of_c = of_d = 0.0
        for j in range(n):
            of_a += a[j] * x[j]
            of_b += b[j] * x[j]
            of_c += c[j] * x[j]
            of_d += d[j] * x[j]
        out[i], out[i + 1], out[i + 2], out[i + 3] = of_a, of_b, of_c, of_d
        i += 4
    for k in range(i, rows):
        a, of_a = part(matrix, k * n, n), 0.0
        for j in range(n):
            of_a += a[j] * x[j]
        out[k] = of_a


@kernel
def add_times(matrix: Array, x: Array, out: Array) -> None:
    """Add the transpose of a matrix, row by row, times a vector.

    Examples
    --------
    >>> import numpy as np
    >>> out = np.zeros(2)
    >>> add_times(np.array([1.0, 2.0, 3.0, 4.0]), np.array([1.0, 1.0]), out)
    >>> out.tolist()
    [4.0, 6.0]
    """
    _add_each(matrix, (x,), (out,))


@kernel
def add_times_both(matrix: Array, x: Array, y: Array, of_x: Array, of_y: Array) -> None:
    """Do as `add_times` for two vectors: the matrix is read once for both."""
    _add_each(matrix, (x, y), (of_x, of_y))


@inside
def _add_each(matrix: Array, vectors: tuple[Array, ...], outs: tuple[Array, ...]) -> None:
    n, j = outs[0].size, 0
    while j + 16 <= n:
        add_columns(matrix, vectors, outs, j, 16)
        j += 16
    while j + 8 <= n:
        add_columns(matrix, vectors, outs, j, 8)
        j += 8
    while j + 1 <= n:
        add_columns(matrix, vectors, outs, j, 1)
        j += 1


@kernel
def congruent(matrix: Array, vectors: Array, n: int, scratch: Array) -> None:
    """Turn a square matrix A into V A V^T, of vectors V row by row."""
    for i in range(n):  # scratch = A V^T
        times(vectors, n, part(matrix, i * n, n), part(scratch, i * n, n))
    for i in range(n):
        row = part(matrix, i * n, n)
        for j in range(n):
            row[j] = 0.0
    for i in range(n):
        row = part(matrix, i * n, n)
        add_times(scratch, part(vectors, i * n, n), row)


@kernel
def semidefinite_root(matrix: Array, n: int, scratch: Array) -> int:
    """Turn A = B B^T, symmetric and not indefinite, into B; return its columns, the rank of A.

    B has n rows, one behind the other. By Cholesky's method with pivots on the diagonal, until
    what is left is below 1e-12 of the largest entry.

    Examples
    --------
    >>> import numpy as np
    >>> matrix, scratch = np.array([4.0, 2.0, 2.0, 1.0]), np.empty(4)
    >>> semidefinite_root(matrix, 2, scratch), matrix[:2].tolist()
    (1, [2.0, 1.0])
    """
    rank, least = 0, 0.0
    while rank < n:
        pivot = 0
        for i in range(n):
            if matrix[i * n + i] > matrix[pivot * n + pivot]:
                pivot = i
        most = matrix[pivot * n + pivot]
        least = _LEFT * most if rank == 0 else least
        if most <= least:
            break
        column = part(scratch, rank * n, n)
        for i in range(n):
            column[i] = matrix[pivot * n + i] / math.sqrt(most)
        for i in range(n):
            for j in range(n):
                matrix[i * n + j] -= column[i] * column[j]
        rank += 1
    for i in range(n):
        for k in range(rank):
            matrix[i * rank + k] = scratch[k * n + i]
    return rank
