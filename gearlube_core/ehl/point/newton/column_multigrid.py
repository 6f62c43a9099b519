"""Multigrid cycle of films with closed sides: rows of nodes side by side, built in little time."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from scipy.sparse import csr_matrix

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.newton.column_cycle import (
    HALO,
    SPARE,
    ColumnGrid,
    add_coarser,
    ascend_alone,
    descend,
    descend_alone,
    finish,
    subtract_changes,
)
from gearlube_core.ehl.point.newton.column_factors import (
    BELOW,
    REACH,
    Links,
    factor_rows,
    restrict,
    solve_rows,
    turn_back,
    turn_field,
)
from gearlube_core.ehl.point.newton.column_stencils import (
    CENTRE,
    PLACES,
    WIDTH,
    Stencils,
    coarsen_across,
    pack_and_coarsen,
    reached_neighbours,
    turn_derivatives,
    weigh_places,
)
from gearlube_core.ehl.point.newton.galerkin import LEAST_FREE, SparseOperator
from gearlube_core.ehl.point.newton.preconditioner import CoarseSolution
from gearlube_core.ehl.point.newton.transfer import Hierarchy, Transfer
from gearlube_core.ehl.point.newton.wave import uniform_wave_deflection, unresolved_wave
from gearlube_core.ehl.point.settings import Sides
from gearlube_core.ehl.point.terms.linearisation import Linearisation

_LEAST = 1.0e-3  # mean weight of a neighbour that is kept, over that of the heaviest one
_WEIGHED = 64  # nodes of a row whose neighbours are weighed, at least
TOGETHER = 16  # rows of nodes that one thread takes: a line of the cache
_PLACES = np.stack(np.divmod(np.arange(PLACES), WIDTH), axis=1) - REACH  # steps along y and x

Single: Any = np.float32
_DAMPING = (
    0.4  # of line solutions; with 0.6 fewer iterations in light steps, more where solids touch
)


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
        Transfer to the next coarser level.
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
            reached_neighbours(self.along, used, *nodes, self._reached[key])
        return self._reached[key]


class ColumnGrids:
    """Arrays of all grids; those of one cycle serve for the next."""

    def __init__(self, hierarchy: Hierarchy) -> None:
        self.hierarchy = hierarchy
        shapes = [(level.shape[1], level.shape[0] - 2) for level in hierarchy.levels]
        self.whole = [WholeStencils(shape) for shape in shapes]
        self.levels = [
            ColumnLevel(fine.grid, coarse.shape, transfer)
            for (coarse, fine), transfer in zip(
                pairwise(hierarchy.levels), hierarchy.transfers, strict=True
            )
        ]
        # with fewer nodes to a row, but not fewer rows yet
        self.between = [
            WholeStencils((coarse[0], fine[1])) if coarse[1] < fine[1] else None
            for coarse, fine in pairwise(shapes)
        ]
        self.right = np.empty(shapes[0], dtype=Single)

    def follow(self, linear: Linearisation) -> list[ColumnGrid]:
        """Return all grids but the coarsest with the derivatives.

        Those of the coarsest grid are then in `whole`.
        """
        self._turn(linear)
        found: list[ColumnGrid] = []
        for k in range(len(self.levels), 0, -1):
            level, fine, coarse = self.levels[k - 1], self.whole[k], self.whole[k - 1]
            half = self.between[k - 1] or coarse
            found.insert(0, level.follow(fine, half))
            if half is not coarse:
                coarsen_across(level.across, half.by_pressure, half.used[0], coarse.by_pressure)
                coarsen_across(level.across, half.by_film, half.used[1], coarse.by_film)
            for of, to in ((fine.free, coarse.free), (fine.by_approach, coarse.by_approach)):
                restrict(level.along, level.across, of, level.half, to)
            coarse.free[:] = coarse.free > LEAST_FREE
            coarse.free[[0, -1]] = 0.0
        return found

    def _turn(self, linear: Linearisation) -> None:
        """Set the derivatives of the finest grid."""
        finest, grid = self.whole[-1], self.hierarchy.levels[-1].grid
        nx, rows = finest.free.shape
        own = held_rows(grid.sides, rows, REACH)
        finest.used[:] = False
        finest.used[:, (linear.neighbours + REACH) @ (WIDTH, 1)] = True
        given = linear.offsets, linear.free, own

        def turn(part: tuple[int, int]) -> None:
            turn_field(linear.free, 1, 1.0, part, finest.free)
            turn_field(linear.by_approach, 1, 1.0, part, finest.by_approach)
            turn_derivatives(linear.by_pressure, *given, True, 1, part, finest.by_pressure)
            turn_derivatives(linear.by_film, *given, False, 1, part, finest.by_film)

        grid.workers.share(turn, rows, nx, TOGETHER)


class ColumnCycle:
    """As `MultigridCycle`, for a uniform grid with closed sides and entrainment along its rows.

    Rows of nodes lie side by side in memory, so that all of a cycle takes many rows in one
    instruction; coarse grids are built from stencils.

    Parameters
    ----------
    hierarchy, linear
        Grids and the linearisation on the finest.
    before
        A cycle of the same grids, whose arrays are taken over; it cannot be used any more.
    """

    def __init__(
        self, hierarchy: Hierarchy, linear: Linearisation, before: ColumnCycle | None = None
    ) -> None:
        self._hierarchy = hierarchy
        self.grids: ColumnGrids = ColumnGrids(hierarchy) if before is None else before.grids
        self._levels = self.grids.follow(linear)
        self._workers = hierarchy.levels[-1].grid.workers
        coarsest = hierarchy.levels[0]
        operator = self.grids.whole[0].operator(coarsest.grid.sides)
        self._direct = CoarseSolution(coarsest.grid, operator, coarsest.load)

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach that cancel most of a residual."""
        # of order one, far from the limits of float32
        size = float(max(residual.max(), -residual.min())) or 1.0
        levels, grids = self._levels, self._hierarchy.levels
        load = load_residual / size
        for k in range(len(levels) - 1, -1, -1):
            below = levels[k - 1].right if k > 0 else self.grids.right
            given = (residual, size) if k == len(levels) - 1 else None
            total = self._descend(levels[k], below, given)
            load -= total * grids[k + 1].grid.cell / grids[k + 1].load
        coarsest = np.zeros(grids[0].shape, dtype=Single)
        coarsest[1:-1] = self.grids.right.T
        direct, approach = self._direct(coarsest, load)
        bent = grids[0].grid.single_deflection(direct)
        fields = np.ascontiguousarray(direct[1:-1].T), np.ascontiguousarray(bent[1:-1].T)
        halo = 0
        for level in levels:
            self._ascend(level, approach, fields, halo)
            fields, halo = (level.pressure, level.film), HALO
        result = np.empty(residual.shape)
        result[[0, -1]] = 0.0
        self._workers.share(
            lambda part: turn_back(levels[-1].pressure, HALO, 1, size, part, result),
            *levels[-1].free.shape,
        )
        return result, size * approach

    def _descend(self, grid: ColumnGrid, below: Any, given: tuple[Array, float] | None) -> float:
        """Smooth, write the rest on the coarser grid, `below`; return the sum of the pressure.

        `given` are, on the finest grid, the residual and its size.
        """

        def solve(part: tuple[int, int]) -> None:
            if given is not None:
                turn_field(given[0], 1, 1.0 / given[1], part, grid.right)
            _solve(grid, grid.right, part)

        (nx, rows), columns = grid.free.shape, below.shape[0]
        share = self._workers.share
        if given is None and self._is_alone(grid):
            descend_alone(grid, _DAMPING, _spare(rows), below)
        else:
            share(solve, rows, nx, TOGETHER)
            share(
                lambda part: descend(grid, part, _spare(rows), below), columns, nx * rows // columns
            )
        return float(grid.sums.sum())

    def _ascend(
        self, grid: ColumnGrid, approach: float, fields: tuple[Any, Any], halo: int
    ) -> None:
        """Add the coarser grid's pressure and film, and smooth again; the film follows."""
        (nx, rows), (pressure, film) = grid.free.shape, fields
        fewer = pressure.shape[1] - 2 * halo
        share = self._workers.share
        bend = grid is not self._levels[-1]
        if self._is_alone(grid):
            ascend_alone(grid, _DAMPING, approach, pressure, film, halo, bend, _spare(rows))
            return
        share(lambda part: add_coarser(grid, part, pressure, film, halo), nx, rows)
        share(lambda part: subtract_changes(grid, part, approach), nx, rows)
        share(lambda part: _solve(grid, grid.rest, part), rows, nx, TOGETHER)
        share(lambda part: finish(grid, part, fewer, bend, _spare(rows)), nx, rows)

    def _is_alone(self, grid: ColumnGrid) -> bool:
        """Return whether one thread does all of a grid: then in one call."""
        return len(self._workers.parts(*grid.free.shape)) == 1


class ColumnCycles:
    """Builds one cycle after the other in the same arrays."""

    def __init__(self) -> None:
        self._last: ColumnCycle | None = None

    def __call__(self, hierarchy: Hierarchy, linear: Linearisation, _: object) -> ColumnCycle:
        """Return the cycle of a linearisation; the one before cannot be used any more."""
        self._last = ColumnCycle(hierarchy, linear, self._last)
        return self._last


def _solve(grid: ColumnGrid, right: Any, rows: tuple[int, int]) -> None:
    """Write the line solutions of some rows, and their means along the rows."""
    solve_rows(grid.band, grid.free, right, _DAMPING, grid.along, rows, grid.rest, grid.half)


def _spare(rows: int) -> Any:
    """Return scratch memory of one thread."""
    return np.empty((SPARE, rows + 2 * HALO), dtype=Single)
