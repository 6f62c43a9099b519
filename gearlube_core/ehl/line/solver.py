"""Steady line contact: nested grids, with continuation on a grid that does not converge."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from gearlube_core.ehl.grid_error import check_search, if_converged, with_grids
from gearlube_core.ehl.line.newton import NewtonRecord, newton
from gearlube_core.ehl.line.problem import MOST_NODES, LineProblem, LineSettings
from gearlube_core.ehl.line.solution import LineSolution, build_solution
from gearlube_core.ehl.line.system import LOAD, LineState, LineSystem
from gearlube_core.errors import ConvergenceError, ParameterError

# oil ahead of the contact must carry some pressure, or its nodes start as broken
_INLET_SEED = 1e-6
# film of the start over the guess. Newton's film falls from above by a third a step, but from
# below it overshoots at the inlet; the last one follows a failure
_START_FILM = (3.0, 20.0)


def solve_line(
    problem: LineProblem,
    settings: LineSettings | None = None,
    *,
    start: LineSolution | None = None,
    film_error: float | None = None,
    most_nodes: int = 16001,
    throw: bool = True,
) -> LineSolution:
    """Return the steady film of a line contact, with an estimate of its error by the grid.

    Parameters
    ----------
    problem : LineProblem
        The contact.
    settings : LineSettings, optional
        Grid and scheme.
    start : LineSolution, optional
        Solution of a similar problem, to start from; default: the dry contact after Hertz on a
        nest of grids.
    film_error : float, optional
        Wanted relative error of the central and the smallest film, 1e-4 to 1 [-]: the spacing is
        halved until the estimate is below it.
    most_nodes : int
        Largest number of nodes of a grid in that search.
    throw : bool
        True: raise if the solution does not converge; False: return the last state, with
        `converged` False.

    Returns
    -------
    LineSolution

    Raises
    ------
    ParameterError
        The mean surface speed is zero, or a starved inlet is combined with Reynolds' cavitation.
    ConvergenceError
        The finest grid does not converge, unless `throw` is False.

    Notes
    -----
    The error by the grid is estimated from the same film on two grids with two and four times the
    spacing, see `estimated_error`, and that by the domain from twice the domain on the coarsest.

    Examples
    --------
    >>> from gearlube_core.oil.film_oil_data import jamali_2015_oil
    >>> contact = LineProblem(lubricant=jamali_2015_oil(), radius=0.014, line_load=3.6e5,
    ...                       reduced_modulus=227.5e9, speed_1=7.93, speed_2=5.49)
    >>> film = solve_line(contact, LineSettings(nodes=501))
    >>> round(film.maximum_pressure / 1e9, 2)
    0.96
    """
    settings = settings or LineSettings()
    if problem.entrainment_speed == 0.0:
        raise ParameterError(
            "A steady film needs entrainment, but speed_1 + speed_2 is 0 m/s. Use the transient "
            "solver for pure squeeze."
        )
    if problem.inlet_fill < 1.0 and settings.cavitation != "mass_conserving":
        raise ParameterError(
            f"inlet_fill is {problem.inlet_fill:g}: a starved inlet needs cavitation "
            "mass_conserving."
        )
    check_search(film_error, most_nodes, MOST_NODES)
    solution = _on_grid(problem, settings, start)
    if throw and not solution.converged:
        raise ConvergenceError(solution.outcome)
    if not solution.converged:
        return solution
    solution, searched = with_grids(
        solution,
        film_error,
        most_nodes,
        lambda nodes: _on_grid(problem, replace(settings, nodes=nodes[0]), None),
        lambda nodes, fine: _from_near(fine.problem, nodes, fine),
    )
    solution = replace(solution, wider=_on_wider_domain(solution))
    return replace(solution, outcome=solution.outcome + solution.error.sentence + searched)


def _on_grid(
    problem: LineProblem, settings: LineSettings, start: LineSolution | None
) -> LineSolution:
    mass_conserving = settings.cavitation == "mass_conserving"
    records: list[tuple[int, NewtonRecord]] = []
    counts = [settings.nodes] if start is not None else grid_nest(settings)
    last: LineState | None = None
    last_x = np.zeros(0)
    for count in counts:
        system = LineSystem(problem, count, settings.stencil, False)
        if start is not None:
            first = _from_solution(system, start)
        elif last is not None:
            first = interpolate(last, last_x, system)
        else:
            first = _cold_start(system, settings, _START_FILM[0])
        state, record = newton(system, first, settings.tolerance, settings.max_iterations)
        if not record.converged and count == settings.nodes:
            state, record = _detour(system, settings, records, record)
        records.append((count, record))
        last, last_x = (state, system.x) if record.converged else (None, last_x)
    if mass_conserving and record.converged:
        system, state, record = _with_voids(problem, settings, state)
        records.append((settings.nodes, record))
    return build_solution(system, state, settings, tuple(records), problem)


def _on_wider_domain(film: LineSolution) -> LineSolution | None:
    """Return the film of the coarsest grid on twice the domain; None: there is none."""
    if not film.coarser:
        return None
    near = film.coarser[-1]
    wide = near.problem.widened(near.nodes[0])
    return None if wide is None else _from_near(wide[0], (wide[1],), near)


def _from_near(
    problem: LineProblem, nodes: tuple[int, ...], fine: LineSolution
) -> LineSolution | None:
    settings = replace(fine.settings, nodes=nodes[0])
    system = LineSystem(problem, nodes[0], settings.stencil, False)
    state, record = newton(
        system, _from_solution(system, fine), settings.tolerance, settings.max_iterations
    )
    if record.converged and settings.cavitation == "mass_conserving":
        system, state, record = _with_voids(problem, settings, state)
    if not record.converged:
        return if_converged(_on_grid(problem, settings, None))
    return build_solution(system, state, settings, ((nodes[0], record),), problem)


def grid_nest(settings: LineSettings) -> list[int]:
    """Return node counts from the coarsest to the finest grid, each about twice the last."""
    counts = [settings.nodes]
    while (counts[0] - 1) // 2 + 1 >= settings.coarsest:
        counts.insert(0, (counts[0] - 1) // 2 + 1)
    return counts


def hertz_start(system: LineSystem, film: float) -> LineState:
    """Return the dry pressure after Hertz and an approach that leaves `film` [m] at x = 0."""
    # the approach: [jamali_2015 (3.46)] [jamali_2015 (3.47)]
    # a thick film carries over the length on which the gap opens, more than the half width
    width = max(np.sqrt(system.load / LOAD), np.sqrt(0.5 * film / system.scales.film))
    X = system.X / width
    P = np.sqrt(np.maximum(1.0 - X * X, 0.0))
    P *= system.load / max(system.step * P.sum(), 1e-300)
    centre = np.interp(0.0, system.X, system.gap + system.deflection(P))
    upstream = system.X * np.sign(system.coefficients.speed) < 0.0
    P = np.where(upstream & (P <= 0.0), _INLET_SEED, P)
    P[[0, -1]] = 0.0
    return LineState(P, np.zeros(P.size), film / system.scales.film - float(centre))


def interpolate(state: LineState, x: np.ndarray, system: LineSystem) -> LineState:
    """Return a state on the nodes of another grid of the same problem."""
    # cubic: kinks of a linear one would be the largest part of the first residual
    P = np.maximum(CubicSpline(x, state.P)(system.x), 0.0)
    P[np.interp(system.x, x, state.P) <= 0.0] = 0.0
    P[[0, -1]] = 0.0
    return LineState(P, np.interp(system.x, x, state.void), state.H0)


def _from_solution(system: LineSystem, start: LineSolution) -> LineState:
    P = np.interp(system.x, start.x, start.pressure / system.scales.pressure)
    P[[0, -1]] = 0.0
    return LineState(P, np.zeros(P.size), start.approach / system.scales.film)


def _detour(
    system: LineSystem,
    settings: LineSettings,
    records: list[tuple[int, NewtonRecord]],
    record: NewtonRecord,
) -> tuple[LineState, NewtonRecord]:
    # thick films first, then the film of the sturdiest stencil as a start
    count = system.x.size
    for factor in _START_FILM:
        records.append((count, record))
        first = _cold_start(system, settings, factor)
        state, record = newton(system, first, settings.tolerance, settings.max_iterations)
        if record.converged:
            return state, record
    records.append((count, record))
    sturdy = LineSystem(system.problem, count, "upwind-1", False)
    first = _cold_start(sturdy, settings, _START_FILM[-1])
    state, record = newton(sturdy, first, settings.tolerance, settings.max_iterations)
    records.append((count, record))
    return newton(system, state, settings.tolerance, settings.max_iterations)


def _cold_start(system: LineSystem, settings: LineSettings, factor: float) -> LineState:
    # the steep edges of the dry pressure would thin an Eyring film out of all measure, so that
    # its start is the Newtonian film
    state = hertz_start(system, factor * system.problem.film_guess())
    shear_thinning = system.coefficients
    if shear_thinning.sigma > 0.0:
        system.coefficients = shear_thinning._replace(sigma=0.0)
        state, _ = newton(system, state, 1e-3, settings.max_iterations)
        system.coefficients = shear_thinning
    return state


def _with_voids(
    problem: LineProblem, settings: LineSettings, state: LineState
) -> tuple[LineSystem, LineState, NewtonRecord]:
    # voids follow the full film's solution; a starved inlet is drained step by step
    system = LineSystem(problem, settings.nodes, settings.stencil, True)
    fill = problem.inlet_fill
    upstream = 0 if system.coefficients.speed > 0.0 else -1
    for fraction in np.linspace(1.0, fill, 1 if fill == 1.0 else 8):
        state = state.copy()
        state.void[upstream] = 1.0 - fraction
        state, record = newton(system, state, settings.tolerance, 2 * settings.max_iterations)
    return system, state, record
