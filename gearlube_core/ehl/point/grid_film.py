"""Steady film of a point contact on one grid, from a nest of coarser ones or from a film near."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np
from scipy.interpolate import interpn

from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.hierarchy import Hierarchy, build_hierarchy
from gearlube_core.ehl.point.newton.newton import NewtonRecord
from gearlube_core.ehl.point.problem import PointContactProblem, expected_film
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.sides import Sides
from gearlube_core.ehl.point.solution import PointOutcome, PointSolution
from gearlube_core.ehl.point.start.continuation import solve_level
from gearlube_core.ehl.point.start.nested import COARSE_TOLERANCE, interpolated_state, zero_border
from gearlube_core.ehl.point.start.starvation import Starvation
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.errors import ConvergenceError

_COARSER_TOLERANCE = 1e-5  # of a film that only tells the error of a finer grid


def _hertz_start(problem: PointContactProblem, level: PointLevel) -> FilmState:
    """Return an ellipse of pressure with the film expected between, on the coarsest grid.

    The dry ellipse, widened to where a rigid film carries and to what the grid can show. The
    approach leaves the expected film: [jamali_2015 (3.46)] [jamali_2015 (3.47)].
    """
    a_x, a_y, _ = problem.hertz_contact
    film = expected_film(problem)
    scales, x, y = level.scales, level.grid.x, level.grid.y
    a_x = max(math.sqrt(a_x**2 + problem.hertz.R_x * film), 2.5 * (x[1] - x[0]))
    if Sides(problem.sides).closed:
        a_y = math.inf
    else:
        a_y = max(math.sqrt(a_y**2 + problem.hertz.R_y * film), 2.5 * (y[1] - y[0]))
    ellipse = 1.0 - (x[:, None] / a_x) ** 2 - (y[None, :] / a_y) ** 2
    ellipse = scales.inward(np.sqrt(np.maximum(0.0, ellipse)))
    pressure = zero_border(level.grid.sides.extended(ellipse))
    pressure *= level.load / level.grid.integral(pressure)
    return level.state(pressure, film / scales.film - float(level.film(pressure, 0.0).min()))


def nested_film(
    problem: PointContactProblem, settings: PointSolverSettings
) -> tuple[Hierarchy, FilmState, NewtonRecord]:
    """Return the film on nested grids: the grids, the state on the finest, what was done."""
    scales = PointScales.of(problem)
    hierarchy = build_hierarchy(
        problem, scales, settings.wedge, settings.discretisation, settings.cavitation
    )
    record = NewtonRecord()
    state = _hertz_start(problem, hierarchy.levels[0])
    count = len(hierarchy.levels)
    starved = None if problem.inlet_layer is None else Starvation(hierarchy, settings, record)
    for k in range(count):
        part = hierarchy.below(k + 1)
        if k:
            pressure = zero_border(hierarchy.transfers[k - 1].up_smoothly(state.pressure))
            state = interpolated_state(part.levels[-1], pressure, state)
        last = k == count - 1
        tolerance = settings.tolerance if last else COARSE_TOLERANCE
        if starved is not None:
            state = starved.start(part, state, last)
        state = solve_level(part, state, settings, tolerance, record, not last)
    return hierarchy, state, record


def point_solution(
    problem: PointContactProblem,
    settings: PointSolverSettings,
    hierarchy: Hierarchy,
    state: FilmState,
    record: NewtonRecord,
    begin: float,
    *,
    throw: bool,
) -> PointSolution:
    """Return a state of the finest grid in SI with its outcome; `begin` [s] of the clock."""
    scales, inner = hierarchy.levels[-1].scales, Sides(problem.sides).inner
    outcome = PointOutcome.of(hierarchy.levels[-1], state, record, settings, problem)
    if throw and not outcome.converged:
        raise ConvergenceError(outcome.sentence)
    return PointSolution(
        problem=problem,
        pressure=scales.outward(inner(state.pressure)) * scales.pressure,
        film=scales.outward(inner(state.film)) * scales.film,
        approach=state.approach * scales.film,
        fill=scales.outward(inner(state.mass / (state.density * state.film))),
        outcome=outcome,
        residuals=tuple(record.residuals),
        krylov_steps=record.krylov,
        seconds=time.perf_counter() - begin,
    )


def film_from_near(
    problem: PointContactProblem, fine: PointSolution, settings: PointSolverSettings
) -> PointSolution | None:
    """Return the film on a coarser grid or a wider domain by the stencil of a film near.

    From this film where a full inlet allows it, else from a nest of its own. None: not found.
    """
    settings = replace(
        settings,
        wedge=fine.outcome.wedge,
        tolerance=max(settings.tolerance, _COARSER_TOLERANCE),
        load_tolerance=max(settings.load_tolerance, _COARSER_TOLERANCE),
    )
    begin = time.perf_counter()
    if problem.inlet_layer is None:
        hierarchy = build_hierarchy(
            problem,
            PointScales.of(problem),
            settings.wedge,
            settings.discretisation,
            settings.cavitation,
        )
        level = hierarchy.levels[-1]
        x, y = np.meshgrid(problem.x, problem.y, indexing="ij")
        near = (fine.problem.x, fine.problem.y)
        pressure = interpn(near, fine.pressure, (x, y), bounds_error=False, fill_value=0.0)
        pressure = level.scales.inward(pressure / level.scales.pressure)
        start = level.state(
            zero_border(level.grid.sides.extended(pressure)),
            fine.approach / level.scales.film,
        )
        record = NewtonRecord()
        if float(start.film.min()) > 0.0:
            state = solve_level(hierarchy, start, settings, settings.tolerance, record, False)
            found = point_solution(problem, settings, hierarchy, state, record, begin, throw=False)
            if found.converged:
                return found
    found = point_solution(problem, settings, *nested_film(problem, settings), begin, throw=False)
    return found if found.converged else None
