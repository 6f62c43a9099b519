"""Layout of the marching model's state vector; SI throughout."""

from __future__ import annotations

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
LINES_MAX = 6  # contact lines at once; a total contact ratio above 6 is refused
POINTS_PER_LINE = 4  # two Gauss points on either side of the pitch line
FLANK_POINTS = LINES_MAX * POINTS_PER_LINE
MU = REFRESHED + 1  # coefficients of friction: drive flank, then coast flank [-]
N_STATE = MU + 2 * FLANK_POINTS
N_CONTINUOUS = LOAD_TORQUE + 1  # the integrated states and the load level: no jumps but at events
