"""Rates of change of the marching model: kernels."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.line_sums import LineSums, line_sums
from gearlube_core.dynamics.helical_pair.march.mesh_data import LEAST_OFFSET
from gearlube_core.dynamics.helical_pair.march.state import (
    BEARING_DAMPING,
    FLANK_POINTS,
    FRICTION,
    MESH_DAMPING,
    MU,
    N_LATERAL,
    PHI_G,
    PHI_P,
    PINION_WORK,
    PSI,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    WHEEL_WORK,
    FlankConstants,
    MotionConstants,
    PairMotion,
    SupportConstants,
    coast_near,
    coast_view,
    drive_view,
    friction_direction,
    pair_motion,
    touches,
    turned,
)
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
def support_rates(
    s: Array,
    u: int,
    v: int,
    F_x: float,
    F_y: float,
    F_z: float,
    M_x: float,
    M_y: float,
    k: SupportConstants,
    ds: Array,
) -> float:
    """Write the accelerations of one member under the forces given; return the dampers' heat [W].

    `u` and `v` are the places of its displacements and rates in the state.
    """
    x, y, z, a_x, a_y = s[u], s[u + 1], s[u + 2], s[u + 3], s[u + 4]
    v_x, v_y, v_z, w_x, w_y = s[v], s[v + 1], s[v + 2], s[v + 3], s[v + 4]
    ds[v] = (F_x - k.K_xx * x - k.K_x_ay * a_y - k.c_x * v_x) * k.mobility
    ds[v + 1] = (F_y - k.K_yy * y - k.K_y_ax * a_x - k.c_y * v_y) * k.mobility
    ds[v + 2] = (F_z - k.K_zz * z - k.c_z * v_z) * k.mobility_z
    ds[v + 3] = (M_x - k.K_ax * a_x - k.K_y_ax * y - k.c_ax * w_x) * k.mobility_a
    ds[v + 4] = (M_y - k.K_ay * a_y - k.K_x_ay * x - k.c_ay * w_y) * k.mobility_a
    lost = k.c_x * v_x * v_x + k.c_y * v_y * v_y + k.c_z * v_z * v_z
    return lost + k.c_ax * w_x * w_x + k.c_ay * w_y * w_y


@kernel
def sums_damping(sums: LineSums, closing: float, p: FlankConstants) -> float:
    """Return the damping force of a flank [N] that closes at a rate [m/s], see `mesh_damping`."""
    if sums.N == 0.0:
        return 0.0
    constant = damping_constant(p.damping, sums.whole)
    return flank_damping(constant, sums.built_up / sums.whole, closing, p.plane.cos_b * sums.N)


class PairForces(NamedTuple):
    """What a mesh does to both members."""

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
    motion: MotionConstants = tuple_from_array(data, MotionConstants)
    p = motion.flanks
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


@kernel
def march_rates(
    s: Array,
    pinion_torque: float,
    wheel_torque: float,
    data: Array,
    ds: Array,
) -> None:
    """Write d/dt of the N_ODE integrated states into `ds`.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    pinion_torque, wheel_torque
        [N.m]
    data : ndarray
        Pair data, see `mesh_data`.
    ds : ndarray of shape (N_ODE,)

    Notes
    -----
    The paper's equations of motion with consistent signs (the pinion's torque drives along -z),
    about a motion that follows the actual rotation of the pinion; flanks press, never pull.
    Products of rotation and tilt (gyroscopic terms) are left out as in the paper. Mesh damping as
    in `mesh_damping`, for either flank by itself.
    Source: [he_2007 (38a)] [he_2007 (38b)] [he_2007 (38c)] [he_2007 (39a)] [he_2007 (39b)]
    [he_2007 (39c)] [he_2007 (40a)] [he_2007 (40b)] [he_2007 (40c)] [he_2007 (41a)] [he_2007 (41b)]
    [he_2007 (41c)]
    """
    motion: MotionConstants = tuple_from_array(data, MotionConstants)
    plane = motion.flanks.plane
    w_p = s[W_P]
    w_g = s[W_G]
    mesh = pair_forces(pair_motion(s), s, MU, data)
    w = mesh.wrench
    lost = support_rates(s, U_P, V_P, w.F_x, w.F_y, w.F_z, w.M_px, w.M_py, motion.pinion, ds)
    lost += support_rates(s, U_G, V_G, -w.F_x, -w.F_y, -w.F_z, w.M_gx, w.M_gy, motion.gear, ds)
    on_pinion = pinion_torque - (w.M_pz + plane.r_bp * (mesh.damping + mesh.moving))
    on_gear = -wheel_torque + (w.M_gz + plane.r_bg * mesh.damping)
    ds[PSI] = mesh.closing
    ds[W_P] = on_pinion * motion.pinion.mobility_r
    ds[W_G] = on_gear * motion.gear.mobility_r
    ds[PHI_P] = w_p
    ds[PHI_G] = w_g
    for i in range(N_LATERAL):
        ds[U_P + i] = s[V_P + i]
    ds[PINION_WORK] = pinion_torque * w_p
    ds[WHEEL_WORK] = wheel_torque * w_g
    ds[FRICTION] = mesh.heat
    ds[MESH_DAMPING] = mesh.damping * mesh.closing
    ds[BEARING_DAMPING] = lost
