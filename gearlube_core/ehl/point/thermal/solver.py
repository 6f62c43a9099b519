"""Steady thermal point contact: film and energy are solved in turn until both converge."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.solid import Solid
from gearlube_core.ehl.grid_error import FilmNumbers, check_search, if_converged, with_grids
from gearlube_core.ehl.point.newton.newton import NewtonRecord, flow_residual, newton
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.problem import MOST_NODES, PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import (
    check_cavitation,
    nested_film,
    point_solution,
    refuse_rupture,
)
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.point.thermal.surfaces import FilmTemperature
from gearlube_core.ehl.warm_film import WarmFilm
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.oil.film_oil_data import check_warms

_FILM_SHARE = 0.3  # of the heat that is not balanced yet: what the film of a turn is solved to
_FILM_STEPS = 1  # of Newton in a turn


@dataclass(frozen=True, slots=True, kw_only=True)
class PointThermalSettings:
    """How the energy balance of a point contact is solved.

    Parameters
    ----------
    heights
        Points across the film, both surfaces included.
    tolerance
        Heat that is not balanced over the heat of shear [-].
    max_turns
        Of film and energy.
    """

    heights: int = 13
    tolerance: float = 1e-6
    max_turns: int = 100

    def __post_init__(self) -> None:
        check_within("heights", self.heights, 5, 401)
        check_within("tolerance", self.tolerance, 1e-10, 1e-2)
        check_within("max_turns", self.max_turns, 1, 10000)


@dataclass(frozen=True, slots=True, kw_only=True)
class ThermalPointSolution(WarmFilm):
    """A point contact's film with its temperatures; arrays over the problem's x and y."""

    film: PointSolution  # at the temperatures found
    temperature: Array  # (nx, ny, heights) from body 1 to body 2 [K]
    flux: Array  # (2, nx, ny) into body 1 and body 2 [W/m2]
    heating: Array  # (nx, ny) heat of shear over the film [W/m2]
    mean_stress: Array  # (nx, ny) at mid-film, along sliding [Pa]
    viscosity: Array  # (nx, ny) to flow by pressure [Pa s]
    density: Array  # (nx, ny) of the mean temperature [kg/m3]
    balances: tuple[float, ...]  # heat not balanced over that of shear, of each turn [-]
    converged: bool
    outcome: str
    seconds: float
    coarser: tuple[ThermalPointSolution, ...] = ()  # the film on coarser grids, finest first
    wider: ThermalPointSolution | None = None  # the last of them on twice the domain

    @property
    def numbers(self) -> FilmNumbers:
        """Films, largest pressure and friction."""
        return self.film.numbers._replace(friction=self.friction_coefficient)

    @property
    def middle_temperature(self) -> Array:
        """Temperature half-way between the surfaces, (nx, ny) [K]."""
        return self.temperature[..., self.temperature.shape[-1] // 2]

    @property
    def friction_force(self) -> float:
        """Force of the mid-film stress along sliding [N]."""
        of = self.film.problem
        return float(np.trapezoid(np.trapezoid(self.mean_stress, of.y, axis=1), of.x))

    @property
    def friction_coefficient(self) -> float:
        """Mid-film shear force over load [-]."""
        return self.friction_force / self.film.problem.load


def solve_thermal_point(
    problem: PointContactProblem,
    solid_1: Solid,
    solid_2: Solid,
    settings: PointSolverSettings | None = None,
    thermal: PointThermalSettings | None = None,
    *,
    film_error: float | None = None,
    most_nodes: int = 513,
    throw: bool = True,
) -> ThermalPointSolution:
    """Return the steady film of a point contact with its temperatures and the error of its grid.

    rho c (u dT/dx + v dT/dy) = k d2T/dz2 + tau . d(u, v)/dz + beta T (u dp/dx + v dp/dy)

    Parameters
    ----------
    problem : PointContactProblem
        Contact with its `sliding`, (0, 0) included; oil after Houpert. The temperature of the oil
        is that of the bodies far from the contact.
    solid_1, solid_2 : Solid
        Bodies below and above: density, conductivity, heat capacity. Body 2 moves by the
        entrainment and half of the sliding.
    settings, thermal
        Of film and energy.
    film_error, most_nodes
        As in `solve_point_contact`.
    throw : bool
        False: return what was reached instead of raising.

    Raises
    ------
    ParameterError
        When sliding is not given or the viscosity law is isothermal.
    ConvergenceError
        When film or temperature fail, unless `throw` is False.

    Notes
    -----
    Entrainment and sliding point anywhere; either surface may stand or move against the other.
    The bodies are half-spaces that warm as those of [carslaw_jaeger_1959] under moving heat, at any
    Peclet number (`moving_heat_coefficients`), bulk temperatures given. The oil carries heat at
    every height along the film as it flows, back out of the inlet as well, and enters at its own
    temperature; along the film it does not conduct, which asks for a film far thinner than the
    contact. Reduced form, as for lines: flow by pressure has a parabolic profile and one
    viscosity, the mean of the fluidity weighted with z^2; the skewing of the carried flow by
    unlike halves of the film (the viscosity wedge) is left out. Shear heats along sliding with
    the full profile; what flows by pressure across sliding adds its own. Beyond a limiting stress
    the film slips and the slip heats it evenly. A broken film is not sheared.

    Films that heat thins by a quarter and more (beta eta0 u^2/k above about 1 in the inlet) take
    tens of turns, and some of them do not converge.

    Converged when residual, load and heat balance hold together: the heat that shear makes is
    conducted and carried away, the sum over all cells of what is not, and what the surfaces'
    temperatures lack, being within `tolerance` of it.
    """
    settings = settings or PointSolverSettings()
    thermal = thermal or PointThermalSettings()
    check_search(film_error, most_nodes, MOST_NODES)
    begin = time.perf_counter()
    check_thermal(problem, settings)

    def on_grid(nodes: tuple[int, ...], of: PointContactProblem = problem) -> ThermalPointSolution:
        return _on_grid(of.with_nodes(*nodes), (solid_1, solid_2), settings, thermal)

    solution = on_grid(problem.nodes)
    if throw and not solution.converged:
        raise ConvergenceError(solution.outcome)
    if not solution.converged or not (settings.estimate_error or film_error):
        return solution
    solution, searched = with_grids(
        solution, film_error, most_nodes, on_grid, lambda nodes, _: if_converged(on_grid(nodes))
    )
    coarse = solution.coarser[-1] if solution.coarser else None
    if coarse is not None and (twice := coarse.film.problem.widened()) is not None:
        solution = replace(solution, wider=if_converged(on_grid(twice.nodes, twice)))
    return replace(
        solution,
        outcome=solution.outcome + solution.error.sentence + searched,
        seconds=time.perf_counter() - begin,
    )


def _on_grid(
    problem: PointContactProblem,
    solids: tuple[Solid, Solid],
    settings: PointSolverSettings,
    thermal: PointThermalSettings,
) -> ThermalPointSolution:
    """Return the film on the problem's own grid, or what was reached."""
    begin = time.perf_counter()
    hierarchy, state, record = nested_film(problem, settings)
    level = hierarchy.levels[-1]
    energy = FilmTemperature(problem, solids, level, thermal.heights)
    balances: list[float] = []
    good = record.converged
    while good:
        film = energy.film(state)
        energy.judge(film)
        balances.append(energy.balance)
        flowing = (
            flow_residual(level, state) <= settings.tolerance
            and abs(state.load_error) <= settings.load_tolerance
        )
        if energy.balance <= thermal.tolerance and flowing:
            break
        if len(balances) > thermal.max_turns or not math.isfinite(energy.balance):
            good = False
            break
        energy.turn(film)
        level.set_thermal_factors(*energy.factors(film))
        state = _film_at_temperatures(hierarchy, state, settings, energy.balance, record)
    energy.judge(energy.film(state), everywhere=True)
    record.converged = good
    solved = point_solution(problem, settings, hierarchy, state, record, begin, throw=False)
    outcome, last = solved.outcome.sentence, balances[-1] if balances else math.inf
    if solved.outcome.converged and good:
        outcome = f"{outcome} Heat balanced to {last:.1e} in {len(balances) - 1} turns."
    elif balances:
        outcome = (
            f"Not converged: heat is balanced to {last:.1e} after {len(balances) - 1} turns. "
            "Take more turns, more nodes at the inlet or less speed."
        )
    converged = good and solved.outcome.converged
    return _solution(energy, state, solved, tuple(balances), converged, outcome, begin)


def check_thermal(problem: PointContactProblem, settings: PointSolverSettings) -> None:
    """Refuse a contact that has no thermal film; see `solve_thermal_point`."""
    check_cavitation(problem, settings)
    refuse_rupture(settings, "with heat")
    if problem.sides != "ambient":
        raise ParameterError(
            f"a thermal film needs sides ambient, got {problem.sides}. Take an isothermal film."
        )
    if problem.sliding is None:
        raise ParameterError(
            "A thermal film needs `sliding`: the velocity of body 2 relative to body 1, (0, 0) in "
            "pure rolling."
        )
    check_warms(problem.lubricant)


def _film_at_temperatures(
    hierarchy: Hierarchy,
    state: FilmState,
    settings: PointSolverSettings,
    balance: float,
    record: NewtonRecord,
) -> FilmState:
    """Return the film at the level's new temperatures, as well as these are worth."""
    level = hierarchy.levels[-1]
    state, report = newton(
        hierarchy,
        level.state(state.pressure, state.approach),
        tolerance=max(0.5 * settings.tolerance, min(1e-2, _FILM_SHARE * balance)),
        load_tolerance=settings.load_tolerance,
        most=_FILM_STEPS,
        most_krylov=settings.krylov_steps,
    )
    record.residuals += report.residuals
    record.krylov += report.krylov
    return state


def _solution(
    energy: FilmTemperature,
    state: FilmState,
    solved: PointSolution,
    balances: tuple[float, ...],
    converged: bool,
    outcome: str,
    begin: float,
) -> ThermalPointSolution:
    level, oil = energy.level, energy.oil
    scales = level.scales

    def outward(values: Array) -> Array:
        return scales.outward(values.reshape(level.shape))

    T = np.stack([outward(row) for row in energy.T.T], axis=-1)
    weight = np.full(T.shape[-1], 1.0)
    weight[[0, -1]] = 0.5
    film = (state.film * scales.film).ravel() / (weight.size - 1)
    seconds = time.perf_counter() - begin
    return ThermalPointSolution(
        film=replace(solved, seconds=seconds),
        temperature=T,
        flux=np.stack([outward(one) for one in energy.flux]),
        heating=outward(film * (energy.heat.source @ weight)),
        mean_stress=outward(energy.heat.stress),
        viscosity=outward(energy.heat.viscosity),
        density=outward(state.density.ravel()) * oil.rho0,
        balances=balances,
        converged=converged,
        outcome=outcome,
        seconds=seconds,
    )
