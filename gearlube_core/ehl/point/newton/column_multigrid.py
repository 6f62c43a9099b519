"""Multigrid cycle of films with closed sides: rows of nodes side by side, built in little time."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
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
    REACH,
    restrict,
    solve_rows,
    turn_back,
    turn_field,
)
from gearlube_core.ehl.point.newton.column_levels import (
    TOGETHER,
    ColumnLevel,
    Single,
    WholeStencils,
    held_rows,
)
from gearlube_core.ehl.point.newton.column_stencils import WIDTH, coarsen_across, turn_derivatives
from gearlube_core.ehl.point.newton.galerkin import LEAST_FREE
from gearlube_core.ehl.point.newton.preconditioner import CoarseSolution
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.terms.linearisation import Linearisation

_DAMPING = (
    0.4  # of line solutions; with 0.6 fewer iterations in light steps, more where solids touch
)


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
