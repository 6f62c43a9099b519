"""Multigrid cycle for the linearised point contact: line solutions and a direct coarse grid."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.newton.galerkin import SparseOperator, coarse_operator, sparse_operator
from gearlube_core.ehl.point.newton.single_stencil import Single, SingleStencil
from gearlube_core.ehl.point.newton.smoother import ColumnSmoother, RowSmoother
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.terms.linearisation import Linearisation

Lines = RowSmoother | ColumnSmoother

_DAMPING = 0.5  # 0.8 and more amplify waves across narrow contacts at high L
# of the entrainment through cells along columns over that along rows, above which lines go both
# ways; where rows carry more, columns on top do harm
_OBLIQUE = 1.0


class SingleOperator:
    """Change of the residual under a change of pressure and approach, float32.

    Stencils are kept neighbour by neighbour, so that rows are read in order. Where oil passes
    ruptured film, beyond a stencil, the compressed rows are taken.

    Parameters
    ----------
    grid, operator
        Grid and its derivatives.

    Attributes
    ----------
    stencil : SingleStencil or None
        None where one would reach too far.
    """

    def __init__(self, grid: PointGrid, operator: SparseOperator) -> None:
        self._grid, self._operator = grid, operator
        ny, nx = grid.shape
        self.stencil = SingleStencil.of(
            operator.matrix, (ny, nx), grid.sides.period(ny), grid.own_deflection[0]
        )
        self._by_approach: Any = operator.by_approach.astype(Single)

    def rest(self, right: Any, pressure: Any, film: Any, approach: float) -> Any:
        """Return the residual of a right-hand side, shape (ny, nx)."""
        if self.stencil is None:
            return (right - self._operator.apply(pressure, film, approach)).astype(Single)
        rest = self.stencil.rest(right, pressure, film, self._grid.workers)
        if approach != 0.0:
            rest -= Single(approach) * self._by_approach
        return rest


class CoarseSolution:
    """Factored matrix of pressure and approach at the free nodes of a Galerkin operator, float32.

    Parameters
    ----------
    grid, operator
        Coarse grid and its derivatives.
    load
        Integral of the pressure that balances the load [-].
    """

    def __init__(self, grid: PointGrid, operator: SparseOperator, load: float) -> None:
        free = operator.free.ravel()
        self._nodes = np.flatnonzero(free)
        n = self._nodes.size
        matrix = np.empty((n + 1, n + 1), dtype=Single, order="F")
        rows = operator.matrix[self._nodes].astype(np.complex64)
        deflection = np.take(grid.dense_deflection(), self._nodes, axis=1).astype(Single)
        matrix[:n, :n] = rows.imag @ deflection
        matrix[:n, :n] += rows.real[:, self._nodes].toarray()
        matrix[:n, n] = operator.by_approach.ravel()[self._nodes]
        matrix[n, :n] = grid.cells[self._nodes % grid.shape[1]] / load
        matrix[n, n] = 0.0
        # fluidity falls by many orders of magnitude: every equation over its largest coefficient
        size = np.abs(matrix).max(axis=1)
        self._scale = 1.0 / np.where(size > 0.0, size, 1.0)
        matrix *= self._scale[:, None]
        self._factors = lu_factor(matrix, overwrite_a=True, check_finite=False)
        self._shape = grid.shape

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach with the residual and the load given."""
        right = np.append(residual.ravel()[self._nodes], load_residual)
        right = (right * self._scale).astype(Single)
        solution = lu_solve(self._factors, right, overwrite_b=True, check_finite=False)
        pressure = np.zeros(self._shape, dtype=Single)
        pressure.ravel()[self._nodes] = solution[:-1]
        return pressure, float(solution[-1])


class MultigridCycle:
    """One V-cycle as an approximate inverse; linearisations on all grids follow from the finest.

    Pressure and approach are found together: the load is an equation of every grid and is met on
    the coarsest. Under what a coarser grid adds, the film is that of the coarser grid, between its
    nodes; under what lines add, which has no long waves, it is a sum over a few neighbours. So only
    the coarsest grid needs its whole deflection. All is computed in single precision.
    """

    def __init__(self, hierarchy: Hierarchy, linear: Linearisation) -> None:
        self._levels = hierarchy.levels
        self._transfers = hierarchy.transfers
        self._smoothers: list[list[Lines]] = []
        operator = sparse_operator(linear)
        self._operators: list[SingleOperator] = []
        self._free: list[Flags] = []
        self._halved: list[tuple[bool, bool]] = []
        for k in range(len(self._levels) - 1, 0, -1):
            fine, coarse = self._levels[k], self._levels[k - 1]
            halved = (coarse.shape[0] < fine.shape[0], coarse.shape[1] < fine.shape[1])
            single = SingleOperator(fine.grid, operator)
            lines: list[Lines] = [
                RowSmoother(fine.grid, operator, single.stencil, halved, _DAMPING)
            ]
            if fine.stencil.wedge_y > _OBLIQUE * fine.stencil.wedge_x and not fine.grid.graded:
                lines.append(ColumnSmoother(fine.grid, operator, halved, _DAMPING))
            self._smoothers.insert(0, lines)
            self._operators.insert(0, single)
            self._halved.insert(0, halved)
            self._free.insert(0, operator.free)
            operator = coarse_operator(operator, self._transfers[k - 1])
        self._direct = CoarseSolution(self._levels[0].grid, operator, self._levels[0].load)

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach that cancel most of a residual."""
        # of order one, far from the limits of float32
        size = float(np.abs(residual).max()) or 1.0
        pressure, _, approach = self._cycle(
            len(self._levels) - 1, (residual / size).astype(Single), load_residual / size
        )
        return size * pressure.astype(np.float64), size * approach

    def _cycle(self, k: int, residual: Any, load_residual: float) -> tuple[Any, Any, float]:
        """Return pressure, the film under it (None on the finest grid) and approach."""
        level = self._levels[k]
        if k == 0:
            pressure, approach = self._direct(residual, load_residual)
            return pressure, level.grid.single_deflection(pressure), approach
        operator, transfer, free = self._operators[k - 1], self._transfers[k - 1], self._free[k - 1]
        pressure = self._smooth(k, residual)
        film = self._bent(k, pressure)
        carried = level.grid.integral(pressure) / level.load
        rest = operator.rest(residual, pressure, film, 0.0)
        coarse, coarse_film, approach = self._cycle(
            k - 1, transfer.down(rest), load_residual - carried
        )
        correction = transfer.up(coarse)
        correction *= free
        pressure += correction
        film += transfer.up(coarse_film)
        level.grid.sides.fill(film)
        after = self._smooth(k, operator.rest(residual, pressure, film, approach))
        pressure += after
        if k == len(self._levels) - 1:
            return pressure, None, approach
        return pressure, film + self._bent(k, after), approach

    def _bent(self, k: int, pressure: Any) -> Any:
        return self._levels[k].grid.short_deflection(pressure, self._halved[k - 1])

    def _smooth(self, k: int, residual: Any) -> Any:
        """Return line solutions without the part that the coarser grid represents.

        Rows with a local deflection are too soft for long waves, by the ratio of their length to
        the spacing, and would amplify them.
        """
        transfer, rest = self._transfers[k - 1], residual
        pressure: Any = None
        for lines in self._smoothers[k - 1]:
            if pressure is not None:
                film = self._bent(k, pressure)
                rest = self._operators[k - 1].rest(residual, pressure, film, 0.0)
            change = lines(rest)
            change -= transfer.up(transfer.down(change))
            change *= self._free[k - 1]
            pressure = change if pressure is None else pressure + change
        return pressure
