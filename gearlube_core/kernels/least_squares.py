"""Linear least squares of small dense systems of any rank, as a kernel."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel

_SWEEPS = 40  # over all pairs of columns; 4 to 10 are usual
_ORTHOGONAL = 1e-15  # cosine of two columns
_LEAST = 1e-12  # singular value of the largest: below it a direction is not determined


def least_squares_work(columns: int) -> int:
    """Return the length of `work` for so many unknowns."""
    return columns * columns


@kernel
def least_squares(
    matrix: Array, rows: int, columns: int, right: Array, x: Array, work: Array
) -> int:
    """Write the shortest x with the least |A x - b|; return in how many directions x is free.

    One-sided Jacobi rotations turn A into A V with orthogonal columns, whose lengths are the
    singular values.

    Parameters
    ----------
    matrix : ndarray of shape (rows * columns,)
        A row by row; overwritten. Should be scaled, so that its numbers compare.
    rows, columns : int
        Numbers of equations and unknowns.
    right : ndarray of shape (rows,)
        Right-hand side b of the equations.
    x : ndarray of shape (columns,)
    work : ndarray of shape (>= least_squares_work(columns),)

    References
    ----------
    M. R. Hestenes, Inversion of matrices by biorthogonalization and related results, J. Soc. Ind.
    Appl. Math. 6 (1958), doi:10.1137/0106005.
    """
    for i in range(columns):
        for j in range(columns):
            work[i * columns + j] = 1.0 if i == j else 0.0
    for _ in range(_SWEEPS):
        turned = False
        for p in range(columns):
            for q in range(p + 1, columns):
                alpha = beta = gamma = 0.0
                for i in range(rows):
                    a, b = matrix[i * columns + p], matrix[i * columns + q]
                    alpha += a * a
                    beta += b * b
                    gamma += a * b
                if abs(gamma) <= _ORTHOGONAL * math.sqrt(alpha * beta):
                    continue
                turned = True
                zeta = (beta - alpha) / (2.0 * gamma)
                t = math.copysign(1.0, zeta) / (abs(zeta) + math.sqrt(1.0 + zeta * zeta))
                cos = 1.0 / math.sqrt(1.0 + t * t)
                _turn(matrix, rows, columns, p, q, cos, t * cos)
                _turn(work, columns, columns, p, q, cos, t * cos)
        if not turned:
            break
    largest = 0.0
    for j in range(columns):
        x[j] = 0.0
        largest = max(largest, _square(matrix, rows, columns, j))
    free = 0
    for j in range(columns):
        square = _square(matrix, rows, columns, j)
        if not square > _LEAST * _LEAST * largest:
            free += 1
            continue
        along = 0.0
        for i in range(rows):
            along += matrix[i * columns + j] * right[i]
        for k in range(columns):
            x[k] += along / square * work[k * columns + j]
    return free


@kernel
def _square(matrix: Array, rows: int, columns: int, j: int) -> float:
    total = 0.0
    for i in range(rows):
        total += matrix[i * columns + j] * matrix[i * columns + j]
    return total


@kernel
def _turn(matrix: Array, rows: int, columns: int, p: int, q: int, cos: float, sin: float) -> None:
    """Turn columns p and q of a matrix towards each other."""
    for i in range(rows):
        a, b = matrix[i * columns + p], matrix[i * columns + q]
        matrix[i * columns + p] = cos * a - sin * b
        matrix[i * columns + q] = sin * a + cos * b
