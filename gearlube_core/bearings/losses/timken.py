"""Running torque of tapered roller bearings after the Timken engineering manual."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

COEFFICIENT = 2.56e-6  # with rpm, mPa s, N and N m; not checked against the printed source


@kernel
def timken_torque(G1: float, speed: float, axial_load: float, eta0: float) -> float:
    """Return the running torque of one row of a tapered roller bearing.

    T = 2.56e-6 G1 (n eta)^0.62 F_a^0.3  in N m, rpm, mPa s, N

    Parameters
    ----------
    G1
        Geometry factor of the bearing, from its manufacturer [-].
    speed
        Of the shaft, not negative [rad/s].
    axial_load
        F_a, that rules where all rollers are loaded [N].
    eta0
        Viscosity [Pa s].

    Returns
    -------
    float
        T [N m].

    Notes
    -----
    Coefficient and exponents are not checked against the printed source. [witte_1973] has the
    exponents 2/3 and 1/3.
    Source: [timken_2011]
    """
    n = speed * 30.0 / math.pi
    return COEFFICIENT * G1 * (n * 1e3 * eta0) ** 0.62 * axial_load**0.3
