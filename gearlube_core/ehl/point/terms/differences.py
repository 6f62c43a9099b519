"""Reynolds equation on one grid by differences between the faces of finite volumes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.cross_flow import add_cross_derivatives, add_cross_flow
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.reynolds import reynolds_derivatives, reynolds_residual
from gearlube_core.ehl.point.equations.stencil import (
    CENTRE,
    NEIGHBOURS,
    OFFSETS,
    SHEARED_NEIGHBOURS,
    StencilParameters,
)
from gearlube_core.ehl.point.terms.linearisation import Derivatives
from gearlube_core.ehl.point.terms.state import FilmState

# rho h at a face over that of the node upstream of it; reached where the film halves in a cell
_LEAST_FACE = 0.5
_MOST_FACE = 2.0


@dataclass(frozen=True, slots=True)
class NoStorage:
    """The film is steady."""

    source: Array  # (ny, nx) [-]; zero

    @property
    def rate(self) -> Array:
        """Return the rate of storage, (ny, nx) [-]: zero."""
        return self.source

    def released(self, mass: Array) -> Array:
        """Return the oil that nodes release, (ny, nx) [-]: zero."""
        return self.source

    def add_derivatives(
        self, state: FilmState, rows: Flags, by_pressure: Array, by_film: Array
    ) -> None:
        """Leave the derivatives as they are."""

    def inflow(self, state: FilmState) -> Array:
        """Return the flow into every node, (ny, nx) [-]."""
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
        """Return the oil that nodes release less the oil that they store, (ny, nx) [-].

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
            Pressure and film state.
        rows : ndarray of bool, shape (ny, nx)
            Nodes whose derivatives are wanted.
        by_pressure, by_film : ndarray, shape (ny, nx)
            Derivatives by pressure and film, changed.
        """
        stored = np.where(rows, self.rate, 0.0)
        stored[[0, -1]] = 0.0
        stored[:, [0, -1]] = 0.0
        by_pressure -= stored * state.density_slope * state.film
        by_film -= stored * state.density

    def inflow(self, state: FilmState) -> Array:
        """Return the flow into every node, (ny, nx) [-]."""
        return np.asarray(state.residual - self.released(state.mass))


class Differences:
    """Finite volumes around the nodes of a grid.

    Parameters
    ----------
    grid
        Grid of this contact level.
    """

    centre = CENTRE  # number of the node itself among its neighbours
    upwinds_along_x = False
    face_limits = _LEAST_FACE, _MOST_FACE

    def __init__(self, grid: PointGrid) -> None:
        self._metric, self._grid = grid.metric, grid

    @staticmethod
    def wedge(name: str) -> str:
        """Return the wedge stencil that is used for the one asked for."""
        return name

    def residual(
        self, stencil: StencilParameters, state: FilmState, carried: Array, source: Array
    ) -> None:
        """Write the residual of a state.

        Parameters
        ----------
        stencil
            Constants of the difference stencil.
        state
            Its `residual` is written.
        carried : ndarray, shape (ny, nx)
            rho h times the entrainment of the row [-].
        source : ndarray, shape (ny, nx)
            What is gathered beside the flow: what nodes held before, less what they store [-].
        """
        flow, cross = state.film_flow, state.shear.cross
        reynolds_residual(stencil, self._metric, state.oil, carried, flow, source, state.residual)
        if cross is not None:
            add_cross_flow(stencil, self._metric, state.oil, flow, cross, state.residual)

    def derivatives(
        self,
        stencil: StencilParameters,
        state: FilmState,
        density: tuple[Array, Array],
        rows: Flags,
        entrainment: Array,
        storage: NoStorage | Storage,
    ) -> Derivatives:
        """Return steps to the neighbours and derivatives by their pressure and film, (n, ny, nx).

        Parameters
        ----------
        stencil, state
            As in `residual`.
        density : tuple of ndarray, shapes (ny, nx)
            rho and d rho/dp times the entrainment of the row [-].
        rows : ndarray of bool, shape (ny, nx)
            Nodes whose derivatives are wanted; those of the others are zero.
        entrainment : ndarray, shape (ny,)
            Of the rows, over that of the problem [-].
        storage
            Term of stored oil, or None.
        """
        shear, flow, cross = state.shear, state.film_flow, state.shear.cross
        count = SHEARED_NEIGHBOURS if shear.sheared else NEIGHBOURS
        slopes = shear.slopes(state.dense, state.viscosity_slope, rows)
        by_pressure, by_film = np.empty((2, count, *state.film.shape))
        given = stencil, self._metric, state.oil, flow, *density, state.film, slopes, rows
        self._grid.workers.share(
            lambda part: reynolds_derivatives(*given, part, by_pressure, by_film),
            *state.film.shape,
        )
        if cross is not None:
            given_cross = *given[:4], cross, state.film, slopes, rows
            add_cross_derivatives(*given_cross, by_pressure, by_film)
        storage.add_derivatives(state, rows, by_pressure[CENTRE], by_film[CENTRE])
        return OFFSETS, by_pressure, by_film
