"""Cavitation on one grid: Reynolds condition (gap full of oil), or mass-conserving."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.rupture import add_fill_derivatives, fill_ruptured_nodes
from gearlube_core.ehl.point.equations.stencil import CarriedMass, MeshMetric
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.ehl.point.terms.ruptured_transport import RupturedTransport
from gearlube_core.ehl.point.terms.state import Balance, FilmState

# pressure, over spacing in dry semi-axes, from which on a node at an exit has its own stencil: that
# of a node or two before a film breaks
_BLEND = 0.1


@dataclass(frozen=True, slots=True)
class ReynoldsCavitation:
    """p >= 0: nodes without pressure hold what their gap holds, and no mass is conserved."""

    full: Flags  # ruptured nodes, (ny, nx): none

    conserves_mass = False
    starved = False
    inlet_layer = math.inf  # film on the upstream border [-]

    def with_inlet_layer(self, layer: float) -> ReynoldsCavitation:
        """Return the same: gaps are full of oil."""
        return self

    def rows(self, free: Flags, state: FilmState) -> Flags:
        """Return the nodes whose derivatives are wanted, (ny, nx)."""
        return free

    def add_residual(self, state: FilmState, balance: Balance) -> None:
        """Leave the state as it is."""

    def add_derivatives(self, linear: Linearisation, state: FilmState, balance: Balance) -> None:
        """Leave the derivatives as they are."""


@dataclass(frozen=True, slots=True)
class MassConservingCavitation:
    """Oil that a grid holds, as a function of pressure and film.

    p >= 0, m <= rho h, p (rho h - m) = 0 with the mass m that a gap holds: nodes with pressure
    are full, in others m follows from what comes, node after node downstream. Only pressure
    and approach are left as unknowns, and oil is balanced wherever there is no pressure. The
    cavity fraction is theta = 1 - m/(rho h).

    Parameters
    ----------
    full : ndarray of bool, shape (ny, nx)
        Ruptured nodes of a film that is not broken: none.
    metric
        Of the grid.
    blend
        Pressure below which a node at an exit has its own stencil [-].
    inlet_layer
        Film on the upstream border [-]; infinite: full.
    """

    full: Flags
    metric: MeshMetric
    blend: float
    inlet_layer: float

    conserves_mass = True

    @classmethod
    def of(
        cls, full: Flags, metric: MeshMetric, spacing: float, inlet_layer: float
    ) -> MassConservingCavitation:
        """Return that of a grid with a spacing along x [-]."""
        return cls(full, metric, _BLEND * spacing, inlet_layer)

    @property
    def starved(self) -> bool:
        """Tell whether an inlet layer is given."""
        return math.isfinite(self.inlet_layer)

    def with_inlet_layer(self, layer: float) -> MassConservingCavitation:
        """Return the cavitation of a contact with another film on its upstream border [-]."""
        return replace(self, inlet_layer=layer)

    def rows(self, free: Flags, state: FilmState) -> Flags:
        """Return the nodes whose derivatives are wanted: ruptured ones as well, (ny, nx)."""
        return free | state.ruptured

    def add_residual(self, state: FilmState, balance: Balance) -> None:
        """Set the oil that the nodes hold and the residual, first computed for full gaps."""
        stencil, full = balance.stencil, state.mass
        state.mass = full.copy()
        state.ruptured = np.zeros(full.shape, dtype=np.bool_)
        for border in (np.s_[:, 0], np.s_[0]) if stencil.wedge_y > 0.0 else (np.s_[:, 0],):
            np.minimum(full[border], self.inlet_layer, out=state.mass[border])
            state.ruptured[border] = state.mass[border] < full[border]
        fill_ruptured_nodes(
            stencil,
            self.metric,
            state.oil,
            self.blend,
            balance.rows,
            balance.storage,
            full,
            state.mass,
            state.ruptured,
            state.residual,
        )
        # other borders show what the nodes beside them pass on; under pressure they are full
        beside: list[tuple[Any, Any]] = [(np.s_[:, -1], np.s_[:, -2]), (np.s_[-1], np.s_[-2])]
        if stencil.wedge_y == 0.0:
            beside.append((np.s_[0], np.s_[1]))
        for border, near in beside:
            passed_on = np.minimum(full[border], state.mass[near])
            state.mass[border] = np.where(state.oil[border] > 0.0, full[border], passed_on)

    def add_derivatives(self, linear: Linearisation, state: FilmState, balance: Balance) -> None:
        """Turn derivatives of full gaps into those of the oil that the nodes hold."""
        stencil, speed, ruptured = balance.stencil, balance.rows, state.ruptured
        rows = linear.free | ruptured
        rows[0] = rows[:, 0] = False
        add_fill_derivatives(
            stencil,
            self.metric,
            state.oil,
            self.blend,
            ruptured,
            speed,
            state.mass,
            CarriedMass(state.density, state.density_slope, state.film),
            rows,
            linear.by_pressure,
            linear.by_film,
        )
        squeeze = stencil.squeeze * speed[:, None] * state.density
        linear.by_film[linear.centre][ruptured] += squeeze[ruptured]
        linear.transport = self._transport(ruptured, balance)

    def _transport(self, ruptured: Flags, balance: Balance) -> RupturedTransport:
        """Return the shares of a change that ruptured nodes pass on downstream."""
        stencil, speed = balance.stencil, balance.rows[:, None]
        out_x = self.metric.narrow * stencil.wedge_x * speed
        out_y = stencil.wedge_y * speed
        leaves = out_x + out_y + balance.storage
        narrow_ahead = np.append(self.metric.narrow[1:], 0.0)
        to_x: Array = np.where(ruptured, narrow_ahead * stencil.wedge_x * speed / leaves, 0.0)
        to_y: Array = np.where(ruptured, out_y / leaves, 0.0)
        to_x[:, -2] = to_y[-2] = 0.0  # what leaves over the border is gone
        return RupturedTransport(to_x, to_y, ruptured)


Cavitation = ReynoldsCavitation | MassConservingCavitation
