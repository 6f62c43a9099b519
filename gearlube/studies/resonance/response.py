"""Response of one model over mesh frequency, and periodic motions at chosen frequencies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube.studies.resonance.summary import rate_over_period
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import DE, R_G, R_P
from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, N_RECORD, OK, march
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit, PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.periodic import Branch, SpecialPoint, follow, solve_periodic, switch_branch

Progress = Callable[[float], None]

HARMONICS = 6
MOST_DOUBLED = 4  # period-doubled branches followed per model
ORBIT_STEPS = 256  # samples per mesh period
STROBES = 240  # mesh periods of the section


@dataclass(frozen=True, slots=True, kw_only=True)
class Segment:
    """A branch of motions and the equations that it solves.

    Parameters
    ----------
    problem : PeriodProblem
        Its `periods` are the mesh periods of the motions.
    branch : Branch
        Over the pinion speed [rad/s].
    """

    problem: PeriodProblem
    branch: Branch

    def orbit(self, row: int) -> Orbit:
        """Return the motion of a row."""
        return self.problem.orbit(self.branch.unknowns[row], self.branch.parameter[row])


@dataclass(slots=True, kw_only=True)
class Response:
    """All branches that were followed for one model.

    Parameters
    ----------
    model : str
        See `MODELS`.
    segments : list of Segment
        The branch from the lowest frequency; where that did not reach the highest, the one from
        there; then those that leave at period doublings.
    """

    model: str
    segments: list[Segment] = field(default_factory=list)

    @property
    def natural_frequency(self) -> float:
        """Natural frequency of the mesh mode [Hz]."""
        return self.segments[0].problem.model.natural_frequency

    @property
    def interrupted(self) -> bool:
        """Whether a branch was cut short by the user."""
        return any(segment.branch.ending == "interrupted" for segment in self.segments)

    def relative(self, speed: Array | float) -> Array:
        """Return mesh over natural frequency at pinion speeds [rad/s]."""
        unit = self.segments[0].problem.model.pinion_speed(self.natural_frequency)
        return np.asarray(speed) / unit

    def motions(self, relative: float) -> list[tuple[Segment, int]]:
        """Return segment and row of every motion found at a requested frequency."""
        speed = self.segments[0].problem.model.pinion_speed(relative * self.natural_frequency)
        found: list[tuple[Segment, int]] = []
        for segment in self.segments:
            for row in segment.branch.at(speed):
                if not any(_same(segment, row, *other) for other in found):
                    found.append((segment, int(row)))
        return found


def _same(segment: Segment, row: int, other: Segment, other_row: int) -> bool:
    """Whether two rows at one frequency are the same motion, found from both ends of the range."""
    if segment.problem.periods != other.problem.periods:
        return False
    apart = segment.branch.unknowns[row] - other.branch.unknowns[other_row]
    return bool(np.max(np.abs(apart / segment.problem.scales)) < 1e-5)


def follow_response(
    response: Response,
    settings: ResonanceSettings,
    *,
    doubled: bool = True,
    progress: Progress | None = None,
) -> None:
    """Fill `response` with the branches of its model over the range of `settings`.

    Parameters
    ----------
    response : Response
        Empty; holds what was found also after KeyboardInterrupt.
    settings : ResonanceSettings
    doubled : bool
        Whether to follow the branches that leave at period doublings.
    progress : callable, optional
        Called with the share of the range that is done [-].

    Raises
    ------
    ConvergenceError
        No motion found at either end of the range.
    """
    problem = PeriodProblem(
        settings.parameters(response.model), steps_per_mesh_period=settings.steps(response.model)
    )
    model = problem.model
    unit = model.pinion_speed(model.natural_frequency)
    wanted = [*settings.relative, *settings.orbits_at]
    if settings.load_at is not None:
        wanted.append(settings.load_at)
    asked = unit * np.unique([at for at in wanted if settings.first <= at <= settings.last])
    low, high = unit * settings.first, unit * settings.last

    def observe(_: int, speed: float) -> None:
        if progress is not None:
            progress((speed - low) / (high - low))

    def add(start: Array, speed: float, heading: float | Array, of: PeriodProblem) -> Branch:
        branch = follow(
            of.equations(),
            start,
            speed,
            limits=(low, high),
            heading=heading,
            at=asked,
            progress=observe,
        )
        response.segments.append(Segment(problem=of, branch=branch))
        return branch

    up = add(problem.initial_guess(low), low, 1.0, problem)
    if up.ending not in ("parameter limit", "interrupted"):
        add(problem.initial_guess(high), high, -1.0, problem)
    if not doubled or response.interrupted:
        return
    twice = PeriodProblem(
        settings.parameters(response.model),
        periods=2,
        steps_per_mesh_period=settings.steps(response.model),
    )
    for point in _doublings(response)[:MOST_DOUBLED]:
        try:
            start = switch_branch(twice.equations(), point)
            add(start.unknowns, start.parameter, start.heading, twice)
        except (ConvergenceError, ParameterError):
            continue  # a doubling at which contact is only grazed may have no branch to follow
        if response.interrupted:
            return


def _doublings(response: Response) -> list[SpecialPoint]:
    return [
        point
        for segment in response.segments
        for point in segment.branch.of_kind("period doubling")
    ]


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """One periodic motion.

    Parameters
    ----------
    model : str
        See `MODELS`.
    relative : float
        Mesh over natural frequency [-].
    stable : bool
    multiplier : float
        Largest modulus of the Floquet multipliers [-].
    problem : PeriodProblem
        `ORBIT_STEPS` steps per mesh period.
    unknowns : ndarray
        z of `problem`.
    orbit : Orbit
    rate : ndarray of shape (samples,)
        x' [m/s].
    """

    model: str
    relative: float
    stable: bool
    multiplier: float
    problem: PeriodProblem
    unknowns: Array
    orbit: Orbit
    rate: Array

    @property
    def peak_to_peak(self) -> float:
        """Of the dynamic transmission error [m]."""
        return float(np.ptp(self.orbit.x))


def motions_at(response: Response, settings: ResonanceSettings, relative: float) -> list[Motion]:
    """Return all motions found at a frequency of `settings.orbits_at`, smallest first."""
    found: list[Motion] = []
    for segment, row in response.motions(relative):
        problem = PeriodProblem(
            settings.parameters(response.model),
            periods=segment.problem.periods,
            steps_per_mesh_period=ORBIT_STEPS,
        )
        motion = motion_near(response.model, problem, segment.branch.unknowns[row], relative)
        if motion is not None:
            found.append(motion)
    return sorted(found, key=lambda motion: motion.peak_to_peak)


def motion_near(model: str, problem: PeriodProblem, start: Array, relative: float) -> Motion | None:
    """Return the periodic motion near a start, None where Newton's method does not find it."""
    pair = problem.model
    speed = pair.pinion_speed(relative * pair.natural_frequency)
    found = solve_periodic(problem.equations(), start, speed, throw=False)
    if not found.converged:
        return None
    orbit = problem.orbit(found.unknowns, speed)
    return Motion(
        model=model,
        relative=relative,
        stable=found.stable,
        multiplier=float(np.max(np.abs(found.multipliers))),
        problem=problem,
        unknowns=found.unknowns,
        orbit=orbit,
        rate=rate_over_period(orbit),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PoincareSection:
    """Motions sampled once per mesh period, at mesh phase zero.

    Parameters
    ----------
    relative : float
        Mesh over natural frequency [-].
    x, rate : ndarray of shape (starts, STROBES + 1)
        Transmission error [m] and its rate [m/s]; NaN after a motion that is no longer finite.
    motions : list of Motion
        Periodic motions found by continuation at that frequency, stable and unstable.
    """

    relative: float
    x: Array
    rate: Array
    motions: list[Motion]


def richest_frequency(response: Response, settings: ResonanceSettings) -> float:
    """Return the middle one of the requested frequencies that have most motions."""
    counts = np.array([len(response.motions(value)) for value in settings.relative])
    most = settings.relative[counts == counts.max()]
    if counts.max() <= 1:
        return float(settings.relative[np.argmin(np.abs(settings.relative - 1.0))])
    return float(most[most.size // 2])


def poincare_section(
    response: Response, settings: ResonanceSettings, relative: float
) -> PoincareSection:
    """Return how motions from a grid of starting states approach periodic motions.

    Starts differ in the relative motion alone: each gets a transmission error and a rate of the
    mesh mode, without changing the momentum about the pinion.
    """
    problem = PeriodProblem(settings.parameters(response.model), steps_per_mesh_period=ORBIT_STEPS)
    pair, p = problem.model, problem.model.kernel_parameters
    rows = pair.rows(ORBIT_STEPS)
    speed = pair.pinion_speed(relative * pair.natural_frequency)
    starts = _starts(response, settings, relative, pair.natural_frequency)
    x = np.full((starts.shape[0], STROBES + 1), np.nan)
    rate = np.full_like(x, np.nan)
    nothing, work = np.zeros((0, N_RECORD)), np.zeros(MARCH_WORK)
    for number, (x_0, rate_0) in enumerate(starts):
        y = pair.initial_state(speed)
        y[0] = MICRO * x_0
        extra = rate_0 - _rate(y, rows, response.model, speed)
        if response.model == "one_dof":
            y[1] += extra
        else:
            y[1] += extra * p.m_eq * p.R_p0 / p.I_p
            y[2] -= extra * p.m_eq * p.R_g0 / p.I_g
        for strobe in range(STROBES + 1):
            x[number, strobe] = UM * y[0]
            rate[number, strobe] = _rate(y, rows, response.model, speed)
            if march(y, strobe, 1, pair.mean_load_torque, speed, rows, p, nothing, work) != OK:
                break
    return PoincareSection(
        relative=relative, x=x, rate=rate, motions=motions_at(response, settings, relative)
    )


def _rate(y: Array, rows: Array, model: str, speed: float) -> float:
    """Return x' [m/s] of a state at mesh phase zero."""
    if model == "one_dof":
        return float(y[1] - rows[0, DE] * speed)
    return float((rows[0, R_P] - rows[0, DE]) * y[1] - rows[0, R_G] * y[2])


def _starts(
    response: Response, settings: ResonanceSettings, relative: float, natural_frequency: float
) -> Array:
    """Return x [m] and x' [m/s] on two ellipses that hold all motions of the frequency, (n, 2)."""
    orbits = [segment.orbit(row).x for segment, row in response.motions(relative)]
    if not orbits:
        return np.zeros((0, 2))
    middle = float(np.mean(orbits[0]))
    reach = max(float(np.max(np.abs(x - middle))) for x in orbits)
    angle = 2.0 * np.pi * np.arange(settings.section_starts) / settings.section_starts
    size = reach * np.where(np.arange(settings.section_starts) % 2, 1.2, 0.6)
    pulse = 2.0 * np.pi * natural_frequency
    return np.column_stack([middle + size * np.cos(angle), size * pulse * np.sin(angle)])
