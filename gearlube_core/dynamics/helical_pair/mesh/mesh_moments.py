"""The linear mesh as fourteen numbers of the phase: moments of stiffness along the lines.

For linear contact the sums of `mesh_wrench` are

    sums = G y - g,   y = (y0, y1) of `mesh_strain`

with G of shape (5, 2) and g of shape (5,) moments of k and k e over the lines. K_mesh = -W G E,
W of shape (12, 5) and E of shape (2, 12) constant: rank two without friction, because delta varies
along the lines only.
"""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    DENSITY,
    LENGTH,
    MU,
    N_COLUMNS,
    OFFSET,
    SLIDING,
    X,
    Z,
    constant_friction,
    contact_points,
    point_capacity,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import (
    N_SUMS,
    mesh_strain,
    sign,
    wrench_of_sums,
)
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel


@kernel
def point_moments(plane: ContactPlane, points: Array, n: int, moments: Array) -> None:
    """Fill G and, as third column, g from points whose MU is set; `moments` has shape (5, 3).

    Friction is linear in the load here: lines that pull are taken to slide with negative load.
    """
    moments[:, :] = 0.0
    for i in range(n):
        x, z = points[i, X], points[i, Z]
        k = points[i, DENSITY] * points[i, LENGTH]
        r = -points[i, MU] * k * sign(points[i, SLIDING])
        p = x * plane.sin_b + z * plane.cos_b
        for column in range(3):
            factor = 1.0 if column == 0 else (p if column == 1 else points[i, OFFSET])
            moments[0, column] += k * factor
            moments[1, column] += k * factor * p
            moments[2, column] += r * factor
            moments[3, column] += r * factor * x
            moments[4, column] += r * factor * z


@kernel
def phase_moments(
    phase: float,
    pinion_speed: float,
    mu: float,
    plane: ContactPlane,
    mesh: MeshArrays,
    points: Array,
    moments: Array,
) -> None:
    """Fill the moments at a mesh phase with constant friction."""
    n = contact_points(phase, pinion_speed, plane, mesh, points)
    constant_friction(mu, points, n)
    point_moments(plane, points, n, moments)


def strain_rows(plane: ContactPlane) -> Array:
    """Return E = dy/dq, shape (2, 12)."""
    columns = [mesh_strain(unit, plane) for unit in np.eye(12)]
    return np.ascontiguousarray(np.array(columns).T)


def wrench_columns(plane: ContactPlane) -> Array:
    """Return W = d(wrench)/d(sums), shape (12, 5)."""
    columns = np.empty((N_SUMS, 12))
    for unit, column in zip(np.eye(N_SUMS), columns, strict=True):
        wrench_of_sums(unit, plane, column)
    return np.ascontiguousarray(columns.T)


def mesh_stiffness_matrix(
    phase: float, plane: ContactPlane, mesh: MeshArrays, mu: float = 0.0, pinion_speed: float = 1.0
) -> Array:
    """Return K_mesh at a mesh phase, shape (12, 12): forces on the members are -K_mesh q.

    Parameters
    ----------
    phase
        [mesh periods]
    plane, mesh
        Geometry and contact lines.
    mu
        Constant coefficient of friction [-].
    pinion_speed
        Its sign sets friction's direction [rad/s].

    Returns
    -------
    ndarray
        Symmetric and positive semidefinite, of rank two, without friction.
    """
    points = np.empty((point_capacity(mesh), N_COLUMNS))
    moments = np.empty((N_SUMS, 3))
    phase_moments(phase, pinion_speed, mu, plane, mesh, points, moments)
    return -wrench_columns(plane) @ moments[:, :2] @ strain_rows(plane)
