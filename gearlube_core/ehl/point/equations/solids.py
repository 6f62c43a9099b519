"""Touching solids on one grid of a film: what they take of the pressure, and their equations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags, Offsets
from gearlube_core.ehl.point.equations.stencil import apply_derivatives
from gearlube_core.ehl.point.solid_contact import SolidLayer

# pressure of oil between touching solids, as a flow, over what flows out of a node as it drains
_DRAINING = 1.0e2


@dataclass(slots=True)
class SolidShare:
    """What touching solids take of the pressure on one grid; arrays of shape (ny, nx)."""

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

    def unbalanced(self, residual: Array) -> Array:
        """Return as flows what is left where nothing should be, what lacks, and what gathers there.

        Flow that gathers counts at drained nodes, too: else a step that ends their draining would
        look like one that unbalances them.
        """
        dry = self.drained(residual)
        wrong = np.where(dry, np.abs(self.left), np.maximum(-self.left, 0.0))
        return self.weight * wrong + np.where(dry, np.maximum(residual, 0.0), 0.0)


def solid_share(
    layer: SolidLayer | None, pressure: Array, film: Array, flow_rate: float
) -> SolidShare | None:
    """Return what touching solids take of a pressure; None where none touch.

    Parameters
    ----------
    layer
        Of the solids.
    pressure, film : ndarray, shape (ny, nx)
        p and h [-].
    flow_rate
        Flow through a cell over its film [-].
    """
    if layer is None or not float(film.min()) < layer.thickness:
        return None
    touching, slope = layer(film)
    left = pressure - touching
    weight = flow_rate * layer.thickness / layer.pressure
    return SolidShare(touching, slope, left, np.maximum(left, 0.0), weight)


def add_solids(
    solids: SolidShare,
    residual: Array,
    offsets: Offsets,
    by_pressure: Array,
    by_film: Array,
    right: Array,
    centre: int,
) -> Flags:
    """Turn derivatives by the pressure of the oil into those by the whole pressure.

    p_f = p - p_s(h), so dp_f = dp - p_s' dh. Drained nodes get the equation p_s - p = 0.

    Parameters
    ----------
    solids
        At the state.
    residual : ndarray, shape (ny, nx)
        Of the flow [-].
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x.
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Derivatives with respect to the neighbours' pressure and film; changed.
    right : ndarray, shape (ny, nx)
        What they times the changes have to be; changed.
    centre
        Number of the node itself among its neighbours.

    Returns
    -------
    ndarray of bool, shape (ny, nx)
        Drained nodes.
    """
    dry = solids.drained(residual)
    dry[[0, -1]] = False
    dry[:, [0, -1]] = False
    # the equations were taken at an oil pressure of zero where p - p_s is below
    change, lacking = np.empty(right.shape), solids.oil - solids.left
    none = np.zeros(right.shape)
    apply_derivatives(offsets, by_pressure, by_film, lacking, none, change)
    right += change
    right[dry] = solids.weight * solids.left[dry]
    for k in range(by_film.shape[0]):
        down, along = offsets[k]
        # rows on the border are zero: what comes round does not count
        by_film[k] -= by_pressure[k] * np.roll(solids.slope, (-down, -along), axis=(0, 1))
    by_pressure[centre][dry] = -solids.weight
    by_film[centre][dry] = solids.weight * solids.slope[dry]
    return dry
