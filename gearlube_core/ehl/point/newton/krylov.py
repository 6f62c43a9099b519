"""Flexible GMRES for a nodal field bordered by one number."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gearlube_core.arrays import Array

Operator = Callable[[Array, float], tuple[Array, float]]


def flexible_gmres(
    operator: Operator,
    inverse: Operator,
    field: Array,
    number: float,
    *,
    tolerance: float,
    most: int,
    weight: float,
) -> tuple[Array, float, float, int]:
    """Return the solution, its relative residual and the number of iterations.

    Parameters
    ----------
    operator
        Takes and returns a field and a number.
    inverse
        Approximate inverse, applied from the right; may change between calls.
    field, number
        Right-hand side.
    tolerance
        Relative residual to stop at [-].
    most
        Most iterations.
    weight
        Of the number's residual beside those of the field [-].

    Returns
    -------
    tuple
        Field, number, relative residual [-], iterations.

    Notes
    -----
    [saad_1993], with modified Gram-Schmidt and Givens rotations, without restart.
    """
    size = field.size
    first = np.append(field.ravel(), weight * number)
    norm = float(np.linalg.norm(first))
    if norm == 0.0:
        return np.zeros_like(field), 0.0, 0.0, 0
    basis = [first / norm]
    directions: list[tuple[Array, float]] = []
    H = np.zeros((most + 1, most))
    cosines, sines, right = np.zeros(most), np.zeros(most), np.zeros(most + 1)
    right[0] = norm
    count = 0
    for k in range(most):
        v = basis[k]
        direction = inverse(v[:size].reshape(field.shape), float(v[size]) / weight)
        directions.append(direction)
        image, image_number = operator(*direction)
        w = np.append(image.ravel(), weight * image_number)
        for i in range(k + 1):
            H[i, k] = float(w @ basis[i])
            w -= H[i, k] * basis[i]
        H[k + 1, k] = float(np.linalg.norm(w))
        for i in range(k):
            upper, lower = H[i, k], H[i + 1, k]
            H[i, k] = cosines[i] * upper + sines[i] * lower
            H[i + 1, k] = -sines[i] * upper + cosines[i] * lower
        length = math.hypot(H[k, k], H[k + 1, k])
        last = H[k + 1, k]
        count = k + 1
        if length == 0.0 or not math.isfinite(length):
            count = k
            break
        cosines[k], sines[k] = H[k, k] / length, H[k + 1, k] / length
        H[k, k] = length
        right[k + 1] = -sines[k] * right[k]
        right[k] *= cosines[k]
        if abs(right[k + 1]) <= tolerance * norm or last == 0.0:
            break
        basis.append(w / last)
    weights = np.linalg.solve(np.triu(H[:count, :count]), right[:count])
    solution, solution_number = np.zeros_like(field), 0.0
    for share, direction in zip(weights, directions, strict=False):
        solution += share * direction[0]
        solution_number += float(share) * direction[1]
    return solution, solution_number, abs(float(right[count])) / norm, count
