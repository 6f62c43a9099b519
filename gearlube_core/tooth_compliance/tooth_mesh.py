"""Structured hexahedral mesh of one tooth with its fillets on a block of the rim.

The section is one block: grid lines run from the left outline to the right one. Between the
flanks they are arcs about the axis; below the root they sag more and more until the last one is
the cut through the rim, which is held. A lengthwise station is one layer of nodes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from skfem import MeshHex

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.tooth_compliance.hat_grid import lengthwise_nodes, profile_nodes
from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry
from gearlube_core.tooth_compliance.tooth_section import HalfSection, half_section


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshDensity:
    """Numbers of elements.

    Parameters
    ----------
    profile, lengthwise
        Along a flank from root to tip and from toe to heel.
    thickness
        Half the number through the tooth; they grow from both flanks to the middle.
    growth
        Ratio of neighbouring elements through the tooth [-].
    fillet, slot, rim
        Along a fillet, the flat of the half slot, and each pitch of plain rim.
    """

    profile: int = 12
    lengthwise: int = 24
    thickness: int = 4
    growth: float = 1.6
    fillet: int = 5
    slot: int = 1
    rim: int = 3

    def __post_init__(self) -> None:
        for name in ("profile", "lengthwise", "fillet", "slot", "rim"):
            check_within(name, getattr(self, name), 1, 500)
        check_within("thickness", self.thickness, 2, 50)
        check_within("growth", self.growth, 1.0, 4.0)


@dataclass(frozen=True, slots=True)
class ToothMesh:
    """Mesh of a tooth and the same mesh in its grid's indices.

    `logical` has the topology of `solid`; its nodes are (across, down, station): across from
    the left to the right outline, down from the tip to the cut through the rim.
    """

    solid: MeshHex
    logical: MeshHex
    across: int
    down: int
    s: Array  # flank parameter of the rows, from 0 at the root line upwards
    t: Array  # of the stations

    def flank_facets(self, side: str) -> Array:
        """Return the facets of the flank `left` or `right`."""
        end = 0.0 if side == "left" else float(self.across)
        return self.logical.facets_satisfying(
            lambda x: (np.abs(x[0] - end) < 0.1) & (x[1] < len(self.s) - 1)
        )

    def flank_parameters(self) -> tuple[Array, Array]:
        """Return s and t at all nodes [-]; s is meant on the flanks only."""
        _, down, station = np.rint(self.logical.p).astype(int)
        return self.s[::-1][np.minimum(down, len(self.s) - 1)], self.t[station]


def graded_thickness(density: MeshDensity) -> Array:
    """Return the fractions of the thickness at the nodes, symmetric about 1/2."""
    sizes = density.growth ** np.arange(density.thickness)
    half = np.concatenate([[0.0], np.cumsum(sizes)]) * (0.5 / sizes.sum())
    return np.concatenate([half, 1.0 - half[-2::-1]])


def _cut(left: HalfSection, right: HalfSection, geometry: ToothGeometry, a: Array) -> Array:
    """Return the last grid line: down, along the bottom and up, (across + 1, stations, 3)."""
    corner = max(1, (len(a) - 1) // 4)
    line = np.empty((len(a), *left.base.shape))
    sides = a[: corner + 1] / a[corner]
    line[: corner + 1] = left.rim[-1] + sides[:, None, None] * (left.base - left.rim[-1])
    line[-corner - 1 :] = (right.rim[-1] + sides[:, None, None] * (right.base - right.rim[-1]))[
        ::-1
    ]
    turn = geometry.angle_between(left.base, right.base)
    inner = a[corner : len(a) - corner]
    for k, x in enumerate((inner - inner[0]) / (inner[-1] - inner[0])):
        line[corner + k] = geometry.rotated_points(left.base, x * turn)
    return line


def _nodes(geometry: ToothGeometry, density: MeshDensity, s: Array, t: Array) -> Array:
    """Return the grid of nodes (across + 1, down + 1, stations, 3) [m]."""
    fillet = np.linspace(0.0, 1.0, density.fillet + 1)[1:]
    slot = np.linspace(0.0, 1.0, density.slot + 1)[1:]
    count = int(np.ceil(density.rim * geometry.neighbour_pitches))
    rim = np.linspace(0.0, 1.0, count + 1)[1:]
    left, right = (
        half_section(geometry, side, s[::-1], t, fillet, slot, rim) for side in ("left", "right")
    )
    a = graded_thickness(density)
    outlines = left.outline, right.outline
    steps = sum(np.linalg.norm(np.diff(x, axis=0), axis=2).mean(axis=1) for x in outlines)
    lengths = steps[len(s) - 1 :]
    # half by length and half by number, so that lines from a short flat do not crowd
    shares = lengths / lengths.sum() + 1.0 / len(lengths)
    below_root = np.concatenate([[0.0], np.cumsum(shares)])
    sag = np.concatenate([np.zeros(len(s) - 1), below_root / below_root[-1]])

    turn = geometry.angle_between(*outlines)
    arcs = np.array(
        [
            (1.0 - x) * geometry.rotated_points(outlines[0], x * turn)
            + x * geometry.rotated_points(outlines[1], (x - 1.0) * turn)
            for x in a
        ]
    )
    cut = _cut(left, right, geometry, a)
    return arcs + sag[None, :, None, None] * (cut - arcs[:, -1])[:, None]


def smallest_scaled_jacobian(mesh: MeshHex) -> float:
    """Return the smallest scaled Jacobian at the elements' corners [-], 1 for bricks.

    Triple product of the unit edges at a corner; a trilinear element is invertible at its
    corners only where it is above zero.
    """
    nodes = mesh.p[:, mesh.t]
    reference = mesh.elem.refdom.p.astype(int)
    smallest = np.inf
    for corner in range(8):
        here = reference[:, corner]
        edges = []
        for axis in range(3):
            other = here.copy()
            other[axis] = 1 - other[axis]
            neighbour = int(np.flatnonzero((other == reference.T).all(axis=1))[0])
            edge = (nodes[:, neighbour] - nodes[:, corner]) * (1 - 2 * here[axis])
            edges.append(edge / np.linalg.norm(edge, axis=0))
        volume = np.einsum("ji,ji->i", np.cross(edges[0], edges[1], axis=0), edges[2])
        smallest = min(smallest, float(volume.min()))
    return smallest


def tooth_mesh(geometry: ToothGeometry, density: MeshDensity) -> ToothMesh:
    """Return the mesh of a tooth.

    Raises
    ------
    ParameterError
        When an element is turned inside out.
    """
    s, t = profile_nodes(density.profile + 1), lengthwise_nodes(density.lengthwise + 1)
    grid = _nodes(geometry, density, s, t)
    across, down, stations = (n - 1 for n in grid.shape[:3])
    tensor = MeshHex.init_tensor(*(np.arange(n + 1.0) for n in (across, down, stations)))
    # the library numbers these elements mirrored (x -> 1 - x); reversed, they are right-handed
    logical = MeshHex(tensor.p, np.ascontiguousarray(tensor.t[::-1]))
    index = np.rint(logical.p).astype(int)
    solid = MeshHex(np.ascontiguousarray(grid[index[0], index[1], index[2]].T), logical.t)
    quality = smallest_scaled_jacobian(solid)
    if not quality > 0.0:
        raise ParameterError(
            f"the mesh's smallest scaled Jacobian must be above 0, got {quality:.3g}. "
            "Seen from the toe with the tip upwards `left` must lie on the left (swap the "
            "flanks if not); else reduce base_depth or slot_depth. A pointed tooth has no such "
            "mesh: give it more topland."
        )
    return ToothMesh(solid, logical, across, down, s, t)
