"""Deflection of two half-spaces under a line pressure: exact coefficients, applied by FFT."""

from __future__ import annotations

import math

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

# from here on the series of the hat's moments is exact to 1e-13
_FAR = 10


def hat_coefficients(step: float, count: int) -> np.ndarray:
    """Return the integral of ln abs(x) over a unit hat, at multiples of the spacing.

    G_d = integral of (1 - abs(s)/D) ln abs(d D - s) ds over abs(s) < D

    Parameters
    ----------
    step : float
        Half width of the hat and node spacing D [any length].
    count : int
        How many d = 0, 1, ... [-].

    Returns
    -------
    numpy.ndarray
        (count,), of the unit of `step`, with lengths inside the logarithm in that unit.

    Notes
    -----
    Closed form by the second antiderivative x^2/2 ln x - 3 x^2/4 nearby, moments of the hat far
    away, where the closed form would lose digits.
    """
    d = np.arange(count, dtype=float)
    far = np.maximum(d, 1.0) ** -2
    G = np.log(np.maximum(d, 1.0)) - far * (
        1.0 / 12.0 + far * (1.0 / 60.0 + far * (1.0 / 168.0 + far * (1.0 / 360.0 + far / 660.0)))
    )
    near = np.arange(-1.0, min(count, _FAR) + 1.0)
    square = near * near
    second = square * (0.5 * np.log(np.where(near == 0.0, 1.0, abs(near))) - 0.75)
    G[:_FAR] = (second[2:] - 2.0 * second[1:-1] + second[:-2])[: min(count, _FAR)]
    return step * (G + math.log(step))


class LineDeflection:
    """Deflection on a uniform grid, H = -(1/pi) sum G P; dimensionless as in `line_scaling`.

    Parameters
    ----------
    step : float
        Node spacing over the Hertz half width [-].
    count : int
        Nodes.

    Notes
    -----
    Pressure is linear between nodes and zero outside the grid. Exact linear convolution: the
    transform is padded to 2 count - 1 at least.
    """

    def __init__(self, step: float, count: int) -> None:
        self.influence = -hat_coefficients(step, count) / math.pi
        self._length = next_fast_len(2 * count - 1, real=True)
        kernel = np.zeros(self._length)
        kernel[:count] = self.influence
        kernel[-count + 1 :] = self.influence[:0:-1]
        self._transform = rfft(kernel)
        self._count = count

    def __call__(self, P: np.ndarray) -> np.ndarray:
        """Return the deflection [-] under nodal pressures (count,) [-]."""
        spectrum = rfft(P, self._length) * self._transform
        return irfft(spectrum, self._length)[: self._count]
