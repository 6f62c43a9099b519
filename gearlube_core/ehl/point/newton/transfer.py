"""Transfer of nodal fields between two grids over one rectangle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.sparse import csr_matrix, kron

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.level import DISCRETE, PointLevel
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import AMBIENT, Sides

_SPARSE = 5000  # entries, from which on a matrix with two or three a row is kept sparse
_DIRECT_NODES = 1300  # of the grid that is solved directly
_DIRECT_CLOSED = 500  # likewise with closed sides, where a cycle is built for every linearisation
_SHORTEST = 12  # nodes of a side that is not halved any more


def linear_interpolation(coarse: int, fine: int) -> Array:
    """Return the matrix, shape (fine, coarse), of linear interpolation along one side."""
    position = np.linspace(0.0, coarse - 1.0, fine)
    left = np.minimum(position.astype(int), coarse - 2)
    weight = position - left
    matrix = np.zeros((fine, coarse))
    rows = np.arange(fine)
    matrix[rows, left] = 1.0 - weight
    matrix[rows, left + 1] += weight
    return matrix


def cubic_interpolation(coarse: int, fine: int) -> Array:
    """Return the matrix, shape (fine, coarse), of cubic interpolation along one side."""
    position = np.linspace(0.0, coarse - 1.0, fine)
    first = np.clip(position.astype(int) - 1, 0, coarse - 4)
    t = position - first
    matrix = np.zeros((fine, coarse))
    rows = np.arange(fine)
    for k in range(4):
        others = [m for m in range(4) if m != k]
        product = np.ones(fine)
        for m in others:
            product *= (t - m) / (k - m)
        matrix[rows, first + k] += product
    return matrix


def closed_interpolation(coarse: int, fine: int, sides: Sides, points: int) -> Array:
    """Return the matrix, shape (fine + 2, coarse + 2), between rows with closed sides.

    Through 2 or 4 `points`; copied rows give and get nothing.
    """
    position = (np.arange(fine) + 0.5) * (coarse / fine) - 0.5
    first = np.floor(position).astype(int) - (points // 2 - 1)
    t = position - first
    matrix = np.zeros((fine + 2, coarse + 2))
    for k in range(points):
        weight = np.ones(fine)
        for m in range(points):
            if m != k:
                weight *= (t - m) / (k - m)
        row = first + k
        if sides.name == "cyclic":
            row = row % coarse
        else:  # mirrored
            row = np.where(row < 0, -1 - row, np.where(row >= coarse, 2 * coarse - 1 - row, row))
        np.add.at(matrix, (np.arange(fine) + 1, row + 1), weight)
    return matrix


class Transfer:
    """Between a fine and a coarse grid of so many rows and columns.

    Parameters
    ----------
    fine, coarse
        Rows and columns of the grids, without copied rows.
    sides
        Of the rows. Fields have copied rows where they are closed; results have zeros there.
    """

    def __init__(
        self, fine: tuple[int, int], coarse: tuple[int, int], sides: Sides = AMBIENT
    ) -> None:
        self._linear = [linear_interpolation(c, f) for c, f in zip(coarse, fine, strict=True)]
        self._cubic = [cubic_interpolation(c, f) for c, f in zip(coarse, fine, strict=True)]
        if sides.closed:
            self._linear[0] = closed_interpolation(coarse[0], fine[0], sides, 2)
            self._cubic[0] = closed_interpolation(coarse[0], fine[0], sides, 4)
        self.means = []
        for matrix in self._linear:
            weights = matrix.T
            shares = weights.sum(axis=1, keepdims=True)
            self.means.append(weights / np.where(shares > 0.0, shares, 1.0))
        self.interpolation: csr_matrix = kron(*self._linear, format="csr")
        self.restriction: csr_matrix = kron(*self.means, format="csr")
        kinds = (np.dtype(np.float32), np.dtype(np.float64))
        self._short_up = {kind: [_short(m, kind) for m in self._linear] for kind in kinds}
        self._short_down = {kind: [_short(m, kind) for m in self.means] for kind in kinds}

    def down(self, values: Array) -> Array:
        """Return weighted means of nodal values around each coarse node, in their precision."""
        return _both(self._short_down[values.dtype], values)

    def up(self, values: Array) -> Array:
        """Return coarse values on the fine grid, linear between nodes, in their precision."""
        return _both(self._short_up[values.dtype], values)

    def up_smoothly(self, values: Array) -> Array:
        """Return coarse values on the fine grid, cubic between nodes."""
        return np.asarray(self._cubic[0] @ values @ self._cubic[1].T)


def _short(matrix: Array, kind: Any) -> csr_matrix | Array | None:
    """Return a matrix as it multiplies fastest in a precision, None for the identity."""
    if matrix.shape[0] == matrix.shape[1]:
        return None
    matrix = matrix.astype(kind)
    return csr_matrix(matrix) if matrix.size > _SPARSE else matrix


def _both(matrices: list[csr_matrix | Array | None], values: Array) -> Array:
    first, second = matrices
    if first is not None:
        values = first @ values
    if second is not None:
        values = (second @ values.T).T
    return np.ascontiguousarray(values)


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
        Boundary conditions along y.
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
