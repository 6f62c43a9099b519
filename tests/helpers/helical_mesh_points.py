"""Loads, sums and stiffness of a helical mesh point by point, against which models are tested."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays, PairConstants
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    DENSITY,
    LENGTH,
    LOAD,
    MU,
    N_COLUMNS,
    OFFSET,
    SLIDING,
    X,
    Z,
    point_capacity,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import (
    N_SUMS,
    phase_moments,
    sign,
    strain_rows,
    wrench_columns,
)
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel


@kernel
def line_loads(y0: float, y1: float, constants: PairConstants, points: Array, n: int) -> float:
    """Fill the points' LOAD w [N/m] and return the stiffness k_m along the line of action [N/m].

    Linear: w = k (delta - e). One-sided: w = k max(0, delta - e) on the drive flank, w =
    -k max(0, -delta - backlash - e) on the back; k_m counts points that touch.

    Notes
    -----
    k_m = cos(b)^2 sum of k dl. The back flanks are taken to touch along the drive flanks' lines,
    which is right in size and direction along the line of action only.
    """
    plane = constants.plane
    stiffness = 0.0
    for i in range(n):
        p = points[i, X] * plane.sin_b + points[i, Z] * plane.cos_b
        delta = constants.mesh_sign * (y0 + p * y1)
        pressed = delta - points[i, OFFSET]
        if constants.one_sided > 0.0 and pressed < 0.0:
            pressed = min(0.0, delta + constants.backlash + points[i, OFFSET])
        points[i, LOAD] = points[i, DENSITY] * pressed
        if constants.one_sided == 0.0 or pressed != 0.0:
            stiffness += points[i, DENSITY] * points[i, LENGTH]
    return stiffness * plane.cos_b * plane.cos_b


@kernel
def load_sums(c: PairConstants, points: Array, n: int, sums: Array) -> None:
    """Integrate LOAD and MU over all lines into `sums`, shape (5,) [N, N.m, N, N.m, N.m].

    One-sided contact has |w| for w in r, so that friction opposes sliding on the back flank too;
    linear contact keeps the paper's w, also where a line pulls.
    """
    plane = c.plane
    sums[:] = 0.0
    for i in range(n):
        x, z = points[i, X], points[i, Z]
        w = points[i, LOAD] * points[i, LENGTH]
        r = -points[i, MU] * (abs(w) if c.one_sided > 0.0 else w) * sign(points[i, SLIDING])
        sums[0] += w
        sums[1] += w * (x * plane.sin_b + z * plane.cos_b)
        sums[2] += r
        sums[3] += r * x
        sums[4] += r * z


@kernel
def friction_power(points: Array, n: int) -> float:
    """Return the power that friction takes from the pair [W]: sum of mu |w| |v_s| dl."""
    power = 0.0
    for i in range(n):
        load = abs(points[i, LOAD]) * points[i, LENGTH]
        power += points[i, MU] * load * abs(points[i, SLIDING])
    return power


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
