"""Cavitation on one grid: Reynolds condition (gap full of oil), or mass-conserving.

Oil flow through ruptured film, on one grid of a point contact: kernels.

A node without pressure holds what its upstream neighbours bring and no more than its gap. Rows and
columns are those of `point_stencil`: entrainment points to larger indices, so one sweep does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.stencil import (
    CENTRE,
    EAST,
    FAR_SOUTH,
    FAR_WEST,
    NORTH,
    SOUTH,
    WEST,
    CarriedMass,
    MeshMetric,
    StencilParameters,
    face_weights,
)
from gearlube_core.ehl.point.terms.linearisation import Linearisation, RupturedTransport
from gearlube_core.ehl.point.terms.state import Balance, FilmState
from gearlube_core.kernels.jit import kernel

# pressure, over spacing in dry semi-axes, from which on a node at an exit has its own stencil: that
# of a node or two before a film breaks
_BLEND = 0.1


@kernel
def wedge_face(
    parameters: StencilParameters,
    along: bool,
    pressure: np.ndarray,
    ruptured: np.ndarray,
    carried: np.ndarray,
    blend: float,
    j: int,
    i: int,
) -> tuple[float, float, float, float, float, float]:
    """Return the face downstream of a node as `reynolds_residual` has it, and its share.

    Parameters
    ----------
    parameters
        Equation parameters of the grid.
    along
        The face across x; else that across y.
    pressure, ruptured, carried : ndarray, shape (ny, nx)
        p, nodes that hold less than their gap, and rho h of full gaps times the share of the speed.
    blend
        Pressure from which on a node passes on what the stencil says [-].
    j, i
        Node upstream of the face.

    Returns
    -------
    tuple
        Value, the weights of the node, of the one upstream and of the one downstream; the share of
        the value beside what the node holds itself, and the slope of the share by the pressure.

    Notes
    -----
    A ruptured node passes on what it holds. Where the stencil says more than rho h of a full one,
    as where the gap opens, its share is q (2 - q), q = p/blend, up to 1: with a jump between the
    two there is an inflow at which neither balances. Where it says less both balance over some
    range, and no share is needed.
    """
    index = i if along else j
    far_j, far_i = (j, max(i - 1, 0)) if along else (max(j - 1, 0), i)
    there_j, there_i = (j, i + 1) if along else (j + 1, i)
    far, near, there = carried[far_j, far_i], carried[j, i], carried[there_j, there_i]
    w0, w1, w2 = face_weights(parameters, index, far, near, there)
    value = w0 * near + w1 * far + w2 * there
    if ruptured[j, i] or (parameters.upstream != 0.0 and ruptured[far_j, far_i]):
        return value, w0, w1, w2, 0.0, 0.0
    q = pressure[j, i] / blend
    if value <= near or q >= 1.0 or index == 0:
        return value, w0, w1, w2, 1.0, 0.0
    return value, w0, w1, w2, q * (2.0 - q), 2.0 * (1.0 - q) / blend


@kernel
def fill_ruptured_nodes(
    parameters: StencilParameters,
    metric: MeshMetric,
    pressure: np.ndarray,
    blend: float,
    rate: np.ndarray,
    storage: np.ndarray,
    full: np.ndarray,
    mass: np.ndarray,
    ruptured: np.ndarray,
    residual: np.ndarray,
) -> None:
    """Write what every node holds and turn the residual of full gaps into that of what they hold.

    Parameters
    ----------
    parameters, metric
        Equation parameters and spacing of the grid.
    pressure : ndarray, shape (ny, nx)
        p [-].
    blend
        Of `wedge_face`.
    rate : ndarray, shape (ny,)
        Entrainment of every row over that of the problem [-].
    storage : ndarray, shape (ny, nx)
        Rate at which oil is stored [-].
    full : ndarray, shape (ny, nx)
        rho h of full gaps [-].
    mass : ndarray, shape (ny, nx)
        rho h times the fill; upstream borders are given, inner nodes are written [-].
    ruptured : ndarray of bool, shape (ny, nx)
        No pressure, and not more oil than the gap takes; upstream borders are given, inner
        nodes are written.
    residual : ndarray, shape (ny, nx)
        Of full gaps; changed. Zero in ruptured nodes.

    Notes
    -----
    Nodes without pressure that cannot take what comes keep the rest as their residual, which
    calls for pressure. [jakobsson_floberg_1957], [olsson_1965]; [elrod_1981]; as a complementarity
    of pressure and void [giacopini_2010].
    """
    ny, nx = pressure.shape
    carried = rate.reshape(ny, 1) * full
    ruptured[1:, 1:] = False
    for j in range(ny - 1):
        for i in range(nx - 1):
            across = parameters.wedge_y > 0.0 and i > 0
            inner = j > 0 and i > 0
            x_value, x_share, y_value, y_share = 0.0, 1.0, 0.0, 1.0
            if j > 0:
                x_value, _, _, _, x_share, _ = wedge_face(
                    parameters, True, pressure, ruptured, carried, blend, j, i
                )
            if across:
                y_value, _, _, _, y_share, _ = wedge_face(
                    parameters, False, pressure, ruptured, carried, blend, j, i
                )
            if inner:
                mass[j, i] = full[j, i]
            if x_share == 1.0 and y_share == 1.0 and not (inner and pressure[j, i] <= 0.0):
                continue
            out_x = metric.narrow[i] * parameters.wedge_x if j > 0 else 0.0
            out_y = parameters.wedge_y if across else 0.0
            if inner and pressure[j, i] <= 0.0:
                excess = residual[j, i]
                excess -= out_x * (carried[j, i] - x_value) + out_y * (carried[j, i] - y_value)
                if excess <= 0.0:
                    ruptured[j, i] = True
                    x_share, y_share = 0.0, 0.0
                    mass[j, i] += excess / ((out_x + out_y) * rate[j] + storage[j, i])
            own = rate[j] * mass[j, i]
            more_x = (1.0 - x_share) * (own - x_value)
            more_y = (1.0 - y_share) * (own - y_value)
            if inner:
                residual[j, i] -= out_x * more_x + out_y * more_y
                if ruptured[j, i]:
                    residual[j, i] = 0.0
            if j > 0 and i < nx - 2:
                residual[j, i + 1] += metric.narrow[i + 1] * parameters.wedge_x * more_x
            if across and j < ny - 2:
                residual[j + 1, i] += parameters.wedge_y * more_y


@kernel
def add_fill_derivatives(
    parameters: StencilParameters,
    metric: MeshMetric,
    pressure: np.ndarray,
    blend: float,
    ruptured: np.ndarray,
    rate: np.ndarray,
    mass: np.ndarray,
    full: CarriedMass,
    rows: np.ndarray,
    by_pressure: np.ndarray,
    by_film: np.ndarray,
) -> None:
    """Turn the derivatives of full gaps into those of the oil that `fill_ruptured_nodes` finds.

    Parameters
    ----------
    parameters, metric, pressure, blend, ruptured, rate, mass
        As in `fill_ruptured_nodes`, after it.
    full
        Density and film of full gaps.
    rows : ndarray of bool, shape (ny, nx)
        Nodes whose derivatives are wanted.
    by_pressure, by_film : ndarray, shape (n, ny, nx)
        Derivatives by pressure and film, changed.
    """
    density, density_slope, film = full
    ny, nx = film.shape
    carried = rate.reshape(ny, 1) * density * film
    for j in range(ny - 1):
        for i in range(nx - 1):
            for along in (True, False):
                if (along and j == 0) or (not along and (i == 0 or parameters.wedge_y == 0.0)):
                    continue
                value, w0, w1, w2, share, slope = wedge_face(
                    parameters, along, pressure, ruptured, carried, blend, j, i
                )
                if share == 1.0:
                    continue
                lack = 1.0 - share
                jump = rate[j] * mass[j, i] - value
                own = 0.0 if ruptured[j, i] else 1.0
                down, right = (0, 1) if along else (1, 0)
                behind, ahead = (WEST, EAST) if along else (SOUTH, NORTH)
                far_behind = FAR_WEST if along else FAR_SOUTH
                there_j, there_i = j + down, i + right
                flow = parameters.wedge_x if along else parameters.wedge_y
                near_row = -flow * (metric.narrow[i] if along else 1.0) * rows[j, i]
                there_row = flow * (metric.narrow[there_i] if along else 1.0)
                there_row *= rows[there_j, there_i]
                for node in range(3):
                    weight = own - w0 if node == 0 else (-w1 if node == 1 else -w2)
                    step = 0 if node == 0 else (-1 if node == 1 else 1)
                    jj, ii = j + step * down, i + step * right
                    if jj < 0 or ii < 0:
                        continue
                    by_p = lack * weight * rate[jj] * density_slope[jj, ii] * film[jj, ii]
                    if node == 0:
                        by_p -= slope * jump
                    by_h = lack * weight * rate[jj] * density[jj, ii]
                    of_near = CENTRE if node == 0 else (behind if node == 1 else ahead)
                    of_there = behind if node == 0 else (far_behind if node == 1 else CENTRE)
                    by_pressure[of_near, j, i] += near_row * by_p
                    by_film[of_near, j, i] += near_row * by_h
                    by_pressure[of_there, there_j, there_i] += there_row * by_p
                    by_film[of_there, there_j, there_i] += there_row * by_h


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
        Spacing factors of the grid.
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
