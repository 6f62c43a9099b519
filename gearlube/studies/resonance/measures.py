"""Numbers that describe a periodic motion."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit


def mesh_harmonics(x: Array, periods: int, count: int) -> Array:
    """Return the amplitudes of mesh orders 1 to `count` [unit of x], shape (count,).

    Parameters
    ----------
    x : ndarray of shape (n,)
        Samples at equal angles over one period of the motion, `periods` mesh periods long.
    """
    amplitude = 2.0 * np.abs(np.fft.rfft(x)) / x.size
    return np.asarray(amplitude[periods * np.arange(1, count + 1)])


def rate_over_period(orbit: Orbit) -> Array:
    """Return x' [m/s] of a periodic motion, shape (samples,).

    Differentiated as a Fourier series; x has continuous second derivatives where the damping is
    gated and continuous first ones otherwise.
    """
    size = orbit.x.size
    span = size * (orbit.angle[1] - orbit.angle[0])
    order = np.fft.rfftfreq(size, 1.0 / size) * (2.0 * math.pi / span)
    spectrum = 1j * order * np.fft.rfft(orbit.x)
    if size % 2 == 0:
        spectrum[-1] = 0.0  # the sign of the highest order is not known from the samples
    return np.asarray(np.fft.irfft(spectrum, size) * orbit.pinion_speed)
