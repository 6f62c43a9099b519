"""Reynolds equation of a point contact on a uniform grid: residual and derivatives, kernels.

Arrays have shape (ny, nx): x, the direction of the larger entrainment, runs along memory. All
quantities are those of `PointScales`; entrainment points to larger x and y.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.jit import kernel

# coefficients of a node and its neighbours, in this order
CENTRE, WEST, EAST, FAR_WEST, SOUTH, NORTH, FAR_SOUTH = range(7)
NEIGHBOURS = 7


class StencilParameters(NamedTuple):
    """Constants of the discrete equation; all floats."""

    poiseuille_x: float  # Lambda/dx^2 [1]
    poiseuille_y: float  # Lambda/dy^2 [1]
    wedge_x: float  # u/(u_s dx) [1]
    wedge_y: float  # v/(u_s dy) [1]
    here: float  # weight of rho h upstream of a face [1]
    upstream: float  # weight of rho h one node further upstream [1]
    downstream: float  # weight of rho h downstream of a face [1]
    squeeze: float  # factor of rho h at this time [1]


@kernel
def face_weights(parameters: StencilParameters, index: int) -> tuple[float, float, float]:
    """Return weights (node, upstream, downstream) of the face after node `index`.

    Behind the first node no second node upstream exists: the mean, second order as well.
    """
    if index == 0 and parameters.upstream != 0.0:
        return 0.5, 0.0, 0.5
    return parameters.here, parameters.upstream, parameters.downstream


@kernel
def reynolds_residual(
    parameters: StencilParameters,
    pressure: np.ndarray,
    mass: np.ndarray,
    mobility_x: np.ndarray,
    mobility_y: np.ndarray,
    source: np.ndarray,
    residual: np.ndarray,
) -> None:
    """Write the residual of all inner nodes.

    R = Lambda [d/dx(eps_x dp/dx) + d/dy(eps_y dp/dy)] - d(u rho h)/dx - d(v rho h)/dy
        - squeeze rho h + source

    Parameters
    ----------
    parameters
        Of the grid.
    pressure, mass, mobility_x, mobility_y, source : ndarray, shape (ny, nx)
        p, rho h, eps = rho h^3/eta times the flow factor of its direction, and what the squeeze
        term takes from earlier times [1].
    residual : ndarray, shape (ny, nx)
        Result; zero on the border [1].

    Notes
    -----
    Fluxes are differences between faces, so mass is balanced to rounding over any set of nodes.
    """
    ny, nx = pressure.shape
    residual[0, :] = 0.0
    residual[ny - 1, :] = 0.0
    px, py = 0.5 * parameters.poiseuille_x, 0.5 * parameters.poiseuille_y
    for j in range(1, ny - 1):
        residual[j, 0] = 0.0
        residual[j, nx - 1] = 0.0
        s0, s1, s2 = face_weights(parameters, j - 1)
        n0, n1, n2 = face_weights(parameters, j)
        jj = max(j - 2, 0)
        for i in range(1, nx - 1):
            w0, w1, w2 = face_weights(parameters, i - 1)
            e0, e1, e2 = face_weights(parameters, i)
            ii = max(i - 2, 0)
            p = pressure[j, i]
            ex, ey = mobility_x[j, i], mobility_y[j, i]
            r = px * (
                (ex + mobility_x[j, i + 1]) * (pressure[j, i + 1] - p)
                + (ex + mobility_x[j, i - 1]) * (pressure[j, i - 1] - p)
            )
            r += py * (
                (ey + mobility_y[j + 1, i]) * (pressure[j + 1, i] - p)
                + (ey + mobility_y[j - 1, i]) * (pressure[j - 1, i] - p)
            )
            m = mass[j, i]
            r -= parameters.wedge_x * (
                (e0 - w2) * m + (e1 - w0) * mass[j, i - 1] - w1 * mass[j, ii] + e2 * mass[j, i + 1]
            )
            if parameters.wedge_y != 0.0:
                r -= parameters.wedge_y * (
                    (n0 - s2) * m
                    + (n1 - s0) * mass[j - 1, i]
                    - s1 * mass[jj, i]
                    + n2 * mass[j + 1, i]
                )
            residual[j, i] = r - parameters.squeeze * m + source[j, i]


@kernel
def reynolds_derivatives(
    parameters: StencilParameters,
    pressure: np.ndarray,
    mobility_x: np.ndarray,
    mobility_y: np.ndarray,
    mobility_slope_p: np.ndarray,
    mobility_slope_h: np.ndarray,
    mass_slope_p: np.ndarray,
    mass_slope_h: np.ndarray,
    free: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Write the derivatives of the residual with respect to pressure and film of each neighbour.

    Parameters
    ----------
    parameters, pressure, mobility_x, mobility_y
        As in `reynolds_residual`.
    mobility_slope_p, mobility_slope_h : ndarray, shape (ny, nx)
        d ln eps/dp and d ln eps/dh [1].
    mass_slope_p, mass_slope_h : ndarray, shape (ny, nx)
        d(rho h)/dp and d(rho h)/dh [1].
    free : ndarray of bool, shape (ny, nx)
        Nodes whose equation is solved; rows of the others become zero.
    by_pressure, by_film : ndarray, shape (7, ny, nx)
        Result [1]; flow factors are held.
    """
    ny, nx = pressure.shape
    by_pressure[:] = 0.0
    by_film[:] = 0.0
    px, py = 0.5 * parameters.poiseuille_x, 0.5 * parameters.poiseuille_y
    for j in range(1, ny - 1):
        s0, s1, s2 = face_weights(parameters, j - 1)
        n0, n1, n2 = face_weights(parameters, j)
        for i in range(1, nx - 1):
            if not free[j, i]:
                continue
            w0, w1, w2 = face_weights(parameters, i - 1)
            e0, e1, e2 = face_weights(parameters, i)
            p = pressure[j, i]
            ex, ey = mobility_x[j, i], mobility_y[j, i]
            east, west = pressure[j, i + 1] - p, pressure[j, i - 1] - p
            north, south = pressure[j + 1, i] - p, pressure[j - 1, i] - p
            ce, cw = px * (ex + mobility_x[j, i + 1]), px * (ex + mobility_x[j, i - 1])
            cn, cs = py * (ey + mobility_y[j + 1, i]), py * (ey + mobility_y[j - 1, i])
            here = px * ex * (east + west) + py * ey * (north + south)
            me, mw = px * mobility_x[j, i + 1] * east, px * mobility_x[j, i - 1] * west
            mn, ms = py * mobility_y[j + 1, i] * north, py * mobility_y[j - 1, i] * south
            ux, uy = parameters.wedge_x, parameters.wedge_y
            centre = -ux * (e0 - w2) - uy * (n0 - s2) - parameters.squeeze
            by_pressure[CENTRE, j, i] = (
                -(ce + cw + cn + cs)
                + here * mobility_slope_p[j, i]
                + centre * mass_slope_p[j, i]
            )
            by_film[CENTRE, j, i] = (
                here * mobility_slope_h[j, i] + centre * mass_slope_h[j, i]
            )
            by_pressure[WEST, j, i] = (
                cw
                + mw * mobility_slope_p[j, i - 1]
                - ux * (e1 - w0) * mass_slope_p[j, i - 1]
            )
            by_film[WEST, j, i] = (
                mw * mobility_slope_h[j, i - 1] - ux * (e1 - w0) * mass_slope_h[j, i - 1]
            )
            by_pressure[EAST, j, i] = (
                ce + me * mobility_slope_p[j, i + 1] - ux * e2 * mass_slope_p[j, i + 1]
            )
            by_film[EAST, j, i] = (
                me * mobility_slope_h[j, i + 1] - ux * e2 * mass_slope_h[j, i + 1]
            )
            by_pressure[SOUTH, j, i] = (
                cs
                + ms * mobility_slope_p[j - 1, i]
                - uy * (n1 - s0) * mass_slope_p[j - 1, i]
            )
            by_film[SOUTH, j, i] = (
                ms * mobility_slope_h[j - 1, i] - uy * (n1 - s0) * mass_slope_h[j - 1, i]
            )
            by_pressure[NORTH, j, i] = (
                cn + mn * mobility_slope_p[j + 1, i] - uy * n2 * mass_slope_p[j + 1, i]
            )
            by_film[NORTH, j, i] = (
                mn * mobility_slope_h[j + 1, i] - uy * n2 * mass_slope_h[j + 1, i]
            )
            if i > 1:
                by_pressure[FAR_WEST, j, i] = ux * w1 * mass_slope_p[j, i - 2]
                by_film[FAR_WEST, j, i] = ux * w1 * mass_slope_h[j, i - 2]
            if j > 1:
                by_pressure[FAR_SOUTH, j, i] = uy * s1 * mass_slope_p[j - 2, i]
                by_film[FAR_SOUTH, j, i] = uy * s1 * mass_slope_h[j - 2, i]


@kernel
def apply_derivatives(
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    pressure: np.ndarray,
    film: np.ndarray,
    result: np.ndarray,
) -> None:
    """Write the change of the residual under changes of pressure and film, shape (ny, nx) [1].

    Parameters
    ----------
    by_pressure, by_film : ndarray, shape (7, ny, nx)
        From `reynolds_derivatives`.
    pressure, film : ndarray, shape (ny, nx)
        Changes.
    result : ndarray, shape (ny, nx)
        Zero where rows are zero.
    """
    ny, nx = pressure.shape
    result[0, :] = 0.0
    result[ny - 1, :] = 0.0
    for j in range(1, ny - 1):
        jj = max(j - 2, 0)
        result[j, 0] = 0.0
        result[j, nx - 1] = 0.0
        result[j, 1] = 0.0
        for i in range(1, nx - 1):
            ii = max(i - 2, 0)
            result[j, i] = (
                by_pressure[0, j, i] * pressure[j, i]
                + by_pressure[1, j, i] * pressure[j, i - 1]
                + by_pressure[2, j, i] * pressure[j, i + 1]
                + by_pressure[3, j, i] * pressure[j, ii]
                + by_pressure[4, j, i] * pressure[j - 1, i]
                + by_pressure[5, j, i] * pressure[j + 1, i]
                + by_pressure[6, j, i] * pressure[jj, i]
                + by_film[0, j, i] * film[j, i]
                + by_film[1, j, i] * film[j, i - 1]
                + by_film[2, j, i] * film[j, i + 1]
                + by_film[3, j, i] * film[j, ii]
                + by_film[4, j, i] * film[j - 1, i]
                + by_film[5, j, i] * film[j + 1, i]
                + by_film[6, j, i] * film[jj, i]
            )
