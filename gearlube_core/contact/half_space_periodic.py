"""Normal displacement of a half-space under pressure that is periodic in y and ends in x."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.fft import next_fast_len
from scipy.special import iti0k0, zeta

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive
from gearlube_core.contact.fftw import pyfftw
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.row_workers import ALONE, RowWorkers

_ROWS, _COLUMNS = 32, 64  # of a block; results have the roundings of their blocks


class _BlockedTransform:
    """Real array to the waves along its rows and its columns, times a transfer, and back.

    Columns are transformed, multiplied and transformed back block by block, so that large arrays
    pass the memory three times instead of six. Blocks are the same for any number of threads.

    Parameters
    ----------
    padded, result
        Input and output, (rows, length), aligned, which this keeps.
    transfer : ndarray, shape (rows, length//2 + 1)
        Real, with the factor 1/(rows length).
    workers
        Threads that share the blocks.
    """

    def __init__(self, padded: Any, result: Any, transfer: Array, workers: RowWorkers) -> None:
        rows, waves = transfer.shape
        paired: Any = np.result_type(padded.dtype, np.complex64)
        spectrum = pyfftw.empty_aligned((rows, waves), dtype=paired)
        options: dict[str, Any] = {"flags": ("FFTW_ESTIMATE",), "threads": 1}
        back: dict[str, Any] = {"direction": "FFTW_BACKWARD", **options}
        self._workers = workers
        self._rows, self._columns, self._returns = [], [], []
        for first in range(0, rows, _ROWS):
            part = slice(first, first + _ROWS)
            self._rows.append(pyfftw.FFTW(padded[part], spectrum[part], axes=(1,), **options))
            self._returns.append(pyfftw.FFTW(spectrum[part], result[part], axes=(1,), **back))
        for first in range(0, waves, _COLUMNS):
            block = spectrum[:, first : first + _COLUMNS]
            turned = pyfftw.empty_aligned(block.shape[::-1], dtype=paired)
            factor = np.repeat(transfer[:, first : first + _COLUMNS].T, 2, axis=1)
            self._columns.append(
                (
                    pyfftw.FFTW(block, turned.T, axes=(0,), **options),
                    turned.view(padded.dtype),
                    factor.astype(padded.dtype),
                    pyfftw.FFTW(turned.T, block, axes=(0,), **back),
                )
            )

    def execute(self) -> None:
        """Transform, multiply and transform back; the input is destroyed nowhere."""
        share = self._workers.share
        share(lambda part: [one.execute() for one in self._rows[slice(*part)]], len(self._rows))
        share(self._multiply, len(self._columns))
        share(lambda part: [one.execute() for one in self._returns[slice(*part)]], len(self._rows))

    def _multiply(self, part: tuple[int, int]) -> None:
        for forward, values, factor, backward in self._columns[slice(*part)]:
            forward.execute()
            np.multiply(values, factor, out=values)
            backward.execute()


_REACH = 38.0  # K0 has fallen to e^-38 there
_MOST_CELLS = 8192  # along one side
_CACHE = 1_000_000  # bytes, from which on a transform goes in blocks


def _k0_tail(z: Array) -> Array:
    """Return the integral of K0 from z to infinity."""
    return np.asarray(0.5 * math.pi - iti0k0(z)[1])


def _line_row(x: Array, dx: float, reference: float) -> Array:
    """Return the integral of -ln(|x|/reference) over cells around x, shape (nx,)."""

    def antiderivative(edge: Array) -> Array:
        return edge * (np.log(np.abs(edge) / reference) - 1.0)

    return antiderivative(x - 0.5 * dx) - antiderivative(x + 0.5 * dx)


def periodic_modes(
    dx: float, dy: float, nx: int, ny: int, contact_modulus: float, reference: float
) -> Array:
    """Return the displacement of every wave along y, over the distance along x.

    u_m(x) = 2/(pi E*) sum over n of sin(k dy/2)/(k dy/2) int K0(|k x|) dx over a cell,
    k = 2 pi (m + n ny)/(ny dy);  u_0(x) = -2/(pi E*) int ln(|x|/reference) dx

    Parameters
    ----------
    dx, dy
        Sides of a cell with constant pressure [m].
    nx, ny
        Number of offsets along x, zero included, and of cells in a period.
    contact_modulus
        E* of the pair of bodies [Pa], half of E'.
    reference
        Distance [m] at which a line load leaves the surface where it was. A half-space under a
        line has no displacement of its own: only differences of the approach mean anything.

    Returns
    -------
    ndarray, shape (nx, ny//2 + 1)
        Displacement per pressure of wave m at the centre of the cell i dx away [m/Pa].

    Raises
    ------
    ParameterError
        A size or the modulus is not positive.

    Notes
    -----
    Exact for cells of constant pressure, to ten digits: the waves that a row of cells holds
    beside the one sampled (n not 0) are summed until they vanish, over the loaded cell itself in
    closed form. Source: Fourier transform of 1/r along y, 2 K0(|k x|).
    """
    for name, value, unit in (
        ("dx", dx, "m"),
        ("dy", dy, "m"),
        ("contact_modulus", contact_modulus, "Pa"),
        ("reference", reference, "m"),
    ):
        check_positive(name, value, unit)
    for name, count in (("nx", nx), ("ny", ny)):
        if not 1 <= count <= _MOST_CELLS:
            raise ParameterError(
                f"{name} must be within 1 to {_MOST_CELLS}, got {count}. Use larger cells."
            )
    x: Array = np.arange(nx, dtype=np.float64) * dx
    modes = np.zeros((nx, ny // 2 + 1))
    modes[:, 0] = _line_row(x, dx, reference)
    mu = np.arange(1, ny // 2 + 1) / ny  # waves a cell
    # pi/|k| times the mean over a cell: sum of (-1)^n/(n + a)^2 from zero on, a = mu and 1 - mu
    alternating = sum(
        0.25 * (zeta(2.0, 0.5 * a) - zeta(2.0, 0.5 * (a + 1.0))) for a in (mu, 1.0 - mu)
    )
    modes[0, 1:] = 0.5 * dy * np.sin(math.pi * mu) / math.pi * alternating
    furthest = math.ceil(_REACH * dy / (math.pi * dx)) + 1
    for n in range(-furthest, furthest + 1):
        k = 2.0 * math.pi / dy * (mu + n)
        share = np.sinc(mu + n) / np.abs(k)
        reached = int(min(nx, _REACH / (np.abs(k).min() * dx) + 2.0))
        edges = (np.arange(reached) + 0.5) * dx
        tail = _k0_tail(np.abs(k) * edges[:, None])
        modes[0, 1:] -= 2.0 * share * tail[0]
        modes[1:reached, 1:] += share * (tail[:-1] - tail[1:])
    return np.asarray(2.0 / (math.pi * contact_modulus) * modes)


def periodic_coefficients(modes: Array, ny: int) -> Array:
    """Return the displacement per pressure on one row of cells and its repetitions.

    Parameters
    ----------
    modes : ndarray, shape (nx, ny//2 + 1)
        From `periodic_modes`.
    ny
        Number of cells in a period.

    Returns
    -------
    ndarray, shape (ny, nx)
        At the centre of the cell j dy and i dx away [m/Pa]; row ny - j equals row j.
    """
    return np.ascontiguousarray(np.fft.irfft(modes, n=ny, axis=1).T)


class PeriodicDeflection:
    """Displacement of a uniform grid of cells, periodic along one axis, by FFT.

    Zero-padded along x, where pressure ends, and not padded along y. The object owns its plans
    and buffers, as `HalfSpaceConvolution` does.

    Parameters
    ----------
    modes : ndarray, shape (nx, ny//2 + 1)
        From `periodic_modes`.
    ny
        Number of cells in a period.
    periodic_axis
        `last`: pressure has shape (nx, ny); `first`: (ny, nx).
    single
        Half the bytes and half the time, for six digits: float32, for preconditioners.
    workers
        Threads that share large grids of the second shape; results do not depend on it.

    Raises
    ------
    ParameterError
        The modes are not finite, their number does not belong to `ny`, or an unknown option.
    """

    __slots__ = ("_blocks", "_padded", "_result", "_whole", "shape")

    def __init__(
        self,
        modes: Array,
        ny: int,
        periodic_axis: str = "last",
        *,
        single: bool = False,
        workers: RowWorkers = ALONE,
    ) -> None:
        check_option("periodic_axis", periodic_axis, ("last", "first"))
        modes = np.asarray(modes, dtype=np.float64)
        if modes.ndim != 2 or modes.shape[1] != ny // 2 + 1 or not np.isfinite(modes).all():
            raise ParameterError(
                f"modes must be finite, of shape (nx, {ny // 2 + 1}) for ny = {ny}, got shape "
                f"{modes.shape}. Take them from periodic_modes."
            )
        nx = modes.shape[0]
        # even, of factors 2, 3 and 5: three times as fast as 1617 = 3 7 7 11, say
        length = 2 * next_fast_len(nx, real=True)
        row = np.zeros((length, modes.shape[1]))
        row[:nx] = modes
        row[length - nx + 1 :] = modes[:0:-1]
        transfer = np.fft.fft(row, axis=0).real / (length * ny)  # of even rows
        last = periodic_axis == "last"
        if not last:
            wave = np.arange(ny)
            transfer = transfer[: length // 2 + 1, np.minimum(wave, ny - wave)].T
        self.shape = (nx, ny) if last else (ny, nx)
        padded = (length, ny) if last else (ny, length)
        options: dict[str, Any] = {"axes": (0, 1), "flags": ("FFTW_ESTIMATE",), "threads": 1}
        real, paired = ("float32", "complex64") if single else ("float64", "complex128")
        self._padded = pyfftw.zeros_aligned(padded, dtype=real)
        self._result = pyfftw.empty_aligned(padded, dtype=real)
        self._whole = self._blocks = None
        if not last and self._padded.nbytes > _CACHE:
            self._blocks = _BlockedTransform(self._padded, self._result, transfer, workers)
            return
        spectrum = pyfftw.empty_aligned(transfer.shape, dtype=paired)
        self._whole = (
            pyfftw.FFTW(self._padded, spectrum, **options),
            spectrum.view(real),
            np.repeat(transfer, 2, axis=1).astype(real),
            pyfftw.FFTW(spectrum, self._result, direction="FFTW_BACKWARD", **options),
        )

    def __call__(self, pressure: Array) -> Array:
        """Return the displacement [m] under cell pressures [Pa], of their shape.

        The result is a view of a buffer that the next call overwrites.
        """
        first, second = self.shape
        self._padded[:first, :second] = pressure
        if self._blocks is not None:
            self._blocks.execute()
        elif self._whole is not None:
            forward, values, factor, backward = self._whole
            forward.execute()
            np.multiply(values, factor, out=values)
            backward.execute()
        return np.asarray(self._result[:first, :second])
