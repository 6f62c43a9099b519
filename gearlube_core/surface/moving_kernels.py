"""Heights of a periodic surface that has moved, on the nodes of a grid."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel

REFINED = 8  # points of the spline for each of the heights


def spline_coefficients(heights: Array) -> Array:
    """Return the B-spline coefficients of the Fourier series through periodic heights.

    The series is taken at eight points for each of the heights, and the spline goes through these.
    A wave of eight points keeps its amplitude to 3e-7, the shortest wave of two points to 6e-5.

    Parameters
    ----------
    heights
        [m], shape (rows, n), each row over one period.

    Returns
    -------
    ndarray, shape (rows, 8 n)
        Of the cubic B-spline whose values at points are (c[k-1] + 4 c[k] + c[k+1])/6 [m].
    """
    n = heights.shape[1]
    waves = np.fft.rfft(heights, axis=1)
    if n % 2 == 0:
        waves[:, -1] *= 0.5  # half of it belongs to the negative frequency
    fine = REFINED * n
    turn = 2.0 * np.pi * np.arange(waves.shape[1]) / fine
    waves *= REFINED * 3.0 / (2.0 + np.cos(turn))
    return np.asarray(np.fft.irfft(waves, fine, axis=1))


def rows_of_map(height: Array, shares: Array) -> Array:
    """Return the sections of a periodic map along x at any places of its period along y.

    Parameters
    ----------
    height
        [m], shape (nx, ny).
    shares
        Places over the period along y [-], shape (rows,).

    Returns
    -------
    ndarray, shape (rows, nx)
        Of the Fourier series along y [m]; at points of the map its own heights.
    """
    count = height.shape[1]
    waves = np.fft.rfft(height, axis=1) / count
    both = slice(1, -1) if count % 2 == 0 else slice(1, None)
    waves[:, both] *= 2.0  # each with its negative frequency
    turns = np.exp(2j * np.pi * np.outer(shares, np.arange(waves.shape[1])))
    return np.ascontiguousarray((turns @ waves.T).real)


class Moved(NamedTuple):
    """Where a surface is at one time; all floats, SI."""

    period: float  # along x [m]
    travel: float  # distance moved along x [m]
    scale: float  # of all heights [-]
    front: float  # x of the first material that has heights [m]; inf: all has
    growth: float  # length behind the front over which heights grow to full [m]


@kernel
def add_moved_heights(
    coefficients: np.ndarray, x: np.ndarray, turns: np.ndarray, moved: Moved, height: np.ndarray
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
