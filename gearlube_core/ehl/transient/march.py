"""March of a film in time: storage of oil, moving gap and load, one Newton solution a step."""

from __future__ import annotations

import math
import time as clock
from dataclasses import replace
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.ehl.point.newton.column_multigrid import ColumnCycles
from gearlube_core.ehl.point.newton.newton import NewtonRecord, flow_residual
from gearlube_core.ehl.point.newton.preconditioner import MultigridCycle
from gearlube_core.ehl.point.newton.transfer import Hierarchy
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import refuse_rupture
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.time_error import TimeError
from gearlube_core.ehl.transient.history import FilmHistory, MarchRecord, check_scheme
from gearlube_core.ehl.transient.level import MovingLevel, lifted
from gearlube_core.ehl.transient.newton import LaggedPreconditioner, step_newton
from gearlube_core.ehl.transient.problem import MovingFilm, set_conditions
from gearlube_core.ehl.transient.rows import RowCycle
from gearlube_core.ehl.transient.solution import FilmSolution, film_solution, pack_solutions
from gearlube_core.ehl.transient.steady import steady_state
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.kernels.row_workers import RowWorkers

# "quick" keeps thin films that a gap has left on half the nodes of "upwind-2"
MARCH_SETTINGS = PointSolverSettings(wedge="quick", tolerance=1e-5)
_MOST_PARTS = 4  # of a step that is not found as a whole
_PRESSED = 0.2  # of the layer of solids, the least film that a step starts from


def _multigrid(grids: Hierarchy, linear: Linearisation, _: object) -> MultigridCycle:
    return MultigridCycle(grids, linear)


class FilmMarch:
    """Marches a film from its steady state, step by step.

    Parameters
    ----------
    film : MovingFilm
    time_step
        [s].
    start_time
        Of the conditions whose steady film is the start [s].
    scheme : {"bdf2", "crank_nicolson"}
        Of the storage term; the first step of "bdf2" is a backward Euler step.
    settings
        Stencil and tolerances; `MARCH_SETTINGS` by default. Elements need a uniform grid,
        entrainment along x and "bdf2".
    record
        Goes on from there instead of from a steady state.
    throw
        Raise where the start does not converge.
    threads
        That share the work on rows, 1 to 64: not more than processors that have nothing else to
        do. Films do not depend on it, to the bit.

    Raises
    ------
    ConvergenceError
        The steady start was not found.
    ParameterError
        An input is out of range or the record belongs to another grid.

    Notes
    -----
    d(rho h)/dt = [1.5 (rho h)^q - 2 (rho h)^(q-1) + 0.5 (rho h)^(q-2)]/dt or the mean of the
    flows at both times. [jamali_2015 (3.23)]; [jamali_2015 (3.24)] prints its right
    side with the wrong sign.
    Nodes without pressure hold what the gap holds. A step that is not found as a whole is taken in
    2 or 4 parts by backward Euler, and its outcome says so; solutions read again
    from a record do not. Each film carries an estimate of what the time steps cost its smallest
    film, see `TimeError`.
    """

    def __init__(
        self,
        film: MovingFilm,
        time_step: float,
        *,
        start_time: float = 0.0,
        scheme: str = "bdf2",
        settings: PointSolverSettings | None = None,
        record: MarchRecord | None = None,
        throw: bool = True,
        threads: int = 1,
    ) -> None:
        check_positive("time_step", time_step, "s")
        check_within("start_time", start_time, -1e9, 1e9, "s")
        if settings is None:
            settings = MARCH_SETTINGS
        check_scheme(scheme, settings.discretisation)
        refuse_rupture(settings, "that changes in time")
        self.film, self.time_step, self.start_time = film, time_step, start_time
        self.scheme, self.settings, self.steps = scheme, settings, 0
        self._grids = film.row_grids(settings) if film.long else film.grids(settings)
        level = self._grids.levels[-1]
        assert isinstance(level, MovingLevel)
        self._level, workers = level, RowWorkers(threads)
        for one in self._grids.levels:
            one.set_workers(workers)
        self._unit = time_step * level.scales.speed / level.scales.length
        if level.grid.sides.closed and not film.long:
            # cheap to build, so rebuilt at every linearisation
            self._lagged = LaggedPreconditioner(self._grids, ColumnCycles(), patience=0)
        else:
            self._lagged = LaggedPreconditioner(self._grids, RowCycle if film.long else _multigrid)
        begin = clock.perf_counter()
        if record is None:
            set_conditions(film, self._grids, start_time)
            state, work = self._steady()
            self._past = FilmHistory(
                state, state.mass, state.mass, level.terms.storage.inflow(state), None
            )
            self._start_pressure = state.pressure
            self._time_error = TimeError(scheme, film.x, state.mass[None])
            count, krylov = len(work.residuals), work.krylov
        else:
            self._resume(record)
            state, count, krylov = self._past.state, 0, 0
        self.solution = self._solution(state, count, krylov, clock.perf_counter() - begin)
        if throw and not self.solution.converged:
            raise ConvergenceError(f"Start: {self.solution.outcome}")

    @property
    def time(self) -> float:
        """Return the time that was reached [s]."""
        return self.start_time + self.steps * self.time_step

    def step(self, *, throw: bool = True) -> FilmSolution:
        """Return the film one time step later.

        Parameters
        ----------
        throw
            False: return a solution that is not converged instead of raising; the march goes on
            from it.

        Raises
        ------
        ConvergenceError
        """
        level, past = self._level, self._past
        begin = clock.perf_counter()
        self.steps += 1
        set_conditions(self.film, self._grids, self.time, finest_only=True)
        self._set_storage()
        level.hold_ambient_above(
            level.film(past.state.pressure, past.state.approach), self.film.open_film
        )
        state, record = self._attempt(self._predicted())
        if not record.converged:
            self._lagged.clear()
            again, second = self._attempt(level.state(past.state.pressure, past.state.approach))
            second.newton_steps += record.newton_steps
            second.krylov_steps += record.krylov_steps
            if second.converged or second.residual < record.residual:
                state, record = again, second
        parts = 1
        while not record.converged and parts < _MOST_PARTS:
            parts *= 2
            divided = self._divided(parts)
            if divided is not None:
                state, record = divided, replace(record, converged=True)
        way = level.terms.entrainment.rows * (level.scales.speed * self.time_step)
        self._time_error.step(state.mass, state.pressure, way)
        rise = (state.pressure - past.state.pressure, state.approach - past.state.approach)
        self._past = FilmHistory(
            state, state.mass, past.mass, level.terms.storage.inflow(state), rise
        )
        self.solution = self._solution(
            state, record.newton_steps, record.krylov_steps, clock.perf_counter() - begin
        )
        if record.converged and parts > 1:
            outcome = (
                f"{self.solution.outcome} The step was taken in {parts} parts, by backward Euler."
            )
            self.solution = replace(self.solution, outcome=outcome)
        if throw and not self.solution.converged:
            raise ConvergenceError(f"Step {self.steps}: {self.solution.outcome}")
        return self.solution

    def save(
        self,
        path: Path | str,
        curves: Array | None = None,
        kept: dict[int, FilmSolution] | None = None,
    ) -> None:
        """Write a record from which a march goes on as if it had not stopped.

        `curves` and the solutions in `kept` go with it, for the caller.
        """
        kept_steps, kept_fields, kept_values = pack_solutions(kept or {})
        past = self._past
        empty = np.zeros_like(past.mass)
        rise, approach_rise = (empty, 0.0) if past.rise is None else past.rise
        MarchRecord(
            steps=self.steps,
            start_time=self.start_time,
            time_step=self.time_step,
            scheme=self.scheme,
            positions=self._level.grid.positions,
            pressure=past.state.pressure,
            approach=past.state.approach,
            start_pressure=self._start_pressure,
            masses=self._time_error.masses,
            mass_error=self._time_error.error,
            inflow=past.inflow,
            rise=rise,
            approach_rise=approach_rise,
            curves=np.zeros(0) if curves is None else curves,
            kept_steps=kept_steps,
            kept_fields=kept_fields,
            kept_values=kept_values,
        ).write(path)
        # what goes on and what is read again start from the same preconditioner: none
        self._lagged.clear()

    def _resume(self, record: MarchRecord) -> None:
        level = self._level
        same = (
            record.pressure.shape == level.shape
            and record.scheme == self.scheme
            and record.time_step == self.time_step
            and record.start_time == self.start_time
        )
        if not same:
            raise ParameterError(
                f"the record must belong to this march: its grid has the shape "
                f"{record.pressure.shape}, its scheme is {record.scheme} and its step "
                f"{record.time_step:.6g} s, got {level.shape}, {self.scheme} and "
                f"{self.time_step:.6g} s. Start again."
            )
        if not np.allclose(
            record.positions, level.grid.positions, rtol=0.0, atol=1e-9 * level.grid.dx
        ):
            raise ParameterError(
                "the record must belong to this march, got nodes at other places along x. Start "
                "again, or take the grid from which it was made."
            )
        self.steps, self._start_pressure = record.steps, record.start_pressure
        set_conditions(self.film, self._grids, self.time)
        state = level.state(record.pressure, record.approach)
        state.residual = np.zeros(level.shape)  # it was solved with storage
        rise = (record.rise, record.approach_rise) if record.steps else None
        self._time_error = TimeError(self.scheme, self.film.x, record.masses, record.mass_error)
        before = record.masses[min(1, len(record.masses) - 1)]
        self._past = FilmHistory(state, record.masses[0], before, record.inflow, rise)

    def _steady(self) -> tuple[FilmState, NewtonRecord]:
        grids = self.film.grids(self.settings)
        set_conditions(self.film, grids, self.start_time)
        state, work = steady_state(self.film, grids, self.settings)
        finest = grids.levels[-1]
        assert isinstance(finest, MovingLevel)
        self._level.set_boundary(finest.terms.boundary)
        return self._level.state(state.pressure, state.approach), work

    def _set_storage(self) -> None:
        self._level.set_storage(*self._past.storage(self.scheme, self._unit, self.steps == 1))

    def _predicted(self) -> FilmState:
        past, level = self._past, self._level
        trial = level.state(*past.predicted())
        if float(trial.film.min()) <= 0.5 * float(past.state.film.min()):
            trial = level.state(past.state.pressure, past.state.approach)
        if self.film.solids is None or self.film.long or level.grid.graded:
            return trial
        # roughness moves with the oil, more or less
        nodes = float(np.mean(level.terms.entrainment.rows)) * self._unit / level.grid.dx
        moved = level.state(past.carried(self._start_pressure, nodes), past.state.approach)
        return min(trial, moved, key=lambda one: flow_residual(level, one))

    def _divided(self, parts: int) -> FilmState | None:
        """Return the state after shorter steps of backward Euler; None if one of them fails."""
        level, state, mass = self._level, self._past.state, self._past.mass
        rate = parts / self._unit
        for left in reversed(range(parts)):
            time = self.time - left * self.time_step / parts
            set_conditions(self.film, self._grids, time, finest_only=True)
            level.set_storage(rate, rate * mass)
            film = level.film(state.pressure, state.approach)
            level.hold_ambient_above(film, self.film.open_film)
            state, record = self._attempt(level.state(state.pressure, state.approach))
            if not record.converged:
                set_conditions(self.film, self._grids, self.time, finest_only=True)
                self._set_storage()
                return None
            mass = state.mass
        return state

    def _attempt(self, begin: FilmState):  # type: ignore[no-untyped-def]
        lowest = float(begin.film.min())
        least = 0.05 * float(np.median(begin.film[begin.pressure > 0.5 * begin.pressure.max()]))
        if self.film.solids is not None:
            # touching solids are meant to be close
            least = min(least, _PRESSED * self.film.solids.thickness / self._level.scales.film)
        if lowest < least:
            raised = begin.approach + least - lowest
            begin = lifted(self._level, begin, least) or self._level.state(begin.pressure, raised)
        return step_newton(
            self._lagged,
            begin,
            tolerance=self.settings.tolerance,
            load_tolerance=self.settings.load_tolerance,
            most=self.settings.newton_steps,
            most_krylov=self.settings.krylov_steps,
        )

    def _solution(self, state: FilmState, steps: int, krylov: int, seconds: float) -> FilmSolution:
        return film_solution(
            self.film,
            self._level,
            state,
            self.settings,
            time=self.time,
            newton_steps=steps,
            krylov_steps=krylov,
            seconds=seconds,
            time_error=self._time_error.of_smallest_film(state.film) if self.steps else math.nan,
        )
