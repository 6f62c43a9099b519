"""The pairs on which the statements are judged, and their response over frequency."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlube.studies.resonance.response import Response, Segment
from gearlube.studies.resonance.summary import mesh_harmonics
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.parameters import (
    HypoidTorsionalParameters,
    karagiannis_2012_pair,
)
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit, PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
from gearlube_core.periodic import ContinuationSettings, follow, solve_periodic

FIRST, LAST, SPACING = 0.2, 1.6, 0.005  # mesh over natural frequency
MISMATCHES = (0.0, 0.002, 0.003, 0.004)
R_P0, TEETH, E0 = 21.1e-3, 13, 0.96e-6  # of `synthetic_mesh`
STEPS = 512
ORDERS = 6
# Below it the separated branch of a mismatched pair breaks up into many short folds.
SEPARATED_FROM = 0.5
_MOST_POINTS = 450


def reconstructed(mismatch: float = 0.0, **options: Any) -> HypoidTorsionalParameters:
    """Return the pair with the paper's reconstructed numbers and a ratio mismatch [-]."""
    mesh = options.pop("mesh", {})
    pair = karagiannis_2012_pair(synthetic_mesh(radius_mismatch=mismatch, **mesh))
    return replace(pair, **{"radii": "paper", **options})


def respond(name: str, parameters: HypoidTorsionalParameters, steps: int = STEPS) -> Response:
    """Return the branches from the lowest and, where they do not meet, the highest frequency."""
    problem = PeriodProblem(parameters, steps_per_mesh_period=steps)
    unit = problem.model.pinion_speed(problem.model.natural_frequency)
    relative = np.arange(FIRST, LAST + 0.5 * SPACING, SPACING)
    response = Response(model=name)
    settings = ContinuationSettings(max_points=_MOST_POINTS)
    for start, heading, lowest in ((FIRST, 1.0, FIRST), (LAST, -1.0, SEPARATED_FROM)):
        branch = follow(
            problem.equations(),
            problem.initial_guess(start * unit),
            start * unit,
            limits=(lowest * unit, LAST * unit),
            heading=heading,
            at=unit * relative[relative >= lowest - 1e-9],
            settings=settings,
        )
        response.segments.append(Segment(problem=problem, branch=branch))
        if branch.ending == "parameter limit" and branch.parameter[-1] > 0.99 * LAST * unit:
            break
    return response


@dataclass(frozen=True, slots=True)
class Point:
    """One stable motion at one frequency."""

    relative: float
    peak_to_peak: float  # m
    minimum: float  # m
    mean: float  # m
    separation_share: float
    harmonics: Array  # m, mesh orders from 1
    segment: Segment
    row: int


def stable_points(response: Response, relative: float) -> list[Point]:
    """Return the stable motions at a frequency that was asked for, smallest first."""
    found = []
    for segment, row in response.motions(relative):
        if not segment.branch.stable[row]:
            continue
        orbit = segment.orbit(row)
        x = orbit.x
        found.append(
            Point(
                relative,
                float(np.ptp(x)),
                float(x.min()),
                float(x.mean()),
                orbit.separation_share,
                mesh_harmonics(x, segment.problem.periods, ORDERS),
                segment,
                row,
            )
        )
    return sorted(found, key=lambda point: point.peak_to_peak)


class Curve:
    """Stable motions of a response over frequency.

    The pair softens: a slow sweep up stays on the smallest motion, one down on the largest.
    """

    def __init__(self, response: Response) -> None:
        self.response = response
        grid = np.round(np.arange(FIRST, LAST + 0.5 * SPACING, SPACING), 4)
        points = {float(r): stable_points(response, float(r)) for r in grid}
        self.points = {r: found for r, found in points.items() if found}

    def up(self, relative: float) -> Point:
        """Return the motion that a sweep up is on."""
        return self.points[relative][0]

    def down(self, relative: float) -> Point:
        """Return the motion that a sweep down is on."""
        return self.points[relative][-1]

    @property
    def relative(self) -> Array:
        """Frequencies at which a stable motion was found."""
        return np.array(sorted(self.points))

    @property
    def bistable(self) -> tuple[float, float] | None:
        """Lowest and highest frequency with more than one stable motion."""
        two = [r for r, found in self.points.items() if len(found) > 1]
        return (min(two), max(two)) if two else None

    def separated(self, direction: str) -> tuple[float, float] | None:
        """Return lowest and highest frequency without full contact in a sweep."""
        pick = self.up if direction == "up" else self.down
        apart = [r for r in self.points if pick(r).separation_share > 0.0]
        return (min(apart), max(apart)) if apart else None


def settled_orbit(parameters: HypoidTorsionalParameters, relative: float) -> Orbit | None:
    """Return the stable periodic motion that Newton's method finds from static deflection."""
    problem = PeriodProblem(parameters, steps_per_mesh_period=256)
    model = problem.model
    speed = model.pinion_speed(relative * model.natural_frequency)
    start = problem.initial_guess(speed)
    found = solve_periodic(problem.equations(), start, speed, throw=False)
    if not (found.converged and found.stable):
        return None
    return problem.orbit(found.unknowns, speed)


def settled(parameters: HypoidTorsionalParameters, relative: float) -> tuple[float, float]:
    """Return swing [m] and share of time without contact of that motion; nan: none found."""
    orbit = settled_orbit(parameters, relative)
    return (float(np.ptp(orbit.x)), orbit.separation_share) if orbit else (np.nan, np.nan)


def double_counts() -> list[tuple[float, ...]]:
    """Return claim 14: a mismatch of the radii expressed as a transmission error.

    Mismatch [-], mesh over natural frequency, error R_p0 d/z [m]; peak to peak [m] with the radii,
    and with the error instead in 2-DOF and in 1-DOF.
    """
    found = []
    for d in MISMATCHES[1:]:
        error = {"error_harmonics": ((E0, -R_P0 * d / TEETH),)}
        pairs = (
            reconstructed(d),
            reconstructed(radii="mean", mesh=error),
            reconstructed(form="one_dof", mesh=error),
        )
        for relative in (0.3, 0.5, 0.65, 1.0):
            swings = (settled(pair, relative)[0] for pair in pairs)
            found.append((d, relative, R_P0 * d / TEETH, *swings))
    return found
