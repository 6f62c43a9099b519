"""Line solutions of a preconditioner with rows of nodes side by side: bands, kernels.

Arrays are as in `column_stencils`. Rows of nodes do not feel each other, so threads share them. A
band has shape (nx, 9, rows): by node, place of the other node from -4 to 4, and row.

Fields with rows of nodes side by side: turned, and between two grids, kernels.

Arrays are float32 and have the node of a row first and the row last, (nx, rows); columns are nodes
beside each other along y.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.ehl.point.newton.row_factors import BELOW, LARGEST_SHARE
from gearlube_core.kernels.line_kernel import line_kernel

REACH = 2  # nodes that a stencil reaches to each side
_LEAST = 1.0e-30  # coefficient, over which shares are taken
TILE = 32  # rows and columns that are turned at once: they stay in the nearest cache


class Links(NamedTuple):
    """Linear interpolation along one axis, and its transpose as means."""

    # both coarse nodes and their shares, for fine nodes from -REACH to REACH beyond the last;
    # beyond both ends they go on
    coarse: np.ndarray  # int, (fine + 2 REACH, 2)
    share: np.ndarray  # float32, (fine + 2 REACH, 2)
    start: np.ndarray  # int, of the fine nodes of every coarse one, (coarse + 1,)
    fine: np.ndarray  # int
    weight: np.ndarray  # float32


@line_kernel
def turn_field(
    values: np.ndarray, first: int, unit: float, rows: tuple[int, int], result: np.ndarray
) -> None:
    """Write a field, (ny, nx), times `unit` with rows side by side, (nx, rows), from `first` on.

    `rows` are the first row of the result that is written and the one behind the last.
    """
    nx = result.shape[0]
    for i0 in range(0, nx, TILE):
        for j in range(rows[0], rows[1]):
            for i in range(i0, min(i0 + TILE, nx)):
                result[i, j] = np.float32(unit * values[j + first, i])


@line_kernel
def turn_back(
    values: np.ndarray,
    halo: int,
    first: int,
    unit: float,
    columns: tuple[int, int],
    result: np.ndarray,
) -> None:
    """Write columns, (nx, rows), with `halo` more rows at both ends, as a field, (ny, nx)."""
    rows = values.shape[1] - 2 * halo
    for i0 in range(columns[0], columns[1], TILE):
        for j in range(rows):
            for i in range(i0, min(i0 + TILE, columns[1])):
                result[j + first, i] = unit * values[i, j + halo]


@line_kernel
def held_row(row: int, rows: int, mirrored: bool) -> int:
    """Return the row that holds one beyond an end: of a film that repeats, or mirrored."""
    if 0 <= row < rows:
        return row
    if row < 0:
        return -1 - row if mirrored else row + rows
    return 2 * rows - 1 - row if mirrored else row - rows


@line_kernel
def mean_across(across: Links, fine: np.ndarray, coarse: np.ndarray) -> None:
    """Write means of a column around the rows of the coarser grid."""
    for to in range(coarse.size):
        mean = np.float32(0.0)
        for k in range(across.start[to], across.start[to + 1]):
            mean += across.weight[k] * fine[across.fine[k]]
        coarse[to] = mean


@line_kernel
def interpolate_across(across: Links, coarse: np.ndarray, mirrored: bool, fine: np.ndarray) -> None:
    """Write a column linear between the rows of the coarser grid."""
    for j in range(fine.size):
        value = np.float32(0.0)
        for m in range(2):
            at = held_row(across.coarse[j + REACH, m], coarse.size, mirrored)
            value += across.share[j + REACH, m] * coarse[at]
        fine[j] = value


@line_kernel
def restrict(
    along: Links, across: Links, fine: np.ndarray, half: np.ndarray, coarse: np.ndarray
) -> None:
    """Write means of a field, shape (nx, rows), around the nodes of the coarser grid."""
    rows = half.shape[1]
    for to in range(half.shape[0]):
        total = half[to]
        total[:] = np.float32(0.0)
        for k in range(along.start[to], along.start[to + 1]):
            of, weight = fine[along.fine[k]], along.weight[k]
            for j in range(rows):
                total[j] += weight * of[j]
        mean = coarse[to]
        if mean.size < rows:
            mean_across(across, total, mean)
        else:
            for j in range(rows):
                mean[j] = total[j]


@line_kernel
def columns_around(along: Links, i: int) -> tuple[int, float, int, float]:
    """Return both coarse columns around one and their shares; a column with none is the other."""
    c, weight = along.coarse[i + REACH, 0], along.share[i + REACH, 0]
    d, other = along.coarse[i + REACH, 1], along.share[i + REACH, 1]
    # where one has no share it may not be there
    return (d if weight == 0.0 else c), weight, (c if other == 0.0 else d), other


@line_kernel
def fill_band(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    film_offsets: np.ndarray,
    by_film: np.ndarray,
    free: np.ndarray,
    local: np.ndarray,
    across: np.ndarray,
    i: int,
    low: int,
    high: int,
    band: np.ndarray,
) -> None:
    """Fill the band of node i of the rows from `low` to before `high`; see `factor_rows`."""
    nx = free.shape[0]
    for place in range(2 * BELOW + 1):
        total = band[i, place, low:high]
        for j in range(total.size):
            total[j] = np.float32(0.0)
    for k in range(offsets.shape[0]):
        ii = i + offsets[k, 1]
        if offsets[k, 0] == 0 and 0 <= ii < nx:
            total, of = band[i, BELOW + ii - i, low:high], by_pressure[i, k, low:high]
            known = free[ii, low:high]
            for j in range(total.size):
                total[j] += of[j] * known[j]
    for k in range(film_offsets.shape[0]):
        ii = i + film_offsets[k, 1]
        if not 0 <= ii < nx:
            continue
        share = across[min(abs(film_offsets[k, 0]), 4)]
        for m in range(max(ii - REACH, 0), min(ii + REACH + 1, nx)):
            deflection = share * local[abs(ii - m)]
            total, of = band[i, BELOW + m - i, low:high], by_film[i, k, low:high]
            known = free[m, low:high]
            for j in range(total.size):
                total[j] += of[j] * known[j] * deflection
    known = free[i, low:high]
    for place in range(2 * BELOW + 1):
        total = band[i, place, low:high]
        for j in range(total.size):
            total[j] *= known[j]
    total = band[i, BELOW, low:high]
    for j in range(total.size):
        total[j] += np.float32(1.0) - known[j]


@line_kernel
def factor_node(i: int, low: int, high: int, band: np.ndarray, most: np.ndarray) -> None:
    """Take the equations of node i off those of the next nodes; see `factor_rows`."""
    nx = band.shape[0]
    pivot, largest = band[i, BELOW, low:high], most[low:high]
    for j in range(largest.size):
        largest[j] = np.float32(_LEAST)
    for k in range(1, min(BELOW, nx - 1 - i) + 1):
        share = band[i + k, BELOW - k, low:high]
        for j in range(share.size):
            largest[j] = max(largest[j], abs(share[j]))
    for j in range(pivot.size):
        # an equation that would have to be exchanged is made to weigh more
        size = max(abs(pivot[j]), np.float32(1.0 / LARGEST_SHARE) * largest[j])
        pivot[j] = np.float32(1.0) / (size if pivot[j] >= np.float32(0.0) else -size)
    for k in range(1, min(BELOW, nx - 1 - i) + 1):
        share = band[i + k, BELOW - k, low:high]
        for j in range(share.size):
            share[j] *= pivot[j]
        for m in range(1, min(BELOW, nx - 1 - i) + 1):
            rest, above = band[i + k, BELOW - k + m, low:high], band[i, BELOW + m, low:high]
            for j in range(rest.size):
                rest[j] -= share[j] * above[j]


@line_kernel
def factor_rows(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    film_offsets: np.ndarray,
    by_film: np.ndarray,
    free: np.ndarray,
    local: np.ndarray,
    across: np.ndarray,
    rows: tuple[int, int],
    band: np.ndarray,
    most: np.ndarray,
) -> None:
    """Write the factors of rows of nodes, uncoupled from each other.

    Parameters
    ----------
    offsets, film_offsets : ndarray of int, shapes (n, 2) and (m, 2)
        Steps to the neighbours along y and x.
    by_pressure, by_film : ndarray, shapes (nx, n, rows) and (nx, m, rows)
        Stencils: derivatives by pressure and film.
    free : ndarray, shape (nx, rows)
        1 where pressure is unknown; other nodes get the identity.
    local : ndarray, shape (3,)
        Deflection along a row 0, 1 and 2 nodes from a cell under unit pressure.
    across : ndarray, shape (5,)
        Share of it that neighbours 0 to 4 rows away see.
    rows
        First row of nodes and the one behind the last.
    band : ndarray, shape (nx, 9, rows)
        Result: L and U, the reciprocal of the diagonal in its place.
    most : ndarray, shape (rows,)
        Scratch memory, its values are lost.

    Notes
    -----
    No equations are exchanged. One of which another would have more than `LARGEST_SHARE` taken
    off gets a larger coefficient of its own node: lines are smoothed with it, no more.
    """
    nx = free.shape[0]
    for i in range(nx + BELOW):
        if i < nx:
            fill_band(
                offsets,
                by_pressure,
                film_offsets,
                by_film,
                free,
                local,
                across,
                i,
                rows[0],
                rows[1],
                band,
            )
        if i >= BELOW:
            factor_node(i - BELOW, rows[0], rows[1], band, most)


@line_kernel
def solve_rows(
    band: np.ndarray,
    free: np.ndarray,
    right: np.ndarray,
    scale: float,
    along: Links,
    rows: tuple[int, int],
    values: np.ndarray,
    means: np.ndarray,
) -> None:
    """Write the solution of rows of nodes, and its means around the nodes of a coarser grid.

    Parameters
    ----------
    band : ndarray, shape (nx, 9, rows)
        Of `factor_rows`.
    free, right : ndarray, shape (nx, rows)
        1 where pressure is unknown, else 0; right-hand side.
    scale
        Factor that scales the solution.
    along
        To the coarser grid.
    rows
        First row of nodes and the one behind the last.
    values : ndarray, shape (nx, rows)
        Result, 0 where pressure is known; may be `right`.
    means : ndarray, shape (coarse nx, rows)
        Result along the rows only.
    """
    nx, factor, low, high = free.shape[0], np.float32(scale), rows[0], rows[1]
    for i in range(nx):
        value, given, known = values[i, low:high], right[i, low:high], free[i, low:high]
        for j in range(value.size):
            value[j] = factor * given[j] * known[j]
        if i >= BELOW:
            for k in range(2, BELOW + 1, 2):
                a, b = band[i, BELOW - k, low:high], values[i - k, low:high]
                c, d = band[i, BELOW - k + 1, low:high], values[i - k + 1, low:high]
                for j in range(value.size):
                    value[j] -= a[j] * b[j] + c[j] * d[j]
        else:
            for k in range(1, i + 1):
                a, b = band[i, BELOW - k, low:high], values[i - k, low:high]
                for j in range(value.size):
                    value[j] -= a[j] * b[j]
    to = means.shape[0] - 1
    for i in range(nx - 1, -1, -1):
        value = values[i, low:high]
        if i < nx - BELOW:
            for k in range(2, BELOW + 1, 2):
                a, b = band[i, BELOW + k, low:high], values[i + k, low:high]
                c, d = band[i, BELOW + k - 1, low:high], values[i + k - 1, low:high]
                for j in range(value.size):
                    value[j] -= a[j] * b[j] + c[j] * d[j]
        else:
            for k in range(1, nx - i):
                a, b = band[i, BELOW + k, low:high], values[i + k, low:high]
                for j in range(value.size):
                    value[j] -= a[j] * b[j]
        pivot = band[i, BELOW, low:high]
        for j in range(value.size):
            value[j] *= pivot[j]
        while to >= 0 and along.fine[along.start[to]] >= i:
            total = means[to, low:high]
            for j in range(total.size):
                total[j] = np.float32(0.0)
            for k in range(along.start[to], along.start[to + 1]):
                weight, of = along.weight[k], values[along.fine[k], low:high]
                for j in range(total.size):
                    total[j] += weight * of[j]
            to -= 1
