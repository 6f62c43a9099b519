"""Starting values and continuation for point contacts where Newton's method fails directly."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.newton import Build, NewtonRecord, newton
from gearlube_core.ehl.point.newton.preconditioner import MultigridCycle
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.terms.state import FilmState

_THICKER = (0.25, 1.0 / 16.0, 1.0 / 64.0)  # mobilities
_LARGEST_FACTOR = 4.0  # from one mobility to the next
_SMALLEST_FACTOR = 1.15
_EASY_TOLERANCE = 1e-3

Attempt = Callable[[FilmState, float, float], FilmState | None]
COARSE_TOLERANCE = 1e-3  # of the flow residual on all but the finest grid
_FACTOR = 0.5  # from one layer to the next
_LARGEST_LAYER_FACTOR = 0.95
_TOLERANCE = 1e-3
# of the flooded film in the middle: thinner layers wait for the finest grid, where no interpolation
# disturbs the film any more
_NESTED = 0.5


def _return_to_mobility(attempt: Attempt, start: FilmState, order: float) -> FilmState | None:
    """Return the solution at full mobility, or None."""
    state, mobility = None, 1.0
    for mobility in _THICKER:
        state = attempt(start, mobility, order)
        if state is not None:
            break
    factor = _LARGEST_FACTOR
    while state is not None and factor > _SMALLEST_FACTOR:
        target = min(1.0, mobility * factor)
        trial = attempt(state, target, order)
        if trial is None:
            factor **= 0.5
            continue
        state, mobility = trial, target
        if mobility == 1.0:
            return state
    return None


def solve_level(
    hierarchy: Hierarchy,
    start: FilmState,
    settings: PointSolverSettings,
    tolerance: float,
    record: NewtonRecord,
    only_start: bool,
    build: Build = MultigridCycle,
) -> FilmState:
    """Return the state on the finest grid of the hierarchy.

    Parameters
    ----------
    hierarchy
        Grids; all but the finest only precondition.
    start
        On the finest grid.
    settings
        Numbers of steps and the tolerance of the load.
    tolerance
        Of the flow residual [-].
    record
        Takes up what was done.
    only_start
        The state starts a finer grid: a first-order or thicker film will do.
    build
        As in `newton`.

    Returns
    -------
    FilmState
        Converged if `record.converged`, else the last state of the last attempt at the problem
        itself or, before any came back to it, of the easier ones.

    Notes
    -----
    In turn: directly; from thicker films (less mobility is more viscosity or speed); the same
    with first-order upwind differences, then back to the order asked for; where that fails, the
    first-order solution itself, if the settings allow, and the level keeps its stencil. Starved
    contacts begin with first-order differences, in which the edge of the oil converges.
    """
    level = hierarchy.levels[-1]
    last = start
    exact = False  # also the first-order problem

    def attempt(begin: FilmState, mobility: float, order: float) -> FilmState | None:
        nonlocal last
        level.set_continuation(mobility, order)
        easy = (mobility < 1.0 or order < 1.0) and not exact
        state, report = newton(
            hierarchy,
            level.state(begin.pressure, begin.approach),
            tolerance=max(tolerance, _EASY_TOLERANCE) if easy else tolerance,
            load_tolerance=_EASY_TOLERANCE if easy else settings.load_tolerance,
            most=settings.newton_steps,
            most_krylov=settings.krylov_steps,
            build=build,
        )
        record.residuals += report.residuals
        record.krylov += report.krylov
        record.converged = report.converged and not easy
        if report.converged or not easy:
            last = state
        return state if report.converged else None

    starved = level.terms.cavitation.starved and settings.wedge != "upwind-1"
    state = None if starved else attempt(start, 1.0, 1.0)
    if state is None and only_start:
        for mobility in (1.0, *_THICKER):
            state = attempt(start, mobility, 0.0)
            if state is not None:
                break
    elif state is None and not starved:
        state = _return_to_mobility(attempt, start, 1.0)
    if state is None and not only_start and settings.wedge != "upwind-1":
        first = attempt(start, 1.0, 0.0)
        if first is None:
            first = _return_to_mobility(attempt, start, 0.0)
        state = first
        for order in (0.5, 0.8, 1.0):
            if state is not None:
                state = attempt(state, 1.0, order)
        if state is None and first is not None and settings.fall_back:
            exact = True
            state = attempt(first, 1.0, 0.0)
            if state is not None:
                record.converged = record.first_order = True
                return state
    level.set_continuation(1.0, 1.0)
    return level.state(last.pressure, last.approach) if state is None else state


def zero_border(pressure: Array) -> Array:
    """Return a pressure without its negative part and zero on the border."""
    pressure = np.maximum(pressure, 0.0)
    pressure[[0, -1]] = 0.0
    pressure[:, [0, -1]] = 0.0
    return pressure


def interpolated_state(level: PointLevel, pressure: Array, coarse: FilmState) -> FilmState:
    """Return the state at a pressure from a coarser grid, no thinner than the film there.

    Interpolation leaves ripples of the film.
    """
    state = level.state(pressure, coarse.approach)
    lift = max(0.0, float(coarse.film.min()) - float(state.film.min()))
    return level.state(pressure, coarse.approach + lift)


def thin_layer(
    hierarchy: Hierarchy,
    start: FilmState,
    layer: float,
    settings: PointSolverSettings,
    record: NewtonRecord,
) -> FilmState:
    """Return the state on the finest grid of the hierarchy with first-order differences.

    Parameters
    ----------
    hierarchy
        Grids; the finest one is left with the layer that is asked for or was found last.
    start
        With the layer that the grid has.
    layer
        That is asked for, over the unit of films [-].
    settings
        Settings with the largest number of steps.
    record
        Takes up what was done.

    Returns
    -------
    FilmState
        With the layer, or the last thicker one that was found.

    Notes
    -----
    As its layer thins the edge of the oil withdraws downstream over as many nodes a step as it
    has to; from a dry inlet it would have to come upstream node by node.
    """
    level = hierarchy.levels[-1]
    factor, state = _FACTOR, start
    level.set_continuation(1.0, 0.0)
    found = min(level.terms.cavitation.inlet_layer, float(state.film[1:-1, 0].min()))
    while found > layer and factor < _LARGEST_LAYER_FACTOR:
        thinner = max(factor * found, layer)
        level.set_inlet_layer(thinner)
        trial, report = newton(
            hierarchy,
            level.state(state.pressure, state.approach),
            tolerance=_TOLERANCE,
            load_tolerance=_TOLERANCE,
            most=settings.newton_steps,
            most_krylov=settings.krylov_steps,
        )
        record.residuals += report.residuals
        record.krylov += report.krylov
        if report.converged:
            state, found = trial, thinner
        else:
            factor **= 0.5
    level.set_inlet_layer(found)
    level.set_continuation(1.0, 1.0)
    return state


class Starvation:
    """Layers of the grids of one starved contact on the way from the coarsest to the finest."""

    def __init__(
        self, hierarchy: Hierarchy, settings: PointSolverSettings, record: NewtonRecord
    ) -> None:
        self._settings, self._record = settings, record
        self._layer = self._nested = hierarchy.levels[-1].terms.cavitation.inlet_layer
        for level in hierarchy.levels:
            level.set_inlet_layer(math.inf)

    def start(self, part: Hierarchy, state: FilmState, last: bool) -> FilmState:
        """Return the start on the finest grid of `part`, which gets its layer."""
        level = part.levels[-1]
        if len(part.levels) == 1:
            state = solve_level(part, state, self._settings, _TOLERANCE, self._record, True)
            pressed = state.pressure >= 0.8 * state.pressure.max()
            self._nested = max(self._layer, _NESTED * float(np.mean(state.mass[pressed])))
        else:
            level.set_inlet_layer(self._nested)
            state = level.state(state.pressure, state.approach)
        if last and len(part.levels) > 1 and self._nested > self._layer:
            state = solve_level(part, state, self._settings, _TOLERANCE, self._record, True)
        target = self._layer if last else self._nested
        state = thin_layer(part, state, target, self._settings, self._record)
        level.set_inlet_layer(target)
        return level.state(state.pressure, state.approach)
