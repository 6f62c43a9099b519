"""Rates of change of the marching model: kernels."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import (
    MotionConstants,
    SupportConstants,
)
from gearlube_core.dynamics.helical_pair.march.pair_forces import pair_forces
from gearlube_core.dynamics.helical_pair.march.state import (
    BEARING_DAMPING,
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
    pair_motion,
)
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel


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
