"""Steady film of a point contact, with the error of its grid and refinement to a goal."""

from __future__ import annotations

import time
from dataclasses import replace

from gearlube_core.ehl.grid_error import check_search, coarser_films, refined_film
from gearlube_core.ehl.point.cavitation import check_cavitation
from gearlube_core.ehl.point.grid_film import film_from_near, nested_film, point_solution
from gearlube_core.ehl.point.problem import MOST_NODES, PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.sides import Sides
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.errors import ConvergenceError


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
    >>> from gearlube_core.ehl.point.elliptical_contact import elliptical_contact
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
    coarser = coarser_films(
        solution,
        lambda nodes, near: film_from_near(problem.with_nodes(*nodes), near, settings),
        closed,
    )
    solution = replace(solution, coarser=coarser)
    searched = ""
    if film_error is not None:
        solution, searched = refined_film(
            solution,
            film_error,
            most_nodes,
            lambda nodes, coarse: replace(on_grid(nodes), coarser=coarse),
            closed,
        )
    if solution.coarser and (twice := solution.coarser[-1].problem.widened()) is not None:
        wide = film_from_near(twice, solution.coarser[-1], settings)
        solution = replace(solution, wider=wide)
    return solution.with_words(solution.error.sentence + searched, time.perf_counter() - begin)
