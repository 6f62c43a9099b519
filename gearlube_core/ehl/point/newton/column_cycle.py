"""One grid of a multigrid cycle with rows of nodes side by side: kernels.

Arrays are as in `column_stencils`. Fields that neighbours are read from have shape
(nx, rows + 2 HALO): rows beyond both ends hold what the film has there.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.ehl.point.newton.column_stencils import BELOW, REACH, Links
from gearlube_core.kernels.jit import kernel

HALO = 8  # rows beyond each end


class ColumnGrid(NamedTuple):
    """What one grid has for the cycle; arrays of shape (nx, rows) unless said."""

    offsets: np.ndarray  # int, (n, 2), steps along y and x
    by_pressure: np.ndarray  # (nx, n, rows)
    film_offsets: np.ndarray
    by_film: np.ndarray
    by_approach: np.ndarray
    band: np.ndarray  # (nx, 9, rows), factors
    free: np.ndarray  # 1 where pressure is unknown, else 0
    short_offsets: np.ndarray  # int, (k, 2), deflection under short waves of pressure
    short_weights: np.ndarray  # (k,)
    own: np.ndarray  # int, (rows + 2 HALO,), row that holds each row of the film
    repeated: np.ndarray  # and of the solids, which always repeat
    along: Links  # to the coarser grid
    across: Links
    right: np.ndarray
    rest: np.ndarray
    pressure: np.ndarray  # (nx, rows + 2 HALO)
    change: np.ndarray  # likewise
    film: np.ndarray  # likewise
    half: np.ndarray  # (coarse nx, rows)
    coarse: np.ndarray  # (coarse nx, coarse rows)


@kernel
def fill_halo(own: np.ndarray, values: np.ndarray) -> None:
    """Write the rows beyond both ends."""
    last = values.shape[1] - HALO
    for i in range(values.shape[0]):
        row = values[i]
        for j in range(HALO):
            row[j] = row[own[j] + HALO]
            row[last + j] = row[own[last + j] + HALO]


@kernel
def solve_bands(
    band: np.ndarray, free: np.ndarray, right: np.ndarray, scale: float, change: np.ndarray
) -> None:
    """Write the solution with factored bands times `scale`; other nodes than free ones get 0."""
    nx, rows = free.shape
    factor = np.float32(scale)
    for i in range(nx):
        value, given, known = change[i, HALO : HALO + rows], right[i], free[i]
        for j in range(rows):
            value[j] = given[j] * known[j]
        for k in range(1, min(BELOW, i) + 1):
            low, before = band[i, BELOW - k], change[i - k, HALO : HALO + rows]
            for j in range(rows):
                value[j] -= low[j] * before[j]
    for i in range(nx - 1, -1, -1):
        value = change[i, HALO : HALO + rows]
        for k in range(1, min(BELOW, nx - 1 - i) + 1):
            above, behind = band[i, BELOW + k], change[i + k, HALO : HALO + rows]
            for j in range(rows):
                value[j] -= above[j] * behind[j]
        pivot = band[i, BELOW]
        for j in range(rows):
            value[j] *= pivot[j]
    for i in range(nx):
        value = change[i, HALO : HALO + rows]
        for j in range(rows):
            value[j] *= factor


@kernel
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
    if coarse.shape[1] == rows:
        coarse[:] = half
        return
    for i in range(coarse.shape[0]):
        for to in range(coarse.shape[1]):
            mean = np.float32(0.0)
            for k in range(across.start[to], across.start[to + 1]):
                mean += across.weight[k] * half[i, across.fine[k]]
            coarse[i, to] = mean


@kernel
def held_row(row: int, rows: int, mirrored: bool) -> int:
    """Return the row that holds one beyond an end: of a film that repeats, or mirrored."""
    if 0 <= row < rows:
        return row
    if row < 0:
        return -1 - row if mirrored else row + rows
    return 2 * rows - 1 - row if mirrored else row - rows


@kernel
def add_interpolated(
    grid: ColumnGrid, coarse: np.ndarray, halo: int, sign: float, fine: np.ndarray
) -> None:
    """Add a coarser grid's field, linear between its nodes, to one with halos.

    `coarse` has `halo` rows beyond its ends, which are not read.
    """
    along, across, half = grid.along, grid.across, grid.half
    mirrored = grid.own[HALO - 1] == 0  # the row before the first is its own image
    rows = half.shape[1]
    fewer = coarse.shape[1] - 2 * halo
    if fewer == rows:
        for i in range(half.shape[0]):
            half[i] = coarse[i, halo : halo + rows]
    else:
        for i in range(half.shape[0]):
            for j in range(rows):
                value = np.float32(0.0)
                for m in range(2):
                    at = across.coarse[j + REACH, m]
                    value += (
                        across.share[j + REACH, m] * coarse[i, halo + held_row(at, fewer, mirrored)]
                    )
                half[i, j] = value
    factor = np.float32(sign)
    for i in range(fine.shape[0]):
        total = fine[i, HALO : HALO + rows]
        for m in range(2):
            weight = factor * along.share[i + REACH, m]
            if weight == 0.0:
                continue
            of = half[along.coarse[i + REACH, m]]
            for j in range(rows):
                total[j] += weight * of[j]


@kernel
def smooth(grid: ColumnGrid, right: np.ndarray, scale: float) -> None:
    """Write into `change` the line solutions without what the coarser grid represents."""
    change, free = grid.change, grid.free
    rows = free.shape[1]
    solve_bands(grid.band, free, right, scale, change)
    restrict(grid.along, grid.across, change[:, HALO : HALO + rows], grid.half, grid.coarse)
    add_interpolated(grid, grid.coarse, 0, -1.0, change)
    for i in range(free.shape[0]):
        value, known = change[i, HALO : HALO + rows], free[i]
        for j in range(rows):
            value[j] *= known[j]


@kernel
def add_short_deflection(grid: ColumnGrid, pressure: np.ndarray, film: np.ndarray) -> None:
    """Add the deflection under short waves of a pressure; solids repeat beyond both ends."""
    fill_halo(grid.repeated, pressure)
    nx, rows = grid.free.shape
    offsets, weights = grid.short_offsets, grid.short_weights
    for i in range(nx):
        total = film[i, HALO : HALO + rows]
        for k in range(weights.size):
            ii = i + offsets[k, 1]
            if 0 <= ii < nx:
                low = HALO + offsets[k, 0]
                of, weight = pressure[ii, low : low + rows], weights[k]
                for j in range(rows):
                    total[j] += weight * of[j]


@kernel
def subtract_changes(grid: ColumnGrid, approach: float) -> None:
    """Write into `rest` what pressure, film and approach leave of `right`."""
    nx, rows = grid.free.shape
    rise = np.float32(approach)
    for i in range(nx):
        total, of = grid.rest[i], grid.by_approach[i]
        given = grid.right[i]
        for j in range(rows):
            total[j] = given[j] - rise * of[j]
        for k in range(grid.offsets.shape[0]):
            ii = i + grid.offsets[k, 1]
            if 0 <= ii < nx:
                low = HALO + grid.offsets[k, 0]
                slope, value = grid.by_pressure[i, k], grid.pressure[ii, low : low + rows]
                for j in range(rows):
                    total[j] -= slope[j] * value[j]
        for k in range(grid.film_offsets.shape[0]):
            ii = i + grid.film_offsets[k, 1]
            if 0 <= ii < nx:
                low = HALO + grid.film_offsets[k, 0]
                slope, value = grid.by_film[i, k], grid.film[ii, low : low + rows]
                for j in range(rows):
                    total[j] -= slope[j] * value[j]


@kernel
def descend(grid: ColumnGrid, scale: float, below: np.ndarray) -> float:
    """Smooth, and write the rest on the coarser grid, `below`; return the sum of the pressure."""
    smooth(grid, grid.right, scale)
    grid.pressure[:] = grid.change
    grid.film[:] = np.float32(0.0)
    add_short_deflection(grid, grid.pressure, grid.film)
    fill_halo(grid.own, grid.pressure)
    fill_halo(grid.own, grid.film)
    subtract_changes(grid, 0.0)
    restrict(grid.along, grid.across, grid.rest, grid.half, below)
    rows, total = grid.free.shape[1], 0.0
    for i in range(grid.free.shape[0]):
        total += float(grid.pressure[i, HALO : HALO + rows].sum())
    return total


@kernel
def ascend(
    grid: ColumnGrid,
    scale: float,
    approach: float,
    pressure: np.ndarray,
    film: np.ndarray,
    halo: int,
    bend: bool,
) -> None:
    """Add the coarser grid's pressure and film, smooth again; with `bend` the film follows."""
    rows = grid.free.shape[1]
    change = grid.change
    change[:] = np.float32(0.0)
    add_interpolated(grid, pressure, halo, 1.0, change)
    for i in range(grid.free.shape[0]):
        total = grid.pressure[i, HALO : HALO + rows]
        value, known = change[i, HALO : HALO + rows], grid.free[i]
        for j in range(rows):
            total[j] += value[j] * known[j]
    fill_halo(grid.own, grid.pressure)
    add_interpolated(grid, film, halo, 1.0, grid.film)
    fill_halo(grid.own, grid.film)
    subtract_changes(grid, approach)
    smooth(grid, grid.rest, scale)
    grid.pressure[:] += change
    if bend:
        add_short_deflection(grid, change, grid.film)
        fill_halo(grid.own, grid.film)


@kernel
def turn_back(pressure: np.ndarray, first: int, unit: float, result: np.ndarray) -> None:
    """Write a pressure with halos times `unit` as a field of shape (ny, nx), zero on entry."""
    nx = pressure.shape[0]
    rows = pressure.shape[1] - 2 * HALO
    for i0 in range(0, nx, 32):
        for j in range(rows):
            for i in range(i0, min(i0 + 32, nx)):
                result[j + first, i] = unit * pressure[i, j + HALO]
