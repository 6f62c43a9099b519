"""Forces of a helical mesh on both members: kernels."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import (
    FLANK_POINTS,
    FlankConstants,
    PairMotion,
    coast_near,
    coast_view,
    drive_view,
    friction_direction,
    touches,
    turned,
)
from gearlube_core.dynamics.helical_pair.march.line_sums import LineSums, line_sums
from gearlube_core.dynamics.helical_pair.march.mesh_data import LEAST_OFFSET
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import damping_constant, flank_damping
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import Wrench, mesh_wrench
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel


@kernel
def flank_wrench(sums: LineSums, direction: float, plane: ContactPlane) -> Wrench:
    """Return forces and moments of one flank in its own frame.

    Parameters
    ----------
    direction
        +1 where the pinion turns about -z of this frame, -1 the other way, between at rest.
    """
    along = plane.sin_b * sums.Nx + plane.cos_b * sums.Nz
    return mesh_wrench(
        sums.N, along, direction * sums.F, direction * sums.Fx, direction * sums.Fz, plane
    )


@kernel
def turned_wrench(w: Wrench, p: FlankConstants) -> Wrench:
    """Return the wrench of the coast flanks' frame in that of the pair."""
    F_x, F_y = turned(w.F_x, w.F_y, p)
    M_px, M_py = turned(w.M_px, w.M_py, p)
    M_gx, M_gy = turned(w.M_gx, w.M_gy, p)
    return Wrench(F_x, F_y, -w.F_z, M_px, M_py, -w.M_pz, M_gx, M_gy, -w.M_gz)


@kernel
def friction_heat(sums: LineSums, direction: float, m: PairMotion, p: FlankConstants) -> float:
    """Return the heat of the drive flanks' friction [W], with the true velocities."""
    rate = sums.F * (m.vy_p - m.vy_g + p.plane.x_g * m.w_g)
    rate -= sums.Fz * (m.ox_p - m.ox_g) + sums.Fx * (m.w_p + m.w_g)
    return -direction * rate


@kernel
def turned_friction_heat(
    sums: LineSums, direction: float, m: PairMotion, p: FlankConstants
) -> float:
    """Return the heat of the coast flanks' friction [W]."""
    _, v_p = turned(m.vx_p, m.vy_p, p)
    _, v_g = turned(m.vx_g, m.vy_g, p)
    om_p, _ = turned(m.ox_p, m.oy_p, p)
    om_g, _ = turned(m.ox_g, m.oy_g, p)
    rate = sums.F * (v_p - v_g - p.plane.x_g * m.w_g)
    rate -= sums.Fz * (om_p - om_g) - sums.Fx * (m.w_p + m.w_g)
    return -direction * rate


@kernel
def sums_damping(sums: LineSums, closing: float, p: FlankConstants) -> float:
    """Return the damping force of a flank [N] that closes at a rate [m/s], see `mesh_damping`."""
    if sums.N == 0.0:
        return 0.0
    constant = damping_constant(p.damping, sums.whole)
    return flank_damping(constant, sums.built_up / sums.whole, closing, p.plane.cos_b * sums.N)


class PairForces(NamedTuple):
    """Forces and moments of a mesh on both members."""

    wrench: Wrench  # without damping and the work of moving lines
    heat: float  # of friction [W]
    damping: float  # along the line of action [N]
    moving: float  # on the pinion alone, as loaded lines move [N]
    closing: float  # rate of the relative rotation along the line of action [m/s]


@inside
def pair_forces(m: PairMotion, mu: Array, mu_at: int, data: Array) -> PairForces:
    """Return the forces of the mesh in a motion of both members.

    Parameters
    ----------
    m : PairMotion
    mu : ndarray
        Coefficients of friction from `mu_at` on: FLANK_POINTS of the drive flanks, then as many
        of the coast flanks.
    data : ndarray
        Pair data, see `mesh_data`.
    """
    p: FlankConstants = tuple_from_array(data, FlankConstants)
    plane = p.plane
    direction = friction_direction(m.w_p)
    psi_rate = plane.r_bp * m.w_p - plane.r_bg * m.w_g
    F_x = F_y = F_z = M_px = M_py = M_pz = M_gx = M_gy = M_gz = 0.0
    heat = damping = moving = 0.0
    drive = drive_view(m, p)
    if touches(drive, data[LEAST_OFFSET], p):
        sums = line_sums(drive.a, drive.tilt, drive.phase, data, mu, mu_at)
        F_x, F_y, F_z, M_px, M_py, M_pz, M_gx, M_gy, M_gz = flank_wrench(sums, direction, plane)
        heat = friction_heat(sums, direction, m, p)
        damping = sums_damping(sums, psi_rate, p)
        moving = p.line_work * sums.moving
    if coast_near(m, data[LEAST_OFFSET], p):
        coast = coast_view(m, p)
        sums = line_sums(coast.a, coast.tilt, coast.phase, data, mu, mu_at + FLANK_POINTS)
        w = turned_wrench(flank_wrench(sums, -direction, plane), p)
        F_x += w.F_x
        F_y += w.F_y
        F_z += w.F_z
        M_px += w.M_px
        M_py += w.M_py
        M_pz += w.M_pz
        M_gx += w.M_gx
        M_gy += w.M_gy
        M_gz += w.M_gz
        heat += turned_friction_heat(sums, -direction, m, p)
        damping -= sums_damping(sums, -psi_rate, p)
        moving -= p.line_work * sums.moving
    total = Wrench(F_x, F_y, F_z, M_px, M_py, M_pz, M_gx, M_gy, M_gz)
    return PairForces(total, heat, damping, moving, psi_rate)
