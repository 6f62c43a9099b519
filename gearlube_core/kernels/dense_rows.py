"""Products of small dense matrices with vectors, as kernels that the compiler does in lanes.

Four rows at a time, so that the vector is read once for them. Sums may be taken in any order.
"""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import summing
from gearlube_core.kernels.jit import kernel


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


@summing
def times_both(matrix: Array, rows: int, x: Array, y: Array, of_x: Array, of_y: Array) -> None:
    """Write a matrix, row by row, times each of two vectors: it is read once for both."""
    n, i = x.size, 0
    while i + 2 <= rows:
        a, b = part(matrix, i * n, n), part(matrix, (i + 1) * n, n)
        a_x = a_y = b_x = b_y = 0.0
        for j in range(n):
            a_x += a[j] * x[j]
            a_y += a[j] * y[j]
            b_x += b[j] * x[j]
            b_y += b[j] * y[j]
        of_x[i], of_y[i], of_x[i + 1], of_y[i + 1] = a_x, a_y, b_x, b_y
        i += 2
    for k in range(i, rows):
        a, a_x, a_y = part(matrix, k * n, n), 0.0, 0.0
        for j in range(n):
            a_x += a[j] * x[j]
            a_y += a[j] * y[j]
        of_x[k], of_y[k] = a_x, a_y


@summing
def add_times(matrix: Array, rows: int, x: Array, out: Array) -> None:
    """Add the transpose of a matrix, row by row, times a vector of so many numbers.

    Examples
    --------
    >>> import numpy as np
    >>> out = np.zeros(2)
    >>> add_times(np.array([1.0, 2.0, 3.0, 4.0]), 2, np.array([1.0, 1.0]), out)
    >>> out.tolist()
    [4.0, 6.0]
    """
    n, i = out.size, 0
    while i + 4 <= rows:
        a, b = part(matrix, i * n, n), part(matrix, (i + 1) * n, n)
        c, d = part(matrix, (i + 2) * n, n), part(matrix, (i + 3) * n, n)
        of_a, of_b, of_c, of_d = x[i], x[i + 1], x[i + 2], x[i + 3]
        for j in range(n):
            out[j] += of_a * a[j] + of_b * b[j] + of_c * c[j] + of_d * d[j]
        i += 4
    for k in range(i, rows):
        a, of_a = part(matrix, k * n, n), x[k]
        for j in range(n):
            out[j] += of_a * a[j]


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
        add_times(scratch, n, part(vectors, i * n, n), row)
