"""Patches of nodes around touching solids, solved exactly after a multigrid cycle.

Where solids touch, the film is given and a small change of it changes the pressure much. A
multigrid cycle takes its films from coarser grids, so it makes residuals within a few nodes of the
contact ten times larger. Small dense matrices with the whole deflection of a patch correct them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg.lapack import sgetrf, sgetrs
from scipy.ndimage import label
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.kernels.jit import kernel

_BESIDE, _ALONG = 2, 3  # nodes around touching ones that belong to their patch, along y and x
_LARGEST = 600  # nodes of a patch; a larger one is cut
_TILE = 24  # into so many rows and columns


@kernel
def fill_patch(
    nodes: np.ndarray,
    place: np.ndarray,
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    reach: np.ndarray,
    coefficients: np.ndarray,
    matrix: np.ndarray,
) -> None:
    """Fill the matrix of a patch: derivatives of its equations by the pressure of its nodes.

    Parameters
    ----------
    nodes : ndarray of int, shape (n, 2)
        Row and column of the nodes.
    place : ndarray of int, shape (ny, nx)
        Number of each node in the patch from 1 on; 0: it is not in it.
    offsets : ndarray of int, shape (m, 2), m >= k
        Steps to the neighbours along y and x.
    by_pressure, by_film : ndarray, shape (k, ny, nx)
        Derivatives by pressure and film.
    reach : ndarray of int, shape (ny + 2,)
        Of the sides: rows that hold those from one before the first to one behind the last.
    coefficients : ndarray
        Deflection under unit pressure on a cell by the number of rows and columns between.
    matrix : ndarray, shape (n, n)
        Result: matrix of the patch.
    """
    nx = place.shape[1]
    for a in range(nodes.shape[0]):
        j, i, row = nodes[a, 0], nodes[a, 1], matrix[a]
        row[:] = 0.0
        for k in range(by_film.shape[0]):
            there, to = reach[j + offsets[k, 0] + 1], i + offsets[k, 1]
            if not 0 <= to < nx:
                continue
            if place[there, to] > 0:
                row[place[there, to] - 1] += by_pressure[k, j, i]
            slope = by_film[k, j, i]
            if slope != 0.0:
                for b in range(row.size):
                    row[b] += slope * coefficients[abs(there - nodes[b, 0]), abs(to - nodes[b, 1])]


@kernel
def rest_of_patches(
    nodes: np.ndarray,
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
    reach: np.ndarray,
    pressure: np.ndarray,
    film: np.ndarray,
    approach: float,
    right: np.ndarray,
    rest: np.ndarray,
) -> None:
    """Write what is left of the equations of some nodes.

    Parameters
    ----------
    nodes, offsets, by_pressure, by_film, reach
        As in `fill_patch`.
    pressure, film, right : ndarray, shape (ny, nx)
        Change of the pressure, deflection under it, and right-hand side.
    approach
        Of the solids, which is added to the deflection.
    rest : ndarray, shape (n,)
        Result: residual of the patch.
    """
    nx = pressure.shape[1]
    for a in range(nodes.shape[0]):
        j, i = nodes[a, 0], nodes[a, 1]
        left = right[j, i]
        for k in range(by_film.shape[0]):
            there, to = reach[j + offsets[k, 0] + 1], i + offsets[k, 1]
            if 0 <= to < nx:
                left -= by_pressure[k, j, i] * pressure[there, to]
                left -= by_film[k, j, i] * (film[there, to] + approach)
        rest[a] = left


class TouchingPatches:
    """Patches of a linearisation around its touching nodes, and the factors of their matrices.

    Parameters
    ----------
    grid
        Grid with uniform spacing.
    linear
        Derivatives and touching nodes.
    """

    def __init__(self, grid: PointGrid, linear: Linearisation) -> None:
        assert linear.touching is not None
        number = patch_numbers(linear.touching, linear.free, linear.sides.name == "cyclic")
        nodes = np.argwhere(number)
        order = np.argsort(number[tuple(nodes.T)], kind="stable")
        self._nodes = nodes[order]
        sizes = np.bincount(number[tuple(nodes.T)])[1:]
        reach = linear.sides.reach(grid.shape[0])
        self._derivatives = linear.offsets, linear.by_pressure, linear.by_film, reach
        self._factors = []
        place = np.zeros(grid.shape, dtype=np.int32)
        end = 0
        for count in sizes:
            part = slice(end, end := end + count)
            at = tuple(self._nodes[part].T)
            # single precision is enough for a preconditioner
            matrix: Any = np.empty((count, count), dtype=np.float32)
            place[at] = np.arange(1, count + 1)
            fill_patch(self._nodes[part], place, *self._derivatives, grid.coefficients, matrix)
            place[at] = 0
            # fluidity falls by many orders of magnitude: equations over their largest coefficient
            scale = 1.0 / np.abs(matrix).max(axis=1)
            matrix *= scale[:, None]
            # of the transpose, as it lies in memory
            factors, pivots, singular = sgetrf(matrix.T, overwrite_a=True)
            if not singular:
                self._factors.append((part, at, scale, factors, pivots))

    def correct(self, right: Array, film: Array, approach: float, pressure: Array) -> None:
        """Add to a pressure, whose deflection is `film`, what the patches lack of `right`."""
        rest = np.empty(len(self._nodes))
        rest_of_patches(self._nodes, *self._derivatives, pressure, film, approach, right, rest)
        for part, at, scale, factors, pivots in self._factors:
            pressure[at] += sgetrs(factors, pivots, rest[part] * scale, trans=1)[0]


def patch_numbers(touching: Flags, free: Flags, cyclic: bool) -> Any:
    """Return the number of the patch of each node from 1 on, shape (ny, nx); 0: it has none.

    Parameters
    ----------
    touching, free : ndarray of bool, shape (ny, nx)
        Where solids touch, and where pressure is unknown; the first and last row hold nothing.
    cyclic
        True where rows repeat along y.
    """
    rows = touching.shape[0] - 2
    row = np.arange(-_BESIDE, rows + _BESIDE)
    inner = (
        touching[1:-1][row % rows] if cyclic else np.pad(touching[1:-1], ((_BESIDE,) * 2, (0, 0)))
    )
    inner = _widened(_widened(inner, _BESIDE).T, _ALONG).T[_BESIDE:-_BESIDE] & free[1:-1]
    number, count = label(inner, np.ones((3, 3)))
    if cyclic:
        # the first row goes on behind the last one
        beside = np.pad(number[-1], 1)
        links = [(number[0], beside[k : k + number.shape[1]]) for k in range(3)]
        a, b = np.concatenate(links, axis=1)
        graph = coo_matrix((a * b > 0, (a, b)), shape=(count + 1, count + 1))
        number = connected_components(graph)[1][number]
    keys = number[inner]
    j, i = np.nonzero(inner)
    tile = (j // _TILE) * number.shape[1] + i // _TILE
    keys = keys * (tile.max(initial=0) + 1) + np.where(np.bincount(keys)[keys] > _LARGEST, tile, 0)
    found = np.zeros(touching.shape, dtype=np.int64)
    found[1:-1][inner] = np.unique(keys, return_inverse=True)[1] + 1
    return found


def _widened(flags: Flags, by: int) -> Flags:
    """Return flags widened by a number of nodes to both sides along the first axis."""
    wide = flags.copy()
    for k in range(1, by + 1):
        wide[k:] |= flags[:-k]
        wide[:-k] |= flags[k:]
    return wide
