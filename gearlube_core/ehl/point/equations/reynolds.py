"""Reynolds equation of a point contact: residual and derivatives by differences, kernels.

Arrays and units are those of `stencil`.
"""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.ehl.point.equations.stencil import (
    BESIDE,
    CENTRE,
    EAST,
    NEIGHBOURS,
    NORTH,
    SOUTH,
    WEST,
    FilmFlow,
    FlowSlopes,
    MeshMetric,
    StencilParameters,
    add_rises,
    face_weights,
    mean_fluidity,
)
from gearlube_core.kernels.jit import kernel, row_kernel


@kernel
def reynolds_residual(
    parameters: StencilParameters,
    metric: MeshMetric,
    pressure: np.ndarray,
    mass: np.ndarray,
    film_flow: FilmFlow,
    source: np.ndarray,
    residual: np.ndarray,
) -> None:
    """Write the residual of all inner nodes.

    R = Lambda [d/dx(rho h^3 f_x dp/dx) + d/dy(rho h^3 f_y dp/dy)] - d(u rho h)/dx
        - d(v rho h)/dy - squeeze rho h + source

    Parameters
    ----------
    parameters, metric
        Of the grid.
    pressure, mass, source : ndarray, shape (ny, nx)
        p, rho h, and what the squeeze term takes from earlier times [-].
    film_flow
        Of the nodes.
    residual : ndarray, shape (ny, nx)
        Result; zero on the border [-].

    Notes
    -----
    Fluxes are differences between faces, so mass is balanced to rounding over any set of nodes.
    rho h^3 of a face is the geometric mean of both nodes: nothing is pumped out of a node as its
    film vanishes, and the error in steep gaps is half that of the plain mean.
    Source: [jamali_2015 (3.1)] [jamali_2015 (3.1a)] [jamali_2015 (3.8)] [jamali_2015 (3.10)]
    [jamali_2015 (3.11)] [jamali_2015 (3.12)]
    (3.11) and (3.12) in the form that carries mass and not split by the product rule.
    """
    ny, nx = pressure.shape
    residual[:] = 0.0
    cubic = film_flow.cubic
    fluidity_x, resistance_x = film_flow.fluidity_x, film_flow.resistance_x
    fluidity_y, resistance_y = film_flow.fluidity_y, film_flow.resistance_y
    px, py = 0.5 * parameters.poiseuille_x, 0.5 * parameters.poiseuille_y
    for j in range(1, ny):
        for i in range(1, nx):
            if j < ny - 1:
                rise = resistance_x[j, i] - resistance_x[j, i - 1]
                mean, _, _ = mean_fluidity(
                    fluidity_x[j, i],
                    fluidity_x[j, i - 1],
                    rise,
                    pressure[j, i] > pressure[j, i - 1],
                )
                flow = 2.0 * math.sqrt(cubic[j, i] * cubic[j, i - 1]) * mean
                flow *= px * metric.near[i] * (pressure[j, i] - pressure[j, i - 1])
                far, near, there = mass[j, max(i - 2, 0)], mass[j, i - 1], mass[j, i]
                f0, f1, f2 = face_weights(parameters, i - 1, far, near, there)
                flow -= parameters.wedge_x * (f0 * near + f1 * far + f2 * there)
                if i < nx - 1:
                    residual[j, i] -= (
                        metric.narrow[i] * flow + parameters.squeeze * mass[j, i] - source[j, i]
                    )
                if i > 1:
                    residual[j, i - 1] += metric.narrow[i - 1] * flow
            if i < nx - 1:
                rise = resistance_y[j, i] - resistance_y[j - 1, i]
                mean, _, _ = mean_fluidity(
                    fluidity_y[j, i],
                    fluidity_y[j - 1, i],
                    rise,
                    parameters.wedge_y > 0.0 and pressure[j, i] > pressure[j - 1, i],
                )
                flow = 2.0 * math.sqrt(cubic[j, i] * cubic[j - 1, i]) * mean
                flow *= py * (pressure[j, i] - pressure[j - 1, i])
                far, near, there = mass[max(j - 2, 0), i], mass[j - 1, i], mass[j, i]
                f0, f1, f2 = face_weights(parameters, j - 1, far, near, there)
                flow -= parameters.wedge_y * (f0 * near + f1 * far + f2 * there)
                if j < ny - 1:
                    residual[j, i] -= flow
                if j > 1:
                    residual[j - 1, i] += flow


@row_kernel
def reynolds_derivatives(
    parameters: StencilParameters,
    metric: MeshMetric,
    pressure: np.ndarray,
    film_flow: FilmFlow,
    density: np.ndarray,
    density_slope: np.ndarray,
    film: np.ndarray,
    slopes: FlowSlopes,
    free: np.ndarray,
    rows: tuple[int, int],
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Write the derivatives of the residual with respect to pressure and film of each neighbour.

    Parameters
    ----------
    parameters, metric, pressure, film_flow
        As in `reynolds_residual`.
    density, density_slope, film : ndarray, shape (ny, nx)
        rho, d rho/dp, h [-].
    slopes
        Of the flow by pressure.
    free : ndarray of bool, shape (ny, nx)
        Nodes whose equation is solved; rows of the others become zero.
    rows
        First row of nodes that is written and the one behind the last.
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Result [-], n = 7, or 13 where fluidity depends on the rise of pressure across its node:
        that of the film is taken then, too. Derivatives by film of the last six are zero.
    """
    ny, nx = pressure.shape
    by_pressure[:, rows[0] : rows[1]] = 0.0
    by_film[:, rows[0] : rows[1]] = 0.0
    sheared = by_pressure.shape[0] > NEIGHBOURS
    cubic, dense = film_flow.cubic, slopes.dense
    fluidity_x, resistance_x = film_flow.fluidity_x, film_flow.resistance_x
    fluidity_y, resistance_y = film_flow.fluidity_y, film_flow.resistance_y
    px, py = 0.5 * parameters.poiseuille_x, 0.5 * parameters.poiseuille_y
    uy = parameters.wedge_y
    down = (0, 0, 0, 0, -1, 1, -2)
    right = (0, -1, 1, -2, 0, 0, 0)
    for j in range(max(rows[0], 1), min(rows[1], ny - 1)):
        for i in range(1, nx - 1):
            if not free[j, i]:
                continue
            here = density[j, i] * film[j, i]
            west, far = density[j, i - 1] * film[j, i - 1], max(i - 2, 0)
            far_mass, east = density[j, far] * film[j, far], density[j, i + 1] * film[j, i + 1]
            w0, w1, w2 = face_weights(parameters, i - 1, far_mass, west, here)
            e0, e1, e2 = face_weights(parameters, i, west, here, east)
            south, far = density[j - 1, i] * film[j - 1, i], max(j - 2, 0)
            far_mass, north = density[far, i] * film[far, i], density[j + 1, i] * film[j + 1, i]
            s0, s1, s2 = face_weights(parameters, j - 1, far_mass, south, here)
            n0, n1, n2 = face_weights(parameters, j, south, here, north)
            p = pressure[j, i]
            ux = parameters.wedge_x * metric.narrow[i]
            h = max(film[j, i], 1e-30)
            for k in (WEST, EAST, SOUTH, NORTH):
                jj, ii = j + down[k], i + right[k]
                if right[k] != 0:
                    unit = px * metric.narrow[i] * metric.near[max(i, ii)]
                    f, there_f = fluidity_x[j, i], fluidity_x[jj, ii]
                    rise = resistance_x[j, i] - resistance_x[jj, ii]
                    along = slopes.x
                else:
                    unit = py
                    f, there_f = fluidity_y[j, i], fluidity_y[jj, ii]
                    rise = resistance_y[j, i] - resistance_y[jj, ii]
                    along = slopes.y
                step = pressure[jj, ii] - p
                steep = (right[k] + down[k]) * step > 0.0 and (right[k] != 0 or uy > 0.0)
                mean, m, mt = mean_fluidity(f, there_f, rise, steep)
                pumped = 2.0 * unit * math.sqrt(cubic[j, i] * cubic[jj, ii])
                flow, total = pumped * mean, pumped * step
                c, of_here, of_there = 0.5 * total * mean, total * m, total * mt
                by_pressure[CENTRE, j, i] += c * dense[j, i] - flow
                by_pressure[CENTRE, j, i] += of_here * along.by_pressure[j, i]
                by_film[CENTRE, j, i] += (3.0 * c + of_here * along.by_film[j, i]) / h
                there_h = max(film[jj, ii], 1e-30)
                by_pressure[k, j, i] += flow + c * dense[jj, ii]
                by_pressure[k, j, i] += of_there * along.by_pressure[jj, ii]
                by_film[k, j, i] += (3.0 * c + of_there * along.by_film[jj, ii]) / there_h
                if sheared:
                    add_rises(along, of_here, j, i, BESIDE[CENTRE], j, i, by_pressure)
                    add_rises(along, of_there, jj, ii, BESIDE[k], j, i, by_pressure)
            wedge = (
                -ux * (e0 - w2) - uy * (n0 - s2) - parameters.squeeze,
                -ux * (e1 - w0),
                -ux * e2,
                ux * w1,
                -uy * (n1 - s0),
                -uy * n2,
                uy * s1,
            )
            for k in range(NEIGHBOURS):
                jj, ii = max(j + down[k], 0), max(i + right[k], 0)
                by_pressure[k, j, i] += wedge[k] * density_slope[jj, ii] * film[jj, ii]
                by_film[k, j, i] += wedge[k] * density[jj, ii]


@kernel
def apply_derivatives(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    reach: np.ndarray,
    pressure: np.ndarray,
    film: np.ndarray,
    result: np.ndarray,
) -> None:
    """Write the change of the residual under changes of pressure and film, shape (ny, nx) [-].

    Parameters
    ----------
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x, at least.
    by_pressure, by_film : ndarray, shape (m, ny, nx), m <= n
        Derivatives with respect to each of them.
    reach : ndarray of int, shape (ny + 2,)
        Of the sides: rows that hold those from one before the first to one behind the last.
    pressure, film : ndarray, shape (ny, nx)
        Changes.
    result : ndarray, shape (ny, nx)
        Zero on the border and where rows are zero.
    """
    ny, nx = pressure.shape
    result[:] = 0.0
    for j in range(1, ny - 1):
        for k in range(by_pressure.shape[0]):
            down, right = offsets[k, 0], offsets[k, 1]
            first, last = max(1, -right), min(nx - 1, nx - right)
            row = result[j, first:last]
            there = reach[j + down + 1]
            p = pressure[there, first + right : last + right]
            h = film[there, first + right : last + right]
            a, b = by_pressure[k, j, first:last], by_film[k, j, first:last]
            for i in range(row.size):
                row[i] += a[i] * p[i] + b[i] * h[i]
