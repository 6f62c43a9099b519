"""Rows and special points of a branch while it is being followed."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from gearlube_core.periodic.arclength import ArclengthCorrector, Node
from gearlube_core.periodic.branch import Branch, Ending, SpecialPoint
from gearlube_core.periodic.floquet import stable
from gearlube_core.periodic.special_points import Crossing, crossings, locate


class Recorder:
    """Collects the points of a branch, with requested values and special points between them.

    Parameters
    ----------
    arc
        Finds points between two others.
    start
        First point.
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
