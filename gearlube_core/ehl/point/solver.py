"""Steady film of a point contact, with the error of its grid and refinement to a goal."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np
from scipy.interpolate import interpn

from gearlube_core.ehl.grid_error import check_search, with_grids
from gearlube_core.ehl.point.equations.film_shear import ALIGNED
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.newton import NewtonRecord
from gearlube_core.ehl.point.newton.transfer import Hierarchy, build_hierarchy
from gearlube_core.ehl.point.problem import MOST_NODES, PointContactProblem, expected_film
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import PointSolverSettings, Sides
from gearlube_core.ehl.point.solution import PointOutcome, PointSolution
from gearlube_core.ehl.point.start import (
    COARSE_TOLERANCE,
    Starvation,
    interpolated_state,
    solve_level,
    zero_border,
)
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.storage.process_pool import on_one_thread

_COARSER_TOLERANCE = 1e-5  # of a film that only gives the error of a finer grid


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


def check_cavitation(problem: PointContactProblem, settings: PointSolverSettings) -> None:
    """Refuse a problem that the cavitation of the settings does not go with.

    Raises
    ------
    ParameterError
        A starved inlet without mass conservation; touching solids, or an Eyring oil sheared along
        neither axis, with it.
    """
    if settings.cavitation == "reynolds":
        if problem.inlet_layer is not None:
            raise ParameterError(
                f"inlet_layer is {problem.inlet_layer:g} m: a starved inlet needs cavitation "
                "mass_conserving."
            )
        return
    if problem.sides != "ambient":
        raise ParameterError(
            f"mass-conserving cavitation needs sides ambient, got {problem.sides}. Take cavitation "
            "reynolds."
        )
    if problem.solids is not None:
        raise ParameterError(
            "Mass-conserving cavitation cannot be combined with touching solids. Leave one of "
            "them out."
        )
    if problem.lubricant.shear.tau0 > 0.0 and problem.sliding is not None:
        along, across = problem.sliding
        if abs(along * across) >= ALIGNED * math.hypot(along, across) ** 2 > 0.0:
            raise ParameterError(
                "mass-conserving cavitation of an Eyring oil needs sliding along x or y, got "
                f"{along:g} and {across:g} m/s. Turn the axes along sliding, or take a Newtonian "
                "oil."
            )


def refuse_rupture(settings: PointSolverSettings, film: str) -> None:
    """Refuse mass-conserving cavitation of a film that changes in time or has heat.

    Raises
    ------
    ParameterError
    """
    if settings.cavitation == "mass_conserving":
        raise ParameterError(
            "Mass-conserving cavitation is only for steady isothermal point contacts, got a film "
            f"{film}. Take cavitation reynolds."
        )


@on_one_thread
def solve_point_contact(
    problem: PointContactProblem,
    settings: PointSolverSettings | None = None,
    *,
    film_error: float | None = None,
    most_nodes: int = 1025,
    throw: bool = True,
) -> PointSolution:
    """Return pressure and film of a steady point contact, with the estimated error by the grid.

    Parameters
    ----------
    problem
        Gap, motion, load, oil, domain.
    settings
        Difference formula and tolerances.
    film_error
        Wanted relative error of the central and the smallest film, 1e-4 to 1 [-]: the spacing is
        halved until the estimate is below it. None: the nodes of the problem.
    most_nodes
        Largest number of nodes along a side in that search.
    throw
        True: raise if the solution does not converge; False: return the last state.

    Returns
    -------
    PointSolution

    Raises
    ------
    ConvergenceError
        The solution does not converge; the message gives the reason and a cure.
    ParameterError
        The problem cannot be combined with the cavitation of the settings.

    Notes
    -----
    The error by the grid is estimated from the same film on two grids with two and four times the
    spacing, that by the domain from twice the domain on the coarsest of them, which takes about
    half as much time again; see `FilmError`.

    The method is Newton's iteration on pressure and approach, with the full deflection by FFT.
    Linear systems are solved by flexible GMRES with a multigrid cycle of line solutions. Nested
    grids start from the dry contact. With mass-conserving cavitation the unknowns are the same: the
    oil in the broken film follows from them, node after node downstream. References:
    [venner_lubrecht_2000] for the equations and the hybrid relaxation; [saad_1993] for GMRES.

    Examples
    --------
    >>> from gearlube_core.ehl.point.contact_domain import elliptical_contact
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> oil = film_oil(eta0=0.04, alpha=2e-8)
    >>> ball = elliptical_contact(R_x=0.01, R_y=0.01, entrainment=(2.0, 0.0), load=20.0,
    ...                           contact_modulus=1.15e11, lubricant=oil, nodes=(65, 65))
    >>> film = solve_point_contact(ball)
    >>> film.outcome.converged, round(1e6 * film.central_film, 2)  # um
    (True, 0.39)
    """
    settings = PointSolverSettings() if settings is None else settings
    check_cavitation(problem, settings)
    check_search(film_error, most_nodes, MOST_NODES)

    def on_grid(nodes: tuple[int, ...]) -> PointSolution:
        begin = time.perf_counter()
        finer = problem.with_nodes(*nodes)
        return point_solution(finer, settings, *nested_film(finer, settings), begin, throw=False)

    solution = on_grid(problem.nodes)
    if throw and not solution.converged:
        raise ConvergenceError(solution.outcome.sentence)
    if not solution.converged or not (settings.estimate_error or film_error):
        return solution
    begin, closed = time.perf_counter(), Sides(problem.sides).closed
    solution, searched = with_grids(
        solution,
        film_error,
        most_nodes,
        on_grid,
        lambda nodes, near: film_from_near(problem.with_nodes(*nodes), near, settings),
        closed,
    )
    if solution.coarser and (twice := solution.coarser[-1].problem.widened()) is not None:
        wide = film_from_near(twice, solution.coarser[-1], settings)
        solution = replace(solution, wider=wide)
    return solution.with_words(solution.error.sentence + searched, time.perf_counter() - begin)
