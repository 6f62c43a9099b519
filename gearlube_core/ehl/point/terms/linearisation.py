"""Derivatives of the film equations on one grid at a state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from gearlube_core.arrays import Array, Flags, Offsets
from gearlube_core.ehl.point.equations.reynolds import apply_to_rows
from gearlube_core.ehl.point.equations.stencil import CENTRE
from gearlube_core.ehl.point.sides import AMBIENT, Sides
from gearlube_core.ehl.point.terms.ruptured_transport import NoTransport, Transport
from gearlube_core.kernels.row_workers import ALONE, RowWorkers

# steps to the neighbours, derivatives by their pressure and by their film, (n, ny, nx)
Derivatives = tuple[Offsets, Array, Array]


@dataclass(slots=True)
class Linearisation:
    """Derivatives of the residual on one grid at a state, in units of `PointScales`."""

    offsets: Offsets  # (m, 2), m >= n, steps to the neighbours along y and x
    by_pressure: Array  # (n, ny, nx), of the neighbours
    by_film: Array  # (n, ny, nx), of the neighbours
    by_approach: Array  # (ny, nx)
    free: Flags  # where pressure is unknown, (ny, nx)
    right: Array  # what the derivatives times the changes have to be, (ny, nx)
    result: Array = field(repr=False)  # of `apply`, (ny, nx)
    load_by_approach: float = 0.0  # change of the load that is carried over the load
    transport: Transport = field(default_factory=NoTransport)  # of oil through ruptured nodes
    centre: int = CENTRE  # number of the node itself among its neighbours
    sides: Sides = AMBIENT  # of the rows
    workers: RowWorkers = ALONE  # who share them

    @property
    def neighbours(self) -> Offsets:
        """Return the steps to the neighbours that have derivatives, (n, 2)."""
        return self.offsets[: self.by_film.shape[0]]

    def sum_by_approach(self) -> None:
        """Set the derivatives by the approach: all nodes of a film rise together."""
        np.sum(self.by_film, axis=0, out=self.by_approach)
        self.transport.carry(self.by_approach)

    def apply(
        self, pressure: Array, approach: float, deflection: Callable[[Array], Array]
    ) -> Array:
        """Return the change of the residual under changes of pressure and approach, (ny, nx).

        The result is overwritten by the next call.
        """
        ny, nx = self.free.shape
        given = self.offsets, self.by_pressure, self.by_film, self.sides.reach(ny)
        changes = self.sides.filled(pressure), deflection(pressure)
        self.workers.share(lambda part: apply_to_rows(*given, *changes, part, self.result), ny, nx)
        self.transport.carry(self.result)
        if approach != 0.0:
            self.result += approach * self.by_approach
        return self.result
