"""Downstream transport of oil from ruptured nodes, on one grid of a point contact: kernels."""

from __future__ import annotations

import numpy as np

from gearlube_core.kernels.jit import kernel


@kernel
def carry_downstream(
    to_x: np.ndarray, to_y: np.ndarray, ruptured: np.ndarray, change: np.ndarray
) -> None:
    """Carry what gathers in ruptured nodes downstream to the next nodes with pressure.

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
    """Write what `carry_downstream` brings to free nodes as entries of a matrix, count them.

    Parameters
    ----------
    to_x, to_y, ruptured : ndarray, shape (ny, nx)
        Of `carry_downstream`.
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
