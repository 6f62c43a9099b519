"""Flow factors of a sheared film on a grid, and their slopes: kernels."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.factor_slopes import factor_slopes
from gearlube_core.oil.shear_flow import shear_factors
from gearlube_core.oil.shear_law import rate_ratio

# below, series to the second order are right to 1e-8
_SMALL_STRESS = 1.0e-2


class ShearUnits(NamedTuple):
    """Stresses over tau0 per unit of the fields, sliding, and the limiting stress."""

    couette: np.ndarray  # of sliding, times film and fluidity, of every row, shape (ny,) [-]
    # stress drop over half the film, over film and difference of pressure between the nodes on
    # both sides [-]; along x of every column, shape (nx,)
    sigma_x: np.ndarray
    sigma_y: float
    cosine: float  # of the angle from x to sliding
    sine: float
    limit: float  # limiting stress at ambient pressure [-]
    limit_slope: float  # its slope with pressure [-]; both 0: none


class _Stresses(NamedTuple):
    """Stresses at a node over tau0 [-]."""

    s: float  # drop over half the film along sliding
    r: float  # and across it
    a: float  # of sliding
    most: float  # limiting
    small: bool  # all of them


@kernel
def _stresses(
    pressure: np.ndarray, h: float, fluidity: float, units: ShearUnits, j: int, i: int
) -> _Stresses:
    x = units.sigma_x[i] * h * (pressure[j, i + 1] - pressure[j, i - 1])
    y = units.sigma_y * h * (pressure[j + 1, i] - pressure[j - 1, i])
    s, r = units.cosine * x + units.sine * y, units.cosine * y - units.sine * x
    a, most = units.couette[j] / (h * fluidity), math.inf
    if units.limit + units.limit_slope > 0.0:
        most = units.limit + units.limit_slope * max(pressure[j, i], 0.0)
    return _Stresses(s, r, a, most, max(abs(s), abs(r), abs(a)) < min(_SMALL_STRESS, most))


@kernel
def fill_shear_factors(
    law: Any,
    pressure: np.ndarray,
    film: np.ndarray,
    fluidity: np.ndarray,
    units: ShearUnits,
    along: np.ndarray,
    across: np.ndarray,
) -> None:
    """Fill the flow factors of a shear-thinning film, by rows of other sliding in one direction.

    Parameters
    ----------
    law
        Shear law.
    pressure, film, fluidity : ndarray, shape (ny, nx)
        p, h and 1/eta [-].
    units
        Stresses and sliding.
    along, across : ndarray, shape (ny, nx)
        Result: flow along and across sliding over its Newtonian value [-]; 1 on the border.

    Notes
    -----
    Pressure slopes are central. Small stresses: flow along grows by Sigma^2/10 + a^2/2, across
    by Sigma^2/10 + a^2/6, both times 6 dG/dq: the first terms of the series of `shear_flow`. A
    film that slips at the limiting stress has the flow of one that is sheared just so far.
    """
    ny, nx = pressure.shape
    # of the series G = 1 + g q/6: Eyring's g is 1
    g = 6.0 * rate_ratio(law, 0.0)[1]
    along[:] = 1.0
    across[:] = 1.0
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            h = film[j, i]
            if h <= 0.0:
                continue
            s, r, a, most, small = _stresses(pressure, h, fluidity[j, i], units, j, i)
            if small:
                pumped = 0.1 * g * (s * s + r * r)
                along[j, i] = 1.0 + pumped + 0.5 * g * a * a
                across[j, i] = 1.0 + pumped + g * a * a / 6.0
                continue
            along[j, i], across[j, i] = shear_factors(law, s, r, a, most)


@kernel
def fill_factor_slopes(
    law: Any,
    pressure: np.ndarray,
    film: np.ndarray,
    fluidity: np.ndarray,
    thickening: np.ndarray,
    units: ShearUnits,
    along: np.ndarray,
    across: np.ndarray,
) -> None:
    """Fill the derivatives of the flow factors of `fill_shear_factors`.

    Parameters
    ----------
    law, pressure, film, fluidity, units
        As in `fill_shear_factors`.
    thickening : ndarray, shape (ny, nx)
        d ln(eta)/dp [-].
    along, across : ndarray, shape (4, ny, nx)
        Result: derivatives of either factor by the pressure of the node, by ln(h), by the rise of
        pressure from the west to the east neighbour and by that from the south to the north one
        [-]; 0 on the border.
    """
    ny, nx = pressure.shape
    g = 6.0 * rate_ratio(law, 0.0)[1]
    along[:] = 0.0
    across[:] = 0.0
    cosine, sine = units.cosine, units.sine
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            h = film[j, i]
            if h <= 0.0:
                continue
            s, r, a, most, small = _stresses(pressure, h, fluidity[j, i], units, j, i)
            if small:
                along_s = across_s = 0.2 * g * s
                along_r = across_r = 0.2 * g * r
                along_a, across_a = g * a, g * a / 3.0
                along_limit = across_limit = 0.0
            else:
                f = factor_slopes(law, s, r, a, most)
                along_s, along_r, along_a, along_limit = (
                    f.along_s,
                    f.along_r,
                    f.along_a,
                    f.along_limit,
                )
                across_s, across_r = f.across_s, f.across_r
                across_a, across_limit = f.across_a, f.across_limit
            hardening = units.limit_slope if pressure[j, i] > 0.0 else 0.0
            thicker = a * thickening[j, i]
            x, y = units.sigma_x[i] * h, units.sigma_y * h
            along[0, j, i] = along_a * thicker + along_limit * hardening
            along[1, j, i] = along_s * s + along_r * r - along_a * a
            along[2, j, i] = (cosine * along_s - sine * along_r) * x
            along[3, j, i] = (sine * along_s + cosine * along_r) * y
            across[0, j, i] = across_a * thicker + across_limit * hardening
            across[1, j, i] = across_s * s + across_r * r - across_a * a
            across[2, j, i] = (cosine * across_s - sine * across_r) * x
            across[3, j, i] = (sine * across_s + cosine * across_r) * y
