"""Newton iteration of one time step; its preconditioner is reused in later steps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.newton.hierarchy import Hierarchy
from gearlube_core.ehl.point.newton.krylov import flexible_gmres
from gearlube_core.ehl.point.newton.newton import flow_residual
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.transient.deflection_window import WindowedDeflection
from gearlube_core.ehl.transient.front import advance_front
from gearlube_core.ehl.transient.level import MovingLevel
from gearlube_core.ehl.transient.lift import lifted, lifted_off_solids
from gearlube_core.ehl.transient.rows import Inverse

_THINNEST = 0.2  # of the film before a step
_GROWTH = 1.2  # of the residual that a step may cost
_CUTS = 4
_LOAD_WEIGHT = 0.1
_ENOUGH = 0.2  # of the residual that ends the iteration, for a linear solution
_FORCING = 0.3  # of the share of the residual that the last step left, for a linear solution
_LARGEST_FORCING = 0.03  # rougher ones lose solids that touch


@dataclass(slots=True)
class StepRecord:
    """What the iteration of one time step did."""

    converged: bool
    residual: float  # as `flow_residual`
    newton_steps: int
    krylov_steps: int
    renewals: int  # of the preconditioner


class LaggedPreconditioner:
    """A multigrid cycle that is built once and used for several linearisations.

    It solves the nodes that carried pressure when it was built; nodes that came since are solved
    on their own, nodes that left keep no pressure.

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
            return self._cycle(residual, load_residual)
        pressure, approach = self._cycle(np.where(self._free, residual, 0.0), load_residual)
        pressure[~self._linear.free] = 0.0
        new = self._new
        solids = self._level.terms.solids
        pressure[new] = residual[new] / solids.own_slope(self._linear, new, self._level.grid)
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
        Predicted.
    tolerance, load_tolerance
        Limits of `flow_residual` and of the relative load error [-].
    most, most_krylov
        Most steps, and most iterations in one of them.

    Returns
    -------
    tuple
        State and record.

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
