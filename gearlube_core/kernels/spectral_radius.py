"""Largest modulus of the eigenvalues of a real matrix, as a kernel."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel

_SQUARINGS = 50  # the root of the norm over the radius, n times the condition, is then round-off


@kernel
def spectral_radius(matrix: Array, n: int, square: Array) -> float:
    """Return the largest modulus of the eigenvalues, NaN or infinite of such a matrix.

    The limit |A^m|^(1/m) of Gelfand for m = 2^50, from above: by squaring, with the norm divided
    out each time. Holds for complex and repeated eigenvalues too.

    Parameters
    ----------
    matrix : ndarray of shape (n * n,)
        Row by row; overwritten.
    n : int
        Number of rows and columns.
    square : ndarray of shape (n * n,)
        Scratch memory, its values are lost.
    """
    logarithm = 0.0
    exponent = 1.0
    for _ in range(_SQUARINGS):
        norm = 0.0
        for i in range(n * n):
            norm += abs(matrix[i])
        if norm == 0.0 or not norm < math.inf:
            return norm
        logarithm += exponent * math.log(norm)
        exponent *= 0.5
        for i in range(n * n):
            matrix[i] /= norm
        for i in range(n):
            for j in range(n):
                total = 0.0
                for k in range(n):
                    total += matrix[i * n + k] * matrix[k * n + j]
                square[i * n + j] = total
        for i in range(n * n):
            matrix[i] = square[i]
    return math.exp(logarithm)
