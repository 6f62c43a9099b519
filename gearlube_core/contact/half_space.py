"""Displacement of an elastic half-space under uniformly loaded cells, equal or graded."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive
from gearlube_core.contact.fftw import pyfftw
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel

_FAR = 8.0  # longer sides of a cell; there the closed mean and Gauss' rule agree to 1e-8
_MOST_CELLS = 4096  # along one side; 8192 x 8192 padded cells are 0.5 GiB


def _asinh_terms(x: Array, y: Array) -> tuple[Array, Array]:
    """Return asinh(y/|x|) and asinh(x/|y|) with zero where the divisor is zero.

    Their factors x or y vanish there, and so do the products' limits.
    """
    size_x, size_y = np.abs(x), np.abs(y)
    along_y = np.arcsinh(np.divide(y, size_x, out=np.zeros_like(y), where=size_x > 0.0))
    along_x = np.arcsinh(np.divide(x, size_y, out=np.zeros_like(x), where=size_y > 0.0))
    return along_y, along_x


def _love_integral(x: Array, y: Array) -> Array:
    """Return the double integral of 1/r from the origin to (x, y), odd in both arguments."""
    along_y, along_x = _asinh_terms(x, y)
    return x * along_y + y * along_x


def _averaged_integral(x: Array, y: Array) -> Array:
    """Return the fourfold integral of 1/r, twice along x and twice along y."""
    along_y, along_x = _asinh_terms(x, y)
    cubic = (x * x + y * y) ** 1.5 / 6.0
    return 0.5 * x * y * (x * along_y + y * along_x) - cubic


def _centre_integral(x: Array, y: Array, dx: float, dy: float) -> Array:
    """Return the integral of 1/r over the cell, seen from (x, y)."""
    right, left, upper, lower = x + 0.5 * dx, x - 0.5 * dx, y + 0.5 * dy, y - 0.5 * dy
    return (
        _love_integral(right, upper)
        - _love_integral(left, upper)
        - _love_integral(right, lower)
        + _love_integral(left, lower)
    )


def _mean_integral(x: Array, y: Array, dx: float, dy: float) -> Array:
    """Return the mean of `_centre_integral` over a cell around (x, y), in closed form."""
    total = np.zeros_like(x)
    for i, weight_x in zip((-1.0, 0.0, 1.0), (1.0, -2.0, 1.0), strict=True):
        for j, weight_y in zip((-1.0, 0.0, 1.0), (1.0, -2.0, 1.0), strict=True):
            total += weight_x * weight_y * _averaged_integral(x + i * dx, y + j * dy)
    return total / (dx * dy)


def _gauss_mean(x: Array, y: Array, dx: float, dy: float) -> Array:
    """Return the mean of `_centre_integral` over a cell around (x, y), by Gauss' rule."""
    points, weights = np.polynomial.legendre.leggauss(3)
    total = np.zeros_like(x)
    for xi, weight_x in zip(0.5 * points, 0.5 * weights, strict=True):
        for eta, weight_y in zip(0.5 * points, 0.5 * weights, strict=True):
            total += weight_x * weight_y * _centre_integral(x + xi * dx, y + eta * dy, dx, dy)
    return total


def love_coefficients(
    dx: float, dy: float, nx: int, ny: int, contact_modulus: float, observed: str = "centre"
) -> Array:
    """Return the normal displacement per unit cell force for all offsets of a uniform grid.

    u(x, y) = 1/(pi E*) F/(dx dy) [I(x+a, y+b) - I(x-a, y+b) - I(x+a, y-b) + I(x-a, y-b)],
    I(x, y) = x asinh(y/|x|) + y asinh(x/|y|),  a = dx/2,  b = dy/2

    Parameters
    ----------
    dx, dy
        Sides of a cell [m], each with constant pressure F/(dx dy).
    nx, ny
        Number of offsets along x and y, zero included.
    contact_modulus
        E* of the pair of bodies [Pa]: the coefficients are the sum over both.
    observed
        `centre`: displacement in the centre of a cell; `mean`: its mean over the cell, the
        Galerkin form with second differences of x y I/2 - r^3/6 in place of the differences of I.

    Returns
    -------
    ndarray, shape (nx, ny)
        Coefficient [m/N] at offset (i dx, j dy), even in both offsets.

    Raises
    ------
    ParameterError
        A size or the modulus is not positive, or the option is unknown.

    Notes
    -----
    Frictionless half-space: exact for the uniform rectangle, as a model of a tooth valid where
    the loaded strip is small against its distance from edges and its radii. `mean` halves the
    error of the approach or better and is positive definite by construction, for a fifth more
    iterations of a contact solution; its gaps are cell means too. Both keep nine digits up to
    256 cells of aspect ratio 17.
    Source: [love_1929]; [johnson_1985 (3.25)] in the asinh form; [jamali_2015 (3.3)].
    """
    check_positive("dx", dx, "m")
    check_positive("dy", dy, "m")
    check_positive("contact_modulus", contact_modulus, "Pa")
    check_option("observed", observed, ("centre", "mean"))
    for name, count in (("nx", nx), ("ny", ny)):
        if not 1 <= count <= _MOST_CELLS:
            raise ParameterError(
                f"{name} must be within 1 to {_MOST_CELLS}, got {count}. Use larger cells."
            )
    x, y = np.meshgrid(np.arange(nx) * dx, np.arange(ny) * dy, indexing="ij")
    if observed == "centre":
        integral = _centre_integral(x, y, dx, dy)
    else:
        far = np.hypot(x, y) > _FAR * max(dx, dy)
        integral = np.where(far, _gauss_mean(x, y, dx, dy), _mean_integral(x, y, dx, dy))
    return np.asarray(integral / (math.pi * contact_modulus * dx * dy))


class HalfSpaceConvolution:
    """Displacement of a uniform grid of cells under any cell forces, by zero-padded FFT.

    u_ij = sum over kl of C_|i-k||j-l| f_kl

    The object owns its plans and buffers and makes no threads. Different objects may run in
    different threads at the same time; one object serves one thread at a time. Plans are
    estimated, not timed, so that equal input gives equal bits.

    Parameters
    ----------
    coefficients : ndarray, shape (nx, ny)
        C [m/N] at all offsets of the grid, e.g. from `love_coefficients`.
    single
        Half the bytes and half the time, for six digits: float32, for preconditioners.

    Raises
    ------
    ParameterError
        The coefficients are not a finite two-dimensional array.

    Examples
    --------
    >>> cells = HalfSpaceConvolution(love_coefficients(1e-4, 1e-4, 3, 2, 1.154e11))
    >>> forces = np.zeros((3, 2))
    >>> forces[0, 0] = 1.0
    >>> displacement = cells(forces)
    >>> bool(np.allclose(displacement, love_coefficients(1e-4, 1e-4, 3, 2, 1.154e11), rtol=1e-12))
    True
    """

    __slots__ = (
        "_padded",
        "_padding",
        "_parts",
        "_plans",
        "_result",
        "_transfer",
        "shape",
    )

    # the sum [jamali_2015 (3.6)] by fast Fourier transform, padded against wrap-around
    def __init__(self, coefficients: Array, *, single: bool = False) -> None:
        coefficients = np.asarray(coefficients, dtype=np.float64)
        if coefficients.ndim != 2 or coefficients.size == 0 or not np.isfinite(coefficients).all():
            raise ParameterError(
                "coefficients must be a finite array of shape (nx, ny), got shape "
                f"{coefficients.shape}. Take them from love_coefficients."
            )
        nx, ny = self.shape = (coefficients.shape[0], coefficients.shape[1])
        padded = tuple(pyfftw.next_fast_len(2 * n - 1) for n in self.shape)
        real, paired = ("float32", "complex64") if single else ("float64", "complex128")
        spectrum = pyfftw.empty_aligned((padded[0], padded[1] // 2 + 1), dtype=paired)
        self._parts = spectrum.view(real)
        self._padding = self._parts[nx:]
        options: dict[str, Any] = {"flags": ("FFTW_ESTIMATE",), "threads": 1}
        back = {"direction": "FFTW_BACKWARD", **options}
        # rows of padding stay zero along y, and their result is not wanted
        self._padded = pyfftw.zeros_aligned((nx, padded[1]), dtype=real)
        self._result = pyfftw.empty_aligned((nx, padded[1]), dtype=real)
        self._plans = (
            pyfftw.FFTW(self._padded, spectrum[:nx], axes=(1,), **options),
            pyfftw.FFTW(spectrum, spectrum, axes=(0,), **options),
            pyfftw.FFTW(spectrum, spectrum, axes=(0,), **back),
            pyfftw.FFTW(spectrum[:nx], self._result, axes=(1,), **back),
        )
        # even coefficients have a real spectrum, written twice to scale real and imaginary parts;
        # FFTW leaves out the division by the size
        even = np.zeros(padded)
        even[:nx, :ny] = coefficients
        even[padded[0] - nx + 1 :, :ny] = coefficients[:0:-1]
        even[:, padded[1] - ny + 1 :] = even[:, ny - 1 : 0 : -1]
        transfer = np.repeat(np.fft.rfft2(even).real / even.size, 2, axis=1)
        self._transfer = transfer.astype(real)

    def __call__(self, forces: Array) -> Array:
        """Return the displacement [m], shape (nx, ny), under cell forces [N], shape (nx, ny).

        The result is a view of a buffer that the next call overwrites.
        """
        ny = self.shape[1]
        self._padded[:, :ny] = forces
        self._padding[:] = 0.0
        rows, columns, columns_back, rows_back = self._plans
        rows.execute()
        columns.execute()
        np.multiply(self._parts, self._transfer, out=self._parts)
        columns_back.execute()
        rows_back.execute()
        return np.asarray(self._result[:, :ny])


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
        Matrices of each wave number, transposed.
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
