"""Stencils of a preconditioner with rows of nodes side by side: building them, kernels.

All arrays are float32 and have the node of a row first and the row last, so that one instruction
takes many rows. Rows are those of the film, without copied ones. Of 25 neighbours, that at
(dj, di) has the place 5 (dj + 2) + di + 2. Whole stencils have shape (25, nx, rows), packed ones
(nx, n, rows): what a node needs stands together. Columns are nodes beside each other along y; what
threads share are parts of them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.ehl.point.newton.column_factors import REACH, TILE, Links
from gearlube_core.kernels.line_kernel import line_kernel

WIDTH = 2 * REACH + 1
PLACES = WIDTH * WIDTH
CENTRE = PLACES // 2


@line_kernel
def turn_derivatives(
    slopes: np.ndarray,
    offsets: np.ndarray,
    free: np.ndarray,
    own: np.ndarray,
    masked: bool,
    first: int,
    rows: tuple[int, int],
    result: np.ndarray,
) -> None:
    """Write the derivatives of free nodes with rows side by side.

    Parameters
    ----------
    slopes : ndarray, shape (n, ny, nx)
        Derivatives by neighbour; rows of nodes that are not free are zero.
    offsets : ndarray of int, shape (m, 2), m >= n
        Steps to the neighbours along y and x.
    free : ndarray of bool, shape (ny, nx)
        Where pressure is unknown.
    own : ndarray of int, shape (rows + 2 REACH,)
        Row that holds each row, from -REACH to REACH beyond the last.
    masked
        Leave out neighbours that are not free.
    first
        Row of `slopes` that is row 0 of the result.
    rows
        First row of the result that is written and the one behind the last.
    result : ndarray, shape (25, nx, rows)
        Result; neighbours that `offsets` does not have are left as they are.
    """
    nx = result.shape[1]
    for k in range(slopes.shape[0]):
        dj, di = offsets[k, 0], offsets[k, 1]
        place = (dj + REACH) * WIDTH + di + REACH
        for i0 in range(0, nx, TILE):
            end = min(i0 + TILE, nx)
            for j in range(rows[0], rows[1]):
                of, known = slopes[k, j + first], free[own[j + dj + REACH] + first]
                for i in range(i0, end):
                    result[place, i, j] = np.float32(of[i])
                if masked:
                    for i in range(i0, end):
                        if not known[min(max(i + di, 0), nx - 1)]:
                            result[place, i, j] = np.float32(0.0)


@line_kernel
def reached_neighbours(
    links: Links, used: np.ndarray, nodes: int, coarse: int, reached: np.ndarray
) -> None:
    """Tell which neighbours stencils get on a grid with fewer nodes to a row.

    Parameters
    ----------
    links
        To the coarser grid.
    used : ndarray of bool, shape (25,)
        Neighbours that the fine stencils have.
    nodes, coarse
        Nodes of a row of both grids.
    reached : ndarray of bool, shape (25,)
        Result: places that the stencil reaches.
    """
    reached[:] = False
    for to in range(coarse):
        for k in range(links.start[to], links.start[to + 1]):
            for place in range(PLACES):
                ii = links.fine[k] + place % WIDTH - REACH
                if not used[place] or not 0 <= ii < nodes:
                    continue
                for m in range(2):
                    step = links.coarse[ii + REACH, m] - to
                    if links.share[ii + REACH, m] != 0.0 and abs(step) <= REACH:
                        reached[place // WIDTH * WIDTH + REACH + step] = True


@line_kernel
def coarsen_column(
    links: Links,
    fine: np.ndarray,
    used: np.ndarray,
    reached: np.ndarray,
    to: int,
    coarse: np.ndarray,
) -> None:
    """Write the stencils of column `to` of a grid with fewer nodes to a row.

    Parameters
    ----------
    links
        To the coarser grid.
    fine, coarse : ndarray, shapes (25, fine nx, rows) and (25, coarse nx, rows)
        Stencils; those of neighbours that are not reached are left as they are.
    used, reached : ndarray of bool, shape (25,)
        Neighbours that the fine stencils have, and that the coarse ones get.
    to
        Coarse node of a row.
    """
    nodes = fine.shape[1]
    for place in range(PLACES):
        if reached[place]:
            total = coarse[place, to]
            for j in range(total.size):
                total[j] = np.float32(0.0)
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
                total, of = coarse[middle + step, to], fine[place, i]
                for j in range(total.size):
                    total[j] += weight * of[j]


@line_kernel
def coarsen_across(links: Links, fine: np.ndarray, used: np.ndarray, coarse: np.ndarray) -> None:
    """Write the stencils of a grid with fewer rows, shapes (25, nx, rows).

    `used`, shape (25,), marks the neighbours that the fine stencils have.
    """
    rows = coarse.shape[2]
    coarse[:] = np.float32(0.0)
    for to in range(rows):
        for k in range(links.start[to], links.start[to + 1]):
            j = links.fine[k]
            for place in range(PLACES):
                if not used[place]:
                    continue
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


@line_kernel
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
        Stencils: derivatives by pressure and film.
    used : ndarray of bool, shape (2, 25)
        Neighbours that they have, by pressure and by film.
    deflection
        Of a node under unit pressure on its own cell.
    stride
        Every so many-th node of a row is looked at.
    most : ndarray, shape (rows,)
        Scratch memory, its values are lost.
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


@line_kernel
def pack_column(
    whole: np.ndarray, used: np.ndarray, kept: np.ndarray, i: int, packed: np.ndarray
) -> None:
    """Write the stencils of column i with the places kept; what is left out goes to the node.

    Parameters
    ----------
    whole : ndarray, shape (25, nx, rows)
        Stencils of all 25 places.
    used, kept : ndarray of bool, shape (25,)
        Neighbours that there are, and those that are kept; the node itself is one.
    i
        Node of a row.
    packed : ndarray, shape (n, rows)
        Result, of the n places kept.
    """
    n = here = 0
    for place in range(PLACES):
        if kept[place]:
            if place == CENTRE:
                here = n
            of, to = whole[place, i], packed[n]
            for j in range(to.size):
                to[j] = of[j]
            n += 1
    centre = packed[here]
    for place in range(PLACES):
        if used[place] and not kept[place]:
            left = whole[place, i]
            for j in range(centre.size):
                centre[j] += left[j]


@line_kernel
def column_bound(links: Links, to: int, nodes: int) -> int:
    """Return the first of the fine columns that go with the coarse one `to` and those after it."""
    if to == 0:
        return 0
    return nodes if to >= links.start.size - 1 else int(links.fine[links.start[to]])


class Stencils(NamedTuple):
    """Derivatives by pressure or by film, on a grid, packed and on the next one along x."""

    whole: np.ndarray  # (25, nx, rows)
    used: np.ndarray  # bool, (25,), neighbours that there are
    kept: np.ndarray  # bool, (25,), and that are kept
    packed: np.ndarray  # (nx, n, rows)
    reached: np.ndarray  # bool, (25,), neighbours on the coarser grid
    coarse: np.ndarray  # (25, coarse nx, rows)


@line_kernel
def pack_and_coarsen(
    links: Links, by_pressure: Stencils, by_film: Stencils, part: tuple[int, int]
) -> None:
    """Write the packed stencils of a grid, and those of one with fewer nodes to a row.

    Parameters
    ----------
    links
        To the coarser grid.
    by_pressure, by_film
        Stencils: derivatives by pressure and film.
    part
        First column of the coarser grid and the one behind the last.
    """
    nodes = by_film.whole.shape[1]
    for to in range(part[0], part[1]):
        for i in range(column_bound(links, to, nodes), column_bound(links, to + 1, nodes)):
            pack_column(
                by_pressure.whole, by_pressure.used, by_pressure.kept, i, by_pressure.packed[i]
            )
            pack_column(by_film.whole, by_film.used, by_film.kept, i, by_film.packed[i])
        coarsen_column(
            links, by_pressure.whole, by_pressure.used, by_pressure.reached, to, by_pressure.coarse
        )
        coarsen_column(links, by_film.whole, by_film.used, by_film.reached, to, by_film.coarse)
