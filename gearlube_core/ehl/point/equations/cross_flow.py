"""Flow across the slope of pressure: an Eyring film that slides at an angle to the axes.

It flows by [[xx, xy], [xy, yy]] grad p; what xy adds goes through the faces of the finite volumes
with what drives the flow straight through them, times the ratio of xy to xx or yy.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.ehl.point.equations.stencil import (
    BESIDE,
    CENTRE,
    EAST,
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
    add_rises,
    mean_fluidity,
)
from gearlube_core.kernels.jit import kernel


class CrossFlow(NamedTuple):
    """Flow factors over those of the flow through a face; arrays of shape (ny, nx) [-]."""

    ratio_x: np.ndarray  # xy/xx
    ratio_y: np.ndarray  # xy/yy


@kernel
def add_cross_flow(
    parameters: StencilParameters,
    metric: MeshMetric,
    pressure: np.ndarray,
    film_flow: FilmFlow,
    cross: CrossFlow,
    residual: np.ndarray,
) -> None:
    """Add Lambda [d/dx(F dp/dy) + d/dy(F dp/dx)], F = rho h^3/eta times the flow factor xy.

    Parameters
    ----------
    parameters, metric, film_flow
        As in `reynolds_residual`.
    pressure : ndarray, shape (ny, nx)
        p [-].
    cross
        Factors of the cross flow at the nodes.
    residual : ndarray, shape (ny, nx)
        Of `reynolds_residual`; only inner nodes change.

    Notes
    -----
    Fluxes are differences between faces, so mass is balanced to rounding over any set of nodes.
    The slope along a face is the mean of the central ones at both nodes, second order.
    Where sliding is oblique the flow factor is a tensor here, where [jamali_2015 (3.41)] and
    [jamali_2015 (3.42)] have one factor along x and one along y.
    """
    ny, nx = pressure.shape
    unit = 0.25 * math.sqrt(parameters.poiseuille_x * parameters.poiseuille_y)
    cubic = film_flow.cubic
    fluidity_x, resistance_x = film_flow.fluidity_x, film_flow.resistance_x
    fluidity_y, resistance_y = film_flow.fluidity_y, film_flow.resistance_y
    for j in range(1, ny):
        for i in range(1, nx):
            if j < ny - 1:
                mean, _, _ = mean_fluidity(
                    fluidity_x[j, i],
                    fluidity_x[j, i - 1],
                    resistance_x[j, i] - resistance_x[j, i - 1],
                    pressure[j, i] > pressure[j, i - 1],
                )
                flow = unit * math.sqrt(cubic[j, i] * cubic[j, i - 1]) * mean
                flow *= 0.5 * (cross.ratio_x[j, i] + cross.ratio_x[j, i - 1])
                flow *= (pressure[j + 1, i] - pressure[j - 1, i]) + (
                    pressure[j + 1, i - 1] - pressure[j - 1, i - 1]
                )
                if i < nx - 1:
                    residual[j, i] -= metric.narrow[i] * flow
                if i > 1:
                    residual[j, i - 1] += metric.narrow[i - 1] * flow
            if i < nx - 1:
                mean, _, _ = mean_fluidity(
                    fluidity_y[j, i],
                    fluidity_y[j - 1, i],
                    resistance_y[j, i] - resistance_y[j - 1, i],
                    parameters.wedge_y > 0.0 and pressure[j, i] > pressure[j - 1, i],
                )
                flow = unit * math.sqrt(cubic[j, i] * cubic[j - 1, i]) * mean
                flow *= 0.5 * (cross.ratio_y[j, i] + cross.ratio_y[j - 1, i])
                near, next_near = metric.near[i], metric.near[i + 1]
                flow *= 2.0 * near * next_near / (near + next_near)
                flow *= (pressure[j, i + 1] - pressure[j, i - 1]) + (
                    pressure[j - 1, i + 1] - pressure[j - 1, i - 1]
                )
                if j < ny - 1:
                    residual[j, i] -= flow
                if j > 1:
                    residual[j - 1, i] += flow


@kernel
def add_cross_derivatives(
    parameters: StencilParameters,
    metric: MeshMetric,
    pressure: np.ndarray,
    film_flow: FilmFlow,
    cross: CrossFlow,
    film: np.ndarray,
    slopes: FlowSlopes,
    free: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Add the derivatives of the cross flow with respect to pressure and film of all neighbours.

    Parameters
    ----------
    parameters, metric, pressure, film_flow, cross
        As in `add_cross_flow`.
    film, slopes, free
        As in `reynolds_derivatives`.
    by_pressure, by_film : ndarray, shape (13, ny, nx)
        Result [-].
    """
    ny, nx = pressure.shape
    unit = 0.25 * math.sqrt(parameters.poiseuille_x * parameters.poiseuille_y)
    cubic, dense = film_flow.cubic, slopes.dense
    fluidity_x, resistance_x = film_flow.fluidity_x, film_flow.resistance_x
    fluidity_y, resistance_y = film_flow.fluidity_y, film_flow.resistance_y
    beside = (EAST, WEST, NORTH, SOUTH)
    down = (0, 0, 1, -1)
    right = (1, -1, 0, 0)
    # behind and ahead of this node, then of the one beside it, along the face
    ahead = (NORTH, NORTH, EAST, EAST)
    behind = (SOUTH, SOUTH, WEST, WEST)
    ahead_there = (NORTH_EAST, NORTH_WEST, NORTH_EAST, SOUTH_EAST)
    behind_there = (SOUTH_EAST, SOUTH_WEST, NORTH_WEST, SOUTH_WEST)
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if not free[j, i]:
                continue
            h = max(film[j, i], 1e-30)
            for k in range(4):
                jj, ii = j + down[k], i + right[k]
                step = (right[k] + down[k]) * (pressure[jj, ii] - pressure[j, i])
                if right[k] != 0:
                    rise = resistance_x[j, i] - resistance_x[jj, ii]
                    f, there_f = fluidity_x[j, i], fluidity_x[jj, ii]
                    steep = step > 0.0
                    scale = unit * metric.narrow[i]
                    ratio = 0.5 * (cross.ratio_x[j, i] + cross.ratio_x[jj, ii])
                    through, turned = slopes.x, slopes.cross_x
                    along = (pressure[j + 1, i] - pressure[j - 1, i]) + (
                        pressure[jj + 1, ii] - pressure[jj - 1, ii]
                    )
                else:
                    rise = resistance_y[j, i] - resistance_y[jj, ii]
                    f, there_f = fluidity_y[j, i], fluidity_y[jj, ii]
                    steep = step > 0.0 and parameters.wedge_y > 0.0
                    near, next_near = metric.near[i], metric.near[i + 1]
                    scale = unit * 2.0 * near * next_near / (near + next_near)
                    ratio = 0.5 * (cross.ratio_y[j, i] + cross.ratio_y[jj, ii])
                    through, turned = slopes.y, slopes.cross_y
                    along = (pressure[j, i + 1] - pressure[j, i - 1]) + (
                        pressure[jj, ii + 1] - pressure[jj, ii - 1]
                    )
                mean, m, mt = mean_fluidity(f, there_f, rise, steep)
                drive = (right[k] + down[k]) * scale * math.sqrt(cubic[j, i] * cubic[jj, ii])
                share = drive * mean * ratio
                by_pressure[ahead[k], j, i] += share
                by_pressure[behind[k], j, i] -= share
                by_pressure[ahead_there[k], j, i] += share
                by_pressure[behind_there[k], j, i] -= share
                total, of_ratio = drive * ratio * along, 0.5 * drive * mean * along
                c, of_here, of_there = 0.5 * total * mean, total * m, total * mt
                by_pressure[CENTRE, j, i] += c * dense[j, i] + of_here * through.by_pressure[j, i]
                by_pressure[CENTRE, j, i] += of_ratio * turned.by_pressure[j, i]
                steeper = of_here * through.by_film[j, i] + of_ratio * turned.by_film[j, i]
                by_film[CENTRE, j, i] += (3.0 * c + steeper) / h
                add_rises(through, of_here, j, i, BESIDE[CENTRE], j, i, by_pressure)
                add_rises(turned, of_ratio, j, i, BESIDE[CENTRE], j, i, by_pressure)
                there, there_h = beside[k], max(film[jj, ii], 1e-30)
                by_pressure[there, j, i] += c * dense[jj, ii]
                by_pressure[there, j, i] += of_there * through.by_pressure[jj, ii]
                by_pressure[there, j, i] += of_ratio * turned.by_pressure[jj, ii]
                steeper = of_there * through.by_film[jj, ii] + of_ratio * turned.by_film[jj, ii]
                by_film[there, j, i] += (3.0 * c + steeper) / there_h
                add_rises(through, of_there, jj, ii, BESIDE[there], j, i, by_pressure)
                add_rises(turned, of_ratio, jj, ii, BESIDE[there], j, i, by_pressure)
