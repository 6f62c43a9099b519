"""One grid of a multigrid cycle with rows of nodes side by side: kernels.

Arrays are as in `column_stencils`. Fields that neighbours are read from have shape
(nx, rows + 2 HALO): rows beyond both ends hold what the film has there.

Work is shared by rows (lines are solved, `column_factors`) and by columns. A part of the columns
computes what it needs of the columns beside it again; both parts then write the same values.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.ehl.point.newton.column_factors import (
    REACH,
    Links,
    columns_around,
    interpolate_across,
    mean_across,
    solve_rows,
)
from gearlube_core.kernels.line_kernel import line_kernel

HALO = 8  # rows beyond each end
_RING = 8  # columns that are kept, a power of two: those around a node, those around a coarse one
SPARE = 2 * _RING + 1  # columns of scratch memory of a part


class ColumnGrid(NamedTuple):
    """Work arrays of one multigrid level, of shape (nx, rows) unless stated."""

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
    rest: np.ndarray  # and the line solutions that it becomes
    pressure: np.ndarray  # (nx, rows + 2 HALO)
    film: np.ndarray  # likewise
    change: np.ndarray  # likewise, of the pressure, by the last lines
    half: np.ndarray  # (coarse nx, rows)
    back: np.ndarray  # likewise
    sums: np.ndarray  # (nx,), of the pressure of the first lines over the rows


@line_kernel
def fill_halo(own: np.ndarray, row: np.ndarray) -> None:
    """Write the rows of a column beyond both ends."""
    last = row.size - HALO
    for j in range(HALO):
        row[j] = row[own[j] + HALO]
        row[last + j] = row[own[last + j] + HALO]


@line_kernel
def subtract_smooth_part(
    grid: ColumnGrid, rows: int, i: int, done: int, spare: np.ndarray, result: np.ndarray
) -> int:
    """Write column i of the line solutions without what the coarser grid represents.

    Parameters
    ----------
    grid
        Line solutions are in `rest`, their means along the rows in `half`.
    rows
        Of the coarser grid.
    i
        Node of a row.
    done
        First coarse column that was not yet taken to the coarser rows and back.
    spare
        Scratch memory, its values are lost.
    result : ndarray, shape (nx, rows + 2 HALO)
        Result; rows beyond both ends are left.

    Returns
    -------
    int
        The new `done`.
    """
    c, weight, d, other = columns_around(grid.along, i)
    fine = grid.half.shape[1]
    if rows == fine:
        a, b = grid.half[c, :fine], grid.half[d, :fine]
    else:
        mirrored = grid.own[HALO - 1] == 0  # the row before the first is its own image
        while done <= max(c, d):
            mean_across(grid.across, grid.half[done, :fine], spare[:rows])
            interpolate_across(grid.across, spare[:rows], mirrored, grid.back[done, :fine])
            done += 1
        a, b = grid.back[c, :fine], grid.back[d, :fine]
    value, line, known = result[i, HALO : HALO + fine], grid.rest[i], grid.free[i]
    for j in range(fine):
        value[j] = (line[j] - weight * a[j] - other * b[j]) * known[j]
    return done


@line_kernel
def reach_along(offsets: np.ndarray) -> int:
    """Return the largest step along x."""
    reach = 0
    for k in range(offsets.shape[0]):
        reach = max(reach, abs(offsets[k, 1]))
    return reach


@line_kernel
def add_neighbours(
    offsets: np.ndarray, weights: np.ndarray, values: np.ndarray, i: int, total: np.ndarray
) -> None:
    """Add weighted neighbours of column i; values of shape (nx, rows + 2 HALO)."""
    nx, rows, reach = values.shape[0], total.size, reach_along(offsets)
    k, count = 0, weights.size
    if reach <= i < nx - reach:
        while k + 3 < count:
            low = HALO + offsets[k, 0]
            a, p = values[i + offsets[k, 1], low : low + rows], weights[k]
            low = HALO + offsets[k + 1, 0]
            b, q = values[i + offsets[k + 1, 1], low : low + rows], weights[k + 1]
            low = HALO + offsets[k + 2, 0]
            c, r = values[i + offsets[k + 2, 1], low : low + rows], weights[k + 2]
            low = HALO + offsets[k + 3, 0]
            d, s = values[i + offsets[k + 3, 1], low : low + rows], weights[k + 3]
            for j in range(rows):
                total[j] += p * a[j] + q * b[j] + r * c[j] + s * d[j]
            k += 4
    while k < count:
        ii = i + offsets[k, 1]
        if 0 <= ii < nx:
            low = HALO + offsets[k, 0]
            a, p = values[ii, low : low + rows], weights[k]
            for j in range(rows):
                total[j] += p * a[j]
        k += 1


@line_kernel
def subtract_products(
    offsets: np.ndarray,
    slopes: np.ndarray,
    values: np.ndarray,
    ring: int,
    nx: int,
    i: int,
    total: np.ndarray,
) -> None:
    """Subtract the slopes of column i, (n, rows), times neighbours; column ii is at ii & `ring`."""
    k, count, rows = 0, offsets.shape[0], total.size
    if REACH <= i < nx - REACH:
        while k + 1 < count:
            low, also = HALO + offsets[k, 0], HALO + offsets[k + 1, 0]
            a, p = values[(i + offsets[k, 1]) & ring, low : low + rows], slopes[k, :rows]
            b, q = values[(i + offsets[k + 1, 1]) & ring, also : also + rows], slopes[k + 1, :rows]
            for j in range(rows):
                total[j] -= p[j] * a[j] + q[j] * b[j]
            k += 2
    while k < count:
        ii = i + offsets[k, 1]
        if 0 <= ii < nx:
            low = HALO + offsets[k, 0]
            a, p = values[ii & ring, low : low + rows], slopes[k, :rows]
            for j in range(rows):
                total[j] -= p[j] * a[j]
        k += 1


@line_kernel
def sum_of(values: np.ndarray, spare: np.ndarray) -> float:
    """Return a sum of up to 2 x 2048 values; scratch memory of at least half as many is taken."""
    width = values.size // 2
    for j in range(width):
        spare[j] = values[j] + values[j + width]
    total = float(values[2 * width]) if values.size % 2 else 0.0
    while width > 8 and width % 2 == 0:
        width //= 2
        for j in range(width):
            spare[j] += spare[j + width]
    for j in range(width):
        total += float(spare[j])
    return total


@line_kernel
def descend(grid: ColumnGrid, part: tuple[int, int], spare: np.ndarray, below: np.ndarray) -> None:
    """Write pressure and film of the first lines, and what they leave on the coarser grid.

    Parameters
    ----------
    grid
        Grid whose lines are solved.
    part
        First column of the coarser grid that is written and the one behind the last.
    spare : ndarray, shape (SPARE, rows + 2 HALO)
        Scratch memory, its values are lost.
    below : ndarray, shape (coarse nx, coarse rows)
        Right-hand side of the coarser grid.
    """
    along, (nx, rows) = grid.along, grid.free.shape
    fewer, reach = below.shape[1], reach_along(grid.short_offsets)
    near, left, line = spare[:_RING], spare[_RING : 2 * _RING], spare[2 * _RING]
    first, last = along.start[part[0]], along.start[part[1]] - 1
    bent = max(along.fine[first] - REACH, 0), min(along.fine[last] + REACH + 1, nx)
    ahead = max(bent[0] - reach, 0)
    done = min(along.coarse[ahead + REACH, 0], grid.half.shape[0] - 1)
    for i in range(bent[0], bent[1]):
        while ahead <= min(i + reach, nx - 1):
            done = subtract_smooth_part(grid, fewer, ahead, done, line, grid.pressure)
            column = grid.pressure[ahead]
            grid.sums[ahead] = sum_of(column[HALO : HALO + rows], line)
            fill_halo(grid.repeated, column)
            ahead += 1
        total, value = line[HALO : HALO + rows], grid.film[i]
        for j in range(rows):
            total[j] = np.float32(0.0)
        add_neighbours(grid.short_offsets, grid.short_weights, grid.pressure, i, total)
        for j in range(rows):
            value[HALO + j] = total[j]
        fill_halo(grid.own, value)
    ahead, after = bent[0], along.fine[first]
    for to in range(part[0], part[1]):
        start, end = along.start[to], along.start[to + 1]
        while after <= along.fine[end - 1]:
            while ahead <= min(after + REACH, nx - 1):
                # beyond both ends solids repeat where the film may not
                value, of = near[ahead & (_RING - 1)], grid.pressure[ahead]
                for j in range(HALO, HALO + rows):
                    value[j] = of[j]
                fill_halo(grid.own, value)
                ahead += 1
            rest, given = left[after & (_RING - 1), :rows], grid.right[after]
            for j in range(rows):
                rest[j] = given[j]
            subtract_products(
                grid.offsets, grid.by_pressure[after], near, _RING - 1, nx, after, rest
            )
            subtract_products(
                grid.film_offsets, grid.by_film[after], grid.film, -1, nx, after, rest
            )
            after += 1
        total, mean = line[:rows], below[to]
        for j in range(rows):
            total[j] = np.float32(0.0)
        for k in range(start, end):
            of, weight = left[along.fine[k] & (_RING - 1)], along.weight[k]
            for j in range(rows):
                total[j] += weight * of[j]
        if fewer < rows:
            mean_across(grid.across, total, mean)
        else:
            for j in range(rows):
                mean[j] = total[j]


@line_kernel
def add_coarser(
    grid: ColumnGrid, part: tuple[int, int], pressure: np.ndarray, film: np.ndarray, halo: int
) -> None:
    """Add the pressure and the film of the coarser grid.

    Parameters
    ----------
    grid
        After `descend`.
    part
        First column that is written and the one behind the last.
    pressure, film
        Of the coarser grid, with `halo` rows beyond its ends, which are not read.
    """
    rows = grid.free.shape[1]
    fewer, mirrored = pressure.shape[1] - 2 * halo, grid.own[HALO - 1] == 0
    done = min(grid.along.coarse[part[0] + REACH, 0], grid.half.shape[0] - 1)
    for i in range(part[0], part[1]):
        c, weight, d, other = columns_around(grid.along, i)
        if fewer == rows:
            a, b = pressure[c, halo : halo + rows], pressure[d, halo : halo + rows]
            e, f = film[c, halo : halo + rows], film[d, halo : halo + rows]
        else:
            while done <= max(c, d):
                of, to = pressure[done, halo : halo + fewer], grid.half[done, :rows]
                interpolate_across(grid.across, of, mirrored, to)
                of, to = film[done, halo : halo + fewer], grid.back[done, :rows]
                interpolate_across(grid.across, of, mirrored, to)
                done += 1
            a, b = grid.half[c, :rows], grid.half[d, :rows]
            e, f = grid.back[c, :rows], grid.back[d, :rows]
        value, known = grid.pressure[i], grid.free[i]
        for j in range(rows):
            value[HALO + j] += (weight * a[j] + other * b[j]) * known[j]
        fill_halo(grid.own, value)
        value = grid.film[i]
        for j in range(rows):
            value[HALO + j] += weight * e[j] + other * f[j]
        fill_halo(grid.own, value)


@line_kernel
def subtract_changes(grid: ColumnGrid, part: tuple[int, int], approach: float) -> None:
    """Write into `rest` what pressure, film and approach leave of `right`, in some columns."""
    nx, rows = grid.free.shape
    rise = np.float32(approach)
    for i in range(part[0], part[1]):
        rest, given, of = grid.rest[i], grid.right[i], grid.by_approach[i]
        for j in range(rows):
            rest[j] = given[j] - rise * of[j]
        subtract_products(grid.offsets, grid.by_pressure[i], grid.pressure, -1, nx, i, rest)
        subtract_products(grid.film_offsets, grid.by_film[i], grid.film, -1, nx, i, rest)


@line_kernel
def finish(
    grid: ColumnGrid, part: tuple[int, int], fewer: int, bend: bool, spare: np.ndarray
) -> None:
    """Add the last lines to the pressure, and with `bend` to the film.

    Parameters
    ----------
    grid
        Grid whose lines are solved.
    part
        First column that is written and the one behind the last.
    fewer
        Rows of the coarser grid.
    bend
        Add to the film.
    spare : ndarray, shape (SPARE, rows + 2 HALO)
        Scratch memory, its values are lost.
    """
    nx, rows = grid.free.shape
    reach = reach_along(grid.short_offsets) if bend else 0
    line = spare[0]
    ahead = max(part[0] - reach, 0)
    done = min(grid.along.coarse[ahead + REACH, 0], grid.half.shape[0] - 1)
    for i in range(part[0], part[1]):
        while ahead <= min(i + reach, nx - 1):
            done = subtract_smooth_part(grid, fewer, ahead, done, line, grid.change)
            if bend:
                fill_halo(grid.repeated, grid.change[ahead])
            ahead += 1
        value, more = grid.pressure[i], grid.change[i]
        for j in range(HALO, HALO + rows):
            value[j] += more[j]
        if bend:
            total = grid.film[i, HALO : HALO + rows]
            add_neighbours(grid.short_offsets, grid.short_weights, grid.change, i, total)


@line_kernel
def descend_alone(grid: ColumnGrid, scale: float, spare: np.ndarray, below: np.ndarray) -> None:
    """Smooth a whole grid, and write what is left on the coarser one; see `descend`."""
    rows = 0, grid.free.shape[1]
    solve_rows(grid.band, grid.free, grid.right, scale, grid.along, rows, grid.rest, grid.half)
    descend(grid, (0, below.shape[0]), spare, below)


@line_kernel
def ascend_alone(
    grid: ColumnGrid,
    scale: float,
    approach: float,
    pressure: np.ndarray,
    film: np.ndarray,
    halo: int,
    bend: bool,
    spare: np.ndarray,
) -> None:
    """Add the coarser grid to a whole one, and smooth it again; see `add_coarser`, `finish`."""
    columns, rows = (0, grid.free.shape[0]), (0, grid.free.shape[1])
    add_coarser(grid, columns, pressure, film, halo)
    subtract_changes(grid, columns, approach)
    solve_rows(grid.band, grid.free, grid.rest, scale, grid.along, rows, grid.rest, grid.half)
    finish(grid, columns, pressure.shape[1] - 2 * halo, bend, spare)
