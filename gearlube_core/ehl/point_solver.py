"""Steady film of a point contact: nested grids around the Newton iteration."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from gearlube_core.ehl.point_level import FilmState, PointLevel
from gearlube_core.ehl.point_newton import NewtonRecord, newton
from gearlube_core.ehl.point_preconditioner import Hierarchy
from gearlube_core.ehl.point_transfer import Transfer
from gearlube_core.ehl.problem import PointContactProblem, expected_film
from gearlube_core.ehl.scaling import PointScales
from gearlube_core.ehl.settings import PointSolverSettings
from gearlube_core.ehl.solution import PointOutcome, PointSolution
from gearlube_core.errors import ConvergenceError

Array = np.ndarray[Any, np.dtype[np.float64]]

_COARSEST = 40  # nodes along a side that are not halved any more
_COARSE_TOLERANCE = 1e-3
_THICKER = (1.0, 0.25, 1.0 / 16.0, 1.0 / 64.0, 1.0 / 256.0)  # mobilities of the continuation


def grid_shapes(nodes: tuple[int, int], steps: tuple[float, float]) -> list[tuple[int, int]]:
    """Return shapes from coarse to fine; the side of the smaller spacing is halved first.

    Parameters
    ----------
    nodes
        (ny, nx) of the finest grid.
    steps
        Its spacings (dy, dx).
    """
    shapes = [nodes]
    sides, spacing = list(nodes), list(steps)
    while max(sides) > _COARSEST:
        ratio = spacing[0] / spacing[1]
        halve = [ratio < 1.6, ratio > 1.0 / 1.6]  # only the finer side of unlike ones
        halve = [wanted and side > _COARSEST for wanted, side in zip(halve, sides, strict=True)]
        if not any(halve):
            halve = [side > _COARSEST for side in sides]
        for axis in range(2):
            if halve[axis]:
                coarse = (sides[axis] - 1) // 2 + 1
                spacing[axis] *= (sides[axis] - 1) / (coarse - 1)
                sides[axis] = coarse
        shapes.insert(0, (sides[0], sides[1]))
    return shapes


def build_hierarchy(problem: PointContactProblem, scales: PointScales, wedge: str) -> Hierarchy:
    """Return the grids of a problem."""
    nx, ny = problem.nodes
    dx = (problem.x_limits[1] - problem.x_limits[0]) / (nx - 1)
    dy = (problem.y_limits[1] - problem.y_limits[0]) / (ny - 1)
    nodes, steps = ((nx, ny), (dx, dy)) if scales.swap else ((ny, nx), (dy, dx))
    shapes = grid_shapes(nodes, steps)
    levels = [PointLevel(problem, scales, shape, wedge) for shape in shapes]
    transfers = [
        Transfer(fine, coarse) for coarse, fine in zip(shapes[:-1], shapes[1:], strict=True)
    ]
    return Hierarchy(levels, transfers)


def _bordered(pressure: Array) -> Array:
    pressure = np.maximum(pressure, 0.0)
    pressure[[0, -1]] = 0.0
    pressure[:, [0, -1]] = 0.0
    return pressure


def _hertz_start(problem: PointContactProblem, level: PointLevel) -> FilmState:
    """Return the dry ellipse with the film expected between, on the coarsest grid."""
    a_x, a_y, _ = problem.hertz_contact
    scales, (ny, nx) = level.scales, level.shape
    nodes = (ny, nx) if scales.swap else (nx, ny)
    x = np.linspace(*problem.x_limits, nodes[0])[:, None] / a_x
    y = np.linspace(*problem.y_limits, nodes[1])[None, :] / a_y
    pressure = _bordered(scales.inward(np.sqrt(np.maximum(0.0, 1.0 - x * x - y * y))))
    film = expected_film(problem) / scales.film
    return level.state(pressure, film - float(level.film(pressure, 0.0).min()))


def _solve_level(
    hierarchy: Hierarchy,
    start: FilmState,
    settings: PointSolverSettings,
    tolerance: float,
    record: NewtonRecord,
) -> FilmState:
    """Return the state on the finest grid, by way of thicker films where it fails directly."""
    level = hierarchy.levels[-1]
    reached: FilmState | None = None
    k = 0
    tries = 0
    while tries < 12:
        tries += 1
        level.with_mobility(_THICKER[k])
        begin = start if reached is None else reached
        begin = level.state(begin.pressure, begin.approach)
        if not float(begin.film.min()) > 0.0:
            lift = 0.05 * float(begin.film.max()) - float(begin.film.min())
            begin = level.state(begin.pressure, begin.approach + min(lift, 1.0))
        state, report = newton(
            hierarchy,
            begin,
            tolerance=tolerance if k == 0 else max(tolerance, _COARSE_TOLERANCE),
            load_tolerance=settings.load_tolerance if k == 0 else 1e-3,
            most=settings.newton_steps if k or tries > 1 else settings.newton_steps,
            most_krylov=settings.krylov_steps,
        )
        record.residuals += report.residuals
        record.krylov += report.krylov
        record.converged = report.converged and k == 0
        if report.converged:
            reached = state
            if k == 0:
                return state
            k -= 1
        elif reached is not None or k + 1 == len(_THICKER):
            break
        else:
            k += 1
    level.with_mobility(1.0)
    return reached if reached is not None else state


def solve_point_contact(
    problem: PointContactProblem,
    settings: PointSolverSettings | None = None,
    *,
    throw: bool = True,
) -> PointSolution:
    """Return pressure and film of a steady point contact.

    Parameters
    ----------
    problem
        Gap, motion, load, oil, domain.
    settings
        Stencil and tolerances.
    throw
        Raise where the solution does not converge; else return the last state.

    Returns
    -------
    PointSolution

    Raises
    ------
    ConvergenceError
        With the reason and a cure.

    Notes
    -----
    Newton iteration on pressure and approach with the full deflection by FFT; linear systems by
    flexible GMRES with a multigrid cycle of line solutions; start on nested grids from the dry
    contact. References: Venner and Lubrecht 2000 for the equations and the hybrid relaxation;
    Saad 1993 for GMRES.
    """
    settings = PointSolverSettings() if settings is None else settings
    begin = time.perf_counter()
    scales = PointScales.of(problem)
    hierarchy = build_hierarchy(problem, scales, settings.wedge)
    record = NewtonRecord()
    state = _hertz_start(problem, hierarchy.levels[0])
    count = len(hierarchy.levels)
    for k in range(count):
        part = hierarchy.below(k + 1)
        if k:
            pressure = _bordered(hierarchy.transfers[k - 1].up_smoothly(state.pressure))
            state = part.levels[-1].state(pressure, state.approach)
        last = k == count - 1
        tolerance = settings.tolerance if last else _COARSE_TOLERANCE
        state = _solve_level(part, state, settings, tolerance, record)
    outcome = PointOutcome.of(hierarchy.levels[-1], state, record, settings)
    if throw and not outcome.converged:
        raise ConvergenceError(outcome.sentence)
    return PointSolution(
        problem=problem,
        pressure=scales.outward(state.pressure) * scales.pressure,
        film=scales.outward(state.film) * scales.film,
        approach=state.approach * scales.film,
        outcome=outcome,
        residuals=tuple(record.residuals),
        krylov_steps=record.krylov,
        seconds=time.perf_counter() - begin,
    )
