"""Linear elasticity on the tooth's mesh: stiffness, hat loads and their compliance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cholesky, solve_triangular
from scipy.sparse import coo_array, csr_array
from skfem import Basis, ElementHexS2, FacetBasis

from gearlube_core.arrays import Array, Indices
from gearlube_core.contact.solid import Solid
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.tooth_compliance.hat_grid import hat_values
from gearlube_core.tooth_compliance.tooth_mesh import ToothMesh

_ELEMENT = ElementHexS2()
_DEGREE = 4  # 27 points in an element, 9 on a facet: exact for quadratics on bricks
_CHUNK = 512  # elements integrated at a time: keeps the products of gradients below 100 MB


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
        F, (n, r).
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
