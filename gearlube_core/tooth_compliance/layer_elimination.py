"""Block Cholesky elimination along the layers of a structured mesh.

A long slender mesh, numbered layer by layer, has a block-tridiagonal stiffness. Dense blocks run
at the speed of BLAS-3, and the products wanted, F^T K^-1 F = (L^-1 F)^T (L^-1 F), need the
forward elimination only, so no factor is stored.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import LinAlgError, cholesky, solve_triangular
from scipy.sparse import csr_array

from gearlube_core.arrays import Array, Indices
from gearlube_core.errors import ConvergenceError


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
