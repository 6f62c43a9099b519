"""Multigrid cycle of films with closed sides: rows of nodes side by side, built in little time."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.newton.coarse import CoarseSolution
from gearlube_core.ehl.point.newton.column_cycle import (
    HALO,
    ascend,
    descend,
    restrict,
    turn_back,
)
from gearlube_core.ehl.point.newton.column_levels import (
    ColumnLevel,
    Single,
    WholeStencils,
    held_rows,
)
from gearlube_core.ehl.point.newton.column_stencils import (
    REACH,
    WIDTH,
    coarsen_across,
    coarsen_along,
    turn_field,
    turn_stencils,
)
from gearlube_core.ehl.point.newton.galerkin import LEAST_FREE
from gearlube_core.ehl.point.newton.hierarchy import Hierarchy
from gearlube_core.ehl.point.newton.preconditioner import MultigridCycle
from gearlube_core.ehl.point.terms.linearisation import Linearisation

_DAMPING = 0.6  # of line solutions; with 0.5 and 0.7 some more iterations, with 0.8 many more


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

    def follow(self, linear: Linearisation) -> None:
        """Set the derivatives of all grids."""
        finest, grid = self.whole[-1], self.hierarchy.levels[-1].grid
        own = held_rows(grid.sides, finest.free.shape[1], REACH)
        turn_field(linear.free.astype(np.float64), 1, 1.0, finest.free)
        turn_field(linear.by_approach, 1, 1.0, finest.by_approach)
        places = (linear.neighbours + REACH) @ (WIDTH, 1)
        finest.used[:] = False
        finest.used[:, places] = True
        for slopes, masked, whole in (
            (linear.by_pressure, True, finest.by_pressure),
            (linear.by_film, False, finest.by_film),
        ):
            turn_stencils(slopes, linear.offsets, finest.free, own, masked, 1, whole)
        for k in range(len(self.levels), 0, -1):
            self._coarsen(k)

    def _coarsen(self, k: int) -> None:
        level, fine, coarse = self.levels[k - 1], self.whole[k], self.whole[k - 1]
        half = self.between[k - 1] or coarse
        for kind, of, to in (
            (0, fine.by_pressure, half.by_pressure),
            (1, fine.by_film, half.by_film),
        ):
            coarsen_along(level.along, of, fine.used[kind], to, half.used[kind])
        if half is not coarse:
            coarsen_across(level.across, half.by_pressure, coarse.by_pressure)
            coarsen_across(level.across, half.by_film, coarse.by_film)
        for of, to in ((fine.free, coarse.free), (fine.by_approach, coarse.by_approach)):
            restrict(level.along, level.across, of, level.half, to)
        coarse.free[:] = coarse.free > LEAST_FREE
        coarse.free[[0, -1]] = 0.0


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
        grids = self.grids
        grids.follow(linear)
        self._levels: list[Any] = [
            level.follow(whole) for level, whole in zip(grids.levels, grids.whole[1:], strict=True)
        ]
        self.exchanging: MultigridCycle | None = None
        if any(level is None for level in self._levels):
            self.exchanging = MultigridCycle(hierarchy, linear)
            return
        coarsest = hierarchy.levels[0]
        operator = grids.whole[0].operator(coarsest.grid.sides)
        self._direct = CoarseSolution(coarsest.grid, operator, coarsest.load)

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach that cancel most of a residual."""
        if self.exchanging is not None:
            return self.exchanging(residual, load_residual)
        # of order one, far from the limits of float32
        size = float(np.abs(residual).max()) or 1.0
        levels, grids = self._levels, self._hierarchy.levels
        finest = levels[-1]
        turn_field(residual, 1, 1.0 / size, finest.right)
        load = load_residual / size
        for k in range(len(levels) - 1, -1, -1):
            below = levels[k - 1].right if k > 0 else self.grids.right
            total = descend(levels[k], _DAMPING, below)
            load -= total * grids[k + 1].grid.cell / grids[k + 1].load
        coarsest = np.zeros(grids[0].shape, dtype=Single)
        coarsest[1:-1] = self.grids.right.T
        direct, approach = self._direct(coarsest, load)
        bent = grids[0].grid.single_deflection(direct)
        pressure, film = (np.ascontiguousarray(one[1:-1].T) for one in (direct, bent))
        halo = 0
        for k, level in enumerate(levels):
            ascend(level, _DAMPING, approach, pressure, film, halo, k < len(levels) - 1)
            pressure, film, halo = level.pressure, level.film, HALO
        result = np.zeros(residual.shape)
        turn_back(pressure, 1, size, result)
        return result, size * approach
