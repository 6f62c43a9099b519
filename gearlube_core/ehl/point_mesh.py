"""Nodes of a grid along the entrainment: uniform, or dense where the film is thin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.checks import check_within
from gearlube_core.ehl.point_stencil import MeshMetric
from gearlube_core.errors import ParameterError

Array = np.ndarray[Any, np.dtype[np.float64]]

_TABLE = 4001  # entries of the position over the index


@dataclass(frozen=True, slots=True)
class Grading:
    """Spacing along x: finest within a zone, growing smoothly with the distance from it.

    Parameters
    ----------
    fine
        Zone of the finest spacing along x [m].
    coarsest
        Largest spacing over the smallest, 1 to 20.
    reach
        Distance from the zone over which the spacing doubles [m].

    Notes
    -----
    dx/d(index) = d (1 + s), s = t^2/(t + 1) up to the coarsest, t the distance over `reach`: the
    slope of the spacing is continuous, so that differences between nodes stay of second order.
    """

    fine: tuple[float, float]
    coarsest: float
    reach: float

    def __post_init__(self) -> None:
        check_within("coarsest", self.coarsest, 1.0, 20.0)
        if not (self.fine[0] < self.fine[1] and self.reach > 0.0):
            raise ParameterError(
                f"the fine zone must rise and reach be above 0 m, got {self.fine} and "
                f"{self.reach} m. Order the limits."
            )

    def nodes(self, limits: tuple[float, float], count: int) -> Array:
        """Return the nodes [m], shape (count,), from limit to limit [m].

        Grids of fewer nodes keep the same ratios: every second node of an odd number is a node
        of half as many.
        """
        if self.coarsest == 1.0:
            return np.linspace(*limits, count)
        x = np.linspace(*limits, _TABLE)
        t = np.maximum(0.0, np.maximum(self.fine[0] - x, x - self.fine[1])) / self.reach
        growth = t * t / (t + 1.0)
        most = self.coarsest - 1.0
        # the smaller of both, rounded off
        spacing = 1.0 + growth * most / (growth**4 + most**4) ** 0.25
        mean = 0.5 * (1.0 / spacing[1:] + 1.0 / spacing[:-1])
        index = np.concatenate(([0.0], np.cumsum(mean)))
        wanted = np.linspace(0.0, index[-1], count)
        nodes = np.interp(wanted, index, x)
        nodes[[0, -1]] = limits
        return np.asarray(nodes)


def cell_faces(nodes: Array) -> Array:
    """Return the faces of the cells around nodes, shape (n + 1,), half an index from them.

    Cubic in the index; the first and the last cell are symmetric about their node.
    """
    middle = 0.5 * (nodes[1:] + nodes[:-1])
    middle[1:-1] += (nodes[1:-2] + nodes[2:-1] - nodes[:-3] - nodes[3:]) / 16.0
    first, last = 2.0 * nodes[0] - middle[0], 2.0 * nodes[-1] - middle[-1]
    return np.concatenate(([first], middle, [last]))


def mesh_metric(nodes: Array, dx: float) -> MeshMetric:
    """Return the metric of nodes against a spacing in the same unit."""
    gaps = np.diff(nodes)
    return MeshMetric(dx / np.append(gaps[0], gaps), dx / np.diff(cell_faces(nodes)))


def central_metric(nodes: Array, dx: float) -> Array:
    """Return dx over half the distance between the neighbours of each node, shape (n,)."""
    ratio = np.ones(nodes.size)
    ratio[1:-1] = 2.0 * dx / (nodes[2:] - nodes[:-2])
    return ratio


def x_nodes(limits: tuple[float, float], count: int, grading: Grading | None) -> Array:
    """Return the nodes along x [m], shape (count,), uniform without a grading."""
    return np.linspace(*limits, count) if grading is None else grading.nodes(limits, count)
