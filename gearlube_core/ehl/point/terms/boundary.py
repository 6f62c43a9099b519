"""Boundary condition of ambient pressure: on the border, or wherever the film is thick."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.far_field import BorderPressure, border_pressure
from gearlube_core.ehl.point.settings import AMBIENT, Sides
from gearlube_core.ehl.point.terms.linearisation import Linearisation


class AmbientBorder:
    """Ambient pressure on the border; oil anywhere inside may have pressure.

    Parameters
    ----------
    sides
        Copied rows instead of the first and the last row of the border.
    """

    _sides = AMBIENT

    def __init__(self, sides: Sides = AMBIENT) -> None:
        self._sides = sides

    def impose(self, pressure: Array, approach: float) -> Array:
        """Return a pressure, (ny, nx), with what the boundary sets."""
        return self._sides.filled(pressure)

    def within(self, nodes: Flags) -> Flags:
        """Return the nodes whose pressure the boundary leaves free, of shape (ny, nx)."""
        if self._sides.closed:
            nodes = nodes.copy()
            nodes[[0, -1]] = False
        return nodes

    def load(self, approach: float) -> tuple[float, float]:
        """Return the load beyond the border and its slope by the approach [-]."""
        return 0.0, 0.0

    def add_derivatives(
        self, linear: Linearisation, approach: float, grid: PointGrid, load: float
    ) -> None:
        """Leave the derivatives as they are."""

    def with_viscosity(self, factor: float) -> AmbientBorder:
        """Return the boundary for an oil of `factor` times the viscosity."""
        return self

    def sentence(self, share: float) -> str:
        """Return a sentence on the share of the load that is carried beyond the border."""
        return ""

    def border_pressure(
        self, pressure: Array, film: Array, approach: float, outward: Callable[[Array], Array]
    ) -> BorderPressure:
        """Return how far the domain cuts the contact.

        Parameters
        ----------
        pressure, film : ndarray, shape (ny, nx)
            p and h [-].
        approach
            h_0 [-].
        outward
            Turns an array into the order of the problem, (nx, ny).
        """
        sides = self._sides
        return border_pressure(
            outward(sides.inner(pressure)), outward(sides.inner(film)), closed=sides.closed
        )


class AmbientOutside(AmbientBorder):
    """Ambient pressure on the border and outside a region.

    Parameters
    ----------
    region : ndarray of bool, shape (ny, nx)
        Nodes where oil may be above ambient pressure.
    sides
        As in `AmbientBorder`.
    """

    def __init__(self, region: Flags, sides: Sides = AMBIENT) -> None:
        super().__init__(sides)
        self._region = region

    def impose(self, pressure: Array, approach: float) -> Array:
        """Return a pressure, (ny, nx), that is ambient outside the region."""
        return super().impose(np.where(self._region, pressure, 0.0), approach)

    def within(self, nodes: Flags) -> Flags:
        """Return the nodes inside the region."""
        return super().within(nodes) & self._region
