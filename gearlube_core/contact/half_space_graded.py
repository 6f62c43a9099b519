"""Normal displacement of a half-space under cells of different width along one axis."""

from __future__ import annotations

import math

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.contact.half_space import _love_integral
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel


def graded_coefficients(
    faces: Array, nodes: Array, dy: float, ny: int, contact_modulus: float
) -> Array:
    """Return the displacement at every node under unit pressure on every cell.

    Parameters
    ----------
    faces : ndarray, shape (nx + 1,)
        Borders of the cells along x [m], rising.
    nodes : ndarray, shape (nx,)
        Where the displacement is observed [m].
    dy
        Width of all cells along y [m]; displacement is observed in their middle.
    ny
        Number of offsets along y, zero included.
    contact_modulus
        E* of the pair of bodies [Pa].

    Returns
    -------
    ndarray, shape (ny, nx, nx)
        Displacement over pressure [m/Pa] at offset, node, cell; even in the offset.

    Raises
    ------
    ParameterError
        A size is not positive or faces do not rise.

    Notes
    -----
    Exact for uniform pressure on each rectangle: differences of x asinh(y/|x|) + y asinh(x/|y|),
    as in `love_coefficients`. Source: [love_1929]; [johnson_1985 (3.25)].
    """
    check_positive("dy", dy, "m")
    check_positive("contact_modulus", contact_modulus, "Pa")
    faces, nodes = np.asarray(faces, dtype=np.float64), np.asarray(nodes, dtype=np.float64)
    if ny < 1 or faces.size != nodes.size + 1 or not (np.diff(faces) > 0.0).all():
        raise ParameterError(
            f"faces must rise and be one more than nodes, got {faces.size} faces, {nodes.size} "
            f"nodes and {ny} offsets. Sort the faces."
        )
    x = (nodes[:, None] - faces)[None]
    y = ((np.arange(ny + 1) - 0.5) * dy)[:, None, None]
    corners = _love_integral(*np.broadcast_arrays(x, y))
    strips = corners[:, :, :-1] - corners[:, :, 1:]
    return np.asarray((strips[1:] - strips[:-1]) / (math.pi * contact_modulus))


@kernel
def multiply_spectra(matrices: np.ndarray, columns: np.ndarray, spectrum: np.ndarray) -> np.ndarray:
    """Return the product of a real matrix and a complex vector at every wave number.

    Parameters
    ----------
    matrices : ndarray, shape (m, k, n)
        Transposed.
    columns : ndarray of int, shape (c,)
        Entries of the vectors that are not zero.
    spectrum : ndarray, shape (m, 2 k)
        Vectors, real and imaginary parts in turn.

    Returns
    -------
    ndarray, shape (m, 2, n)
        Real and imaginary parts.
    """
    count, _, n = matrices.shape
    result = np.zeros((count, 2, n), dtype=spectrum.dtype)
    for f in range(count):
        real, imaginary = result[f, 0], result[f, 1]
        for k in columns:
            a, b, part = spectrum[f, 2 * k], spectrum[f, 2 * k + 1], matrices[f, k]
            for i in range(n):
                real[i] += a * part[i]
                imaginary[i] += b * part[i]
    return result


class GradedConvolution:
    """Displacement of a grid of cells, uniform along y, under any cell pressures.

    u_jn = sum over im of C_|j-i|nm p_im; along y by zero-padded FFT, along x by a matrix at every
    wave number. Columns of cells without any pressure cost nothing.

    Parameters
    ----------
    coefficients : ndarray, shape (ny, nx, nx)
        C, e.g. from `graded_coefficients`.
    single
        Half the bytes for six digits: float32, for preconditioners.
    """

    __slots__ = ("_length", "_matrices", "shape")

    def __init__(self, coefficients: Array, *, single: bool = False) -> None:
        ny, nx, _ = coefficients.shape
        self.shape = (ny, nx)
        length = self._length = next_fast_len(2 * ny - 1, real=True)
        even = np.zeros((length, nx, nx))
        even[:ny] = coefficients.transpose(0, 2, 1)
        if ny > 1:
            even[1 - ny :] = even[ny - 1 : 0 : -1]
        real = np.float32 if single else np.float64
        self._matrices = np.ascontiguousarray(rfft(even, axis=0).real, dtype=real)

    def __call__(self, pressure: Array) -> Array:
        """Return the displacement, shape (ny, nx), in units of coefficient times pressure."""
        if pressure.shape != self.shape:
            raise ParameterError(
                f"pressure must have shape {self.shape}, got {pressure.shape}. Give it per cell."
            )
        ny, _ = self.shape
        real = self._matrices.dtype
        columns = np.flatnonzero(pressure.any(axis=0))
        spectrum = rfft(pressure.astype(real, copy=False), n=self._length, axis=0)
        parts = multiply_spectra(self._matrices, columns, np.ascontiguousarray(spectrum).view(real))
        product = parts[:, 0] + 1j * parts[:, 1]
        return np.asarray(irfft(product, n=self._length, axis=0)[:ny])
