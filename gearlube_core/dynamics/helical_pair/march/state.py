"""State vector of the helical march."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import N_FRICTION, PairMotion
from gearlube_core.kernels.jit import kernel

PSI = 0  # r_bp phi_p - r_bg phi_g: relative rotation along the line of action [m]
W_P, W_G = 1, 2  # speeds of pinion and gear, forward positive [rad/s]
PHI_P, PHI_G = 3, 4  # angles, forward positive [rad]; the contact lines follow the pinion's
U_P, TH_P = 5, 8  # displacement x, y, z [m] and tilt about x, y [rad] of the pinion
U_G, TH_G = 10, 13  # those of the gear
V_P, OM_P = 15, 18  # their rates
V_G, OM_G = 20, 23
N_LATERAL = 10  # displacements and tilts of both
PINION_WORK, WHEEL_WORK = 25, 26  # work of the external torques [J]
FRICTION, MESH_DAMPING, BEARING_DAMPING = 27, 28, 29  # losses [J]
N_ENERGIES = 5
N_ODE = 30  # everything above is integrated

LOAD_TORQUE = 30  # filtered abs(pinion torque) that selects the level of the line mesh [N.m]
TIME_IN_STEP = 31  # length of the communication step that means are over, see `keep_means` [s]
WORK_MARK = 32  # the energies at the start of that step [J]
REFRESHED = WORK_MARK + N_ENERGIES  # when friction was last computed [refreshes since phase 0]
MU = REFRESHED + 1  # coefficients of friction: drive flank, then coast flank [-]
N_STATE = REFRESHED + N_FRICTION
N_CONTINUOUS = LOAD_TORQUE + 1  # the integrated states and the load level: no jumps but at events


@kernel
def pair_motion(s: Array) -> PairMotion:
    """Return the motion in a state of the pair, shape (N_STATE,)."""
    return PairMotion(
        s[PSI],
        s[PHI_P],
        s[W_P],
        s[W_G],
        s[U_P],
        s[U_P + 1],
        s[U_P + 2],
        s[TH_P],
        s[TH_P + 1],
        s[U_G],
        s[U_G + 1],
        s[U_G + 2],
        s[TH_G],
        s[TH_G + 1],
        s[V_P],
        s[V_P + 1],
        s[OM_P],
        s[OM_P + 1],
        s[V_G],
        s[V_G + 1],
        s[OM_G],
        s[OM_G + 1],
    )
