"""Damped Newton's method in a plane through a point, and pseudo-arclength steps."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from scipy.optimize import brentq

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.periodic.floquet import Multipliers, floquet_multipliers
from gearlube_core.periodic.problem import Evaluation, PeriodicProblem

Status = Literal[
    "converged", "iteration limit", "no descent", "singular Jacobian", "map not finite at the start"
]


@dataclass(frozen=True, slots=True, kw_only=True)
class NewtonSettings:
    """Tolerance and limits of Newton's method.

    Parameters
    ----------
    tolerance
        Largest entry of the next step [unknown scales] at which the unknowns are accepted as they
        are: about their error. 1e-14 to 1e-2.
    max_iterations
        Steps taken before giving up, 1 or more.
    smallest_fraction
        Smallest fraction of a step tried for a smaller residual [-], 1e-6 to 1.
    """

    tolerance: float = 1e-9
    max_iterations: int = 20
    smallest_fraction: float = 1.0 / 256.0

    def __post_init__(self) -> None:
        check_within("tolerance", self.tolerance, 1e-14, 1e-2)
        check_within("smallest_fraction", self.smallest_fraction, 1e-6, 1.0)
        if self.max_iterations < 1:
            raise ParameterError(f"max_iterations must be 1 or more, got {self.max_iterations}.")


class Correction(NamedTuple):
    """End of an iteration: the last evaluation, the history of residual norms, and the status."""

    evaluation: Evaluation
    history: tuple[float, ...]
    evaluations: int
    status: Status

    @property
    def converged(self) -> bool:
        """Whether the equations hold."""
        return self.status == "converged"

    @property
    def iterations(self) -> int:
        """Newton steps taken."""
        return len(self.history) - 1


def correct(
    problem: PeriodicProblem, start: Array, normal: Array, settings: NewtonSettings
) -> Correction:
    """Solve r = 0 in the plane through `start` with the given normal.

    The plane of a fixed parameter has the normal (0, ..., 0, 1); pseudo-arclength continuation
    takes the tangent of the branch.

    Parameters
    ----------
    problem
        Equations and scales of the unknowns.
    start, normal : ndarray, shape (m + 1,)
        Scaled place to start from and direction [-] without change.
    settings
        Tolerance and limits of Newton's method.

    Notes
    -----
    Each step solves [dr/dy; normal] step = [-r; 0], so that iterates stay in the plane, and is
    halved until the residual norm falls by a small part of what the step promises (Armijo). The
    last step, found to be below the tolerance, is not taken: everything handed back belongs to
    the place handed back. Motions through a backlash make the map piecewise smooth: its
    derivative is exact off grazing and changes like the root of the penetration at grazing, where
    convergence falls from order 2 to 1.5; in the discretised map these are small kinks. Halving
    keeps the iteration from cycling across them. Where halving finds no descent the answer is
    `no descent`, and a continuation takes a shorter step.
    """
    here = problem.evaluate(start)
    history, evaluations = [here.size], 1
    if not np.isfinite(here.size):
        return Correction(here, tuple(history), 1, "map not finite at the start")
    system, right_hand = np.empty((start.size, start.size)), np.zeros(start.size)
    system[-1] = normal
    while True:
        system[:-1], right_hand[:-1] = here.jacobian, -here.equations
        try:
            step = np.linalg.solve(system, right_hand)
        except np.linalg.LinAlgError:
            return Correction(here, tuple(history), evaluations, "singular Jacobian")
        if not np.isfinite(step).all():
            return Correction(here, tuple(history), evaluations, "singular Jacobian")
        if np.abs(step).max() <= settings.tolerance:
            return Correction(here, tuple(history), evaluations, "converged")
        if len(history) > settings.max_iterations:
            return Correction(here, tuple(history), evaluations, "iteration limit")
        fraction = 1.0
        while True:
            trial = problem.evaluate(here.place + fraction * step)
            evaluations += 1
            if trial.size <= (1.0 - 1e-4 * fraction) * here.size:
                break
            fraction *= 0.5
            if fraction < settings.smallest_fraction:
                # rounding: the residual is as small as it gets, and the step ill determined
                settled = here.size <= settings.tolerance
                status: Status = "converged" if settled else "no descent"
                return Correction(here, tuple(history), evaluations, status)
        here = trial
        history.append(here.size)


class Node(NamedTuple):
    """A converged point: scaled place, unit tangent, multipliers, and det [dr/dy; tangent]."""

    place: Array
    tangent: Array
    multipliers: Multipliers
    determinant: float


class ArclengthCorrector:
    """Finds points of one branch and counts the evaluations.

    Parameters
    ----------
    problem
        Equations and scales of the unknowns.
    settings
        Tolerance and limits of Newton's method.
    """

    def __init__(self, problem: PeriodicProblem, settings: NewtonSettings) -> None:
        self.problem = problem
        self.settings = settings
        self.evaluations = 0

    def correct(self, place: Array, normal: Array) -> Correction:
        """Solve the equations in the plane through a place, both of shape (m + 1,)."""
        correction = correct(self.problem, place, normal, self.settings)
        self.evaluations += correction.evaluations
        return correction

    def node(self, evaluation: Evaluation, reference: Array) -> Node | None:
        """Return the branch's point, its tangent on the side of `reference`; None if singular.

        With A = [dr/dy; reference], A t = (0, ..., 0, 1) gives the tangent t up to its length, and
        det [dr/dy; t/abs(t)] = det(A) abs(t). That determinant changes sign at branch points but
        not at folds ([keller_1977]).
        """
        system = np.vstack((evaluation.jacobian, reference))
        right_hand = np.zeros(reference.size)
        right_hand[-1] = 1.0
        try:
            direction = np.linalg.solve(system, right_hand)
        except np.linalg.LinAlgError:
            return None
        length = float(np.linalg.norm(direction))
        if not math.isfinite(length):
            return None
        return Node(
            evaluation.place,
            np.asarray(direction / length),
            floquet_multipliers(evaluation.monodromy, trivial=self.problem.trivial_multipliers),
            float(np.linalg.det(system)) * length,
        )

    def first(self, evaluation: Evaluation, heading: Array) -> Node | None:
        """Return a point whose tangent, the null vector of dr/dy, is on the side of `heading`."""
        tangent = np.linalg.svd(evaluation.jacobian)[2][-1]
        return self.node(evaluation, tangent if tangent @ heading >= 0.0 else -tangent)

    def between(self, a: Node, b: Node, fraction: float) -> Node | None:
        """Return the point at a fraction [0, 1] of the way from one point to the next."""
        place, direction = hermite(a, b, fraction)
        correction = self.correct(place, direction)
        return self.node(correction.evaluation, direction) if correction.converged else None

    def at_parameter(self, a: Node, b: Node, value: float) -> Node | None:
        """Return the point between two others at a scaled parameter between theirs.

        None if Newton's method fails or ends further away than the two are from one another.
        """
        fraction = brentq(lambda x: hermite(a, b, x)[0][-1] - value, 0.0, 1.0, xtol=1e-6)
        place, direction = hermite(a, b, fraction)
        place[-1] = value
        correction = self.correct(place, np.eye(place.size)[-1])
        moved = float(np.linalg.norm(correction.evaluation.place - place))
        if not correction.converged or moved > float(np.linalg.norm(b.place - a.place)):
            return None
        return self.node(correction.evaluation, direction)


def hermite(a: Node, b: Node, fraction: float) -> tuple[Array, Array]:
    """Return place and unit direction on the cubic through two points along their tangents."""
    chord = b.place - a.place
    length, x = float(np.linalg.norm(chord)), fraction
    start, end = length * a.tangent, length * b.tangent
    place = (
        a.place
        + x * x * (3.0 - 2.0 * x) * chord
        + x * (1.0 - x) ** 2 * start
        - x * x * (1.0 - x) * end
    )
    direction = (
        6.0 * x * (1.0 - x) * chord
        + (1.0 - x) * (1.0 - 3.0 * x) * start
        + x * (3.0 * x - 2.0) * end
    )
    size = float(np.linalg.norm(direction))
    return place, direction / size if size > 0.0 else a.tangent


def turning_angle(a: Node, b: Node) -> float:
    """Return the angle by which the branch turns from one point to the next [rad].

    The larger of the angle between the tangents and twice the angle between tangent and chord,
    equal on an arc of a circle.
    """
    chord = b.place - a.place
    along = float(a.tangent @ chord) / float(np.linalg.norm(chord))
    tangents = math.acos(min(1.0, max(-1.0, float(a.tangent @ b.tangent))))
    return max(tangents, 2.0 * math.acos(min(1.0, max(-1.0, along))))
