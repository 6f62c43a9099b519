"""Smallest ball around points in five dimensions: kernel."""

from __future__ import annotations

import numpy as np

from gearlube_core.kernels.jit import kernel

DIMENSIONS = 5  # of deviatoric stress


@kernel
def smallest_ball(
    points: np.ndarray,
    tolerance: float,
    most: int,
    weights: np.ndarray,
    centre: np.ndarray,
) -> tuple[float, int]:
    """Return the radius of the smallest ball around points and write its centre.

    Frank and Wolfe's method with steps towards the farthest and away from the nearest point. The
    ball holds all points and its radius is at most 1 + tolerance times the smallest.

    Parameters
    ----------
    points
        Shape (n, 5).
    tolerance
        Of the radius [-].
    most
        Steps at most.
    weights
        Work, shape (n,).
    centre
        Shape (5,), written.

    Returns
    -------
    tuple
        Radius, and steps; `most` if it did not converge.

    Notes
    -----
    Source: [yildirim_2008 algorithm 4.1].
    """
    n, d = points.shape
    for m in range(d):
        centre[m] = points[0, m]
    far, _ = _farthest(points, centre)
    for i in range(n):
        weights[i] = 0.0
    weights[0] += 0.5
    weights[far] += 0.5
    for m in range(d):
        centre[m] = 0.5 * (points[0, m] + points[far, m])
    limit = (1.0 + tolerance) ** 2 - 1.0
    largest = 0.0
    for step in range(most):
        inner, nearest, near = 0.0, np.inf, 0
        largest, far = -1.0, 0
        for i in range(n):
            square = 0.0
            for m in range(d):
                difference = points[i, m] - centre[m]
                square += difference * difference
            # the weighted mean square from the centre: never above that of the smallest ball
            inner += weights[i] * square
            if square > largest:
                largest, far = square, i
            if weights[i] > 0.0 and square < nearest:
                nearest, near = square, i
        if largest <= inner * (1.0 + limit) or largest == 0.0:
            return np.sqrt(largest), step
        outward, inward = largest / inner - 1.0, 1.0 - nearest / inner
        if outward >= inward or weights[near] >= 1.0:
            share, i = outward / (2.0 * (1.0 + outward)), far
        else:
            whole = weights[near] / (1.0 - weights[near])
            best = inward / (2.0 * (1.0 - inward)) if inward < 1.0 else whole
            share, i = -min(best, whole), near
            if best >= whole:
                weights[near] = 0.0  # set below to exactly none
        for k in range(n):
            weights[k] *= 1.0 - share
        if share > 0.0 or weights[i] > 0.0:
            weights[i] += share
        for m in range(d):
            centre[m] = (1.0 - share) * centre[m] + share * points[i, m]
    return np.sqrt(largest), most


@kernel
def _farthest(points: np.ndarray, centre: np.ndarray) -> tuple[int, float]:
    far, largest = 0, -1.0
    for i in range(points.shape[0]):
        square = 0.0
        for m in range(points.shape[1]):
            difference = points[i, m] - centre[m]
            square += difference * difference
        if square > largest:
            largest, far = square, i
    return far, largest
