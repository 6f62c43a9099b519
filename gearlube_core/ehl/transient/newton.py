"""Newton iteration of one time step; its preconditioner is reused in later steps.

Front of the pressurised oil, updated alone between two Newton steps of the whole film.

A Newton step opens the next node downstream of the nodes with pressure, no more. Where a gap
closes quickly, at the edge of a relief, oil fills many nodes of a row within one time step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.newton.newton import flexible_gmres, flow_residual
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.transient.level import MovingLevel, lifted, lifted_off_solids
from gearlube_core.ehl.transient.patches import TouchingPatches
from gearlube_core.ehl.transient.rows import Inverse, WindowedDeflection
from gearlube_core.kernels.jit import kernel

_LARGEST = 3.0  # flow residual, above which the film behind the front is too rough
# share of the unbalanced flow at reopening nodes above which the front is taken as the cause
_SHARE = 0.3
# below this flow residual only the front is open: then a smaller share suffices, and the flow that
# its move unbalances elsewhere is left to the next linear solution
_FOUND = 0.2
_SHARE_FOUND, _GROWTH_FOUND = 0.1, 6.0
_FEW = 0.01  # of the largest unbalanced flow, below which an opening node is left alone
_BACK, _AHEAD, _BESIDE = 4, 16, 2  # nodes along and across the motion that follow an opening one
_SWEEPS = 50
_THINNEST = 0.2  # of the film before a step
_GROWTH = 1.2  # of the residual that a step may cost
_CUTS = 4
_LOAD_WEIGHT = 0.1
_ENOUGH = 0.2  # of the residual that ends the iteration, for a linear solution
_FORCING = 0.3  # of the share of the residual that the last step left, for a linear solution
_LARGEST_FORCING = 0.03  # rougher ones lose solids that touch


@kernel
def mark_band(opening: np.ndarray, back: int, ahead: int, beside: int, band: np.ndarray) -> None:
    """Set flags around opening nodes, inside the border; shapes (ny, nx)."""
    ny, nx = opening.shape
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if opening[j, i]:
                for jj in range(max(1, j - beside), min(ny - 1, j + beside + 1)):
                    for ii in range(max(1, i - back), min(nx - 1, i + ahead + 1)):
                        band[jj, ii] = True


@kernel
def relax_band(
    offsets: np.ndarray,
    by_pressure: np.ndarray,
    slope: np.ndarray,
    places: np.ndarray,
    pressure: np.ndarray,
    right: np.ndarray,
    centre: int,
    sweeps: int,
    change: np.ndarray,
) -> None:
    """Write changes of pressure that balance a band of nodes downstream, node by node.

    Parameters
    ----------
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x.
    by_pressure : ndarray, shape (m, ny, nx), m <= n
        Derivatives of the residual at given film.
    slope : ndarray, shape (ny, nx)
        Of the node itself, with what its own pressure does to the film.
    places : ndarray of int, shape (k, 2)
        Nodes in the order of the sweep.
    pressure, right : ndarray, shape (ny, nx)
        Pressure, and what the derivatives times the changes have to be.
    centre
        Number of the node itself among its neighbours.
    sweeps
        Number of Gauss-Seidel sweeps.
    change : ndarray, shape (ny, nx)
        Result; zero on entry. Pressure does not become negative.
    """
    ny, nx = change.shape
    for _ in range(sweeps):
        for m in range(places.shape[0]):
            j, i = places[m, 0], places[m, 1]
            if slope[j, i] >= 0.0:
                continue
            rest = right[j, i] - (slope[j, i] - by_pressure[centre, j, i]) * change[j, i]
            for k in range(by_pressure.shape[0]):
                jj, ii = j + offsets[k, 0], i + offsets[k, 1]
                if 0 <= jj < ny and 0 <= ii < nx:
                    rest -= by_pressure[k, j, i] * change[jj, ii]
            change[j, i] = max(change[j, i] + rest / slope[j, i], -pressure[j, i])


def advance_front(level: MovingLevel, state: FilmState, size: float) -> tuple[FilmState, float]:
    """Return the state with its front moved, and its flow residual, where that pays.

    Parameters
    ----------
    level
        Grid level with its equations.
    state
        After a Newton step.
    size
        Its flow residual [-].

    Returns
    -------
    tuple
        The state as given where flow is unbalanced elsewhere or the front's move left more, six
        times as much once little is left: by then it is the front alone that Newton steps find
        node by node, while what its move does to the film around it is linear.

    Notes
    -----
    Projected Gauss-Seidel on the linearised Reynolds equation in a band around the opening nodes,
    at the film of the state but for what a node's own pressure adds.
    """
    if not size < _LARGEST:
        return state, size
    found = size < _FOUND
    share, growth = (_SHARE_FOUND, _GROWTH_FOUND) if found else (_SHARE, 1.0)
    opening = (state.pressure <= 0.0) & state.free
    flow = np.where(opening, state.residual, 0.0)
    if level.grid.integral(flow) < share * level.grid.integral(
        np.where(state.free, np.abs(state.residual), 0.0)
    ):
        return state, size
    band = np.zeros(level.shape, dtype=np.bool_)
    mark_band(flow > _FEW * flow.max(), _BACK, _AHEAD, _BESIDE, band)
    band = state.contact.apart(state.boundary.within(band))
    linear = level.linearise(state, rows=band.copy())
    change, centre = np.zeros(level.shape), linear.centre
    relax_band(
        linear.offsets,
        linear.by_pressure,
        linear.by_pressure[centre] + level.grid.own_deflection * linear.by_film[centre],
        np.argwhere(band),
        state.pressure,
        linear.right,
        centre,
        _SWEEPS,
        change,
    )
    moved = level.state(state.pressure + change, state.approach)
    after = flow_residual(level, moved)
    return (moved, after) if after < growth * size else (state, size)


@dataclass(slots=True)
class StepRecord:
    """Outcome of the iteration of one time step."""

    converged: bool
    residual: float  # as `flow_residual`
    newton_steps: int
    krylov_steps: int
    renewals: int  # of the preconditioner


class LaggedPreconditioner:
    """A multigrid cycle that is built once and used for several linearisations.

    It solves the nodes that carried pressure when it was built; nodes that came since are solved
    on their own, nodes that left keep no pressure. Between closed sides patches around touching
    nodes are solved after it, at every linearisation.

    Parameters
    ----------
    hierarchy
        Grids; the finest one is solved.
    build
        Of hierarchy, linearisation and the cycle before, None at first: the cycle.
    patience
        Krylov iterations of one linear solution after which the cycle is brought up to date.
    """

    def __init__(
        self,
        hierarchy: Hierarchy,
        build: Callable[[Hierarchy, Linearisation, Any], Inverse],
        patience: int = 8,
    ) -> None:
        self.hierarchy = hierarchy
        self._build = build
        self.patience = patience
        self.renewals = 0
        self._cycle: Inverse | None = None
        self._stale, self._same = True, False
        self._free = self._new = np.zeros(0, dtype=np.bool_)
        self._linear: Linearisation | None = None
        self._patches: TouchingPatches | None = None
        level = hierarchy.levels[-1]
        self.deflection = WindowedDeflection(level.grid)
        self._level = level

    def renew(self, linear: Linearisation) -> None:
        """Build the cycle at a linearisation."""
        self._cycle = self._build(self.hierarchy, linear, self._cycle)
        self._stale = False
        self._free = linear.free.copy()
        self.renewals += 1

    def use_for(self, linear: Linearisation) -> None:
        """Use the cycle for another linearisation."""
        if self._stale:
            self.renew(linear)
        self._linear = linear
        self.deflection.follow(linear.free)
        self._same = np.array_equal(linear.free, self._free)
        self._new = linear.free & ~self._free
        # rows that are solved whole need none
        touches = linear.touching is not None and linear.sides.closed
        self._patches = TouchingPatches(self._level.grid, linear) if touches else None

    def mark_outdated(self) -> None:
        """Bring the cycle up to date before its next use."""
        self._stale = True

    def clear(self) -> None:
        """Drop the cycle."""
        self._cycle, self._stale = None, True
        self.deflection.clear()

    def __call__(self, residual: Array, load_residual: float) -> tuple[Array, float]:
        """Return pressure and approach that cancel most of a residual."""
        assert self._cycle is not None
        assert self._linear is not None
        if self._same:
            # other nodes have no equation: residual and pressure are zero there
            pressure, approach = self._cycle(residual, load_residual)
        else:
            pressure, approach = self._cycle(np.where(self._free, residual, 0.0), load_residual)
            pressure[~self._linear.free] = 0.0
            new = self._new
            solids = self._level.terms.solids
            pressure[new] = residual[new] / solids.own_slope(self._linear, new, self._level.grid)
        if self._patches is not None:
            self._patches.correct(residual, self.deflection(pressure), approach, pressure)
        return pressure, approach


def step_newton(
    lagged: LaggedPreconditioner,
    state: FilmState,
    *,
    tolerance: float,
    load_tolerance: float,
    most: int,
    most_krylov: int,
) -> tuple[FilmState, StepRecord]:
    """Return the state at the new time on the finest grid.

    Parameters
    ----------
    lagged
        Preconditioner; renewed where it has become too slow.
    state
        State as predicted for the step.
    tolerance, load_tolerance
        Limits of `flow_residual` and of the relative load error [-].
    most, most_krylov
        Most steps, and most iterations in one of them.

    Returns
    -------
    tuple
        Last state and record of the iteration.

    Notes
    -----
    As the steady iteration: active set, negative pressure cut, steps shortened where the film
    would collapse or the residual grow. A film that collapses at few nodes, or where solids are
    pressed on each other too far, is lifted there.
    Storage makes a fictitious squeeze term superfluous.
    Linear solutions are as exact as the step before suggests that the film is linear
    ([eisenstat_walker_1996]), with deflection in single precision.
    """
    level = lagged.hierarchy.levels[-1]
    assert isinstance(level, MovingLevel)
    size = flow_residual(level, state)
    krylov, steps, before, forcing = 0, 0, lagged.renewals, _LARGEST_FORCING
    while steps < most:
        if size <= tolerance and abs(state.load_error) <= load_tolerance:
            break
        steps += 1
        linear = level.linearise(state)
        lagged.use_for(linear)
        wanted = max(min(forcing, _LARGEST_FORCING), _ENOUGH * tolerance / size)
        pressure, approach, remainder, count = flexible_gmres(
            lambda p, h, linear=linear: (  # type: ignore[misc]
                level.apply(linear, p, h, lagged.deflection).copy(),
                level.grid.integral(p) / level.load,
            ),
            lagged,
            linear.right,
            state.load_error,
            tolerance=wanted,
            most=most_krylov,
            weight=_LOAD_WEIGHT * float(np.linalg.norm(linear.by_approach)),
        )
        krylov += count
        if remainder > wanted:
            lagged.clear()  # what it kept of an earlier state stands in the way
        elif count > lagged.patience:
            lagged.mark_outdated()
        thinnest = _THINNEST * max(float(state.film.min()), 0.0)
        length, accepted = 1.0, False
        for _ in range(_CUTS):
            trial = level.state(
                np.maximum(state.pressure + length * pressure, 0.0),
                state.approach + length * approach,
            )
            if float(trial.film.min()) <= thinnest:
                trial = lifted(level, trial, _THINNEST * state.film) or trial
            trial = lifted_off_solids(level, trial)
            trial_size = flow_residual(level, trial)
            # a change of load unbalances flow before it balances it
            allowed = _GROWTH * (size + abs(state.load_error))
            if float(trial.film.min()) > thinnest and trial_size < allowed:
                accepted = True
                break
            length *= 0.4
        if not accepted:
            break
        state, after = trial, trial_size
        if not (after <= tolerance and abs(state.load_error) <= load_tolerance):
            state, after = advance_front(level, trial, trial_size)
        forcing, size = _FORCING * after / size, after
    converged = (
        size <= tolerance
        and abs(state.load_error) <= load_tolerance
        and float(state.film.min()) > 0.0
    )
    return state, StepRecord(converged, size, steps, krylov, lagged.renewals - before)
