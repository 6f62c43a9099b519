"""Steady thermal line contact: film and energy are solved in turn until both converge."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.checks import check_within
from gearlube_core.contact.solid import Solid
from gearlube_core.ehl.grid_error import check_search, if_converged, with_grids
from gearlube_core.ehl.line.energy import (
    FilmFields,
    SurfaceHeating,
    fill_surface_weights,
    fill_thermal_oil,
    march_energy,
)
from gearlube_core.ehl.line.newton import newton
from gearlube_core.ehl.line.problem import MOST_NODES, LineProblem, LineSettings
from gearlube_core.ehl.line.solution import LineSolution, build_solution
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.system import LineState, LineSystem
from gearlube_core.ehl.thin_film import thin_film_sentence
from gearlube_core.ehl.warm_film import WarmFilm
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.oil.film_oil_data import check_warms


@dataclass(frozen=True, slots=True, kw_only=True)
class ThermalSettings:
    """How the energy balance is solved.

    Parameters
    ----------
    heights
        Points across the film, both surfaces included.
    tolerance
        Largest change of temperature from turn to turn [K].
    max_turns
        Of film and energy.
    relaxation
        Share of the new temperature that is taken, 0 to 1.
    """

    heights: int = 17
    tolerance: float = 1e-3
    max_turns: int = 60
    relaxation: float = 0.7

    def __post_init__(self) -> None:
        check_within("heights", self.heights, 5, 401)
        check_within("tolerance", self.tolerance, 1e-8, 10.0, "K")
        check_within("max_turns", self.max_turns, 1, 10000)
        check_within("relaxation", self.relaxation, 0.01, 1.0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ThermalLineSolution(WarmFilm):
    """A line film with its temperatures; arrays on the film's `x`."""

    film: LineSolution  # mean_stress of the warm film
    temperature: np.ndarray  # (n, heights) from body 1 to body 2 [K]
    flux: np.ndarray  # (n, 2) into body 1 and body 2 [W/m2]
    heating: np.ndarray  # (n,) heat of shear over the film [W/m2]
    changes: tuple[float, ...]  # of temperature in each turn [K]
    converged: bool
    outcome: str
    coarser: tuple[ThermalLineSolution, ...] = ()  # the film on coarser grids, finest first
    wider: ThermalLineSolution | None = None  # the last of them on twice the domain


def solve_thermal_line(
    problem: LineProblem,
    solid_1: Solid,
    solid_2: Solid,
    settings: LineSettings | None = None,
    thermal: ThermalSettings | None = None,
    *,
    film_error: float | None = None,
    most_nodes: int = 16001,
    throw: bool = True,
) -> ThermalLineSolution:
    """Return the steady film of a line contact with its temperatures and the error of its grid.

    Parameters
    ----------
    problem : LineProblem
        Contact; oil after Houpert, with surface speeds of one sign. The temperature of the oil is
        that of the bodies far from the contact.
    solid_1, solid_2 : Solid
        Bodies below and above: density, conductivity, heat capacity.
    settings, thermal
        Of film and energy.
    film_error, most_nodes
        As in `solve_line`.
    throw : bool
        False: return what was reached instead of raising.

    Raises
    ------
    ParameterError
        When the surface speeds differ in sign or the viscosity law is isothermal.
    ConvergenceError
        When film or temperature fail, unless `throw` is False.

    Notes
    -----
    Reduced form: the viscosity to flow by pressure is the mean of the fluidity weighted by z^2,
    the skewing of the carried flow by unlike halves of the film (the viscosity wedge) is left
    out; heat goes along x with the oil, not by conduction, and into bodies that move fast against
    diffusion (u b rho c/k above about 10). Traction takes the full profile.
    """
    thermal = thermal or ThermalSettings()
    settings = settings or LineSettings()
    if not problem.speed_1 * problem.speed_2 > 0.0:
        raise ParameterError(
            "In a thermal line contact both surfaces must move in the direction of entrainment, "
            f"got {problem.speed_1:g} and {problem.speed_2:g} m/s."
        )
    check_warms(problem.lubricant)
    check_search(film_error, most_nodes, MOST_NODES)
    solids = solid_1, solid_2

    def on_grid(nodes: tuple[int, ...], of: LineProblem = problem) -> ThermalLineSolution:
        return thermal_line_on_grid(of, solids, replace(settings, nodes=nodes[0]), thermal)

    solution = on_grid((settings.nodes,))
    if throw and not solution.converged:
        raise ConvergenceError(solution.outcome)
    if not solution.converged:
        return solution
    solution, searched = with_grids(
        solution, film_error, most_nodes, on_grid, lambda nodes, _: if_converged(on_grid(nodes))
    )
    coarsest = solution.coarser[-1].nodes[0] if solution.coarser else 0
    if coarsest and (twice := problem.widened(coarsest)) is not None:
        solution = replace(solution, wider=if_converged(on_grid((twice[1],), twice[0])))
    return replace(solution, outcome=solution.outcome + solution.error.sentence + searched)


def thermal_line_on_grid(
    problem: LineProblem,
    solids: tuple[Solid, Solid],
    settings: LineSettings,
    thermal: ThermalSettings,
) -> ThermalLineSolution:
    """Return the film on one grid, or what was reached, without its error by coarser grids.

    Arguments as in `solve_thermal_line`; they are not checked, and nothing is raised.
    """
    start = solve_line(problem, settings, throw=False)
    conserving = settings.cavitation == "mass_conserving"
    system = LineSystem(problem, settings.nodes, settings.stencil, conserving)
    scales = system.scales
    state = LineState(
        start.pressure / scales.pressure, start.void.copy(), start.approach / scales.film
    )
    energy = _Energy(system, problem, *solids, thermal)
    film, changes = start, []
    reason = "the isothermal film did not converge" if not start.converged else ""
    for _ in range(thermal.max_turns if start.converged else 0):
        changes.append(energy.turn(film))
        state, record = newton(system, state, settings.tolerance, settings.max_iterations)
        film = build_solution(system, state, settings, ((settings.nodes, record),), problem)
        if not record.converged:
            reason = f"the warm film: {film.outcome}"
            break
        if changes[-1] <= thermal.tolerance:
            break
    else:
        reason = reason or f"temperature still changes by {changes[-1]:.2g} K a turn"
    film = replace(film, mean_stress=energy.stress() * film.streaks)
    outcome = (
        f"Not converged: {reason}. Take a smaller relaxation or more turns."
        if reason
        else f"Converged in {len(changes)} turns, last change {changes[-1]:.1e} K."
        + thin_film_sentence(film.pressure, film.film, film.axes, (problem.radius,))
    )
    return ThermalLineSolution(
        film=film,
        temperature=energy.along(energy.T),
        flux=energy.along(energy.flux),
        heating=energy.along(energy.heating),
        changes=tuple(changes),
        converged=not reason,
        outcome=outcome,
    )


class _Energy:
    """Temperatures of one grid, in the direction of entrainment."""

    def __init__(
        self,
        system: LineSystem,
        problem: LineProblem,
        solid_1: Solid,
        solid_2: Solid,
        thermal: ThermalSettings,
    ) -> None:
        n = system.x.size
        self.system, self.problem, self.thermal = system, problem, thermal
        self.backward = problem.speed_1 < 0.0
        self.step = float(system.x[1] - system.x[0])
        self.now, self.before = np.empty(n), np.empty(n)
        fill_surface_weights(self.step, self.now, self.before)
        self.heating_of = SurfaceHeating(
            abs(problem.speed_1),
            abs(problem.speed_2),
            _surface_factor(solid_1, problem.speed_1),
            _surface_factor(solid_2, problem.speed_2),
            problem.lubricant.temperature,
        )
        self.T = np.full((n, thermal.heights), problem.lubricant.temperature)
        self.flux = np.zeros((n, 2))
        self.tau, self.eta, self.heating = np.zeros(n), np.zeros(n), np.zeros(n)

    def along(self, values: np.ndarray) -> np.ndarray:
        """Return values in the direction of entrainment in that of x, or the other way round."""
        return values[::-1].copy() if self.backward else values.copy()

    def stress(self) -> np.ndarray:
        """Return the mid-film stress along x (n,) [Pa]."""
        tau = self.along(self.tau)
        return -tau if self.backward else tau

    def turn(self, film: LineSolution) -> float:
        """Update the temperatures of the system from a film; return their largest change [K]."""
        p, h = self.along(film.pressure), self.along(film.film)
        rho = self.along(film.density)
        flow = np.abs(film.mass_flow)
        mean = np.concatenate([flow[:1], 0.5 * (flow[1:] + flow[:-1]), flow[-1:]])
        wet = (p > 0.0).astype(float)
        fields = FilmFields(p, np.gradient(p, self.step), h, rho, self.along(mean) / (rho * h), wet)
        new = np.empty_like(self.T)
        oil = self.problem.lubricant
        march_energy(
            fields,
            self.step,
            self.heating_of,
            oil,
            self.now,
            self.before,
            self.T,
            new,
            self.flux,
            self.tau,
            self.eta,
            self.heating,
        )
        change = float(np.abs(new - self.T).max())
        self.T += self.thermal.relaxation * (new - self.T)
        cooling, dilation = np.empty(p.size), np.empty(p.size)
        fill_thermal_oil(p, self.T, self.eta, oil, cooling, dilation)
        self.system.cooling = self.along(cooling)
        self.system.dilation = self.along(dilation)
        return change


def _surface_factor(solid: Solid, speed: float) -> float:
    diffusion = solid.density * solid.heat_capacity * solid.conductivity
    return 1.0 / math.sqrt(math.pi * diffusion * abs(speed))
