"""Structured hexahedral mesh of one tooth with its fillets on a block of the rim.

The section is one block: grid lines run from the left outline to the right one. Between the
flanks they are arcs about the axis; below the root they sag more and more until the last one is
the cut through the rim, which is held. A lengthwise station is one layer of nodes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cholesky, solve_triangular
from scipy.sparse import coo_array, csr_array
from skfem import Basis, ElementHexS2, FacetBasis, MeshHex

from gearlube_core.arrays import Array, Indices
from gearlube_core.checks import check_within
from gearlube_core.contact.solid import Solid
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.tooth_compliance.hat_grid import hat_values, lengthwise_nodes, profile_nodes
from gearlube_core.tooth_compliance.tooth_geometry import HalfSection, ToothGeometry, half_section

_ELEMENT = ElementHexS2()
_DEGREE = 4  # 27 points in an element, 9 on a facet: exact for quadratics on bricks
_CHUNK = 512  # elements integrated at a time: keeps the products of gradients below 100 MB


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


def lame_constants(solid: Solid) -> tuple[float, float]:
    """Return lambda = E nu/((1 + nu)(1 - 2 nu)) and mu = E/(2 (1 + nu)) [Pa]."""
    E, nu = solid.youngs_modulus, solid.poisson_ratio
    return E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu))


def stiffness_matrix(basis: Basis, solid: Solid) -> csr_array:
    """Return the stiffness of all unknowns, 3 to a node, sparse (3 nodes, 3 nodes) [N/m].

    k[i a, j b] = integral of lambda N_i,a N_j,b + mu N_i,b N_j,a + mu delta_ab N_i,c N_j,c
    """
    lam, mu = lame_constants(solid)
    gradients = np.stack([field[0].grad for field in basis.basis])  # (nodes, 3, elements, points)
    functions, _, elements, _ = gradients.shape
    size = 3 * functions
    values = np.empty((elements, functions, 3, functions, 3))
    for first in range(0, elements, _CHUNK):
        part = slice(first, min(first + _CHUNK, elements))
        grad = gradients[:, :, part].transpose(2, 0, 1, 3).reshape(-1, size, basis.dx.shape[1])
        products = (grad * basis.dx[part, None, :]) @ grad.transpose(0, 2, 1)
        products = products.reshape(-1, functions, 3, functions, 3)
        block = values[part]
        block[:] = lam * products + mu * products.transpose(0, 1, 4, 3, 2)
        laplacian = mu * np.einsum("eicjc->eij", products)
        for axis in range(3):
            block[:, :, axis, :, axis] += laplacian
    unknowns = (3 * basis.element_dofs.T[:, :, None] + np.arange(3)).reshape(elements, size)
    rows = np.repeat(unknowns, size, axis=1)
    columns = np.tile(unknowns, (1, size))
    shape = (3 * basis.N, 3 * basis.N)
    return csr_array(coo_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=shape))


def normal_hat_loads(
    mesh: ToothMesh, side: str, s_nodes: Array, t_nodes: Array
) -> tuple[Array, Array]:
    """Return the nodal forces of unit hats along the inward normal.

    f[i a, h] = (1/A_h) integral of N_i n_a hat_h dA,  A_h = integral of hat_h dA

    Returns
    -------
    forces
        (3 nodes, mh nh) [-]: newtons per newton. Their transpose averages the displacement.
    gram
        Integral of hat_h hat_k dA [m2], (mh nh, mh nh); a row adds up to A_h.

    Raises
    ------
    ParameterError
        An element is so distorted that no point on its face can be found.
    """
    try:
        basis = FacetBasis(mesh.solid, _ELEMENT, facets=mesh.flank_facets(side), intorder=_DEGREE)
    except Exception as error:  # the library has no class of its own for it
        raise ParameterError(
            f"The elements on the {side} flank of a tooth must be nearly bricks, got distorted "
            f"ones ({error}). A deeply undercut or nearly pointed pinion has such elements: give "
            "it more addendum, more teeth or another pressure angle."
        ) from error
    s_all, t_all = mesh.flank_parameters()
    # on a flank the mesh's trilinear map carries the parameters too
    corners = FacetBasis(
        mesh.solid, mesh.solid.elem(), facets=basis.find, quadrature=basis.quadrature
    )
    s, t = (np.asarray(corners.interpolate(field)) for field in (s_all, t_all))
    hats = hat_values(s, t, s_nodes, t_nodes)
    gram = (hats.T @ hats.multiply(basis.dx.reshape(-1, 1))).toarray()
    forces = np.zeros((3 * basis.N, hats.shape[1]))
    for function in range(basis.Nbfun):
        shape = np.asarray(basis.basis[function][0]) * basis.dx
        nodes = np.repeat(basis.element_dofs[function], shape.shape[1])
        for axis in range(3):
            amount = (-basis.normals[axis] * shape).ravel()
            gather = csr_array(
                coo_array((amount, (nodes, np.arange(amount.size))), shape=(basis.N, amount.size))
            )
            forces[axis::3] += (gather @ hats).toarray()
    return forces / gram.sum(axis=1), gram


@dataclass(frozen=True, slots=True)
class ToothModel:
    """Assembled stiffness of a tooth whose base is held.

    Parameters
    ----------
    stiffness
        Of the free unknowns, sparse [N/m].
    free
        Indices of the free unknowns among all, which are 3 to a node.
    layer
        Lengthwise layer of each free unknown; unknowns couple to their own and the next layers.
    """

    mesh: ToothMesh
    stiffness: csr_array
    free: Indices
    layer: Indices

    def compliance(self, loads: Array) -> Array:
        """Return loads^T K^-1 loads [m/N] for nodal loads of all unknowns, (3 nodes, n)."""
        return energy_products(self.stiffness, loads[self.free], self.layer)


def tooth_model(mesh: ToothMesh, solid: Solid) -> ToothModel:
    """Return the model of the tooth held at the base block's bottom and its two cut sides."""
    basis = Basis(mesh.solid, _ELEMENT, intorder=_DEGREE)
    stiffness = stiffness_matrix(basis, solid)
    _, down, station = Basis(mesh.logical, _ELEMENT, intorder=1).doflocs
    held = down > mesh.down - 0.25
    free = np.flatnonzero(np.repeat(~held, 3))
    layer = np.repeat(np.floor(station + 0.25).astype(int), 3)[free]
    return ToothModel(mesh, stiffness[free][:, free], free, layer)


def energy_products(matrix: csr_array, loads: Array, layer: Indices) -> Array:
    """Return F^T K^-1 F of a symmetric positive definite K.

    Parameters
    ----------
    matrix
        K, sparse (n, n); entries between layers more than one apart must be zero.
    loads
        Loads F, shape (n, r).
    layer
        Layer of each unknown, from 0 upwards, (n,).

    Returns
    -------
    ndarray
        (r, r), symmetric; in the units of F^2/K.

    Raises
    ------
    ConvergenceError
        When K is not positive definite: a body that is not held, or a mesh turned inside out.
    """
    count = loads.shape[1]
    products = np.zeros((count, count))
    members = [np.flatnonzero(layer == k) for k in range(int(layer.max()) + 1)]
    here = members[0]
    schur = matrix[here][:, here].toarray()
    right = loads[here]
    for k, here in enumerate(members):
        try:
            lower = cholesky(schur, lower=True, overwrite_a=True, check_finite=False)
        except LinAlgError:
            raise ConvergenceError(
                f"the stiffness is not positive definite in layer {k}. "
                "The base must be held and every element's Jacobian must be positive."
            ) from None
        reduced = solve_triangular(lower, right, lower=True, check_finite=False)
        products += reduced.T @ reduced
        if k + 1 == len(members):
            break
        after = members[k + 1]
        coupling = matrix[here][:, after]
        touched = np.unique(coupling.indices)
        panel = solve_triangular(
            lower, coupling[:, touched].toarray(), lower=True, check_finite=False
        )
        schur = matrix[after][:, after].toarray()
        schur[np.ix_(touched, touched)] -= panel.T @ panel
        right = loads[after]
        right[touched] -= panel.T @ reduced
    return 0.5 * (products + products.T)
