"""Forces of two opposed roller bearings on a shaft; coordinates as in `cage_frame`."""

from __future__ import annotations

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.roller_loads import bearing_forces
from gearlube_core.kernels.jit import kernel


@kernel
def shaft_bearing_forces(
    motion: ShaftMotion,
    f_ref: float,
    eta0: float,
    alpha: float,
    p: BearingParameters,
) -> tuple[float, float, float, float, float, float, float]:
    """Return the forces of both opposed bearings on the shaft, and the power of the hysteresis.

    w_i = kn d^n + 0.009 n kn d^(n-1) d'/f_ref,  d = H - C + (r1 cos th + r2 sin th) cos L
    + s xa sin L,  F_r1 = -sum w cos th cos L,  F_r2 = -sum w sin th cos L,  F_a = -s sum w sin L.

    Parameters
    ----------
    motion : ShaftMotion
        Keep the cage angle within a few turns for accuracy.
    f_ref : float
        Reference frequency of the hysteresis, above zero [Hz].
    eta0, alpha : float
        Viscosity [Pa s] and pressure-viscosity coefficient [1/Pa] of the oil.
    p : BearingParameters
        The bearing on either side.

    Returns
    -------
    tuple of float
        F1_r1, F1_r2, F1_a of the side s = +1, F2_r1, F2_r2, F2_a of s = -1 [N]; power lost in the
        rollers, >= 0 [W].

    Notes
    -----
    The lost power covers the motion of the shaft and of the cage: with the potential V of
    `shaft_bearing_energy` at constant film, dV/dt = -F.v - T_c cage_speed - power, where T_c is
    `cage_torque`. Printed [mohammadpour_2015 (24)] has no side s; printed [mohammadpour_2015 (26)]
    halves the displacement, which is the option approach="as_printed". A NaN in any input gives NaN
    forces.

    References
    ----------
    [mohammadpour_2015 (24)]; `roller_loads.bearing_forces` has the rollers.
    """
    F1_r1, F1_r2, F1_a, lost_1 = bearing_forces(motion, f_ref, eta0, alpha, p, 1.0)
    F2_r1, F2_r2, F2_a, lost_2 = bearing_forces(motion, f_ref, eta0, alpha, p, -1.0)
    return F1_r1, F1_r2, F1_a, F2_r1, F2_r2, F2_a, lost_1 + lost_2
