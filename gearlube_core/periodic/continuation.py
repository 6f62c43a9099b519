"""Branches of periodic motions followed through folds by pseudo-arclength."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.periodic.branch import Branch, Crossing, Ending, SpecialPoint, crossings, locate
from gearlube_core.periodic.floquet import stable
from gearlube_core.periodic.newton import (
    ArclengthCorrector,
    Correction,
    NewtonSettings,
    Node,
    hermite,
    turning_angle,
)
from gearlube_core.periodic.problem import PeriodicProblem
from gearlube_core.periodic.shooting import require


class _Recorder:
    """Collects the points of a branch, with requested values and special points between them.

    Parameters
    ----------
    arc
        Finds points between two others.
    start
        First point of the branch.
    values
        Scaled parameters at which rows are wanted.
    tolerance
        Width [-] within which special points are located.
    """

    def __init__(
        self, arc: ArclengthCorrector, start: Node, values: Iterable[float], tolerance: float
    ) -> None:
        self._arc, self._tolerance = arc, tolerance
        self._values = np.unique(np.array(list(values), dtype=np.float64))
        self._nodes: list[Node] = [start]
        self._special: list[tuple[int, Crossing]] = []

    @property
    def count(self) -> int:
        """Rows so far."""
        return len(self._nodes)

    @property
    def last_parameter(self) -> float:
        """P of the last row."""
        return self._arc.problem.unscaled(self._nodes[-1].place)[1]

    def point_at_parameter(self, a: Node, b: Node, value: float) -> Node | None:
        """Return the point between two others at a scaled parameter; None if it is not found."""
        if a.place[-1] == value:
            return a
        node = self._arc.at_parameter(a, b, value)
        if node is not None:
            return node
        node, width, _ = locate(
            self._arc, a, b, lambda point: float(point.place[-1]) - value, self._tolerance
        )
        return node if width <= self._tolerance else None

    def add(self, a: Node, b: Node) -> None:
        """Add a step from the last row to a new one: special points, wanted values, the end."""
        if b is a:
            return
        nodes, found = [a], crossings(self._arc, a, b, self._tolerance)
        for crossing in found:
            if crossing.node is not nodes[-1] and crossing.node is not b:
                nodes += [*self._wanted(nodes[-1], crossing.node), crossing.node]
        nodes += [*self._wanted(nodes[-1], b), b]
        rows = {id(node): self.count - 1 + place for place, node in enumerate(nodes)}
        self._special += [(rows[id(crossing.node)], crossing) for crossing in found]
        self._nodes += nodes[1:]

    def _wanted(self, a: Node, b: Node) -> list[Node]:
        low, high = sorted((float(a.place[-1]), float(b.place[-1])))
        values = self._values[(self._values > low) & (self._values < high)]
        if a.place[-1] > b.place[-1]:
            values = values[::-1]
        found = (self.point_at_parameter(a, b, float(value)) for value in values)
        return [node for node in found if node is not None]

    def branch(self, ending: Ending) -> Branch:
        """Return the branch of all collected points."""
        problem = self._arc.problem
        places = np.array([node.place for node in self._nodes])
        gaps = np.linalg.norm(np.diff(places, axis=0), axis=1)
        return Branch(
            parameter=places[:, -1] * problem.parameter_scale,
            unknowns=places[:, :-1] * problem.unknown_scale,
            multipliers=np.array([node.multipliers for node in self._nodes]),
            stable=np.array([stable(node.multipliers) for node in self._nodes]),
            arclength=np.concatenate(([0.0], np.cumsum(gaps))),
            special=tuple(self._point(row, crossing) for row, crossing in self._special),
            ending=ending,
            evaluations=self._arc.evaluations,
        )

    def _point(self, row: int, crossing: Crossing) -> SpecialPoint:
        unknowns, parameter = self._arc.problem.unscaled(crossing.node.place)
        return SpecialPoint(
            kind=crossing.kind,
            index=row,
            parameter=parameter,
            unknowns=unknowns,
            tangent=crossing.node.tangent,
            width=crossing.width,
            smooth=crossing.smooth,
        )


_FAILURES = 2  # shorter steps tried before a corner is suspected
_BACK = 0.995  # cosine of 6 degrees: a branch does not return so nearly along itself
Progress = Callable[[int, float], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class ContinuationSettings:
    """Lengths and limits of a continuation; lengths are in scaled unknowns and parameter [-].

    Parameters
    ----------
    step, smallest_step, largest_step
        Arclength of the first step, and its limits. Two special points of one kind within a step
        are not seen: the largest step should be below the width of what is looked for.
    turn
        Angle [rad] by which the branch should turn in a step; steps that turn three times as far
        are repeated with half the length. 0.01 to 0.5.
    max_points
        Rows at which to stop.
    location_tolerance
        Arclength within which folds and bifurcations are located.
    newton
        Of the corrector. Few iterations: a shorter step is better than a long search.
    """

    step: float = 0.05
    smallest_step: float = 1e-5
    largest_step: float = 0.2
    turn: float = 0.15
    max_points: int = 1000
    location_tolerance: float = 1e-7
    newton: NewtonSettings = field(
        default_factory=lambda: NewtonSettings(
            tolerance=1e-9, max_iterations=8, smallest_fraction=0.125
        )
    )

    def __post_init__(self) -> None:
        check_positive("smallest_step", self.smallest_step)
        check_finite("largest_step", self.largest_step)
        check_within("step", self.step, self.smallest_step, self.largest_step)
        check_within("turn", self.turn, 0.01, 0.5, "rad")
        check_positive("location_tolerance", self.location_tolerance)
        if self.max_points < 1:
            raise ParameterError(f"max_points must be 1 or more, got {self.max_points}.")


_DEFAULTS = ContinuationSettings()


def follow(
    problem: PeriodicProblem,
    start: Array,
    parameter: float,
    *,
    limits: tuple[float, float],
    heading: float | Array = 1.0,
    at: Iterable[float] = (),
    settings: ContinuationSettings = _DEFAULTS,
    progress: Progress | None = None,
) -> Branch:
    """Return the branch of periodic motions through a start, with its folds and bifurcations.

    Parameters
    ----------
    problem
        Equations and scales. The scales decide what counts as a step.
    start : ndarray, shape (m,)
        Unknowns near a motion at `parameter`.
    parameter
        p to start from, within the limits.
    limits
        Least and largest p; the branch ends exactly on them.
    heading
        Above zero to set out towards larger p, below zero towards smaller; or a scaled direction,
        shape (m + 1,), as `switch_branch` hands out.
    at
        Values of p at which the branch shall have rows, `Branch.at` finds them.
    settings
        Step lengths and limits.
    progress
        Called after each step with the number of rows and p. KeyboardInterrupt, raised there or
        anywhere else, ends the branch with what was found.

    Raises
    ------
    ParameterError
        Start of the wrong shape, or parameter outside the limits.
    ConvergenceError
        No motion found near the start. Later failures end the branch with `step limit`.

    Notes
    -----
    [keller_1977]: predictor along the tangent, corrector in the plane normal to it. The step grows
    and shrinks with the corrector's iterations and with the turn of the branch. A turn that does
    not shrink with the step is a corner and is passed, also when sharper than a right angle.
    Motions through a backlash, integrated with fixed steps, give branches with a corner wherever
    a step of the integration meets a corner of the force. Corners cost points: if a branch
    creeps, let the map resolve its corners with more steps.

    Examples
    --------
    The fold of p = z^2 at the origin, entered on the upper side. As a map with multiplier
    exp(-2 z) the upper side is stable:

    >>> def parabola(z, p):
    ...     return p - z * z, np.diag(-2.0 * z), np.ones(1), np.diag(np.exp(-2.0 * z))
    >>> problem = PeriodicProblem(
    ...     residual=parabola, unknown_scale=np.ones(1), parameter_scale=1.0
    ... )
    >>> branch = follow(
    ...     problem, np.ones(1), 1.0, limits=(-1.0, 1.0), heading=-1.0, at=[0.25]
    ... )
    >>> [point.kind for point in branch.special], abs(branch.special[0].parameter) < 1e-8
    (['fold'], True)
    >>> branch.unknowns[branch.at(0.25), 0].round(9).tolist(), branch.ending
    ([0.5, -0.5], 'parameter limit')
    >>> [stable for _, stable in branch.runs()]
    [True, False]
    """
    low, high = (value / problem.parameter_scale for value in _checked_limits(limits))
    check_within("parameter", parameter, *limits)
    values = [check_finite("at", value) / problem.parameter_scale for value in at]
    arc = ArclengthCorrector(problem, settings.newton)
    node = _first(arc, problem.place(start, parameter), heading)
    recorder = _Recorder(arc, node, values, settings.location_tolerance)
    ending: Ending = "point limit"
    try:
        outward = node.tangent[-1]
        if (outward > 0.0 and node.place[-1] >= high) or (outward < 0.0 and node.place[-1] <= low):
            ending = "parameter limit"
        stepper = _BranchStepper(arc, node, settings)
        while ending == "point limit" and recorder.count < settings.max_points:
            before, after = stepper.node, stepper.advance()
            if after is None:
                ending = "step limit"
                break
            bound = min(max(after.place[-1], low), high)
            if bound != after.place[-1]:
                landed = recorder.point_at_parameter(before, after, bound)
                ending = "step limit" if landed is None else "parameter limit"
                after = landed
            elif stepper.steps > 3 and _passes(before, after, node):
                ending, after = "closed", node
            if after is not None:
                recorder.add(before, after)
            if progress is not None:
                progress(recorder.count, recorder.last_parameter)
    except KeyboardInterrupt:
        ending = "interrupted"
    return recorder.branch(ending)


def _checked_limits(limits: tuple[float, float]) -> tuple[float, float]:
    low, high = (check_finite("limits", value) for value in limits)
    if not low < high:
        raise ParameterError(f"limits must rise, got {low:g} to {high:g}. Give (least, largest).")
    return low, high


def _first(arc: ArclengthCorrector, place: Array, heading: float | Array) -> Node:
    direction = np.zeros(place.size)
    if np.ndim(heading) == 0:
        direction[-1] = heading
    elif np.shape(heading) == place.shape:
        direction[:] = heading
    if not direction.any():
        raise ParameterError(
            f"heading must be a number or a direction of shape {place.shape}, and not zero, got "
            f"{heading}."
        )
    # on a new branch the fixed parameter may lead back to the old one: keep to the heading
    normal = direction / float(np.linalg.norm(direction))
    correction = arc.correct(place, normal)
    require(arc.problem, correction)
    node = arc.first(correction.evaluation, direction)
    if node is None:
        raise ParameterError("The start is a branch point. Start beside it.")
    return node


def _passes(a: Node, b: Node, start: Node) -> bool:
    """Whether a step runs through the start again, in the same direction."""
    chord = b.place - a.place
    squared = float(chord @ chord)
    fraction = float(chord @ (start.place - a.place)) / squared
    if not 0.0 < fraction <= 1.0 or float(a.tangent @ start.tangent) < 0.5:
        return False
    apart = start.place - hermite(a, b, fraction)[0]
    return float(apart @ apart) <= 1e-4 * squared


class _BranchStepper:
    """Steps along a branch; the step length adapts to the corrector's convergence."""

    def __init__(self, arc: ArclengthCorrector, node: Node, settings: ContinuationSettings) -> None:
        self.arc, self.node, self.settings = arc, node, settings
        self.length, self.steps = settings.step, 0

    def advance(self) -> Node | None:
        """Return the next point; None if the smallest step fails."""
        refused, unmoved, failed, length = math.inf, 0, 0, self.length
        while self.length >= self.settings.smallest_step:
            here = self.node
            correction = self.arc.correct(here.place + self.length * here.tangent, here.tangent)
            node = None
            if correction.converged:
                node = self.arc.node(correction.evaluation, here.tangent)
            if node is None:
                failed += 1
                node = self._beyond_corner() if failed > _FAILURES else None
                if node is not None:
                    return self._step_to(node)
            else:
                angle = turning_angle(here, node)
                unmoved = unmoved + 1 if angle > 0.8 * refused else 0
                refused = angle
                shortest = self.length < 2.0 * self.settings.smallest_step
                if angle <= 3.0 * self.settings.turn or unmoved >= 2 or shortest:
                    if unmoved >= 2:
                        self.length = length
                    self._adapt(float(np.linalg.norm(node.tangent - here.tangent)), correction)
                    return self._step_to(node)
            self.length *= 0.5
        return None

    def _beyond_corner(self) -> Node | None:
        """Return a point around a corner so sharp that no plane ahead meets the branch.

        Beyond the corner the branch leaves along the null vector of the derivative found there. Of
        its two directions the one that keeps the sign of det [dr/dy; tangent] leads onwards, in
        piecewise smooth equations as in smooth ones ([allgower_georg_1990 ch. 12]).
        """
        here, arc = self.node, self.arc
        ahead = arc.problem.evaluate(here.place + self.length * here.tangent)
        arc.evaluations += 1
        if not np.isfinite(ahead.size):
            return None
        direction = np.linalg.svd(ahead.jacobian)[2][-1]
        if np.linalg.det(np.vstack((ahead.jacobian, direction))) * here.determinant < 0.0:
            direction = -direction
        predicted = here.place + self.length * direction
        correction = arc.correct(predicted, direction)
        moved = float(np.linalg.norm(correction.evaluation.place - predicted))
        if not correction.converged or moved > self.length:
            return None
        chord = correction.evaluation.place - here.place
        if float(chord @ here.tangent) < -_BACK * float(np.linalg.norm(chord)):
            return None
        return arc.node(correction.evaluation, direction)

    def _step_to(self, node: Node) -> Node:
        self.node, self.steps = node, self.steps + 1
        return node

    def _adapt(self, angle: float, correction: Correction) -> None:
        by_effort = {0: 2.0, 1: 2.0, 2: 2.0, 3: 1.5, 4: 1.0}.get(correction.iterations, 0.7)
        by_turn = self.settings.turn / max(angle, 1e-6)
        length = self.length * max(0.5, min(by_effort, by_turn))
        self.length = min(max(length, self.settings.smallest_step), self.settings.largest_step)
