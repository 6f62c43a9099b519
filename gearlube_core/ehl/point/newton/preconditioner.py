"""Multigrid cycle for the linearised point contact: line solutions and a direct coarse grid."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.newton.coarse import CoarseSolution
from gearlube_core.ehl.point.newton.galerkin import coarse_operator, sparse_operator
from gearlube_core.ehl.point.newton.hierarchy import Hierarchy
from gearlube_core.ehl.point.newton.single_operator import SingleOperator
from gearlube_core.ehl.point.newton.single_stencil import Single
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
