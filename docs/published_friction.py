"""Published formulas of the mean friction of gears, for the pages that compare with them.

All take floats or arrays, and the composite roughness sigma [m].
"""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array

_XU = (-8.916465, 1.03303, 1.036077, -0.354068, 2.812084, -0.100601, 0.752755, -0.390958)


def roughness_ra(sigma: float) -> float:
    """Return Ra [um] of one of two like Gaussian surfaces."""
    return 1e6 * sigma / math.sqrt(2.0) / 1.25


def schlenk(line_load: Array, speed_radius: Array, viscosity: float, sigma: float) -> Array:
    """0.048 [(F/b)/(v_sum rho)]^0.2 eta^-0.05 Ra^0.25, N/mm, m/s, mm, mPa s, um; mineral oil.

    Schlenk 1995, in ISO/TR 14179-2.
    """
    return np.asarray(
        0.048 * (line_load / speed_radius) ** 0.2 * viscosity**-0.05 * roughness_ra(sigma) ** 0.25
    )


def xu_kahraman(
    pressure: Array, slide_roll: Array, speed: Array, viscosity: float, radius: Array, sigma: float
) -> Array:
    """exp(f) p^b2 SR^b3 u^b6 nu^b7 R^b8; GPa, -, m/s, mPa s, m, um.

    Xu and Kahraman 2007, fitted to thermal non-Newtonian films of a 75W-90 oil.
    """
    b, p, SR = _XU, pressure, slide_roll
    group = SR * p * math.log10(viscosity)
    f = b[0] + b[3] * group + b[4] * np.exp(-group) + 0.620305 * math.exp(1e6 * sigma)
    return np.asarray(
        np.exp(f) * p ** b[1] * SR ** b[2] * speed ** b[5] * viscosity ** b[6] * radius ** b[7]
    )
