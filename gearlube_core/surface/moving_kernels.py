"""Heights of a periodic surface that has moved, on the nodes of a grid."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel


class Moved(NamedTuple):
    """Where a surface is at one time; all floats, SI."""

    period: float  # along x [m]
    travel: float  # distance moved along x [m]
    scale: float  # of all heights [-]
    front: float  # x of the first material that has heights [m]; inf: all has
    growth: float  # length behind the front over which heights grow to full [m]


@kernel
def add_moved_heights(
    coefficients: np.ndarray,
    x: np.ndarray,
    turns: np.ndarray,
    moved: Moved,
    height: np.ndarray,
) -> None:
    """Add the heights of a moved surface on the nodes of a grid.

    z(x, y) = g p_y(x - turns(y) period - travel),  g = scale min(max((front - x)/growth, 0), 1)

    Parameters
    ----------
    coefficients
        Of the periodic cubic B-spline p_y [m], shape (rows, n): a row for each y, or one for all.
    x
        Nodes [m], shape (nx,).
    turns
        By how many periods the crests have moved along x at each y [-], shape (ny,).
    moved
        Where the surface is.
    height
        [m], shape (nx, ny), added to.
    """
    n = coefficients.shape[1]
    shared = coefficients.shape[0] == 1
    for i in range(x.size):
        growth = (moved.front - x[i]) / moved.growth
        factor = moved.scale * min(max(growth, 0.0), 1.0) / 6.0
        if factor == 0.0:
            continue
        place = (x[i] - moved.travel) / moved.period
        for j in range(turns.size):
            row = 0 if shared else j
            turn = place - turns[j]
            point = (turn - math.floor(turn)) * n
            k = int(point)
            s = point - k
            k = k % n  # rounding may give n itself
            r = 1.0 - s
            before = coefficients[row, k - 1] if k > 0 else coefficients[row, n - 1]
            after = coefficients[row, (k + 1) % n]
            second = coefficients[row, (k + 2) % n]
            height[i, j] += factor * (
                r * r * r * before
                + (4.0 - 3.0 * s * s * (1.0 + r)) * coefficients[row, k]
                + (4.0 - 3.0 * r * r * (1.0 + s)) * after
                + s * s * s * second
            )
