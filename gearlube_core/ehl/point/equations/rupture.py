"""Oil that flows where a film is broken, on one grid of a point contact: kernels.

A node without pressure holds what its upstream neighbours bring and no more than its gap. Rows and
columns are those of `point_stencil`: entrainment points to larger indices, so one sweep does.
"""

from __future__ import annotations

import numpy as np

from gearlube_core.ehl.point.equations.stencil import (
    CENTRE,
    EAST,
    FAR_SOUTH,
    FAR_WEST,
    NORTH,
    SOUTH,
    WEST,
    MeshMetric,
    StencilParameters,
    face_weights,
)
from gearlube_core.kernels.jit import kernel


@kernel
def wedge_face(
    parameters: StencilParameters,
    along: bool,
    pressure: np.ndarray,
    ruptured: np.ndarray,
    carried: np.ndarray,
    blend: float,
    j: int,
    i: int,
) -> tuple[float, float, float, float, float, float]:
    """Return the face downstream of a node as `reynolds_residual` has it, and its share.

    Parameters
    ----------
    parameters
        Of the grid.
    along
        The face across x; else that across y.
    pressure, ruptured, carried : ndarray, shape (ny, nx)
        p, nodes that hold less than their gap, and rho h of full gaps times the share of the speed.
    blend
        Pressure from which on a node passes on what the stencil says [-].
    j, i
        Node upstream of the face.

    Returns
    -------
    tuple
        Value, the weights of the node, of the one upstream and of the one downstream; the share of
        the value beside what the node holds itself, and the slope of the share by the pressure.

    Notes
    -----
    A ruptured node passes on what it holds. Where the stencil says more than rho h of a full one,
    as where the gap opens, its share is q (2 - q), q = p/blend, up to 1: with a jump between the
    two there is an inflow at which neither balances. Where it says less both balance over some
    range, and no share is needed.
    """
    index = i if along else j
    far_j, far_i = (j, max(i - 1, 0)) if along else (max(j - 1, 0), i)
    there_j, there_i = (j, i + 1) if along else (j + 1, i)
    far, near, there = carried[far_j, far_i], carried[j, i], carried[there_j, there_i]
    w0, w1, w2 = face_weights(parameters, index, far, near, there)
    value = w0 * near + w1 * far + w2 * there
    if ruptured[j, i] or (parameters.upstream != 0.0 and ruptured[far_j, far_i]):
        return value, w0, w1, w2, 0.0, 0.0
    q = pressure[j, i] / blend
    if value <= near or q >= 1.0 or index == 0:
        return value, w0, w1, w2, 1.0, 0.0
    return value, w0, w1, w2, q * (2.0 - q), 2.0 * (1.0 - q) / blend


@kernel
def settle_oil(
    parameters: StencilParameters,
    metric: MeshMetric,
    pressure: np.ndarray,
    blend: float,
    rate: np.ndarray,
    storage: np.ndarray,
    full: np.ndarray,
    mass: np.ndarray,
    ruptured: np.ndarray,
    residual: np.ndarray,
) -> None:
    """Write what every node holds and turn the residual of full gaps into that of what they hold.

    Parameters
    ----------
    parameters, metric
        Of the grid.
    pressure : ndarray, shape (ny, nx)
        p [-].
    blend
        Of `wedge_face`.
    rate : ndarray, shape (ny,)
        Entrainment of every row over that of the problem [-].
    storage : ndarray, shape (ny, nx)
        Rate at which oil is stored [-].
    full : ndarray, shape (ny, nx)
        rho h of full gaps [-].
    mass : ndarray, shape (ny, nx)
        rho h times the fill; upstream borders are given, inner nodes are written [-].
    ruptured : ndarray of bool, shape (ny, nx)
        No pressure, and not more oil than the gap takes; upstream borders are given, inner
        nodes are written.
    residual : ndarray, shape (ny, nx)
        Of full gaps; changed. Zero in ruptured nodes.

    Notes
    -----
    Nodes without pressure that cannot take what comes keep the rest as their residual, which
    calls for pressure. [jakobsson_floberg_1957], [olsson_1965]; [elrod_1981]; as a complementarity
    of pressure and void [giacopini_2010].
    """
    ny, nx = pressure.shape
    carried = rate.reshape(ny, 1) * full
    ruptured[1:, 1:] = False
    for j in range(ny - 1):
        for i in range(nx - 1):
            across = parameters.wedge_y > 0.0 and i > 0
            inner = j > 0 and i > 0
            x_value, x_share, y_value, y_share = 0.0, 1.0, 0.0, 1.0
            if j > 0:
                x_value, _, _, _, x_share, _ = wedge_face(
                    parameters, True, pressure, ruptured, carried, blend, j, i
                )
            if across:
                y_value, _, _, _, y_share, _ = wedge_face(
                    parameters, False, pressure, ruptured, carried, blend, j, i
                )
            if inner:
                mass[j, i] = full[j, i]
            if x_share == 1.0 and y_share == 1.0 and not (inner and pressure[j, i] <= 0.0):
                continue
            out_x = metric.narrow[i] * parameters.wedge_x if j > 0 else 0.0
            out_y = parameters.wedge_y if across else 0.0
            if inner and pressure[j, i] <= 0.0:
                excess = residual[j, i]
                excess -= out_x * (carried[j, i] - x_value) + out_y * (carried[j, i] - y_value)
                if excess <= 0.0:
                    ruptured[j, i] = True
                    x_share, y_share = 0.0, 0.0
                    mass[j, i] += excess / ((out_x + out_y) * rate[j] + storage[j, i])
            own = rate[j] * mass[j, i]
            more_x = (1.0 - x_share) * (own - x_value)
            more_y = (1.0 - y_share) * (own - y_value)
            if inner:
                residual[j, i] -= out_x * more_x + out_y * more_y
                if ruptured[j, i]:
                    residual[j, i] = 0.0
            if j > 0 and i < nx - 2:
                residual[j, i + 1] += metric.narrow[i + 1] * parameters.wedge_x * more_x
            if across and j < ny - 2:
                residual[j + 1, i] += parameters.wedge_y * more_y


@kernel
def add_fill_derivatives(
    parameters: StencilParameters,
    metric: MeshMetric,
    pressure: np.ndarray,
    blend: float,
    ruptured: np.ndarray,
    rate: np.ndarray,
    mass: np.ndarray,
    density: np.ndarray,
    density_slope: np.ndarray,
    film: np.ndarray,
    rows: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Turn the derivatives of full gaps into those of `settle_oil` with the oil of nodes that hold.

    Parameters
    ----------
    parameters, metric, pressure, blend, ruptured, rate, mass
        As in `settle_oil`, after it.
    density, density_slope, film : ndarray, shape (ny, nx)
        rho, d rho/dp, h [-].
    rows : ndarray of bool, shape (ny, nx)
        Nodes whose derivatives are wanted.
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Changed.
    """
    ny, nx = film.shape
    carried = rate.reshape(ny, 1) * density * film
    for j in range(ny - 1):
        for i in range(nx - 1):
            for along in (True, False):
                if (along and j == 0) or (not along and (i == 0 or parameters.wedge_y == 0.0)):
                    continue
                value, w0, w1, w2, share, slope = wedge_face(
                    parameters, along, pressure, ruptured, carried, blend, j, i
                )
                if share == 1.0:
                    continue
                lack = 1.0 - share
                jump = rate[j] * mass[j, i] - value
                own = 0.0 if ruptured[j, i] else 1.0
                down, right = (0, 1) if along else (1, 0)
                behind, ahead = (WEST, EAST) if along else (SOUTH, NORTH)
                far_behind = FAR_WEST if along else FAR_SOUTH
                there_j, there_i = j + down, i + right
                flow = parameters.wedge_x if along else parameters.wedge_y
                near_row = -flow * (metric.narrow[i] if along else 1.0) * rows[j, i]
                there_row = flow * (metric.narrow[there_i] if along else 1.0)
                there_row *= rows[there_j, there_i]
                for node in range(3):
                    weight = own - w0 if node == 0 else (-w1 if node == 1 else -w2)
                    step = 0 if node == 0 else (-1 if node == 1 else 1)
                    jj, ii = j + step * down, i + step * right
                    if jj < 0 or ii < 0:
                        continue
                    by_p = lack * weight * rate[jj] * density_slope[jj, ii] * film[jj, ii]
                    if node == 0:
                        by_p -= slope * jump
                    by_h = lack * weight * rate[jj] * density[jj, ii]
                    of_near = CENTRE if node == 0 else (behind if node == 1 else ahead)
                    of_there = behind if node == 0 else (far_behind if node == 1 else CENTRE)
                    by_pressure[of_near, j, i] += near_row * by_p
                    by_film[of_near, j, i] += near_row * by_h
                    by_pressure[of_there, there_j, there_i] += there_row * by_p
                    by_film[of_there, there_j, there_i] += there_row * by_h


@kernel
def pass_on(to_x: np.ndarray, to_y: np.ndarray, ruptured: np.ndarray, change: np.ndarray) -> None:
    """Carry what gathers in ruptured nodes downstream to the nodes that answer with pressure.

    Parameters
    ----------
    to_x, to_y : ndarray, shape (ny, nx)
        Share of what gathers in a ruptured node that its neighbour downstream gets, along x and y.
    ruptured : ndarray of bool, shape (ny, nx)
    change : ndarray, shape (ny, nx)
        Rows times a change; ruptured nodes become zero.
    """
    ny, nx = change.shape
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if ruptured[j, i]:
                change[j, i + 1] += to_x[j, i] * change[j, i]
                change[j + 1, i] += to_y[j, i] * change[j, i]
                change[j, i] = 0.0


@kernel
def carried_entries(
    to_x: np.ndarray,
    to_y: np.ndarray,
    ruptured: np.ndarray,
    free: np.ndarray,
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    row: np.ndarray,
    column: np.ndarray,
    entry: np.ndarray,
) -> int:
    """Write what `pass_on` brings to free nodes as entries of a matrix; return their number.

    Parameters
    ----------
    to_x, to_y, ruptured : ndarray, shape (ny, nx)
        Of `pass_on`.
    free : ndarray of bool, shape (ny, nx)
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x, at least.
    by_pressure, by_film : ndarray, shape (m, ny, nx), m <= n
        Derivatives, those of ruptured nodes included.
    row, column, entry : ndarray
        Result, as far as it fits; entries are those by pressure, and by film as imaginary part.

    Returns
    -------
    int
        Of all of them.

    Notes
    -----
    Oil that pressure drives back or aside into ruptured nodes returns downstream: without it a
    preconditioner would see a given pressure at the edge of the oil where a given flow is. Oil is
    followed over 32 nodes along and 8 across the motion, down to a thousandth.
    """
    ny, nx = ruptured.shape
    count = 0
    share = np.zeros((9, 33))
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if not ruptured[j, i]:
                continue
            some = False
            for k in range(by_pressure.shape[0]):
                jj, ii = max(j + offsets[k, 0], 0), max(i + offsets[k, 1], 0)
                some |= by_pressure[k, j, i] != 0.0 and free[jj, ii]
            if not some:
                continue
            share[:] = 0.0
            share[0, 0] = 1.0
            for b in range(min(8, ny - 1 - j)):
                for a in range(min(32, nx - 1 - i)):
                    part = share[b, a]
                    if part < 1e-3:
                        continue
                    at_j, at_i = j + b, i + a
                    if ruptured[at_j, at_i]:
                        share[b, a + 1] += part * to_x[at_j, at_i]
                        share[b + 1, a] += part * to_y[at_j, at_i]
                        continue
                    if not free[at_j, at_i]:
                        continue
                    for k in range(by_pressure.shape[0]):
                        jj, ii = j + offsets[k, 0], i + offsets[k, 1]
                        p, h = by_pressure[k, j, i], by_film[k, j, i]
                        if jj < 0 or ii < 0 or (p == 0.0 and h == 0.0):
                            continue
                        if not free[jj, ii]:
                            p = 0.0
                        if count < entry.size:
                            row[count] = at_j * nx + at_i
                            column[count] = jj * nx + ii
                            entry[count] = complex(part * p, part * h)
                        count += 1
    return count
