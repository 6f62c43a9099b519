"""How a mesh decides the length of integrator steps, and how its data follow the load."""

from __future__ import annotations

from gearlube_core.bearings.followed_shaft import STEP_PARTS
from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP
from gearlube_core.kernels.jit import kernel

MICRO = 1.0e6  # um per m
# Change of the load level that the mesh data follow at once, over load or torque
LOAD_REACH = 4e-3
# Parts of a step in which flanks meet or part: the slope of their force jumps there, and damping
# builds up over half a micrometre. A step moves them by that much at 0.1 m/s.
CONTACT_PARTS = STEP_PARTS
_STILL = 0.1  # of the build-up; smaller moves in a step need no parts
LOAD_FILTER_TIME = 0.02  # s, load level follows the torque below the driveline's shuffle
REAL_AXIS_LIMIT = 2.0  # RK4 is stable to 2.78 on the negative real axis


@kernel
def contact_parts(x: float, change: float, backlash: float) -> int:
    """Return into how many parts a step is divided: CONTACT_PARTS where flanks meet or part.

    Parameters
    ----------
    x, change
        Transmission error, and how far it moves in the step [um].
    backlash
        [um]
    """
    build_up = DAMPING_BUILD_UP * MICRO
    if abs(change) < _STILL * build_up:
        return 1
    low, high = min(x, x + 1.5 * change), max(x, x + 1.5 * change)
    drive = high > 0.0 and low < build_up
    coast = low < -backlash and high > -backlash - build_up
    return CONTACT_PARTS if drive or coast else 1
