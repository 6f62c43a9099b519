"""Multigrid cycle for the linearised point contact: line solutions and a direct coarse grid."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.newton.coarse import CoarseSolution
from gearlube_core.ehl.point.newton.galerkin import coarse_operator, sparse_operator
from gearlube_core.ehl.point.newton.hierarchy import Hierarchy
from gearlube_core.ehl.point.newton.smoother import ColumnSmoother, RowSmoother
from gearlube_core.ehl.point.terms.linearisation import Linearisation

Lines = RowSmoother | ColumnSmoother

_DAMPING = 0.5  # 0.8 and more amplify waves across narrow contacts at high L
# of the entrainment through cells along columns over that along rows, above which lines go both
# ways; where rows carry more, columns on top do harm
_OBLIQUE = 1.0


class MultigridCycle:
    """One V-cycle as an approximate inverse; linearisations on all grids follow from the finest.

    Pressure and approach are found together: the load is an equation of every grid and is met on
    the coarsest. Operators and deflections are in single precision.
    """

    def __init__(self, hierarchy: Hierarchy, linear: Linearisation) -> None:
        self._levels = hierarchy.levels
        self._transfers = hierarchy.transfers
        self._smoothers: list[list[Lines]] = []
        operator = sparse_operator(linear)
        self._operators = [operator.rough()]
        for k in range(len(self._levels) - 1, 0, -1):
            fine, coarse = self._levels[k], self._levels[k - 1]
            halved = (coarse.shape[0] < fine.shape[0], coarse.shape[1] < fine.shape[1])
            lines: list[Lines] = [RowSmoother(fine.grid, operator, halved, _DAMPING)]
            if fine.stencil.wedge_y > _OBLIQUE * fine.stencil.wedge_x and not fine.grid.graded:
                lines.append(ColumnSmoother(fine.grid, operator, halved, _DAMPING))
            self._smoothers.insert(0, lines)
            operator = coarse_operator(operator, self._transfers[k - 1])
            self._operators.insert(0, operator.rough())
        self._direct = CoarseSolution(self._levels[0].grid, operator, self._levels[0].load)

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure, shape (ny, nx), and approach that cancel most of a residual."""
        return self._cycle(len(self._levels) - 1, residual, load_residual)

    def _cycle(self, k: int, residual: Array, load_residual: float) -> tuple[Array, float]:
        if k == 0:
            return self._direct(residual, load_residual)
        level, operator, transfer = self._levels[k], self._operators[k], self._transfers[k - 1]
        pressure = self._smooth(k, residual)
        carried = level.grid.integral(pressure) / level.load
        rest = residual - operator.apply(level.grid, pressure, 0.0)
        coarse, approach = self._cycle(k - 1, transfer.down(rest), load_residual - carried)
        correction = transfer.up(coarse)
        correction[~operator.free] = 0.0
        pressure += correction
        rest = residual - operator.apply(level.grid, pressure, approach)
        pressure += self._smooth(k, rest)
        return pressure, approach

    def _smooth(self, k: int, residual: Array) -> Array:
        """Return line solutions without the part that the coarser grid represents.

        Rows with a local deflection are too soft for long waves, by the ratio of their length to
        the spacing, and would amplify them.
        """
        level, operator, transfer = self._levels[k], self._operators[k], self._transfers[k - 1]
        pressure, rest = np.zeros(level.shape), residual
        for count, lines in enumerate(self._smoothers[k - 1]):
            if count:
                rest = residual - operator.apply(level.grid, pressure, 0.0)
            change = lines(rest)
            change -= transfer.up(transfer.down(change))
            change[~operator.free] = 0.0
            pressure += change
        return pressure
