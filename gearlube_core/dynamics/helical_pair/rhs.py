"""Forces and accelerations of the twelve coordinates: kernels."""

from __future__ import annotations

import math

from gearlube_core.dynamics.helical_pair.kernel_parameters import (
    Array,
    PairConstants,
    SupportArrays,
)
from gearlube_core.dynamics.helical_pair.mesh_wrench import load_sums, wrench_of_sums
from gearlube_core.jit import kernel


@kernel
def mesh_damping(k_m: float, flank_force: float, psi_rate: float, c: PairConstants) -> float:
    """Return the damping force F_d against the relative rotation along the line of action [N].

    F_d = 2 zeta sqrt(m_e k_m) d(psi)/dt,  psi = r_bp th_zp + r_bg th_zg

    Parameters
    ----------
    k_m
        Mesh stiffness along the line of action [N/m].
    flank_force
        Elastic force along it, positive on the drive flank [N]: one-sided flanks do not adhere, so
        that F_d takes at most all of it away.
    psi_rate
        [m/s]

    Notes
    -----
    In place of He et al. 2007 eq. (36), (37), which are not each other's reaction: one damper that
    turns the members against each other with moments r_bp F_d and r_bg F_d.
    """
    force = 2.0 * c.zeta_mesh * math.sqrt(c.m_e * max(0.0, k_m)) * psi_rate
    if c.one_sided > 0.0:
        force = min(force, flank_force) if flank_force >= 0.0 else max(force, flank_force)
    return force


@kernel
def support_force(q: Array, v: Array, supports: SupportArrays, force: Array) -> None:
    """Fill the forces and moments of the bearings on both members, shape (12,) [N, N.m].

    Notes
    -----
    He et al. 2007 eq. (28)-(35); the paper's combined bearing force F_SB is rows 0-2 and 6-8.
    """
    for member in range(2):
        first = 6 * member
        for i in range(6):
            total = supports.damping[member, i] * v[first + i]
            for j in range(6):
                total += supports.stiffness[member, i, j] * q[first + j]
            force[first + i] = -total


@kernel
def pair_accelerations(
    q: Array,
    v: Array,
    k_m: float,
    torque_p: float,
    torque_g: float,
    c: PairConstants,
    supports: SupportArrays,
    points: Array,
    n: int,
    wrench: Array,
    sums: Array,
    acceleration: Array,
) -> None:
    """Fill the accelerations of the twelve coordinates from loaded contact points.

    Parameters
    ----------
    q, v : ndarray of shape (12,)
        Displacements and rates.
    k_m
        From `line_loads`, which has filled LOAD; a friction law has filled MU.
    torque_p, torque_g
        Driving torque along -z of the pinion, load torque along -z of the gear [N.m].
    wrench, sums
        Shapes (12,), (5,): mesh forces, and work space.
    acceleration : ndarray of shape (12,)
        Written; zero where a coordinate is held.

    Notes
    -----
    He et al. 2007 eq. (38)-(41) with -T_p in (39c): the pinion turns about -z. Products of nominal
    rotation and tilting (gyroscopic terms) are left out as in the paper.
    """
    plane = c.plane
    support_force(q, v, supports, acceleration)
    load_sums(c, points, n, sums)
    wrench_of_sums(sums, plane, wrench)
    psi_rate = plane.r_bp * v[5] + plane.r_bg * v[11]
    damping = mesh_damping(k_m, plane.cos_b * sums[0], psi_rate, c)
    wrench[5] -= plane.r_bp * damping
    wrench[11] -= plane.r_bg * damping
    for i in range(12):
        acceleration[i] += wrench[i]
    acceleration[5] -= torque_p
    acceleration[11] -= torque_g
    for i in range(3):
        acceleration[i] *= supports.free[i] / c.m_p
        acceleration[6 + i] *= supports.free[6 + i] / c.m_g
    for i in range(3, 5):
        acceleration[i] *= supports.free[i] / c.J_p
        acceleration[6 + i] *= supports.free[6 + i] / c.J_g
    acceleration[5] *= supports.free[5] / c.J_zp
    acceleration[11] *= supports.free[11] / c.J_zg
