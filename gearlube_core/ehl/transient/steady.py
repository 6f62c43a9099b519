"""Steady film at one time of a transient problem: nested grids from the dry contact."""

from __future__ import annotations

import time as clock
from dataclasses import replace

import numpy as np

from gearlube_core.ehl.grid_error import FIRST_ORDER, check_search, if_converged, with_grids
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap
from gearlube_core.ehl.point.newton.newton import Build, NewtonRecord
from gearlube_core.ehl.point.newton.preconditioner import MultigridCycle
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.problem import MOST_NODES, expected_film
from gearlube_core.ehl.point.settings import PointSolverSettings, Sides
from gearlube_core.ehl.point.solver import refuse_rupture
from gearlube_core.ehl.point.start import (
    COARSE_TOLERANCE,
    interpolated_state,
    solve_level,
    zero_border,
)
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.transient.level import MovingLevel
from gearlube_core.ehl.transient.problem import MovingFilm, set_conditions
from gearlube_core.ehl.transient.rows import RowCycle
from gearlube_core.ehl.transient.solution import FilmSolution, film_solution
from gearlube_core.errors import ConvergenceError


def dry_start(film: MovingFilm, level: MovingLevel) -> FilmState:
    """Return the dry contact on a grid, lifted by the film expected between."""
    scales = level.scales
    length = scales.length
    # on a uniform grid of as many nodes
    x = np.linspace(*film.x_limits, level.grid.x.size)
    sides = level.grid.sides
    gap = np.array([np.interp(x, level.grid.x, row) for row in sides.inner(level.gap)])
    dry = dry_contact_of_gap(
        gap.T * scales.film,
        x[1] - x[0],
        level.grid.dy * length,
        film.contact_modulus,
        level.load * scales.pressure * length**2,
        tolerance=1e-3,
        repeated=sides.closed,
    )
    spread = [np.interp(level.grid.x, x, column) for column in dry.pressure.T / scales.pressure]
    pressure = zero_border(sides.extended(np.array(spread)))
    pressure *= level.load / level.grid.integral(pressure)
    lowest = float(level.film(pressure, 0.0).min())
    approach = expected_film(film.reference()) / scales.film - lowest
    level.hold_ambient_above(level.film(pressure, approach), film.open_film)
    return level.state(pressure, approach)


def steady_state(
    film: MovingFilm, grids: Hierarchy, settings: PointSolverSettings
) -> tuple[FilmState, NewtonRecord]:
    """Return the steady state on the finest grid under the conditions that the grids hold."""
    refuse_rupture(settings, "that changes in time")
    coarsest = grids.levels[0]
    assert isinstance(coarsest, MovingLevel)
    state = dry_start(film, coarsest)
    record = NewtonRecord()
    count = len(grids.levels)
    for k in range(count):
        part = grids.below(k + 1)
        level = part.levels[-1]
        assert isinstance(level, MovingLevel)
        if k:
            pressure = zero_border(grids.transfers[k - 1].up_smoothly(state.pressure))
            level.hold_ambient_above(level.film(pressure, state.approach), film.open_film)
            state = interpolated_state(level, pressure, state)
        last = k == count - 1
        goal = settings.tolerance if last else COARSE_TOLERANCE
        build: Build = MultigridCycle
        if last and film.grading is not None and film.long:
            # partial row solutions diverge on a spacing that changes along the rows
            part, build = film.with_rows_below(grids, settings), RowCycle
        state = solve_level(part, state, settings, goal, record, not last, build)
    return state, record


def solve_steady_film(
    film: MovingFilm,
    time: float,
    settings: PointSolverSettings | None = None,
    *,
    film_error: float | None = None,
    most_nodes: int = 1025,
    throw: bool = True,
) -> FilmSolution:
    """Return the film as if the conditions of a time had lasted, with the error of its grid.

    Parameters
    ----------
    film
        Contact whose load and motion change.
    time
        [s].
    settings
        Stencil and tolerances of the solver.
    film_error, most_nodes
        As in `solve_point_contact`.
    throw
        Raise where the solution does not converge; else return the last state.

    Raises
    ------
    ConvergenceError
        With the reason and a cure.
    """
    settings = PointSolverSettings() if settings is None else settings
    check_search(film_error, most_nodes, MOST_NODES)
    begin = clock.perf_counter()

    def on_grid(
        nodes: tuple[int, ...], wedge: str, of: MovingFilm = film
    ) -> tuple[FilmSolution, str]:
        return _on_grid(of.with_nodes(*nodes), time, replace(settings, wedge=wedge))

    solution, wedge = on_grid(film.nodes, settings.wedge)
    if throw and not solution.converged:
        raise ConvergenceError(solution.outcome)
    if not solution.converged or not (settings.estimate_error or film_error):
        return solution
    solution, searched = with_grids(
        solution,
        film_error,
        most_nodes,
        lambda nodes: on_grid(nodes, settings.wedge)[0],
        lambda nodes, _: if_converged(on_grid(nodes, wedge)[0]),
        Sides(film.sides).closed,
    )
    coarse = film.with_nodes(*solution.coarser[-1].nodes) if solution.coarser else None
    if coarse is not None and (twice := coarse.widened()) is not None:
        solution = replace(solution, wider=if_converged(on_grid(twice.nodes, wedge, twice)[0]))
    return replace(
        solution,
        outcome=solution.outcome + solution.error.sentence + searched,
        seconds=clock.perf_counter() - begin,
    )


def _on_grid(
    film: MovingFilm, time: float, settings: PointSolverSettings
) -> tuple[FilmSolution, str]:
    """Return the film on its own grid and the stencil of the answer."""
    begin = clock.perf_counter()
    grids = film.grids(settings)
    set_conditions(film, grids, time)
    state, record = steady_state(film, grids, settings)
    level = grids.levels[-1]
    assert isinstance(level, MovingLevel)
    solution = film_solution(
        film,
        level,
        state,
        settings,
        time=time,
        newton_steps=len(record.residuals),
        krylov_steps=record.krylov,
        seconds=clock.perf_counter() - begin,
        steady=True,
    )
    if solution.converged:
        outcome = solution.outcome + record.fallen_back(settings.wedge)
        order = FIRST_ORDER if record.first_order else solution.formal_order
        solution = replace(solution, outcome=outcome, formal_order=order)
    return solution, "upwind-1" if record.first_order else settings.wedge
