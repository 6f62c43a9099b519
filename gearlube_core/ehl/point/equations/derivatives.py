"""Derivatives of the flow through a film, with what flows across the slope of pressure."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.equations.cross_flow import add_cross_derivatives
from gearlube_core.ehl.point.equations.state import FilmState, Flags, Offsets
from gearlube_core.ehl.point.equations.stencil import (
    CROSS_NEIGHBOURS,
    NEIGHBOURS,
    OFFSETS,
    FlowSlopes,
    MeshMetric,
    StencilParameters,
    reynolds_derivatives,
)


def flow_derivatives(
    stencil: StencilParameters,
    metric: MeshMetric,
    state: FilmState,
    slopes: FlowSlopes,
    free: Flags,
) -> tuple[Offsets, Array, Array]:
    """Return steps to the neighbours and derivatives by their pressure and film, (n, ny, nx).

    Parameters
    ----------
    stencil, metric
        Of the grid.
    state
        Where they are taken.
    slopes
        Of the flow by pressure, flow factors included.
    free : ndarray of bool, shape (ny, nx)
        Nodes whose equation is solved; rows of the others are zero.
    """
    if state.shear is not None:
        slopes = state.shear.relative(slopes)
    flow, cross = state.film_flow, state.cross
    count = NEIGHBOURS if cross is None else CROSS_NEIGHBOURS
    by_pressure, by_film = np.empty((2, count, *state.film.shape))
    reynolds_derivatives(
        stencil,
        metric,
        state.oil,
        flow,
        state.viscosity_slope,
        state.density,
        state.density_slope,
        state.film,
        slopes,
        free,
        by_pressure,
        by_film,
    )
    if cross is not None:
        add_cross_derivatives(
            stencil,
            metric,
            state.oil,
            flow,
            cross,
            state.viscosity_slope,
            state.film,
            slopes,
            free,
            by_pressure,
            by_film,
        )
    return OFFSETS, by_pressure, by_film
