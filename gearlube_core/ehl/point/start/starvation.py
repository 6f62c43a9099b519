"""Continuation to a starved point contact: the inlet oil layer is thinned step by step."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.ehl.point.newton.hierarchy import Hierarchy
from gearlube_core.ehl.point.newton.newton import NewtonRecord, newton
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.start.continuation import solve_level
from gearlube_core.ehl.point.terms.state import FilmState

_FACTOR = 0.5  # from one layer to the next
_LARGEST_FACTOR = 0.95
_TOLERANCE = 1e-3
# of the flooded film in the middle: thinner layers wait for the finest grid, where no interpolation
# disturbs the film any more
_NESTED = 0.5


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
        Most steps.
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
    while found > layer and factor < _LARGEST_FACTOR:
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
