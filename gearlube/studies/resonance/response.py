"""Response of one model over mesh frequency, by continuation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit, PeriodProblem
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.periodic import Branch, SpecialPoint, follow, switch_branch

Progress = Callable[[float], None]

HARMONICS = 6
MOST_DOUBLED = 4  # period-doubled branches followed per model


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
