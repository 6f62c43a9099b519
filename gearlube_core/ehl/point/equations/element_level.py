"""One grid of a point contact with the Reynolds equation in finite elements."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.equations.finite_elements import (
    ELEMENT_CENTRE,
    ELEMENT_NEIGHBOURS,
    ELEMENT_OFFSETS,
    element_derivatives,
    element_residual,
)
from gearlube_core.ehl.point.equations.level import PointLevel
from gearlube_core.ehl.point.equations.state import FilmState, Flags, Offsets
from gearlube_core.ehl.point.equations.stencil import FlowSlopes, StencilParameters
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales


class ElementLevel(PointLevel):
    """Grid of shape (ny, nx) with the Galerkin equations of a problem.

    Takes the place of `PointLevel`: the same state, residual per cell, and linear operator.

    Parameters
    ----------
    problem, scales, shape
        As for `PointLevel`.
    wedge
        `upwind-1` for upwinding of first order everywhere.
    """

    _centre = ELEMENT_CENTRE

    def __init__(
        self,
        problem: PointContactProblem,
        scales: PointScales,
        shape: tuple[int, int],
        wedge: str = "central",
    ) -> None:
        super().__init__(problem, scales, shape, wedge if wedge == "upwind-1" else "central")
        self.stencil = self.stencil._replace(least=-math.inf, most=math.inf)
        # waves of the length 2 d on a half-space: 2/(E* k), k = pi/d
        self.compliance = 2.0 * min(self.dx, self.dy) / (math.pi * self.modulus)

    def _cubic_xy(self, state: FilmState) -> Array:
        return self._aligned if state.cubic_xy is None else state.cubic_xy

    def _balance(self, state: FilmState, carried: Array) -> None:
        element_residual(
            self.stencil,
            state.oil,
            carried,
            state.cubic_x,
            self._cubic_xy(state),
            state.cubic_y,
            state.fluidity,
            self.source,
            self.compliance,
            state.density,
            state.residual,
        )

    def _derivatives(
        self, stencil: StencilParameters, state: FilmState, slopes: FlowSlopes, free: Flags
    ) -> tuple[Offsets, Array, Array]:
        by_pressure, by_film = np.empty((2, ELEMENT_NEIGHBOURS, *self.shape))
        element_derivatives(
            stencil,
            state.oil,
            state.cubic_x,
            self._cubic_xy(state),
            state.cubic_y,
            state.fluidity,
            state.viscosity_slope,
            state.density,
            state.density_slope,
            state.film,
            slopes,
            self.compliance,
            free,
            by_pressure,
            by_film,
        )
        return ELEMENT_OFFSETS, by_pressure, by_film
