"""A branch of periodic motions: the result of a continuation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.periodic.floquet import Multipliers

Kind = Literal["fold", "branch point", "exchange", "period doubling", "Neimark-Sacker"]
Ending = Literal["parameter limit", "closed", "point limit", "step limit", "interrupted"]


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
        may at grazing: a non-smooth bifurcation of which the kind tells only the outcome.
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
        p.
    unknowns : ndarray, shape (n, m)
        z.
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
