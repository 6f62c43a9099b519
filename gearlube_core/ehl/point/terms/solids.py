"""Solid contact on one grid of a film: contact pressure of touching solids."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.reynolds import apply_derivatives
from gearlube_core.ehl.point.solid_contact import SolidLayer
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.kernels.jit import kernel

# pressure of oil between touching solids, as a flow, over what flows out of a node as it drains
_DRAINING = 1.0e2


@kernel
def add_layer_slopes(
    offsets: np.ndarray,
    reach: np.ndarray,
    begin: np.ndarray,
    column: np.ndarray,
    slope: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Take p_s' times the derivative by the oil's pressure off that by the film.

    Parameters
    ----------
    offsets : ndarray of int, shape (m, 2), m >= n
        Steps to the neighbours along y and x.
    reach : ndarray of int, shape (ny + 2,)
        Of the sides: rows that hold those from one before the first to one behind the last.
    begin, column : ndarray of int, shapes (ny + 1,) and (k,)
        Columns of the touching nodes, row after row.
    slope : ndarray, shape (ny, nx)
        p_s' of the nodes [-].
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Derivatives; those by film are changed.
    """
    _, ny, nx = by_film.shape
    for k in range(by_film.shape[0]):
        for j in range(1, ny - 1):
            there = reach[j + offsets[k, 0] + 1]
            for m in range(begin[there], begin[there + 1]):
                i = column[m] - offsets[k, 1]
                if 0 < i < nx - 1:
                    by_film[k, j, i] -= by_pressure[k, j, i] * slope[there, column[m]]


@dataclass(frozen=True, slots=True)
class NoContact:
    """No solids touch: the oil has all the pressure."""

    oil: Array  # pressure of the oil, (ny, nx) [-]

    def undrained(self, free: Flags, residual: Array) -> Flags:
        """Return the nodes of `free` whose oil has a pressure of its own."""
        return free

    def apart(self, nodes: Flags) -> Flags:
        """Return the nodes where no solids touch."""
        return nodes

    def unbalanced(self, residual: Array, grid: PointGrid) -> float:
        """Return the residual of the equations of solids, as a flow [-]."""
        return 0.0

    def add_derivatives(self, linear: Linearisation, residual: Array) -> None:
        """Leave the derivatives as they are."""


@dataclass(frozen=True, slots=True)
class ContactPressure:
    """Pressure that touching solids carry on one grid; arrays of shape (ny, nx) [-]."""

    pressure: Array  # of the solids
    slope: Array  # by the film
    left: Array  # whole pressure less that of the solids
    oil: Array  # the same where it is above zero
    weight: float  # of what is left beside the flow that is not balanced

    def drained(self, residual: Array) -> Flags:
        """Return where solids touch and p_f = 0 holds: more oil flows out than pressure there.

        max(R, -c p_f) = 0 is p_f >= 0, R <= 0, p_f R = 0 for any c; a large one leaves the
        Reynolds equation to nodes that hold little oil for a while.
        """
        return (self.pressure > 0.0) & (residual < -_DRAINING * self.weight * self.left)

    def undrained(self, free: Flags, residual: Array) -> Flags:
        """Return the nodes of `free` whose oil has a pressure of its own."""
        return free & ~self.drained(residual)

    def apart(self, nodes: Flags) -> Flags:
        """Return the nodes where no solids touch."""
        return nodes & (self.pressure <= 0.0)

    def unbalanced(self, residual: Array, grid: PointGrid) -> float:
        """Return the residual of the equations of solids, as a flow [-]."""
        return grid.integral(self.unbalanced_flows(residual))

    def unbalanced_flows(self, residual: Array) -> Array:
        """Return the residual of the equations of the nodes, as flows, (ny, nx) [-].

        Flow that gathers counts at drained nodes, too: else a step that ends their draining would
        look like one that unbalances them.
        """
        dry = self.drained(residual)
        wrong = np.where(dry, np.abs(self.left), np.maximum(-self.left, 0.0))
        return self.weight * wrong + np.where(dry, np.maximum(residual, 0.0), 0.0)

    def add_derivatives(self, linear: Linearisation, residual: Array) -> None:
        """Turn derivatives by the pressure of the oil into those by the whole pressure.

        p_f = p - p_s(h), so dp_f = dp - p_s' dh. Drained nodes get the equation p_s - p = 0.

        Parameters
        ----------
        linear
            With the derivatives by the oil's pressure; changed.
        residual : ndarray, shape (ny, nx)
            Of the flow [-].
        """
        offsets, right = linear.neighbours, linear.right
        by_pressure, by_film = linear.by_pressure, linear.by_film
        dry = self.drained(residual)
        dry[[0, -1]] = False
        dry[:, [0, -1]] = False
        reach = linear.sides.reach(right.shape[0])
        # the equations were taken at an oil pressure of zero where p - p_s is below
        lacking = self.oil - self.left
        if lacking.any():
            change, none = np.empty(right.shape), np.zeros(right.shape)
            apply_derivatives(offsets, by_pressure, by_film, reach, lacking, none, change)
            right += change
        right[dry] = self.weight * self.left[dry]
        row, column = np.nonzero(self.slope)
        begin = np.searchsorted(row, np.arange(right.shape[0] + 1))
        add_layer_slopes(offsets, reach, begin, column, self.slope, by_pressure, by_film)
        by_pressure[linear.centre][dry] = -self.weight
        by_film[linear.centre][dry] = self.weight * self.slope[dry]
        linear.free |= dry
        linear.touching = self.pressure > 0.0


class NoSolids:
    """The oil carries the whole load."""

    def share(self, pressure: Array, film: Array, flow_rate: float) -> NoContact:
        """Return the part of a pressure that solids carry: zero."""
        return NoContact(pressure)

    def own_slope(self, linear: Linearisation, nodes: Flags, grid: PointGrid) -> Array:
        """Return the derivative of nodes by their own pressure, for a preconditioner."""
        return linear.by_pressure[linear.centre][nodes]


@dataclass(frozen=True, slots=True)
class TouchingSolids:
    """Solids that touch where the film is thinner than their layer."""

    layer: SolidLayer  # in units of the grid

    def share(self, pressure: Array, film: Array, flow_rate: float) -> NoContact | ContactPressure:
        """Return the part of a pressure that solids carry.

        Parameters
        ----------
        pressure, film : ndarray, shape (ny, nx)
            p and h [-].
        flow_rate
            Flow through a cell over its film [-].
        """
        layer = self.layer
        if not float(film.min()) < layer.thickness:
            return NoContact(pressure)
        touching, slope = layer(film)
        left = pressure - touching
        weight = flow_rate * layer.thickness / layer.pressure
        return ContactPressure(touching, slope, left, np.maximum(left, 0.0), weight)

    def own_slope(self, linear: Linearisation, nodes: Flags, grid: PointGrid) -> Array:
        """Return the derivative of nodes by their own pressure, their deflection included."""
        slope = linear.by_pressure[linear.centre][nodes]
        return slope + grid.own_deflection[nodes] * linear.by_film[linear.centre][nodes]


Contact = NoContact | ContactPressure
Solids = NoSolids | TouchingSolids
