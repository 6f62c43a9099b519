"""Fields with rows of nodes side by side: turned, and between two grids, kernels.

Arrays are float32 and have the node of a row first and the row last, (nx, rows); columns are nodes
beside each other along y.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.kernels.line_kernel import line_kernel

REACH = 2  # nodes that a stencil reaches to each side
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
