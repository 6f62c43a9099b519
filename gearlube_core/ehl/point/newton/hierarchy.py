"""Nested grids of a point contact and the transfers between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from gearlube_core.ehl.point.level import DISCRETE, PointLevel
from gearlube_core.ehl.point.newton.transfer import Transfer
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.sides import AMBIENT, Sides

_DIRECT_NODES = 1300  # of the grid that is solved directly
_DIRECT_CLOSED = 500  # likewise with closed sides, where a cycle is built for every linearisation
_SHORTEST = 12  # nodes of a side that is not halved any more


@dataclass(slots=True)
class Hierarchy:
    """Grids from the coarsest to the finest and the transfers between neighbours."""

    levels: Sequence[PointLevel]
    transfers: Sequence[Transfer]  # between level k + 1 and k

    def below(self, count: int) -> Hierarchy:
        """Return the first `count` grids."""
        return Hierarchy(self.levels[:count], self.transfers[: count - 1])


def grid_shapes(
    nodes: tuple[int, int], steps: tuple[float, float], sides: Sides = AMBIENT
) -> list[tuple[int, int]]:
    """Return shapes from coarse to fine; the side of the smaller spacing is halved first.

    Parameters
    ----------
    nodes
        (ny, nx) of the finest grid.
    steps
        Its spacings (dy, dx).
    sides
        Of the rows.
    """
    shapes = [nodes]
    counts, spacing = list(nodes), list(steps)
    most = _DIRECT_CLOSED if sides.closed else _DIRECT_NODES
    while counts[0] * counts[1] > most:
        ratio = spacing[0] / spacing[1]
        halve = [ratio < 1.5 and counts[0] > _SHORTEST, ratio > 1.0 / 1.5 and counts[1] > _SHORTEST]
        if not any(halve):
            halve = [count > _SHORTEST for count in counts]
        for axis in range(2):
            if halve[axis]:
                ends = sides if axis == 0 else AMBIENT
                coarse = ends.halved(counts[axis])
                spacing[axis] *= ends.intervals(counts[axis]) / ends.intervals(coarse)
                counts[axis] = coarse
        shapes.insert(0, (counts[0], counts[1]))
    return shapes


def build_hierarchy(
    problem: PointContactProblem,
    scales: PointScales,
    wedge: str,
    discretisation: str = "differences",
    cavitation: str = "reynolds",
) -> Hierarchy:
    """Return the grids of a problem."""
    (nx, ny), (dx, dy), sides = problem.nodes, problem.spacing, Sides(problem.sides)
    nodes, steps = ((nx, ny), (dx, dy)) if scales.swap else ((ny, nx), (dy, dx))
    shapes = grid_shapes(nodes, steps, sides)
    levels = [
        PointLevel(
            problem, scales, shape, wedge, scheme=DISCRETE[discretisation], cavitation=cavitation
        )
        for shape in shapes
    ]
    transfers = [Transfer(fine, coarse, sides) for coarse, fine in pairwise(shapes)]
    return Hierarchy(levels, transfers)
