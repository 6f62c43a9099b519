"""Deflection from its Laplacian: the differential formulation, equal to the integral one.

The Laplacian of the deflection feels pressure nearby (as r^-3) where the deflection itself feels it
from afar (as r^-1). A Poisson equation between known border values gives the deflection back.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.fft import dstn, idstn, irfft, next_fast_len, rfft

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.errors import ParameterError


def laplacian_coefficients(
    dx: float, dy: float, nx: int, ny: int, contact_modulus: float, form: str = "difference"
) -> Array:
    """Return the Laplacian of the deflection per unit cell pressure for all offsets of a grid.

    difference: f_ij = [g_i+1,j - 2 g_ij + g_i-1,j]/dx^2 + [g_i,j+1 - 2 g_ij + g_i,j-1]/dy^2
    derivative: f = 1/(pi E*) [[-r/(x y)]] over the corners of the cell

    Parameters
    ----------
    dx, dy
        Sides of a cell [m].
    nx, ny
        Number of offsets along x and y, zero included.
    contact_modulus
        E* of the pair of bodies [Pa].
    form
        `difference`: the five-point Laplacian of Love's deflection g, what the discrete Poisson
        equation takes back exactly. `derivative`: the Laplacian itself, which differs by second
        order far from the cell and by a finite part near it.

    Returns
    -------
    ndarray, shape (nx, ny)
        f [1/(m Pa)], even in both offsets.

    Raises
    ------
    ParameterError
        As `love_coefficients`, or an unknown form.

    Notes
    -----
    Source: Evans and Hughes 2000; Jamali 2015 eq. (3.7), (3.16), (3.17), with the factor
    2/(pi E') = 1/(pi E*) included.
    """
    check_option("form", form, ("difference", "derivative"))
    if form == "difference":
        wider = love_coefficients(dx, dy, nx + 1, ny + 1, contact_modulus) * (dx * dy)
        g = np.pad(wider, ((1, 0), (1, 0)), mode="reflect")
        along_x = g[2:, 1:-1] - 2.0 * g[1:-1, 1:-1] + g[:-2, 1:-1]
        along_y = g[1:-1, 2:] - 2.0 * g[1:-1, 1:-1] + g[1:-1, :-2]
        return np.asarray(along_x / dx**2 + along_y / dy**2)
    love_coefficients(dx, dy, 1, 1, contact_modulus)  # checks
    x = (np.arange(nx + 1) - 0.5)[:, None] * dx
    y = (np.arange(ny + 1) - 0.5)[None, :] * dy
    corner = -np.hypot(x, y) / (x * y)
    total = corner[1:, 1:] - corner[:-1, 1:] - corner[1:, :-1] + corner[:-1, :-1]
    return np.asarray(total / (math.pi * contact_modulus))


class DifferentialDeflection:
    """Deflection of a uniform grid of nodes from the Poisson equation of its Laplacian.

    Parameters
    ----------
    dx, dy
        Node spacing [m]; pressure is constant over a cell around each node.
    nx, ny
        Nodes along x and y, 3 or more.
    contact_modulus
        E* of the pair of bodies [Pa].
    reach
        Cells along x and y beyond which the coefficients of the Laplacian are dropped; by
        default none is.

    Raises
    ------
    ParameterError
        As `laplacian_coefficients`, or fewer than three nodes along a side.

    Notes
    -----
    Without `reach` equal to the convolution with Love's coefficients to rounding. Border values
    are exact sums, row by row transforms. A call costs 1.6 to 4 times the convolution of
    `HalfSpaceConvolution`: the formulation pays where deflection is needed point by point, in a
    relaxation that takes near pressures with the unknown, not where an FFT does all points.

    Far coefficients are small but not negligible: what a reach of n cells drops is a sheet over
    the whole loaded area, of relative weight 1/n, and the Poisson equation adds it up. Over a
    contact of 128 cells on 257 x 257 nodes the deflection is wrong by 1.4 of its largest value at
    a reach of 16 and by 7 % at 64. The thesis sums the far part on a coarse grid instead.
    """

    def __init__(
        self,
        dx: float,
        dy: float,
        nx: int,
        ny: int,
        contact_modulus: float,
        reach: int | None = None,
    ) -> None:
        if min(nx, ny) < 3:
            raise ParameterError(
                f"nx and ny must be 3 or more, got {nx} and {ny}: there are no inner nodes. "
                "Refine the grid."
            )
        self.shape = (nx, ny)
        self._dx, self._dy = dx, dy
        coefficients = laplacian_coefficients(dx, dy, nx, ny, contact_modulus)
        if reach is not None:
            check_within("reach", reach, 0, max(nx, ny))
            coefficients[reach + 1 :] = 0.0
            coefficients[:, reach + 1 :] = 0.0
        self._convolution = HalfSpaceConvolution(coefficients)
        love = love_coefficients(dx, dy, nx, ny, contact_modulus) * (dx * dy)
        self._lengths = tuple(next_fast_len(2 * n - 1, real=True) for n in self.shape)
        self._rows = self._spectra(love, 0), self._spectra(love, 1)
        wave_x = np.sin(0.5 * math.pi * np.arange(1, nx - 1) / (nx - 1)) / dx
        wave_y = np.sin(0.5 * math.pi * np.arange(1, ny - 1) / (ny - 1)) / dy
        self._symbol = -4.0 * (wave_x[:, None] ** 2 + wave_y[None, :] ** 2)

    def _spectra(self, love: Array, axis: int) -> Array:
        """Return the transforms along an axis of even coefficients."""
        n = self.shape[axis]
        lines = np.moveaxis(love, axis, -1)
        padded = np.zeros((lines.shape[0], self._lengths[axis]))
        padded[:, :n] = lines
        padded[:, self._lengths[axis] - n + 1 :] = lines[:, :0:-1]
        return np.asarray(rfft(padded, axis=-1).real)

    def _borders(self, pressure: Array, axis: int) -> tuple[Array, Array]:
        """Return the deflection of the first and last line along an axis."""
        n, length = self.shape[axis], self._lengths[axis]
        spectrum = rfft(np.moveaxis(pressure, axis, -1), length, axis=-1)
        rows = self._rows[axis]
        first = irfft(np.einsum("jk,jk->k", spectrum, rows), length)[:n]
        last = irfft(np.einsum("jk,jk->k", spectrum, rows[::-1]), length)[:n]
        return first, last

    def laplacian(self, pressure: Array) -> Array:
        """Return the discrete Laplacian of the deflection [1/m], shape (nx, ny)."""
        return np.array(self._convolution(pressure))

    def __call__(self, pressure: Array) -> Array:
        """Return the deflection [m], shape (nx, ny), under nodal pressures [Pa]."""
        deflection = np.empty(self.shape)
        deflection[:, 0], deflection[:, -1] = self._borders(pressure, 0)
        deflection[0], deflection[-1] = self._borders(pressure, 1)
        right = self.laplacian(pressure)[1:-1, 1:-1]
        right[0] -= deflection[0, 1:-1] / self._dx**2
        right[-1] -= deflection[-1, 1:-1] / self._dx**2
        right[:, 0] -= deflection[1:-1, 0] / self._dy**2
        right[:, -1] -= deflection[1:-1, -1] / self._dy**2
        deflection[1:-1, 1:-1] = idstn(dstn(right, type=1) / self._symbol, type=1)
        return deflection
