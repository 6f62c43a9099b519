"""Reynolds equation on one grid by differences between the faces of finite volumes."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array, Flags
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
from gearlube_core.ehl.point.terms.storage import NoStorage, Storage

# rho h at a face over that of the node upstream of it; reached where the film halves in a cell
_LEAST_FACE = 0.5
_MOST_FACE = 2.0


class Differences:
    """Finite volumes around the nodes of a grid.

    Parameters
    ----------
    grid
        Grid.
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
            Its constants.
        state
            Its `residual` is written.
        carried : ndarray, shape (ny, nx)
            rho h times the entrainment of the row [-].
        source : ndarray, shape (ny, nx)
            What is gathered beside the flow: what nodes held before, less what they store [-].
        """
        flow = state.film_flow
        reynolds_residual(stencil, self._metric, state.oil, carried, flow, source, state.residual)
        state.shear.add_cross_flow(stencil, self._metric, state.oil, flow, state.residual)

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
            Of oil.
        """
        shear, flow = state.shear, state.film_flow
        count = SHEARED_NEIGHBOURS if shear.sheared else NEIGHBOURS
        slopes = shear.slopes(state.dense, state.viscosity_slope, rows)
        by_pressure, by_film = np.empty((2, count, *state.film.shape))
        given = stencil, self._metric, state.oil, flow, *density, state.film, slopes, rows
        self._grid.workers.share(
            lambda part: reynolds_derivatives(*given, part, by_pressure, by_film),
            *state.film.shape,
        )
        shear.add_cross_derivatives(
            stencil, self._metric, state.oil, flow, state.film, slopes, rows, by_pressure, by_film
        )
        storage.add_derivatives(state, rows, by_pressure[CENTRE], by_film[CENTRE])
        return OFFSETS, by_pressure, by_film
