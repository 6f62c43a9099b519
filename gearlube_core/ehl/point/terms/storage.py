"""Oil that is stored as the film changes in time, on one grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.terms.state import FilmState


@dataclass(frozen=True, slots=True)
class NoStorage:
    """The film is steady."""

    source: Array  # (ny, nx) [-]; zero

    @property
    def rate(self) -> Array:
        """Return the rate of storage, (ny, nx) [-]: zero."""
        return self.source

    def released(self, mass: Array) -> Array:
        """Return what nodes release of what they held, (ny, nx) [-]: nothing."""
        return self.source

    def add_derivatives(
        self, state: FilmState, rows: Flags, by_pressure: Array, by_film: Array
    ) -> None:
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

    def released(self, mass: Array) -> Array:
        """Return what nodes release of what they held, less what they store, (ny, nx) [-].

        Parameters
        ----------
        mass : ndarray, shape (ny, nx)
            rho h now [-].
        """
        return np.asarray(self.source - self.rate * mass)

    def add_derivatives(
        self, state: FilmState, rows: Flags, by_pressure: Array, by_film: Array
    ) -> None:
        """Add the derivatives of what nodes store by their own pressure and film.

        Parameters
        ----------
        state
            State.
        rows : ndarray of bool, shape (ny, nx)
            Nodes whose derivatives are wanted.
        by_pressure, by_film : ndarray, shape (ny, nx)
            Changed.
        """
        stored = np.where(rows, self.rate, 0.0)
        stored[[0, -1]] = 0.0
        stored[:, [0, -1]] = 0.0
        by_pressure -= stored * state.density_slope * state.film
        by_film -= stored * state.density

    def inflow(self, state: FilmState) -> Array:
        """Return what flows into every node, (ny, nx) [-]."""
        return np.asarray(state.residual - self.released(state.mass))
