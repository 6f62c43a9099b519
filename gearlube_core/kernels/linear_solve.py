"""Small dense linear equations as kernels: LU factors with partial pivoting."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel

_LEAST_PIVOT = 1e-14  # of the largest number in the matrix: below it a pivot is rounding


@kernel
def factorise(matrix: Array, n: int, order: Array) -> float:
    """Replace a matrix by its LU factors; return the number of pivots that were raised.

    Parameters
    ----------
    matrix : ndarray of shape (n * n,)
        Row by row; should be scaled, so that its numbers compare. On return the factors.
    n : int
        Number of rows and columns.
    order : ndarray of shape (n,)
        On return the row that stands in each place.

    Notes
    -----
    A pivot of a singular matrix is raised to `_LEAST_PIVOT` of the largest number: the solution is
    then finite and long in the direction that the matrix does not determine.
    """
    largest = 0.0
    for i in range(n * n):
        largest = max(largest, abs(matrix[i]))
    least = _LEAST_PIVOT * largest if largest > 0.0 else 1.0
    raised = 0.0
    for i in range(n):
        order[i] = i
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(matrix[i * n + k]) > abs(matrix[best * n + k]):
                best = i
        if best != k:
            order[k], order[best] = order[best], order[k]
            for j in range(n):
                a, b = k * n + j, best * n + j
                matrix[a], matrix[b] = matrix[b], matrix[a]
        pivot = matrix[k * n + k]
        if abs(pivot) < least:
            pivot = -least if pivot < 0.0 else least
            matrix[k * n + k] = pivot
            raised += 1.0
        for i in range(k + 1, n):
            factor = matrix[i * n + k] / pivot
            matrix[i * n + k] = factor
            if factor != 0.0:
                for j in range(k + 1, n):
                    matrix[i * n + j] -= factor * matrix[k * n + j]
    return raised


@kernel
def solve_factorised(factors: Array, n: int, order: Array, right: Array, x: Array) -> None:
    """Write the solution of A x = right, with what `factorise` made of A; shapes (n,)."""
    for i in range(n):
        total = right[int(order[i])]
        for j in range(i):
            total -= factors[i * n + j] * x[j]
        x[i] = total
    for back in range(n):
        i = n - 1 - back
        total = x[i]
        for j in range(i + 1, n):
            total -= factors[i * n + j] * x[j]
        x[i] = total / factors[i * n + i]
