"""A housing of beams in space, whole and reduced, for tests of reduced models."""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np
import scipy.linalg

from gearlube_core.housings.reduced_model import GENERALISED, InterfaceNode, ReducedModel
from gearlube_core.shafts.beam import bending_element
from gearlube_core.shafts.section import ShaftMaterial, ShaftSection

ALUMINIUM = ShaftMaterial(E=70e9, G=26.5e9, density=2700.0)
RIB = ShaftSection(start=0.0, end=1.0, outer_diameter=0.05, inner_diameter=0.03)
SIZE = np.array([0.4, 0.3, 0.25])  # m
PIECES = 3  # elements along each edge
# places of the nodes that are kept, as shares of the size
SEATS = {
    "a_low": (1 / 3, 0.0, 0.0),
    "a_high": (1 / 3, 0.0, 1.0),
    "b_low": (2 / 3, 1.0, 0.0),
    "b_high": (2 / 3, 1.0, 1.0),
}
MOUNTS = {
    "mount_1": (0.0, 0.0, 0.0),
    "mount_2": (1.0, 0.0, 0.0),
    "mount_3": (0.0, 1.0, 1 / 3),
    "mount_4": (1.0, 1.0, 2 / 3),
}
NODES = {**SEATS, **MOUNTS}


class Frame(NamedTuple):
    """A housing with six coordinates at each place."""

    places: np.ndarray
    stiffness: np.ndarray
    mass: np.ndarray

    def first(self, name: str) -> int:
        """Return the row of the first coordinate of a node that is kept."""
        wanted = SIZE * NODES[name]
        return 6 * int(np.linalg.norm(self.places - wanted, axis=1).argmin())


def _element(length: float) -> tuple[np.ndarray, np.ndarray]:
    """Return stiffness and mass of a beam along z: x y z rx ry rz at both ends."""
    bending = bending_element(RIB, length, ALUMINIUM)
    stiffness, mass = np.zeros((12, 12)), np.zeros((12, 12))
    flip = np.diag([1.0, -1.0, 1.0, -1.0])
    for whole, part in ((stiffness, bending.stiffness), (mass, bending.mass)):
        whole[np.ix_([0, 4, 6, 10], [0, 4, 6, 10])] = part
        whole[np.ix_([1, 3, 7, 9], [1, 3, 7, 9])] = flip @ part @ flip
    pull, share = np.array([[1.0, -1.0], [-1.0, 1.0]]), np.array([[2.0, 1.0], [1.0, 2.0]]) / 6.0
    for at, k, m in (
        ([2, 8], ALUMINIUM.E * RIB.area, ALUMINIUM.density * RIB.area),
        ([5, 11], 2.0 * ALUMINIUM.G * RIB.second_moment,
         2.0 * ALUMINIUM.density * RIB.second_moment),
    ):  # fmt: skip
        stiffness[np.ix_(at, at)] = k / length * pull
        mass[np.ix_(at, at)] = m * length * share
    return stiffness, mass


def box_frame() -> Frame:
    """Return twelve edges of a box and a diagonal brace."""
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
    edges = [(a, b) for a in range(8) for b in range(a) if abs(corners[a] - corners[b]).sum() == 1]
    edges.append((0, 7))
    places, elements = list(corners * SIZE), []
    for a, b in edges:
        chain = [a]
        for i in range(1, PIECES):
            chain.append(len(places))
            places.append((corners[a] + (corners[b] - corners[a]) * i / PIECES) * SIZE)
        chain.append(b)
        elements += itertools.pairwise(chain)
    n = 6 * len(places)
    stiffness, mass = np.zeros((n, n)), np.zeros((n, n))
    for a, b in elements:
        along = places[b] - places[a]
        length = float(np.linalg.norm(along))
        z = along / length
        x = np.cross(z, [0.3, 0.5, 0.8])
        x /= np.linalg.norm(x)
        turned = np.kron(np.eye(4), np.array([x, np.cross(z, x), z]))
        at = np.ix_(*2 * ([*range(6 * a, 6 * a + 6), *range(6 * b, 6 * b + 6)],))
        for whole, part in zip((stiffness, mass), _element(length), strict=True):
            whole[at] += turned.T @ part @ turned
    return Frame(np.array(places), stiffness, mass)


def reduced(frame: Frame, modes: int, fixed: bool = False, **more) -> ReducedModel:
    """Return the frame by Craig and Bampton with this many modes between its kept nodes.

    `fixed` clamps the place opposite the origin, a corner that is not kept.
    """
    names = [*NODES]
    kept = [frame.first(name) + i for name in names for i in range(6)]
    gone = set(range(6 * 7, 6 * 8)) if fixed else set()
    inner = [i for i in range(len(frame.mass)) if i not in kept and i not in gone]
    k_ii, m_ii = (one[np.ix_(inner, inner)] for one in (frame.stiffness, frame.mass))
    shapes = scipy.linalg.eigh(k_ii, m_ii)[1]
    ways = np.zeros((len(frame.mass), len(kept) + modes))
    ways[kept, range(len(kept))] = 1.0
    ways[inner, : len(kept)] = -np.linalg.solve(k_ii, frame.stiffness[np.ix_(inner, kept)])
    ways[inner, len(kept) :] = shapes[:, :modes]
    return ReducedModel(
        stiffness=ways.T @ frame.stiffness @ ways,
        mass=ways.T @ frame.mass @ ways,
        nodes=tuple(InterfaceNode(name, *(SIZE * NODES[name]).tolist()) for name in names),
        owner=np.array([i // 6 for i in range(len(kept))] + modes * [GENERALISED]),
        direction=np.array([i % 6 for i in range(len(kept))] + modes * [0]),
        **more,
    )
