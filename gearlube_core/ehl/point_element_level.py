"""One grid of a point contact with the Reynolds equation in finite elements."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.sparse import csr_matrix

from gearlube_core.ehl.point_finite_elements import (
    ELEMENT_NEIGHBOURS,
    apply_element_derivatives,
    element_derivatives,
    element_entries,
    element_residual,
)
from gearlube_core.ehl.point_level import FilmState, Linearisation, PointLevel
from gearlube_core.ehl.problem import PointContactProblem
from gearlube_core.ehl.scaling import PointScales

Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(slots=True)
class ElementLinearisation(Linearisation):
    """Derivatives by finite elements beside those by central differences.

    The seven-point differences of the base are what preconditioners take.
    """

    element_by_pressure: Array = field(default_factory=lambda: np.empty(0))  # (9, ny, nx)
    element_by_film: Array = field(default_factory=lambda: np.empty(0))  # (9, ny, nx)

    def matrix(self) -> csr_matrix:
        """Return the derivatives as a sparse matrix, shape (ny nx, ny nx).

        Real part with respect to pressure, imaginary part to film; rows of free nodes only.
        """
        size = self.free.size
        most = ELEMENT_NEIGHBOURS * int(self.free.sum())
        start = np.empty(size + 1, dtype=np.int32)
        column = np.empty(most, dtype=np.int32)
        entry = np.empty(most, dtype=np.complex128)
        count = element_entries(
            self.element_by_pressure, self.element_by_film, self.free, start, column, entry
        )
        return csr_matrix((entry[:count], column[:count], start), shape=(size, size))


class ElementLevel(PointLevel):
    """Grid of shape (ny, nx) with the Galerkin equations of a problem.

    Takes the place of `PointLevel`: the same state, residual per cell, and linear operator.

    Parameters
    ----------
    problem, scales, shape
        As for `PointLevel`.

    Notes
    -----
    `cross_factor`, shape (ny, nx), is the xy component of the flow factor tensor of a film whose
    sliding is along neither axis; zero by default.
    """

    def __init__(
        self, problem: PointContactProblem, scales: PointScales, shape: tuple[int, int]
    ) -> None:
        super().__init__(problem, scales, shape, "central")
        self.cross_factor = np.zeros(shape)
        # waves of the length 2 d on a half-space: 2/(E* k), k = pi/d
        self.compliance = 2.0 * min(self.dx, self.dy) / (math.pi * self.modulus)

    def _cubic_xy(self, state: FilmState) -> Array:
        return np.asarray(self.cross_factor * state.density * np.maximum(state.film, 0.0) ** 3)

    def state(self, pressure: Array, approach: float, film: Array | None = None) -> FilmState:
        """Return the state at a pressure, zero on the border, and an approach."""
        state = super().state(pressure, approach, film)
        element_residual(
            self.stencil,
            state.pressure,
            state.mass,
            state.cubic_x,
            self._cubic_xy(state),
            state.cubic_y,
            state.fluidity,
            self.source,
            self.compliance,
            state.density,
            state.residual,
        )
        return state

    def linearise(self, state: FilmState, squeeze: float = 0.0) -> ElementLinearisation:
        """Return the derivatives of the residual at a state; flow factors are held."""
        base = super().linearise(state, squeeze)
        by_pressure, by_film = np.empty((2, ELEMENT_NEIGHBOURS, *self.shape))
        element_derivatives(
            self.stencil._replace(squeeze=self.stencil.squeeze + squeeze),
            state.pressure,
            state.cubic_x,
            self._cubic_xy(state),
            state.cubic_y,
            state.fluidity,
            state.viscosity_slope,
            state.density,
            state.density_slope,
            state.film,
            self.compliance,
            base.free,
            by_pressure,
            by_film,
        )
        return ElementLinearisation(
            base.by_pressure,
            base.by_film,
            by_film.sum(axis=0),
            base.free,
            base.result,
            by_pressure,
            by_film,
        )

    def apply(self, linear: Linearisation, pressure: Array, approach: float) -> Array:
        """Return the change of the residual under changes of pressure and approach.

        The result is overwritten by the next call with the same `linear`.
        """
        assert isinstance(linear, ElementLinearisation)
        film = self.deflection(pressure)
        apply_element_derivatives(
            linear.element_by_pressure, linear.element_by_film, pressure, film, linear.result
        )
        if approach != 0.0:
            linear.result += approach * linear.by_approach
        return linear.result
