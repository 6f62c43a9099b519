"""A housing as reduced by a finite element program: matrices at a few nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from gearlube_core.arrays import Array, Offsets
from gearlube_core.checks import check_finite
from gearlube_core.errors import ParameterError
from gearlube_core.number import check_fields

Length = Literal["m", "mm"]
Mass = Literal["kg", "t"]
LENGTHS: dict[Length, float] = {"m": 1.0, "mm": 1e-3}
MASSES: dict[Mass, float] = {"kg": 1.0, "t": 1e3}
DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")
GENERALISED = -1  # owner of a coordinate that belongs to no node
_UNSYMMETRIC = 1e-8  # of the largest entry
_NEGATIVE = -1e-6  # of the largest mass, matrices of seven digits


class InterfaceNode(NamedTuple):
    """A node of the finite element model that is kept, in its unit of length.

    Examples
    --------
    >>> InterfaceNode("left", 0.0, 0.12, 0.05).y
    0.12
    """

    name: str  # empty: no element acts on it
    x: float
    y: float
    z: float


@dataclass(frozen=True, kw_only=True, eq=False)
class ReducedModel:
    """Stiffness and mass of a housing at its nodes, and perhaps of generalised coordinates.

    Reduction by Guyan or Craig and Bampton gives such matrices. Stiffness is force over
    displacement with the force that moves one `mass_unit` by one `length_unit` per s2: N/m and
    N.m/rad with m and kg, N/mm and N.mm/rad with mm and t.

    Parameters
    ----------
    stiffness, mass : ndarray of shape (n, n)
        Symmetric matrices in the model's units.
    damping : ndarray of shape (n, n), optional
    nodes : sequence of InterfaceNode
    owner : ndarray of shape (n,)
        Node of each row, counted from 0; -1 for a generalised coordinate.
    direction : ndarray of shape (n,)
        0 to 5 of each row: along x, y, z, about x, y, z. Any number where there is no node.
    length_unit : {"m", "mm"}
    mass_unit : {"kg", "t"}

    Raises
    ------
    ParameterError
        Matrices are of unlike size, not finite, not symmetric, or masses are negative; rows name
        one coordinate twice or no node; a node with a name has no row.

    Examples
    --------
    >>> bar = ReducedModel(
    ...     stiffness=1e8 * np.array([[1.0, -1.0], [-1.0, 1.0]]),
    ...     mass=np.eye(2),
    ...     nodes=[InterfaceNode("left", 0.0, 0.0, 0.0), InterfaceNode("right", 1.0, 0.0, 0.0)],
    ...     owner=np.array([0, 1]),
    ...     direction=np.array([0, 0]),
    ... )
    >>> bar.coordinate(1)
    'x of right'
    """

    stiffness: Array
    mass: Array
    damping: Array | None = None
    nodes: tuple[InterfaceNode, ...]
    owner: Offsets
    direction: Offsets
    length_unit: Length = "m"
    mass_unit: Mass = "kg"

    def __post_init__(self) -> None:
        check_fields(self)
        names = [one.name for one in self.nodes if one.name]
        for name in names:
            if "." in name or names.count(name) > 1:
                raise ParameterError(
                    f"nodes must have names of their own without a point, got {name!r}."
                )
        for one in self.nodes:
            for axis, value in zip("xyz", one[1:], strict=True):
                check_finite(f"{axis} of {one.name or 'a node'}", value, self.length_unit)
        n = len(self.owner)
        if n == 0 or len(self.direction) != n:
            raise ParameterError(
                f"owner and direction must have a number for each row, got {n} and "
                f"{len(self.direction)}."
            )
        for what in ("stiffness", "mass", "damping"):
            matrix = getattr(self, what)
            if matrix is not None:
                object.__setattr__(self, what, self._checked(what, np.asarray(matrix, float)))
        rows = list(zip(self.owner.tolist(), self.direction.tolist(), strict=True))
        for row, (owner, direction) in enumerate(rows):
            if not (owner == GENERALISED or (0 <= owner < len(self.nodes) and 0 <= direction < 6)):
                raise ParameterError(
                    f"row {row + 1} must belong to a node, 0 to {len(self.nodes) - 1}, and a "
                    f"direction, 0 to 5, or to no node, -1; got {owner} and {direction}."
                )
            if owner != GENERALISED and rows.index((owner, direction)) != row:
                raise ParameterError(
                    f"{self.coordinate(row)} must have one row, got a second one, {row + 1}."
                )
        bare = [one.name for i, one in enumerate(self.nodes) if one.name and i not in self.owner]
        if bare:
            raise ParameterError(
                f"node {bare[0]} has a name but no row in the matrices. Keep its coordinates when "
                "the model is reduced, or check its number."
            )

    def coordinate(self, row: int) -> str:
        """Return the words for a row of the matrices."""
        node = int(self.owner[row])
        if node == GENERALISED:
            return f"generalised coordinate in row {row + 1}"
        name = self.nodes[node].name or f"node {node + 1}"
        return f"{DIRECTIONS[int(self.direction[row])]} of {name}"

    def _checked(self, what: str, matrix: Array) -> Array:
        n = len(self.owner)
        if matrix.shape != (n, n) or not np.isfinite(matrix).all():
            raise ParameterError(
                f"{what} must be {n} x {n} finite numbers, got the shape {matrix.shape}."
            )
        apart = abs(matrix - matrix.T)
        largest = float(abs(matrix).max())
        if apart.max() > _UNSYMMETRIC * largest:
            at, column = divmod(int(apart.argmax()), n)
            raise ParameterError(
                f"{what} must be symmetric to {_UNSYMMETRIC:g} of its largest entry, got "
                f"{apart.max() / largest:.3g} in row {at + 1}, column {column + 1}. A file of "
                "one triangle must be read as a symmetric one."
            )
        matrix = 0.5 * (matrix + matrix.T)
        if what != "stiffness":
            scale = np.sqrt(np.maximum(np.diag(matrix), 0.0))
            scale[scale == 0.0] = np.sqrt(largest or 1.0)
            values, ways = np.linalg.eigh(matrix / np.outer(scale, scale))
            if values[0] < _NEGATIVE * max(values[-1], 0.0) or values[-1] < 0.0:
                row = int(abs(ways[:, 0]).argmax())
                raise ParameterError(
                    f"{what} must not be negative in any motion, got {values[0]:.3g} of its scale "
                    f"in one of mainly {self.coordinate(row)}."
                )
        return matrix

    def si(self) -> ReducedModel:
        """Return the model in m and kg; a rotation is 1 rad in all units."""
        length, mass = LENGTHS[self.length_unit], MASSES[self.mass_unit]
        turning = (self.owner == GENERALISED) | (self.direction >= 3)
        moving = np.where(turning, length, 1.0)
        factor = mass * np.outer(moving, moving)
        return ReducedModel(
            stiffness=self.stiffness * factor,
            mass=self.mass * factor,
            damping=None if self.damping is None else self.damping * factor,
            nodes=tuple(
                InterfaceNode(name, x * length, y * length, z * length)
                for name, x, y, z in self.nodes
            ),
            owner=self.owner,
            direction=self.direction,
        )

    def rigid_motions(self) -> Array:
        """Return the six rigid motions about the mean of the nodes, shape (n, 6).

        Generalised coordinates take the values that cost least; those of Craig and Bampton are 0.
        """
        at_nodes = self.owner != GENERALISED
        places = np.array([[one.x, one.y, one.z] for one in self.nodes])
        arms = (places - places.mean(axis=0))[self.owner]
        moved = np.zeros((self.owner.size, 6))
        for row in np.flatnonzero(at_nodes):
            way = int(self.direction[row])
            moved[row, way] = 1.0
            if way < 3:  # rotation x arm
                a, b = (way + 1) % 3, (way + 2) % 3
                moved[row, 3 + a], moved[row, 3 + b] = arms[row, b], -arms[row, a]
        inside = ~at_nodes
        if inside.any():
            pulled = self.stiffness[np.ix_(inside, at_nodes)] @ moved[at_nodes]
            inner = self.stiffness[np.ix_(inside, inside)]
            moved[inside] = -np.linalg.pinv(inner, hermitian=True) @ pulled
        return moved
