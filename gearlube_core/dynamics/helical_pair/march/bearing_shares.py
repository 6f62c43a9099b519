"""Shares of each bearing in the support force of a member's displacement and velocity."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.parameters import Body
from gearlube_core.dynamics.helical_pair.supports.support_matrices import (
    bearing_matrix,
    support_damping,
)


def bearing_shares(body: Body, ratio: float) -> Array:
    """Return K_x, K_x_ay, K_y, K_y_ax, K_z, c_x, c_y, c_z of both bearings of a member.

    The member's damping is shared in the ratio of the bearings' stiffness.
    """
    support = body.support
    c = support_damping(support, body.mass, body.inertia, ratio, False)
    matrices = []
    for bearing in (support.first, support.second):
        T = np.eye(6)
        T[0, 4], T[1, 3] = bearing.position, -bearing.position
        matrices.append(bearing_matrix(bearing, support.shaft) @ T)
    total = np.array([sum(K[i, i] for K in matrices) for i in range(3)])
    rows = [
        np.r_[K[0, 0], K[0, 4], K[1, 1], K[1, 3], K[2, 2], c[:3] * np.diag(K)[:3] / total]
        for K in matrices
    ]
    return np.concatenate(rows)
