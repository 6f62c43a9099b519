"""Reynolds equation of a point contact: residual and derivatives by differences, kernels.

Arrays and units are those of `stencil`.
"""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.ehl.point.equations.stencil import (
    CENTRE,
    EAST,
    FAR_EAST,
    FAR_NORTH,
    FAR_SOUTH,
    FAR_WEST,
    NEIGHBOURS,
    NORTH,
    NORTH_EAST,
    NORTH_WEST,
    SOUTH,
    SOUTH_EAST,
    SOUTH_WEST,
    WEST,
    FilmFlow,
    FlowSlopes,
    MeshMetric,
    StencilParameters,
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
        Equation parameters and spacing of the grid.
    pressure, mass, source : ndarray, shape (ny, nx)
        p, rho h, and what the squeeze term takes from earlier times [-].
    film_flow
        Flow factors of the film at the nodes.
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
    sheared = by_pressure.shape[0] > NEIGHBOURS
    cubic, dense, x, y = film_flow.cubic, slopes.dense, slopes.x, slopes.y
    fluidity_x, resistance_x = film_flow.fluidity_x, film_flow.resistance_x
    fluidity_y, resistance_y = film_flow.fluidity_y, film_flow.resistance_y
    px, py = 0.5 * parameters.poiseuille_x, 0.5 * parameters.poiseuille_y
    uy = parameters.wedge_y
    by_film[NEIGHBOURS:, rows[0] : rows[1]] = 0.0
    for j in range(rows[0], rows[1]):
        inner = 0 < j < ny - 1
        for i in range(nx):
            if not (inner and 0 < i < nx - 1 and free[j, i]):
                for k in range(by_pressure.shape[0]):
                    by_pressure[k, j, i] = 0.0
                for k in range(NEIGHBOURS):
                    by_film[k, j, i] = 0.0
                continue
            fw, fs = max(i - 2, 0), max(j - 2, 0)
            here = density[j, i] * film[j, i]
            west, far_west = density[j, i - 1] * film[j, i - 1], density[j, fw] * film[j, fw]
            south, far_south = density[j - 1, i] * film[j - 1, i], density[fs, i] * film[fs, i]
            east, north = density[j, i + 1] * film[j, i + 1], density[j + 1, i] * film[j + 1, i]
            w0, w1, w2 = face_weights(parameters, i - 1, far_west, west, here)
            e0, e1, e2 = face_weights(parameters, i, west, here, east)
            s0, s1, s2 = face_weights(parameters, j - 1, far_south, south, here)
            n0, n1, n2 = face_weights(parameters, j, south, here, north)
            ux = parameters.wedge_x * metric.narrow[i]
            wedge = -ux * (e0 - w2) - uy * (n0 - s2) - parameters.squeeze
            wedge_w, wedge_e, wedge_fw = -ux * (e1 - w0), -ux * e2, ux * w1
            wedge_s, wedge_n, wedge_fs = -uy * (n1 - s0), -uy * n2, uy * s1
            # flow through each face, its slope with both rho h^3, and with ln(fluidity) on
            # this side and on the other
            p, c, flow = pressure[j, i], cubic[j, i], fluidity_x[j, i]
            unit, rise = px * metric.narrow[i], resistance_x[j, i]
            step = pressure[j, i - 1] - p
            flow_w, c_w, near_w, there_w = _face(
                c,
                cubic[j, i - 1],
                flow,
                fluidity_x[j, i - 1],
                rise - resistance_x[j, i - 1],
                step,
                unit * metric.near[i],
                step < 0.0,
            )
            step = pressure[j, i + 1] - p
            flow_e, c_e, near_e, there_e = _face(
                c,
                cubic[j, i + 1],
                flow,
                fluidity_x[j, i + 1],
                rise - resistance_x[j, i + 1],
                step,
                unit * metric.near[i + 1],
                step > 0.0,
            )
            flow, rise = fluidity_y[j, i], resistance_y[j, i]
            step = pressure[j - 1, i] - p
            flow_s, c_s, near_s, there_s = _face(
                c,
                cubic[j - 1, i],
                flow,
                fluidity_y[j - 1, i],
                rise - resistance_y[j - 1, i],
                step,
                py,
                step < 0.0 and uy > 0.0,
            )
            step = pressure[j + 1, i] - p
            flow_n, c_n, near_n, there_n = _face(
                c,
                cubic[j + 1, i],
                flow,
                fluidity_y[j + 1, i],
                rise - resistance_y[j + 1, i],
                step,
                py,
                step > 0.0 and uy > 0.0,
            )
            near_x, near_y, c = near_w + near_e, near_s + near_n, c_w + c_e + c_s + c_n
            centre = c * dense[j, i] - (flow_w + flow_e + flow_s + flow_n)
            centre += near_x * x.by_pressure[j, i] + near_y * y.by_pressure[j, i]
            centre += wedge * density_slope[j, i] * film[j, i]
            of_w = flow_w + c_w * dense[j, i - 1] + there_w * x.by_pressure[j, i - 1]
            of_e = flow_e + c_e * dense[j, i + 1] + there_e * x.by_pressure[j, i + 1]
            of_s = flow_s + c_s * dense[j - 1, i] + there_s * y.by_pressure[j - 1, i]
            of_n = flow_n + c_n * dense[j + 1, i] + there_n * y.by_pressure[j + 1, i]
            of_w += wedge_w * density_slope[j, i - 1] * film[j, i - 1]
            of_e += wedge_e * density_slope[j, i + 1] * film[j, i + 1]
            of_s += wedge_s * density_slope[j - 1, i] * film[j - 1, i]
            of_n += wedge_n * density_slope[j + 1, i] * film[j + 1, i]
            of_fw = wedge_fw * density_slope[j, fw] * film[j, fw]
            of_fs = wedge_fs * density_slope[fs, i] * film[fs, i]
            bent = 3.0 * c + near_x * x.by_film[j, i] + near_y * y.by_film[j, i]
            by_film[CENTRE, j, i] = bent / max(film[j, i], 1e-30) + wedge * density[j, i]
            bent = (3.0 * c_w + there_w * x.by_film[j, i - 1]) / max(film[j, i - 1], 1e-30)
            by_film[WEST, j, i] = bent + wedge_w * density[j, i - 1]
            bent = (3.0 * c_e + there_e * x.by_film[j, i + 1]) / max(film[j, i + 1], 1e-30)
            by_film[EAST, j, i] = bent + wedge_e * density[j, i + 1]
            bent = (3.0 * c_s + there_s * y.by_film[j - 1, i]) / max(film[j - 1, i], 1e-30)
            by_film[SOUTH, j, i] = bent + wedge_s * density[j - 1, i]
            bent = (3.0 * c_n + there_n * y.by_film[j + 1, i]) / max(film[j + 1, i], 1e-30)
            by_film[NORTH, j, i] = bent + wedge_n * density[j + 1, i]
            by_film[FAR_WEST, j, i] = wedge_fw * density[j, fw]
            by_film[FAR_SOUTH, j, i] = wedge_fs * density[fs, i]
            if sheared:
                # as pressure rises across the node itself, and across each neighbour
                rise = near_x * x.by_rise_x[j, i] + near_y * y.by_rise_x[j, i]
                of_e, of_w = of_e + rise, of_w - rise
                rise = near_x * x.by_rise_y[j, i] + near_y * y.by_rise_y[j, i]
                of_n, of_s = of_n + rise, of_s - rise
                rise_w, turn_w = there_w * x.by_rise_x[j, i - 1], there_w * x.by_rise_y[j, i - 1]
                rise_e, turn_e = there_e * x.by_rise_x[j, i + 1], there_e * x.by_rise_y[j, i + 1]
                turn_s, rise_s = there_s * y.by_rise_x[j - 1, i], there_s * y.by_rise_y[j - 1, i]
                turn_n, rise_n = there_n * y.by_rise_x[j + 1, i], there_n * y.by_rise_y[j + 1, i]
                centre += rise_w - rise_e + rise_s - rise_n
                of_fw, of_fs = of_fw - rise_w, of_fs - rise_s
                by_pressure[FAR_EAST, j, i], by_pressure[FAR_NORTH, j, i] = rise_e, rise_n
                by_pressure[SOUTH_WEST, j, i] = -turn_w - turn_s
                by_pressure[SOUTH_EAST, j, i] = turn_s - turn_e
                by_pressure[NORTH_WEST, j, i] = turn_w - turn_n
                by_pressure[NORTH_EAST, j, i] = turn_e + turn_n
            by_pressure[CENTRE, j, i] = centre
            by_pressure[WEST, j, i], by_pressure[EAST, j, i] = of_w, of_e
            by_pressure[SOUTH, j, i], by_pressure[NORTH, j, i] = of_s, of_n
            by_pressure[FAR_WEST, j, i], by_pressure[FAR_SOUTH, j, i] = of_fw, of_fs


@kernel
def _face(
    cubic: float,
    there_cubic: float,
    fluidity: float,
    there_fluidity: float,
    rise: float,
    step: float,
    unit: float,
    steep: bool,
) -> tuple[float, float, float, float]:
    """Return the flow through a face per step of pressure, and its derivatives [-].

    Those by ln(rho h^3) of either node, and by ln(fluidity) of this and of the other one.
    """
    mean, near, there = mean_fluidity(fluidity, there_fluidity, rise, steep)
    pumped = 2.0 * unit * math.sqrt(cubic * there_cubic)
    total = pumped * step
    return pumped * mean, 0.5 * total * mean, total * near, total * there


@row_kernel
def apply_to_rows(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    reach: np.ndarray,
    pressure: np.ndarray,
    film: np.ndarray,
    rows: tuple[int, int],
    result: np.ndarray,
) -> None:
    """As `apply_derivatives`, from the first of some rows to the one behind the last."""
    ny, nx = pressure.shape
    for j in range(rows[0], rows[1]):
        result[j] = 0.0
        if j == 0 or j == ny - 1:
            continue
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
        Changes of pressure and film.
    result : ndarray, shape (ny, nx)
        Zero on the border and where rows are zero.
    """
    rows = 0, pressure.shape[0]
    apply_to_rows(offsets, by_pressure, by_film, reach, pressure, film, rows, result)
