"""Derivatives on one grid as preconditioners apply them: in single precision."""

from __future__ import annotations

from typing import Any

from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.newton.galerkin import SparseOperator
from gearlube_core.ehl.point.newton.single_stencil import Single, SingleStencil


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
        """Return what is left of a right-hand side, shape (ny, nx)."""
        if self.stencil is None:
            return (right - self._operator.apply(pressure, film, approach)).astype(Single)
        rest = self.stencil.rest(right, pressure, film, self._grid.workers)
        if approach != 0.0:
            rest -= Single(approach) * self._by_approach
        return rest
