"""Layout of the axle's state vector.

Displacements and the transmission error are kept in micrometres (MICRO per metre): their natural
size then stands beside the speeds, which relative tolerances of an adaptive integrator need.
"""

from __future__ import annotations

from gearlube_core.bearings.followed_shaft import N_FOLLOWED
from gearlube_core.bearings.roller_nodes import N_ROLLER_NODES
from gearlube_core.dynamics.hypoid_mesh.node_films import N_FILMS

UM = 1.0e-6  # m per um; multiplied with, since a kernel divides dearly

X = 0  # dynamic transmission error [um]
W_P, W_G = 1, 2  # speeds of pinion and gear [rad/s]
PHI_P, PHI_G = 3, 4  # angles [rad]; all periodic data are indexed by the pinion's
U_P, V_P = 5, 8  # displacement [um] and velocity [m/s] of the pinion, x y z
U_G, V_G = 11, 14  # those of the gear
CAGE_P, CAGE_G = 17, 18  # cage angles [rad]
PINION_WORK, WHEEL_WORK = 19, 20  # work of the external torques [J]
VISCOUS, BOUNDARY = 21, 22  # flank friction losses [J]
MESH_DAMPING, BEARING_DAMPING, BEARING_TORQUE = 23, 24, 25  # other losses [J]
CHURNING, SEALS, ROLLING = 26, 27, 28  # ditto
N_ENERGIES = 10  # from PINION_WORK on
N_ODE = 29  # everything above is integrated

LOAD_TORQUE = 29  # filtered abs(pinion torque) that selects the load level [N.m]
TIME_IN_STEP = 30  # length of the communication step that means are over, see `keep_means` [s]
WORK_MARK = 31  # these energies at the start of that step [J]
SIDE = WORK_MARK + N_ENERGIES  # below 0: the mesh data are those of the coast flanks [-]
FRICTION_BOUND = SIDE + 1  # of the flank friction losses of that step [J]
DRAG_BOUND = FRICTION_BOUND + 1  # of the drag losses of the bearings, likewise [J]
FILM_NODES = DRAG_BOUND + 1  # films at the nodes of the mesh table, with a film model
ROLLER_NODES = FILM_NODES + N_FILMS  # `roller_nodes` of both shafts, with a film model of rollers
N_ROLLERS = 2 * N_ROLLER_NODES
KEPT_DRAG = ROLLER_NODES + N_ROLLERS  # drag that is kept, with a law that takes single rollers
N_DRAG = 2 * N_FOLLOWED
N_STATE = KEPT_DRAG + N_DRAG
N_CONTINUOUS = LOAD_TORQUE + 1  # the integrated states and the load level: no jumps but at events
