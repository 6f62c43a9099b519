"""Line contact in time: squeeze, moving features, load and speeds that change."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.ehl.line.newton import newton
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solution import LineSolution, build_solution
from gearlube_core.ehl.line.system import LOAD, LineState, LineSystem, row_coefficients
from gearlube_core.ehl.time_error import TimeError, time_error_sentence
from gearlube_core.errors import ConvergenceError, ParameterError

TIME_SCHEMES = ("bdf2", "crank_nicolson")


@dataclass(frozen=True, slots=True, kw_only=True)
class LineHistory:
    """Quantities that change in time; the others stay constant.

    Parameters
    ----------
    gap
        Undeformed gap [m] at positions (n,) [m] and a time [s].
    line_load
        w [N/m] at a time [s].
    speeds
        Surface speeds of body 1 and 2 [m/s] at a time [s].
    """

    gap: Callable[[np.ndarray, float], np.ndarray] | None = None
    line_load: Callable[[float], float] | None = None
    speeds: Callable[[float], tuple[float, float]] | None = None


class LineMarch:
    """Marches a line contact from a solution at time zero, step by step.

    Parameters
    ----------
    start : LineSolution
        Converged, on a grid that is kept.
    history : LineHistory
        What changes with time.
    time_step : float
        [s], the same for every step.
    scheme : {"bdf2", "crank_nicolson"}
        Of the squeeze term; the first step of "bdf2" is a backward Euler step.

    Raises
    ------
    ParameterError
        When the start has not converged or an input is out of range.

    Notes
    -----
    d(rho h)/dt = [1.5 (rho h)^q - 2 (rho h)^(q-1) + 0.5 (rho h)^(q-2)]/dt, or the mean of the
    flows at both times. [jamali_2015 (3.23)]; [jamali_2015 (3.24)] prints its right
    side with the wrong sign.
    Where a film without mass conservation is broken, what gathers is the whole gap. Where no film
    is found, the step is solved again with solids that touch at `contact_film`: load and balances
    of all other nodes hold, what oil a held film makes is `contact_flow` of the solution.
    Each solution has the error of its smallest film by time steps, see `TimeError`, and the
    errors of grid and domain that the start has.
    """

    def __init__(
        self, start: LineSolution, history: LineHistory, time_step: float, scheme: str = "bdf2"
    ) -> None:
        check_option("scheme", scheme, TIME_SCHEMES)
        check_positive("time_step", time_step, "s")
        if not start.converged:
            raise ParameterError(f"The start of a march must have converged. {start.outcome}")
        settings = start.settings
        conserving = settings.cavitation == "mass_conserving"
        ends = float(start.x[0]), float(start.x[-1])
        beyond = start.problem.flooded_beyond
        problem = replace(start.problem, domain=ends, oil_beyond=beyond)
        self.settings: LineSettings = settings
        self.history, self.scheme, self.time, self.steps = history, scheme, 0.0, 0
        self._problem, self._error = problem, f" At the start:{start.error.sentence}"
        self._system = LineSystem(problem, start.x.size, settings.stencil, conserving)
        scales = self._system.scales
        self._time_step = time_step
        self._dT = time_step / scales.time
        P = start.pressure / scales.pressure
        self._state = LineState(P, start.void.copy(), start.approach / scales.film)
        self._rise: LineState | None = None
        self._system.evaluate(self._state)
        self._mass = self._stored(self._state)
        self._time_error = TimeError(scheme, self._system.X, self._mass[None, None])
        self._older = self._mass
        self._divergence = self._outflow()

    def step(self, *, throw: bool = True) -> LineSolution:
        """Return the solution one time step later.

        Parameters
        ----------
        throw : bool
            False: return a solution that is not converged instead of raising; the march goes on
            from it.

        Raises
        ------
        ConvergenceError
        """
        system = self._system
        self.steps += 1
        self.time = self.steps * self._time_step
        problem = self._problem_now()
        self._set_balance(problem)
        state, record = newton(
            system, self._predicted(), self.settings.tolerance, self.settings.max_iterations
        )
        if not record.converged and self.settings.contact_film > 0.0:
            system.least = self.settings.contact_film / system.scales.film
            for first in (self._predicted(), self._state):
                state, record = newton(
                    system, first, self.settings.tolerance, 2 * self.settings.max_iterations
                )
                if record.converged:
                    break
        records = ((system.x.size, record),)
        solution = build_solution(system, state, self.settings, records, problem)
        stored = self._stored(state)
        way = problem.entrainment_speed * self._time_step / system.scales.length
        self._time_error.step(stored[None], state.P[None], np.array([way]))
        error = self._time_error.of_smallest_film(system.H[None])
        solution = replace(
            solution,
            time_error=error,
            outcome=solution.outcome + time_error_sentence(error) + self._error,
        )
        system.least = 0.0
        if throw and not solution.converged:
            raise ConvergenceError(f"Step {self.steps}: {solution.outcome}")
        self._rise = LineState(
            state.P - self._state.P, state.void - self._state.void, state.H0 - self._state.H0
        )
        self._state = state
        self._older, self._mass = self._mass, stored
        self._divergence = self._outflow()
        return solution

    def _problem_now(self) -> LineProblem:
        history, problem = self.history, self._problem
        if history.line_load is not None:
            load = check_within("line_load", history.line_load(self.time), 0.0, 1e12, "N/m")
            problem = replace(problem, line_load=max(load, 1e-300))
        if history.speeds is not None:
            u1, u2 = history.speeds(self.time)
            problem = replace(problem, speed_1=u1, speed_2=u2)
        return problem

    def _set_balance(self, problem: LineProblem) -> None:
        system, history = self._system, self.history
        if history.gap is not None:
            gap = np.asarray(history.gap(system.x, self.time), dtype=float)
            system.gap = gap / system.scales.film
        system.set_beyond(problem)
        system.load = LOAD * problem.line_load / self._problem.line_load
        c = row_coefficients(
            problem,
            system.scales,
            system.step,
            self.settings.stencil,
            system.mass_conserving,
        )
        weight, storage = 1.0, 1.0 / self._dT
        old = self._mass
        if self.scheme == "crank_nicolson":
            weight = 0.5
        elif self.steps > 1:
            storage = 1.5 / self._dT
            old = (4.0 * self._mass - self._older) / 3.0
        system.coefficients = c._replace(weight=weight, storage=storage)
        system.source = -system.step * storage * old
        if self.scheme == "crank_nicolson":
            system.source += 0.5 * self._divergence

    def _predicted(self) -> LineState:
        state, rise = self._state, self._rise
        if rise is None:
            return state
        P = np.where(state.P > 0.0, np.maximum(state.P + rise.P, 0.5 * state.P), 0.0)
        return LineState(P, state.void, state.H0 + rise.H0)

    def _stored(self, state: LineState) -> np.ndarray:
        # of the state that was evaluated last
        return self._system.rows.rho * self._system.H * (1.0 - state.void)

    def _outflow(self) -> np.ndarray:
        # what leaves each cell at full weight, without storage
        system = self._system
        kept = system.coefficients, system.source
        system.coefficients = kept[0]._replace(weight=1.0, storage=0.0)
        system.source = np.zeros(system.x.size)
        system.evaluate(self._state)
        outflow = system.rows.residual.copy()
        system.coefficients, system.source = kept
        return outflow
