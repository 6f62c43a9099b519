"""Mass-conserving cavitation on one grid of a point contact: what broken film carries."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.equations.rupture import (
    add_fill_derivatives,
    settle_oil,
)
from gearlube_core.ehl.point.equations.state import Carriage, FilmState, Flags
from gearlube_core.ehl.point.equations.stencil import CENTRE, MeshMetric, StencilParameters

# pressure, over spacing in dry semi-axes, from which on a node at an exit has its own stencil: that
# of a node or two before a film breaks
_BLEND = 0.1


class BrokenFilm:
    """Fill of a grid as a function of pressure and film.

    p >= 0, m <= rho h, p (rho h - m) = 0 with the mass m that a gap holds: nodes with pressure
    are full, in others m follows from what comes, node after node downstream. Only pressure
    and approach are left as unknowns, and oil is balanced wherever there is no pressure.

    Parameters
    ----------
    metric, spacing
        Of the grid.
    shape
        Rows and columns.
    layer
        Film on the upstream border [-]; infinite: full.

    Attributes
    ----------
    layer : float
        As given; it may be changed.
    """

    def __init__(
        self, metric: MeshMetric, spacing: float, shape: tuple[int, int], layer: float
    ) -> None:
        self._metric = metric
        self.layer = layer
        self._rate, self._storage = np.ones(shape[0]), np.zeros(shape)
        self._blend = _BLEND * spacing

    @property
    def starved(self) -> bool:
        """Tell whether a layer is given."""
        return bool(np.isfinite(self.layer))

    def settle(
        self,
        stencil: StencilParameters,
        rate: Array | None,
        storage: Array | None,
        state: FilmState,
    ) -> None:
        """Set what the nodes hold and the residual of a state; it has that of full gaps."""
        full = state.mass
        state.mass = full.copy()
        state.ruptured = np.zeros(full.shape, dtype=np.bool_)
        for border in (np.s_[:, 0], np.s_[0]) if stencil.wedge_y > 0.0 else (np.s_[:, 0],):
            np.minimum(full[border], self.layer, out=state.mass[border])
            state.ruptured[border] = state.mass[border] < full[border]
        settle_oil(
            stencil,
            self._metric,
            state.oil,
            self._blend,
            self._rate if rate is None else rate[:, 0],
            self._storage if storage is None else storage,
            full,
            state.mass,
            state.ruptured,
            state.residual,
        )
        # other borders show what the nodes beside them pass on
        for border, beside in ((np.s_[:, -1], np.s_[:, -2]), (np.s_[-1], np.s_[-2])):
            np.minimum(full[border], state.mass[beside], out=state.mass[border])
        if stencil.wedge_y == 0.0:
            np.minimum(full[0], state.mass[1], out=state.mass[0])

    def linearise(
        self,
        stencil: StencilParameters,
        rate: Array | None,
        storage: Array | None,
        state: FilmState,
        free: Flags,
        by_pressure: Array,
        by_film: Array,
    ) -> Carriage:
        """Turn derivatives of full gaps into those of what the nodes hold."""
        assert state.ruptured is not None
        ruptured = state.ruptured
        speed = self._rate if rate is None else rate[:, 0]
        rows = free | ruptured
        rows[0] = rows[:, 0] = False
        add_fill_derivatives(
            stencil,
            self._metric,
            state.oil,
            self._blend,
            ruptured,
            speed,
            state.mass,
            state.density,
            state.density_slope,
            state.film,
            rows,
            by_pressure,
            by_film,
        )
        broken_squeeze = stencil.squeeze * speed[:, None] * state.density
        by_film[CENTRE][ruptured] += broken_squeeze[ruptured]
        out_x = self._metric.narrow * stencil.wedge_x * speed[:, None]
        out_y = stencil.wedge_y * speed[:, None]
        leaves = out_x + out_y + (self._storage if storage is None else storage)
        narrow_ahead = np.append(self._metric.narrow[1:], 0.0)
        to_x = np.where(ruptured, narrow_ahead * stencil.wedge_x * speed[:, None] / leaves, 0.0)
        to_y = np.where(ruptured, out_y / leaves, 0.0)
        to_x[:, -2] = to_y[-2] = 0.0  # what leaves over the border is gone
        return Carriage(to_x, to_y, ruptured)
