"""Nodes of a grid along the entrainment: uniform, or dense where the film is thin."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.interpolate import PchipInterpolator

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.ehl.point.equations.stencil import MeshMetric
from gearlube_core.errors import ParameterError

_LARGEST_RATIO = 20.0
_TABLE = 4001  # entries of the position over the index


@dataclass(frozen=True, slots=True)
class Grading:
    """Spacing along x, in proportion, at some places; smooth between and constant beyond them.

    Parameters
    ----------
    at
        Places [m], rising, two or more.
    spacing
        At each of them, in any unit, above zero; the largest is at most 20 of the smallest.

    Raises
    ------
    ParameterError
        Places or spacings are out of range.

    Notes
    -----
    The logarithm of the spacing is a monotone cubic spline of x with a continuous slope, so that
    differences between nodes stay of second order. Spacing should double over some five nodes
    or more.
    """

    at: tuple[float, ...]
    spacing: tuple[float, ...]

    def __post_init__(self) -> None:
        rising = all(a < b for a, b in pairwise(self.at))
        if len(self.at) < 2 or len(self.spacing) != len(self.at) or not rising:
            raise ParameterError(
                "A graded grid needs at least two rising positions, each with a spacing, got "
                f"{self.at} m and {self.spacing}. Sort the positions."
            )
        for spacing in self.spacing:
            check_positive("spacing", spacing, "")
        ratio = max(self.spacing) / min(self.spacing)
        check_within("largest over smallest spacing", ratio, 1.0, _LARGEST_RATIO)

    def nodes(self, limits: tuple[float, float], count: int) -> Array:
        """Return the nodes [m], shape (count,), from limit to limit [m].

        Grids of fewer nodes keep the same proportions: every second node of an odd number is a
        node of half as many.
        """
        x = np.linspace(*limits, _TABLE)
        logarithm = PchipInterpolator(self.at, np.log(self.spacing))
        density = np.exp(-logarithm(np.clip(x, self.at[0], self.at[-1])))
        index = np.append(0.0, np.cumsum(0.5 * (density[1:] + density[:-1])))
        nodes = np.interp(np.linspace(0.0, index[-1], count), index, x)
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
