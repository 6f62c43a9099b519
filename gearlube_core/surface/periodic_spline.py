"""Periodic heights between their points: a Fourier series, then a fine cubic B-spline."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array

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
