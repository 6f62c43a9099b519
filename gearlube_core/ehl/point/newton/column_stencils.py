"""Stencils of a preconditioner with rows of nodes side by side: building them, kernels.

All arrays are float32 and have the node of a row first and the row last, so that one instruction
takes many rows. Rows are those of the film, without copied ones. Of 25 neighbours, that at
(dj, di) has the place 5 (dj + 2) + di + 2. Whole stencils have shape (25, nx, rows), packed ones
(nx, n, rows): what a node needs stands together.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel

REACH = 2  # nodes that a stencil reaches to each side
WIDTH = 2 * REACH + 1
PLACES = WIDTH * WIDTH
CENTRE = PLACES // 2
BELOW = 4  # nodes to each side that a node of a row depends on
_TILE = 32  # rows and columns that are turned at once: they stay in the nearest cache


class Links(NamedTuple):
    """Linear interpolation along one axis, and its transpose as means."""

    # both coarse nodes and their shares, for fine nodes from -REACH to REACH beyond the last;
    # beyond both ends they go on
    coarse: np.ndarray  # int, (fine + 2 REACH, 2)
    share: np.ndarray  # float32, (fine + 2 REACH, 2)
    start: np.ndarray  # int, of the fine nodes of every coarse one, (coarse + 1,)
    fine: np.ndarray  # int
    weight: np.ndarray  # float32


@kernel
def turn_field(values: np.ndarray, first: int, unit: float, result: np.ndarray) -> None:
    """Write a field, (ny, nx), times `unit` with rows side by side, (nx, rows), from `first` on."""
    nx, rows = result.shape
    for i0 in range(0, nx, _TILE):
        for j in range(rows):
            for i in range(i0, min(i0 + _TILE, nx)):
                result[i, j] = np.float32(unit * values[j + first, i])


@kernel
def turn_stencils(
    slopes: np.ndarray,
    offsets: np.ndarray,
    free: np.ndarray,
    own: np.ndarray,
    masked: bool,
    first: int,
    result: np.ndarray,
) -> None:
    """Write the derivatives of free nodes with rows side by side.

    Parameters
    ----------
    slopes : ndarray, shape (n, ny, nx)
        Derivatives by neighbour; rows of nodes that are not free are zero.
    offsets : ndarray of int, shape (m, 2), m >= n
        Steps to the neighbours along y and x.
    free : ndarray, shape (nx, rows)
        1 where pressure is unknown, else 0.
    own : ndarray of int, shape (rows + 2 REACH,)
        Row that holds each row, from -REACH to REACH beyond the last.
    masked
        Leave out neighbours that are not free.
    first
        Row of `slopes` that is row 0 of the result.
    result : ndarray, shape (25, nx, rows)
        Result; neighbours that `offsets` does not have are left as they are.
    """
    _, nx, rows = result.shape
    for k in range(slopes.shape[0]):
        dj, di = offsets[k, 0], offsets[k, 1]
        place = (dj + REACH) * WIDTH + di + REACH
        for i0 in range(0, nx, _TILE):
            for j in range(rows):
                for i in range(i0, min(i0 + _TILE, nx)):
                    result[place, i, j] = np.float32(slopes[k, j + first, i])
        if not masked:
            continue
        for i in range(nx):
            ii = min(max(i + di, 0), nx - 1)
            for j in range(rows):
                result[place, i, j] *= free[ii, own[j + dj + REACH]]


@kernel
def coarsen_along(
    links: Links, fine: np.ndarray, used: np.ndarray, coarse: np.ndarray, reached: np.ndarray
) -> None:
    """Write the stencils of a grid with fewer nodes to a row, shapes (25, nx, rows).

    `used` and `reached`, shape (25,), tell which neighbours the fine stencils have, and the coarse
    ones get; others are left as they are.
    """
    nodes = fine.shape[1]
    reached[:] = False
    for adding in (False, True):
        for to in range(coarse.shape[1]):
            for k in range(links.start[to], links.start[to + 1]):
                i = links.fine[k]
                for place in range(PLACES):
                    ii = i + place % WIDTH - REACH
                    if not used[place] or not 0 <= ii < nodes:
                        continue
                    middle = place // WIDTH * WIDTH + REACH
                    for m in range(2):
                        step = links.coarse[ii + REACH, m] - to
                        weight = links.weight[k] * links.share[ii + REACH, m]
                        if weight == 0.0 or abs(step) > REACH:
                            continue
                        if not adding:
                            reached[middle + step] = True
                            continue
                        total, of = coarse[middle + step, to], fine[place, i]
                        for j in range(total.size):
                            total[j] += weight * of[j]
        if not adding:
            for place in range(PLACES):
                if reached[place]:
                    coarse[place] = np.float32(0.0)


@kernel
def coarsen_across(links: Links, fine: np.ndarray, coarse: np.ndarray) -> None:
    """Write the stencils of a grid with fewer rows, shapes (25, nx, rows)."""
    rows = coarse.shape[2]
    coarse[:] = np.float32(0.0)
    for to in range(rows):
        for k in range(links.start[to], links.start[to + 1]):
            j = links.fine[k]
            for place in range(PLACES):
                jj = j + place // WIDTH
                for m in range(2):
                    step = links.coarse[jj, m] - to
                    weight = links.weight[k] * links.share[jj, m]
                    # a mean may take rows from the other end, where a film repeats
                    if step > REACH:
                        step -= rows
                    elif step < -REACH:
                        step += rows
                    if weight == 0.0 or abs(step) > REACH:
                        continue
                    there = (step + REACH) * WIDTH + place % WIDTH
                    for i in range(coarse.shape[1]):
                        coarse[there, i, to] += weight * fine[place, i, j]


@kernel
def weigh_places(
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    used: np.ndarray,
    deflection: float,
    stride: int,
    most: np.ndarray,
    weight: np.ndarray,
) -> int:
    """Add up how much neighbours weigh; return the number of nodes with an equation.

    Parameters
    ----------
    by_pressure, by_film : ndarray, shape (25, nx, rows)
        Stencils.
    used : ndarray of bool, shape (2, 25)
        Neighbours that they have, by pressure and by film.
    deflection
        Of a node under unit pressure on its own cell.
    stride
        Every so many-th node of a row is looked at.
    most : ndarray, shape (rows,)
        Overwritten.
    weight : ndarray, shape (2, 25)
        Result, zero on entry: by pressure and by film. The neighbour that weighs most in the
        equation of its node adds 1.
    """
    own = np.float32(deflection)
    nodes = 0
    for i in range(stride // 2, by_film.shape[1], stride):
        most[:] = np.float32(0.0)
        for place in range(PLACES):
            if used[0, place]:
                p = by_pressure[place, i]
                for j in range(most.size):
                    most[j] = max(most[j], abs(p[j]))
            if used[1, place]:
                h = by_film[place, i]
                for j in range(most.size):
                    most[j] = max(most[j], own * abs(h[j]))
        for j in range(most.size):
            if most[j] > 0.0:
                nodes += 1
                most[j] = np.float32(1.0) / most[j]
        for place in range(PLACES):
            total = np.float32(0.0)
            if used[0, place]:
                p = by_pressure[place, i]
                for j in range(most.size):
                    total += abs(p[j]) * most[j]
                weight[0, place] += total
            total = np.float32(0.0)
            if used[1, place]:
                h = by_film[place, i]
                for j in range(most.size):
                    total += abs(h[j]) * most[j]
                weight[1, place] += own * total
    return nodes


@kernel
def pack_places(whole: np.ndarray, used: np.ndarray, kept: np.ndarray, packed: np.ndarray) -> None:
    """Write stencils, (nx, n, rows), of the n places kept; what is left out goes to the node.

    Parameters
    ----------
    whole : ndarray, shape (25, nx, rows)
        Stencils.
    used, kept : ndarray of bool, shape (25,)
        Neighbours that there are, and those that are kept; the node itself is one.
    packed : ndarray, shape (nx, n, rows)
        Result.
    """
    here = 0
    for place in range(CENTRE):
        if kept[place]:
            here += 1
    for i in range(whole.shape[1]):
        n = 0
        for place in range(PLACES):
            if kept[place]:
                packed[i, n] = whole[place, i]
                n += 1
        centre = packed[i, here]
        for place in range(PLACES):
            if used[place] and not kept[place]:
                left = whole[place, i]
                for j in range(centre.size):
                    centre[j] += left[j]


@kernel
def fill_bands(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    film_offsets: np.ndarray,
    by_film: np.ndarray,
    free: np.ndarray,
    local: np.ndarray,
    across: np.ndarray,
    band: np.ndarray,
) -> None:
    """Fill the bands of rows of nodes, uncoupled from each other.

    Parameters
    ----------
    offsets, film_offsets : ndarray of int, shapes (n, 2) and (m, 2)
        Steps to the neighbours along y and x.
    by_pressure, by_film : ndarray, shapes (nx, n, rows) and (nx, m, rows)
        Stencils.
    free : ndarray, shape (nx, rows)
        1 where pressure is unknown; other nodes get the identity.
    local : ndarray, shape (3,)
        Deflection along a row 0, 1 and 2 nodes from a cell under unit pressure.
    across : ndarray, shape (5,)
        Share of it that neighbours 0 to 4 rows away see.
    band : ndarray, shape (nx, 9, rows)
        Result: by node, place of the other node from -4 to 4, and row.
    """
    nx = free.shape[0]
    for i in range(nx):
        here = band[i]
        here[:] = np.float32(0.0)
        for k in range(offsets.shape[0]):
            ii = i + offsets[k, 1]
            if offsets[k, 0] == 0 and 0 <= ii < nx:
                total, of, known = here[BELOW + ii - i], by_pressure[i, k], free[ii]
                for j in range(total.size):
                    total[j] += of[j] * known[j]
        for k in range(film_offsets.shape[0]):
            ii = i + film_offsets[k, 1]
            if not 0 <= ii < nx:
                continue
            share = across[min(abs(film_offsets[k, 0]), 4)]
            for m in range(max(ii - REACH, 0), min(ii + REACH + 1, nx)):
                deflection = share * local[abs(ii - m)]
                total, of, known = here[BELOW + m - i], by_film[i, k], free[m]
                for j in range(total.size):
                    total[j] += of[j] * known[j] * deflection
        known = free[i]
        for place in range(2 * BELOW + 1):
            total = here[place]
            for j in range(total.size):
                total[j] *= known[j]
        total = here[BELOW]
        for j in range(total.size):
            total[j] += np.float32(1.0) - known[j]


@kernel
def factor_bands(band: np.ndarray, largest: np.ndarray) -> None:
    """Factor the bands of rows of nodes in place; the reciprocal of the diagonal stands in it.

    Parameters
    ----------
    band : ndarray, shape (nx, 9, rows)
        Of `fill_bands`; L and U on return.
    largest : ndarray, shape (rows,)
        Result: largest share of an equation that was taken off another, for every row of nodes.
    """
    nx = band.shape[0]
    largest[:] = np.float32(0.0)
    for i in range(nx):
        pivot = band[i, BELOW]
        for j in range(pivot.size):
            pivot[j] = np.float32(1.0) / pivot[j]
        for k in range(1, min(BELOW, nx - 1 - i) + 1):
            low = band[i + k, BELOW - k]
            for j in range(low.size):
                low[j] *= pivot[j]
            for j in range(low.size):
                # written so that what is no number counts as too large
                largest[j] = largest[j] if abs(low[j]) <= largest[j] else abs(low[j])
            for m in range(1, min(BELOW, nx - 1 - i) + 1):
                rest, above = band[i + k, BELOW - k + m], band[i, BELOW + m]
                for j in range(rest.size):
                    rest[j] -= low[j] * above[j]
