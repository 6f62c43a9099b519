"""Deflection along the rows of a grid under pressure that alternates across them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import toeplitz
from scipy.special import iti0k0

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.stencil import cell_faces
from gearlube_core.ehl.point.settings import AMBIENT, Sides
from gearlube_core.kernels.row_workers import ALONE, RowWorkers

_SPECTRUM = 512


def uniform_wave_deflection(nodes: int, dx: float, modulus: float, wave_number: float) -> Array:
    """Return `wave_deflection` on rows of nodes `dx` apart."""
    count = max(_SPECTRUM, 4 * nodes)
    n = np.fft.fftfreq(count) * 2.0 * np.pi / dx
    symbol = 2.0 / (modulus * np.hypot(n, wave_number))
    return np.asarray(toeplitz(np.fft.ifft(symbol).real[:nodes]))


@dataclass(frozen=True, slots=True)
class TransposedGrid:
    """Uniform grid with rows and columns interchanged, as far as smoothers use it."""

    shape: tuple[int, int]
    dx: float
    dy: float
    modulus: float
    positions: Array  # of the columns along x [-]
    graded: bool = False
    sides: Sides = AMBIENT  # of its rows
    workers: RowWorkers = ALONE

    @classmethod
    def of(cls, grid: PointGrid) -> TransposedGrid:
        """Return the transpose of a uniform grid."""
        ny, nx = grid.shape
        positions = np.arange(ny) * grid.dy
        return cls((nx, ny), grid.dy, grid.dx, grid.modulus, positions, workers=grid.workers)


def unresolved_wave(grid: PointGrid | TransposedGrid, halved: tuple[bool, bool]) -> float:
    """Return the number k of the longest waves across the rows that a coarser grid lacks [-].

    `halved` is whether that has fewer rows, and fewer columns.
    """
    return max(
        0.55 * np.pi / grid.dy if halved[0] else 0.0,
        0.35 * np.pi / grid.dx if halved[1] else 0.0,
    )


def wave_deflection(grid: PointGrid | TransposedGrid, wave_number: float | Array) -> Array:
    """Return the deflection at the nodes of a row under unit pressure on its cells.

    Parameters
    ----------
    grid
        Grid of this contact level.
    wave_number
        k of the wave across the rows, above zero; on a graded grid also one for every node,
        shape (nx,).

    Returns
    -------
    ndarray, shape (nx, nx)
        At node, under cell [-].

    Notes
    -----
    Inverse transform of 2/(E* sqrt(k_x^2 + k^2)): over the waves of a uniform grid, else in
    closed form, 2/(pi E*) int K0(k |x|) dx over cells.
    """
    if not grid.graded:
        return uniform_wave_deflection(grid.shape[1], grid.dx, grid.modulus, float(wave_number))
    wave = np.broadcast_to(wave_number, grid.positions.shape)[:, None]
    distance = cell_faces(grid.positions) - grid.positions[:, None]
    integral = np.sign(distance) * iti0k0(wave * np.abs(distance))[1] / wave
    return np.asarray(2.0 / (math.pi * grid.modulus) * np.diff(integral, axis=1))
