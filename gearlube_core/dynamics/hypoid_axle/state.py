"""Places in the state of the axle, which is that of its train: SI units."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.dynamics.train.element import BODY_STATES, RATE, RZ, W
from gearlube_core.dynamics.train.elements.held_port import N_KEPT, REFERENCE

PINION, GEAR = 0, BODY_STATES
U_P, V_P = PINION, PINION + RATE  # displacement [m] and velocity [m/s] of the pinion, x y z
U_G, V_G = GEAR, GEAR + RATE  # those of the gear
PHI_P, PHI_G = PINION + RZ, GEAR + RZ  # angles [rad]; all periodic data are indexed by the pinion's
W_P, W_G = PINION + W, GEAR + W  # speeds [rad/s]
X = GEAR + BODY_STATES  # dynamic transmission error [m]
CAGE_P, CAGE_G = X + 1, X + 2  # cage angles [rad]
PINION_WORK, WHEEL_WORK = X + 3, X + 4  # work put in; a load of the wheel takes it out [J]
# losses [J]
(
    VISCOUS, BOUNDARY, ROLLING, MESH_DAMPING, BEARING_DAMPING, BEARING_TORQUE, SEALS, CHURNING,
) = range(WHEEL_WORK + 1, WHEEL_WORK + 9)  # fmt: skip
FRICTION_BOUND, BEARING_BOUND = CHURNING + 1, CHURNING + 2  # of losses by solved films [J]
N_ODE = BEARING_BOUND + 1  # everything above is integrated
# of the last step: torques [N.m], and the speed at which the pinion is held [rad/s]
PINION_TORQUE, SPEED_REFERENCE, WHEEL_TORQUE = N_ODE, N_ODE + REFERENCE, N_ODE + N_KEPT
LOAD_TORQUE = WHEEL_TORQUE + 1  # filtered abs(pinion torque) that selects the load level [N.m]
SIDE = LOAD_TORQUE + 1  # below 0: the mesh data are those of the coast flanks [-]


def pinion_motion(s: Array) -> ShaftMotion:
    """Return the motion of the pinion in its bearings.

    The shaft lies along x: r1 = z, r2 = y turns with the pinion, which drives about -x.
    """
    places = U_P + 2, U_P + 1, U_P, V_P + 2, V_P + 1, V_P, CAGE_P, W_P
    return ShaftMotion._make(float(s[place]) for place in places)


def gear_motion(s: Array) -> ShaftMotion:
    """Return the motion of the gear in its bearings; the shaft lies along z."""
    places = *range(U_G, U_G + 3), *range(V_G, V_G + 3), CAGE_G, W_G
    return ShaftMotion._make(float(s[place]) for place in places)
