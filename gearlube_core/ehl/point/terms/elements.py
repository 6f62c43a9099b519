"""Reynolds equation on one grid in finite elements."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.finite_elements import (
    ELEMENT_CENTRE,
    ELEMENT_NEIGHBOURS,
    ELEMENT_OFFSETS,
    SHEARED_ELEMENT_NEIGHBOURS,
    element_derivatives,
    element_residual,
)
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.stencil import (
    CarriedMass,
    FlowTensor,
    StencilParameters,
)
from gearlube_core.ehl.point.terms.linearisation import Derivatives
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.point.terms.storage import NoStorage, Storage


class Elements:
    """Galerkin equations of bilinear elements; takes the place of `Differences`.

    Parameters
    ----------
    grid
        Uniform grid.
    compliance
        Deflection per pressure that sets the upwinding [-]; None: of waves of the length 2 d on a
        half-space, 2/(E* k), k = pi/d.
    """

    centre = ELEMENT_CENTRE  # number of the node itself among its neighbours
    upwinds_along_x = True  # alone what is stored
    face_limits = -math.inf, math.inf

    def __init__(self, grid: PointGrid, compliance: float | None = None) -> None:
        waves = 2.0 * min(grid.dx, grid.dy) / (math.pi * grid.modulus)
        self._compliance = waves if compliance is None else compliance

    @staticmethod
    def wedge(name: str) -> str:
        """Return the wedge stencil: `upwind-1` for upwinding of first order everywhere."""
        return name if name == "upwind-1" else "central"

    def residual(
        self, stencil: StencilParameters, state: FilmState, carried: Array, source: Array
    ) -> None:
        """Write the residual of a state, as `Differences.residual`."""
        element_residual(
            stencil,
            state.oil,
            carried,
            _flow(state),
            source,
            self._compliance,
            state.density,
            state.residual,
        )

    def derivatives(
        self,
        stencil: StencilParameters,
        state: FilmState,
        density: tuple[Array, Array],
        rows: Flags,
        entrainment: Array,
        storage: NoStorage | Storage,
    ) -> Derivatives:
        """Return neighbours and derivatives, as `Differences.derivatives`."""
        count = SHEARED_ELEMENT_NEIGHBOURS if state.shear.sheared else ELEMENT_NEIGHBOURS
        by_pressure, by_film = np.empty((2, count, *state.film.shape))
        element_derivatives(
            stencil,
            state.oil,
            _flow(state),
            CarriedMass(*density, state.film),
            state.shear.tensor_slopes(
                state.cubic * state.fluidity, state.dense, state.viscosity_slope
            ),
            self._compliance,
            np.ascontiguousarray(storage.rate / entrainment[:, None]),
            rows,
            by_pressure,
            by_film,
        )
        return ELEMENT_OFFSETS, by_pressure, by_film


def _flow(state: FilmState) -> FlowTensor:
    cubic_xy = state.shear.cubic_xy(state.cubic)
    return FlowTensor(state.cubic_x, cubic_xy, state.cubic_y, state.fluidity)
