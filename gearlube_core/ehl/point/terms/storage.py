"""Oil that is stored as the film changes in time, on one grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.ehl.point.terms.state import Balance, FilmState


@dataclass(frozen=True, slots=True)
class NoStorage:
    """The film is steady."""

    source: Array  # (ny, nx) [-]; zero

    @property
    def rate(self) -> Array:
        """Return the rate of storage, (ny, nx) [-]: zero."""
        return self.source

    def add_residual(self, state: FilmState, balance: Balance) -> None:
        """Leave the residual as it is."""

    def add_derivatives(self, linear: Linearisation, state: FilmState, balance: Balance) -> None:
        """Leave the derivatives as they are."""

    def inflow(self, state: FilmState) -> Array:
        """Return what flows into every node, (ny, nx) [-]."""
        return state.residual


@dataclass(frozen=True, slots=True)
class Storage:
    """Oil is stored at a rate times rho h less a source; both in units of the scales."""

    rate: Array  # per time of the scales, (ny, nx) [-]
    source: Array  # what is stored already, (ny, nx) [-]

    @classmethod
    def of(cls, rate: Array | float, source: Array, shape: tuple[int, int]) -> Storage:
        """Return the storage of a grid with `shape` rows and columns."""
        return cls(
            np.broadcast_to(np.asarray(rate, dtype=np.float64), shape),
            np.ascontiguousarray(np.broadcast_to(np.asarray(source, dtype=np.float64), shape)),
        )

    def add_residual(self, state: FilmState, balance: Balance) -> None:
        """Take off what is stored; the stencil has added the source."""
        state.residual[1:-1, 1:-1] -= (self.rate * state.mass)[1:-1, 1:-1]

    def add_derivatives(self, linear: Linearisation, state: FilmState, balance: Balance) -> None:
        """Add the derivatives of what free nodes store."""
        stored = np.where(linear.free, self.rate, 0.0)
        stored[[0, -1]] = 0.0
        stored[:, [0, -1]] = 0.0
        centre = linear.centre
        linear.by_pressure[centre] -= stored * state.density_slope * state.film
        linear.by_film[centre] -= stored * state.density

    def inflow(self, state: FilmState) -> Array:
        """Return what flows into every node, (ny, nx) [-]."""
        return np.asarray(state.residual - self.source + self.rate * state.mass)
