"""Eigenvalues and eigenvectors of a real symmetric matrix, as a kernel."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel

_SWEEPS = 40  # over all pairs; 6 to 10 are usual
_SMALL = 1e-15  # of the geometric mean of two diagonal entries, or of the largest entry


@kernel
def symmetric_modes(matrix: Array, n: int, vectors: Array) -> None:
    """Turn a symmetric matrix into its eigenvalues, on the diagonal; write the eigenvectors.

    Jacobi rotations in the cyclic order, until no entry beside the diagonal matters.

    Parameters
    ----------
    matrix : ndarray of shape (n * n,)
        Row by row; overwritten.
    n : int
        Number of rows and columns.
    vectors : ndarray of shape (n * n,)
        Eigenvector k, of length 1, is row k.

    References
    ----------
    G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., Johns Hopkins 2013, section 8.5.

    Examples
    --------
    >>> import numpy as np
    >>> matrix, vectors = np.array([2.0, 1.0, 1.0, 2.0]), np.empty(4)
    >>> symmetric_modes(matrix, 2, vectors)
    >>> sorted(matrix[[0, 3]].round(12).tolist())
    [1.0, 3.0]
    """
    largest = 0.0
    for i in range(n):
        for j in range(n):
            vectors[i * n + j] = 1.0 if i == j else 0.0
            largest = max(largest, abs(matrix[i * n + j]))
    for _ in range(_SWEEPS):
        turned = False
        for p in range(n):
            for q in range(p + 1, n):
                beside = matrix[p * n + q]
                if abs(beside) <= _SMALL * _SMALL * largest:
                    continue
                a, b = matrix[p * n + p], matrix[q * n + q]
                if abs(beside) <= _SMALL * math.sqrt(abs(a * b)):
                    continue
                turned = True
                half = 0.5 * (b - a) / beside
                t = math.copysign(1.0, half) / (abs(half) + math.sqrt(1.0 + half * half))
                cos = 1.0 / math.sqrt(1.0 + t * t)
                sin = t * cos
                _turn_columns(matrix, n, p, q, cos, sin)
                _turn_rows(matrix, n, p, q, cos, sin)
                _turn_rows(vectors, n, p, q, cos, sin)
        if not turned:
            return


@kernel
def _turn_rows(matrix: Array, n: int, p: int, q: int, cos: float, sin: float) -> None:
    for i in range(n):
        a, b = matrix[p * n + i], matrix[q * n + i]
        matrix[p * n + i], matrix[q * n + i] = cos * a - sin * b, sin * a + cos * b


@kernel
def _turn_columns(matrix: Array, n: int, p: int, q: int, cos: float, sin: float) -> None:
    for i in range(n):
        a, b = matrix[i * n + p], matrix[i * n + q]
        matrix[i * n + p], matrix[i * n + q] = cos * a - sin * b, sin * a + cos * b
