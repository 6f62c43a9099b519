"""One grid of a multigrid cycle with rows of nodes side by side: its arrays and its equations."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csr_matrix

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.newton.column_cycle import HALO, ColumnGrid
from gearlube_core.ehl.point.newton.column_factors import BELOW, REACH, Links, factor_rows
from gearlube_core.ehl.point.newton.column_stencils import (
    CENTRE,
    PLACES,
    WIDTH,
    Stencils,
    pack_and_coarsen,
    reached_places,
    weigh_places,
)
from gearlube_core.ehl.point.newton.galerkin import SparseOperator
from gearlube_core.ehl.point.newton.transfer import Transfer
from gearlube_core.ehl.point.newton.wave import uniform_wave_deflection, unresolved_wave
from gearlube_core.ehl.point.settings import Sides

_LEAST = 1.0e-3  # mean weight of a neighbour that is kept, over that of the heaviest one
_WEIGHED = 64  # nodes of a row whose neighbours are weighed, at least
TOGETHER = 16  # rows of nodes that one thread takes: a line of the cache
_PLACES = np.stack(np.divmod(np.arange(PLACES), WIDTH), axis=1) - REACH  # steps along y and x

Single: Any = np.float32


def held_rows(sides: Sides, rows: int, beyond: int) -> np.ndarray:
    """Return the row that holds each, so many beyond both closed sides included."""
    row = np.arange(-beyond, rows + beyond)
    if sides.name == "cyclic":
        return row % rows
    row = row % (2 * rows)
    return np.where(row < rows, row, 2 * rows - 1 - row)


def linked(position: Array, means: Array) -> Links:
    """Return the interpolation along one axis as a list.

    Parameters
    ----------
    position : ndarray, shape (fine + 2 REACH,)
        Of the fine nodes among the coarse ones, those beyond both ends included.
    means : ndarray, shape (coarse, fine)
        Weights of the fine nodes.
    """
    first = np.floor(position + 1e-9)
    share = np.maximum(position - first, 0.0)
    share[share < 1e-9] = 0.0
    to, of = np.nonzero(means)
    return Links(
        np.column_stack((first, first + 1)).astype(np.int64),
        np.column_stack((1.0 - share, share)).astype(Single),
        np.searchsorted(to, np.arange(means.shape[0] + 1)).astype(np.int64),
        of.astype(np.int64),
        means[to, of].astype(Single),
    )


class WholeStencils:
    """Derivatives by all of 25 neighbours, and where pressure is unknown; rows side by side."""

    def __init__(self, shape: tuple[int, int]) -> None:
        nx, rows = shape
        self.by_pressure, self.by_film = np.zeros((2, PLACES, nx, rows), dtype=Single)
        self.by_approach, self.free = np.zeros((2, nx, rows), dtype=Single)
        # neighbours that there are, by pressure and by film
        self.used = np.ones((2, PLACES), dtype=np.bool_)

    def operator(self, sides: Sides) -> SparseOperator:
        """Return compressed rows of a film with copied rows; for small grids."""
        _, nx, rows = self.by_pressure.shape
        own = held_rows(sides, rows, REACH)
        place, i, j = np.nonzero((self.by_pressure != 0.0) | (self.by_film != 0.0))
        down, along = _PLACES[place].T
        inside = (i + along >= 0) & (i + along < nx)
        i, place, j, down, along = (one[inside] for one in (i, place, j, down, along))
        there, to = own[j + down + REACH], i + along
        pressure = self.by_pressure[place, i, j] * self.free[to, there]
        entry = pressure + 1j * self.by_film[place, i, j]
        size = (rows + 2) * nx
        place_of = (j + 1) * nx + i, (there + 1) * nx + to
        matrix = csr_matrix((entry, place_of), shape=(size, size))
        free, approach = np.zeros((2, rows + 2, nx))
        free[1:-1], approach[1:-1] = self.free.T, self.by_approach.T
        return SparseOperator(matrix, free > 0.5, approach)


class ColumnLevel:
    """Arrays of one grid but the coarsest, which serve for one linearisation after the other.

    Parameters
    ----------
    grid
        Uniform grid with closed sides.
    coarse
        Shape of the next coarser one, with copied rows.
    transfer
        To that.
    """

    def __init__(self, grid: PointGrid, coarse: tuple[int, int], transfer: Transfer) -> None:
        self._grid, sides = grid, grid.sides
        rows, nx = grid.shape[0] - 2, grid.shape[1]
        fewer, coarse_nx = self.coarse = coarse[0] - 2, coarse[1]
        self.shape = nx, rows
        halved = fewer < rows, coarse_nx < nx
        down = transfer.means
        column, row = np.arange(-REACH, nx + REACH), np.arange(-REACH, rows + REACH)
        self.along = linked(np.asarray(column * ((coarse_nx - 1) / (nx - 1))), down[1])
        self.across = linked(np.asarray((row + 0.5) * (fewer / rows) - 0.5), down[0][1:-1, 1:-1])
        wave = unresolved_wave(grid, halved)
        self._local = uniform_wave_deflection(nx, grid.dx, grid.modulus, wave)[0, :3].astype(Single)
        shortest = min(wave * grid.dy, 0.55 * np.pi)
        self._across = np.cos(shortest * np.arange(5.0)).astype(Single)
        short = grid.short_waves(halved)
        reach = np.abs(short.offsets[:, 0]) <= HALO
        self._short = short.offsets[reach], short.weights[reach]
        self._held = held_rows(sides, rows, HALO), held_rows(Sides("cyclic"), rows, HALO)
        self._band = np.empty((nx, 2 * BELOW + 1, rows), dtype=Single)
        self._fields = np.empty((2, nx, rows), dtype=Single)
        self._padded = np.zeros((3, nx, rows + 2 * HALO), dtype=Single)
        self.half, back = np.empty((2, coarse_nx, rows), dtype=Single)
        self._scratch = self.half, back, np.empty(nx)
        self._packed: dict[tuple[int, int], Any] = {}
        self._reached: dict[bytes, Any] = {}
        self._most = np.empty(rows, dtype=Single)

    def follow(self, whole: WholeStencils, coarse: WholeStencils) -> ColumnGrid:
        """Return the grid with derivatives and factors.

        Parameters
        ----------
        whole
            Derivatives of this grid.
        coarse
            Result: derivatives of the grid with fewer nodes to a row and as many rows.
        """
        weight, nx, rows = np.zeros((2, PLACES)), *self.shape
        own = self._grid.own_deflection[0, 0]
        both, stride = (whole.by_pressure, whole.by_film), max(1, nx // _WEIGHED)
        nodes = weigh_places(*both, whole.used, own, stride, self._most, weight)
        kept = weight > _LEAST * nodes
        kept[:, CENTRE] = True
        stencils, packed = [], []
        for k, to in enumerate((coarse.by_pressure, coarse.by_film)):
            count = int(kept[k].sum())
            if (k, count) not in self._packed:
                self._packed[k, count] = np.empty((nx, count, rows), dtype=Single)
            used = whole.used[k]
            coarse.used[k] = self._reached_by(used)
            packed += [_PLACES[kept[k]], self._packed[k, count]]
            stencils.append(Stencils(both[k], used, kept[k], packed[-1], coarse.used[k], to))
        columns, share = self.coarse[1], self._grid.workers.share

        def factor(part: tuple[int, int]) -> None:
            local, across, most = self._local, self._across, self._most
            p_offsets, p, h_offsets, h = packed
            given = p_offsets, p, h_offsets, h, whole.free, local, across
            factor_rows(*given, part, self._band, most)

        share(
            lambda part: pack_and_coarsen(self.along, stencils[0], stencils[1], part),
            columns,
            nx * rows // columns,
        )
        share(factor, rows, nx, TOGETHER)
        links = *self._held, self.along, self.across
        derivatives = *packed, whole.by_approach, self._band, whole.free
        fields = *self._fields, *self._padded, *self._scratch
        return ColumnGrid._make((*derivatives, *self._short, *links, *fields))

    def _reached_by(self, used: Any) -> Any:
        """Return which neighbours the stencils of the coarser grid have."""
        key = used.tobytes()
        if key not in self._reached:
            self._reached[key] = np.empty(PLACES, dtype=np.bool_)
            nodes = self.shape[0], self.coarse[1]
            reached_places(self.along, used, *nodes, self._reached[key])
        return self._reached[key]
