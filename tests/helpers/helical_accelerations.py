"""Forces and accelerations of the twelve coordinates: kernels."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP
from gearlube_core.dynamics.helical_pair.kernel_parameters import PairConstants, SupportArrays
from gearlube_core.dynamics.helical_pair.mesh.contact_points import DENSITY, LENGTH, LOAD
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import (
    built_up,
    damping_constant,
    damping_factor,
    flank_damping,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import wrench_of_sums
from gearlube_core.kernels.jit import kernel
from tests.helpers.helical_mesh_points import load_sums


@kernel
def points_damping(psi_rate: float, c: PairConstants, points: Array, n: int) -> float:
    """Return the damping force of `mesh_damping` at points with LOAD [N], positive with the rate.

    Parameters
    ----------
    psi_rate
        Of psi = r_bp th_zp + r_bg th_zg, which grows as the drive flanks part [m/s].
    """
    plane = c.plane
    factor = damping_factor(c.zeta_mesh, c.m_e, plane.cos_b)
    whole = drive = back = on_drive = on_back = 0.0
    for i in range(n):
        load = points[i, LOAD] * points[i, LENGTH]
        stiffness = points[i, DENSITY] * points[i, LENGTH]
        whole += stiffness
        if stiffness > 0.0:
            share = stiffness * built_up(
                abs(points[i, LOAD]) / points[i, DENSITY], DAMPING_BUILD_UP
            )
            if load > 0.0:
                on_drive += load
                drive += share
            elif load < 0.0:
                on_back -= load
                back += share
    constant = damping_constant(factor, whole)
    if c.one_sided == 0.0 or whole == 0.0:
        return constant * psi_rate
    parting = flank_damping(constant, drive / whole, -psi_rate, plane.cos_b * on_drive)
    return flank_damping(constant, back / whole, psi_rate, plane.cos_b * on_back) - parting


@kernel
def support_force(q: Array, v: Array, supports: SupportArrays, force: Array) -> None:
    """Fill the forces and moments of the bearings on both members, shape (12,) [N, N.m].

    Notes
    -----
    He et al. 2007 eq. (28)-(35); the paper's combined bearing force F_SB is rows 0-2 and 6-8. For
    any matrix, those as printed too; the kernels of `SpringSupport` know which entries can differ
    from zero, 9 products a member in place of 36.
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
    points
        `line_loads` has filled LOAD, a friction law MU.
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
    damping = points_damping(psi_rate, c, points, n)
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
