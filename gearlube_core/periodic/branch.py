"""A branch of periodic motions, its folds and bifurcations, and the switch to another branch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.periodic.floquet import (
    Multipliers,
    doubling_test,
    exchange_test,
    torus_pair,
    torus_test,
)
from gearlube_core.periodic.newton import ArclengthCorrector, NewtonSettings, Node, correct
from gearlube_core.periodic.problem import PeriodicProblem

Kind = Literal["fold", "branch point", "exchange", "period doubling", "Neimark-Sacker"]
Ending = Literal["parameter limit", "closed", "point limit", "step limit", "interrupted"]
_DEFAULTS = NewtonSettings()
_SINGULAR = 1e-3  # second smallest singular value over the largest at a branch point, at most
_HALVINGS = 6
Test = Callable[[Node], float]

_TESTS: dict[Kind, Test] = {
    "branch point": lambda node: node.determinant,
    "fold": lambda node: float(node.tangent[-1]),
    "exchange": lambda node: exchange_test(node.multipliers),
    "period doubling": lambda node: doubling_test(node.multipliers),
    "Neimark-Sacker": lambda node: torus_test(node.multipliers),
}
_MOST_TRIALS = 80  # bisection alone needs half as many from step 1 to rounding
_NOISE = 1e-8  # without damping the pairs' product is one but for the errors of integration
_SAME = 1e-3  # share of a test function's size left where another kind explains its zero
_BESIDE = 1000.0  # location tolerances within which a zero is explained likewise
_JUMP = 0.05  # share of a test function's size that must be gone at a zero


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SpecialPoint:
    """A point on a branch where stability or the number of solutions changes.

    Parameters
    ----------
    kind
        `fold` (the branch turns in the parameter), `branch point` (another branch of the same
        period crosses), `exchange` (a multiplier through +1 with neither: possible where the
        disturbed system holds constants that are unknowns of the problem), `period doubling` (a
        multiplier through -1), `Neimark-Sacker` (a complex pair through the unit circle: a slow
        modulation sets in).
    index
        Row of the branch that holds it.
    parameter, unknowns
        p and z there; z has shape (m,).
    tangent : ndarray, shape (m + 1,)
        Direction of the branch there, scaled [-].
    width
        Arclength [-] within which it lies; above the location tolerance where the search was
        lost.
    smooth
        Whether what defines the kind passes through zero. False where it jumps, as multipliers
        may at grazing: a non-smooth bifurcation of which the kind gives only the outcome.
    """

    kind: Kind
    index: int
    parameter: float
    unknowns: Array
    tangent: Array
    width: float
    smooth: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Branch:
    """Periodic motions in the order in which they lie along a branch.

    Parameters
    ----------
    parameter : ndarray, shape (n,)
        Parameter p of each point.
    unknowns : ndarray, shape (n, m)
        Unknowns z of each point.
    multipliers : ndarray of complex, shape (n, k)
        Floquet multipliers, largest first, without trivial ones.
    stable : ndarray of bool, shape (n,)
        Whether all multipliers lie inside the unit circle. On a special point rounding decides.
    arclength : ndarray, shape (n,)
        Sum of scaled distances between rows [-].
    special
        Folds and bifurcations, each with a row of its own.
    ending
        Why it ends there. `step limit`: Newton's method failed with the smallest step.
    evaluations
        Calls of the problem's residual.
    """

    parameter: Array
    unknowns: Array
    multipliers: Multipliers
    stable: np.ndarray[Any, np.dtype[np.bool_]]
    arclength: Array
    special: tuple[SpecialPoint, ...]
    ending: Ending
    evaluations: int

    def at(self, parameter: float) -> np.ndarray[Any, np.dtype[np.intp]]:
        """Return the rows at a requested parameter value, in the order of the branch."""
        reach = 1e-6 * float(np.ptp(self.parameter))
        return np.flatnonzero(np.abs(self.parameter - parameter) <= reach)

    def of_kind(self, kind: Kind) -> tuple[SpecialPoint, ...]:
        """Return the special points of one kind, in the order of the branch."""
        return tuple(point for point in self.special if point.kind == kind)

    def runs(self) -> list[tuple[slice, bool]]:
        """Return ranges of rows of equal stability, for one line style each.

        Neighbouring stretches share a row, so that the lines join. Special points belong to
        neither side.
        """
        marked = {point.index for point in self.special}
        rows = [row for row in range(self.parameter.size) if row not in marked]
        if not rows:
            return []
        stretches, first, last = [], 0, rows[0]
        for row in rows[1:]:
            if self.stable[row] != self.stable[last]:
                joint = next((r for r in range(last + 1, row) if r in marked), row)
                stretches.append((slice(first, joint + 1), bool(self.stable[last])))
                first = joint
            last = row
        return [*stretches, (slice(first, self.parameter.size), bool(self.stable[last]))]


class BranchStart(NamedTuple):
    """Start of `follow` on a new branch: z, p, and the direction away from the old branch."""

    unknowns: Array
    parameter: float
    heading: Array


def switch_branch(
    problem: PeriodicProblem, point: SpecialPoint, *, step: float = 0.05
) -> BranchStart:
    """Return a motion on the branch that leaves at a special point.

    Parameters
    ----------
    problem
        The same problem at a branch point. At a period doubling, the same unknowns over two
        periods, for instance by `fixed_point_residual(period_map, periods=2)`: there the
        point is a branch point.
    point
        Branch point or period doubling.
    step
        Scaled distance [-] at which to look; halved up to six times. Its sign chooses the side: the
        two sides of a period doubling are the same motion, one period apart.

    Raises
    ------
    ParameterError
        No other branch leaves there.
    ConvergenceError
        None was found.

    Notes
    -----
    At a branch point the derivative [dr/dz, dr/dp] has a null space of dimension two. The search
    goes along the direction in it that is normal to the known branch, and is held at that distance,
    so that it cannot fall back onto the known branch ([keller_1977]).
    """
    check_finite("step", step)
    centre = problem.place(point.unknowns, point.parameter)
    values, directions = np.linalg.svd(problem.evaluate(centre).jacobian)[1:]
    if values[-1] > _SINGULAR * max(values[0], 1.0):
        raise ParameterError(
            f"No branch of this period leaves the {point.kind} at parameter {point.parameter:g}: "
            f"smallest singular value {values[-1]:.2g}, but it must be near 0. At a period "
            "doubling give the problem over two periods."
        )
    plane = directions[-2:]
    across = np.array([plane[1] @ point.tangent, -(plane[0] @ point.tangent)]) @ plane
    across /= float(np.linalg.norm(across))
    across *= 1.0 if across[np.argmax(np.abs(across))] > 0.0 else -1.0
    for halving in range(_HALVINGS + 1):
        place = centre + step * 0.5**halving * across
        correction = correct(problem, place, across, _DEFAULTS)
        if correction.converged:
            found = correction.evaluation.place
            return BranchStart(*problem.unscaled(found), found - centre)
    raise ConvergenceError(
        f"No branch found beside the {point.kind} at parameter {point.parameter:g} within "
        f"{abs(step):g} unknown scales: {correction.status}. Try another step or its other sign."
    )


class Crossing(NamedTuple):
    """Where a test function changes sign: the point, the width of the bracket, zero or jump."""

    kind: Kind
    node: Node
    width: float
    smooth: bool


def crossings(arc: ArclengthCorrector, a: Node, b: Node, tolerance: float) -> list[Crossing]:
    """Return the special points from a (excluded) to b (included), in the order they are met.

    Parameters
    ----------
    arc
        Finds points between a and b.
    a, b
        Successive points of a branch.
    tolerance
        Width of the bracket [-] at which a search ends.

    Notes
    -----
    Seen by the signs of test functions at the two ends, so that two of one kind within a step
    cancel. Where the parameter has an extremum at a branch point (the arms of a pitchfork), the
    branch point alone is listed. Folds and branch points bring a multiplier through +1 with them,
    which is not listed again; an exchange apart from them is looked for only where the problem has
    more unknowns than multipliers.
    """
    found: list[Crossing] = []
    for kind, test in _TESTS.items():
        if kind == "exchange" and a.multipliers.size >= arc.problem.count:
            continue
        at_a, at_b = test(a), test(b)
        size = max(abs(at_a), abs(at_b))
        if not _NOISE < size < np.inf or at_a == 0.0 or at_a * at_b > 0.0:
            continue
        if kind == "exchange" and any(
            abs(test(crossing.node)) <= _SAME * size for crossing in found
        ):
            continue
        node, width, smooth = locate(arc, a, b, test, tolerance)
        if kind == "Neimark-Sacker" and not torus_pair(node.multipliers):
            continue
        if kind in ("fold", "exchange") and any(
            np.linalg.norm(crossing.node.place - node.place) <= _BESIDE * tolerance
            for crossing in found
        ):
            continue
        found.append(Crossing(kind, node, width, smooth))
    chord = b.place - a.place
    return sorted(found, key=lambda crossing: float(chord @ (crossing.node.place - a.place)))


def locate(
    arc: ArclengthCorrector, a: Node, b: Node, test: Test, tolerance: float
) -> tuple[Node, float, bool]:
    """Return where a test function changes sign, the bracket's width, and whether smoothly.

    The Illinois variant of false position on the cubic between the ends of the bracket, each
    trial corrected onto the branch. If that fails, the better end of the bracket reached so far is
    returned with its width.
    """
    at_a, at_b = test(a), test(b)
    size, width = max(abs(at_a), abs(at_b)), float(np.linalg.norm(b.place - a.place))
    true_a, true_b, side, long = at_a, at_b, 0, width > 100.0 * tolerance
    for _ in range(_MOST_TRIALS):
        if width <= tolerance or true_b == 0.0:
            break
        margin = 0.4 * tolerance / width  # else the far end of the bracket would never move
        node = arc.between(a, b, min(max(at_a / (at_a - at_b), margin), 1.0 - margin))
        if node is None:
            break
        value = test(node)
        if value * at_b > 0.0:
            b, at_b, true_b = node, value, value
            at_a *= 0.5 if side < 0 else 1.0
            side = -1
        elif value * at_a > 0.0:
            a, at_a, true_a = node, value, value
            at_b *= 0.5 if side > 0 else 1.0
            side = 1
        else:
            return node, 0.0, True
        width = float(np.linalg.norm(b.place - a.place))
    node, value = (a, true_a) if abs(true_a) < abs(true_b) else (b, true_b)
    return node, width, not long or abs(value) <= _JUMP * size
