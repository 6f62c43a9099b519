"""Flow along one axis that a slope of pressure along the other drives: residual and derivatives.

The flow through a face is the mean of the flows at the nodes on both sides.
"""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.ehl.point_stencil import (
    EAST,
    NORTH,
    NORTH_EAST,
    NORTH_WEST,
    SOUTH,
    SOUTH_EAST,
    SOUTH_WEST,
    WEST,
    FlowSlopes,
    StencilParameters,
)
from gearlube_core.jit import kernel


@kernel
def add_cross_flow(
    parameters: StencilParameters,
    pressure: np.ndarray,
    cubic_xy: np.ndarray,
    fluidity: np.ndarray,
    residual: np.ndarray,
) -> None:
    """Add Lambda [d/dx(F dp/dy) + d/dy(F dp/dx)], F = rho h^3/eta times the flow factor xy.

    Parameters
    ----------
    parameters
        Of the grid.
    pressure, cubic_xy, fluidity : ndarray, shape (ny, nx)
        p, zero on the border, F eta and 1/eta [1].
    residual : ndarray, shape (ny, nx)
        Of `reynolds_residual`; only inner nodes change.

    Notes
    -----
    Fluxes are differences between faces, so mass is balanced to rounding over any set of nodes.
    """
    ny, nx = pressure.shape
    unit = 0.25 * math.sqrt(parameters.poiseuille_x * parameters.poiseuille_y)
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            share = unit * cubic_xy[j, i] * fluidity[j, i]
            flow_x = share * (pressure[j + 1, i] - pressure[j - 1, i])
            flow_y = share * (pressure[j, i + 1] - pressure[j, i - 1])
            if i > 1:
                residual[j, i - 1] += flow_x
            if i < nx - 2:
                residual[j, i + 1] -= flow_x
            if j > 1:
                residual[j - 1, i] += flow_y
            if j < ny - 2:
                residual[j + 1, i] -= flow_y


@kernel
def add_cross_derivatives(
    parameters: StencilParameters,
    pressure: np.ndarray,
    cubic_xy: np.ndarray,
    fluidity: np.ndarray,
    viscosity_slope: np.ndarray,
    film: np.ndarray,
    slopes: FlowSlopes,
    free: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Add the derivatives of the cross flow with respect to pressure and film of all neighbours.

    Parameters
    ----------
    parameters, pressure, cubic_xy, fluidity
        As in `add_cross_flow`.
    viscosity_slope, film, slopes, free
        As in `reynolds_derivatives`.
    by_pressure, by_film : ndarray, shape (11, ny, nx)
        Result [1].
    """
    ny, nx = pressure.shape
    unit = 0.25 * math.sqrt(parameters.poiseuille_x * parameters.poiseuille_y)
    beside = (EAST, WEST, NORTH, SOUTH)
    down = (0, 0, 1, -1)
    right = (1, -1, 0, 0)
    plus = (NORTH_EAST, SOUTH_WEST, NORTH_EAST, SOUTH_WEST)
    minus = (SOUTH_EAST, NORTH_WEST, NORTH_WEST, SOUTH_EAST)
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if not free[j, i]:
                continue
            for k in range(4):
                jj, ii = j + down[k], i + right[k]
                if jj == 0 or ii == 0 or jj == ny - 1 or ii == nx - 1:
                    continue
                f = unit * fluidity[jj, ii]
                share = f * slopes.slope_xy[jj, ii]
                if right[k] != 0:
                    rise = pressure[jj + 1, ii] - pressure[jj - 1, ii]
                else:
                    rise = pressure[jj, ii + 1] - pressure[jj, ii - 1]
                flow = (right[k] + down[k]) * f * cubic_xy[jj, ii] * rise
                by_pressure[plus[k], j, i] += share
                by_pressure[minus[k], j, i] -= share
                by_pressure[beside[k], j, i] += flow * (
                    slopes.by_pressure[jj, ii] - viscosity_slope[jj, ii]
                )
                by_film[beside[k], j, i] += (
                    flow * slopes.film_power[jj, ii] / max(film[jj, ii], 1e-30)
                )
