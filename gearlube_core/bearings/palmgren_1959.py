"""Drag torque of a roller bearing after Palmgren: a viscous part and a load part."""

from __future__ import annotations

import math

from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.kernels.jit import kernel

# Tapered roller bearings in an oil bath, [harris_kotzalas_2007] (f0 = 3 for oil mist, 8 to 10
# for an oil jet) and the same f1 in [iso_tr_14179_1].
F0_TAPERED_OIL_BATH = 6.0  # 1
F1_TAPERED = 4e-4  # 1

# 1e-7 f0 (nu n)^(2/3) dm^3 in N mm, cSt, rpm, mm -> N m, m2/s, rad/s, m
_VISCOUS = 1e-7 * (1e6 * 30.0 / math.pi) ** (2.0 / 3.0) * 1e9 * 1e-3
_VISCOUS_FLOOR = 160e-7 * 1e9 * 1e-3  # 160e-7 f0 dm^3, N m and m
SMOOTHING_SPEED = 1.0  # rad/s, below which the torque falls to zero; choice of this library


@kernel
def drag_torque(
    speed: float, axial_load: float, radial_load: float, nu: float, p: BearingParameters
) -> float:
    """Return the drag torque of one tapered roller bearing, with the sign of the speed.

    M = (M0 + M1) w/sqrt(w^2 + w0^2),  M0 = 1e-7 f0 (nu n)^(2/3) dm^3, at least 160e-7 f0 dm^3
    [N mm, cSt, 1/min, mm],  M1 = f1 P1 dm,  P1 = 2 Y F_a, at least F_r,  Y = 0.4 cot(contact
    angle).

    Parameters
    ----------
    speed : float
        Speed w of the shaft [rad/s].
    axial_load : float
        Axial load of the bearing, its preload included [N].
    radial_load : float
        F_r, not negative [N].
    nu : float
        Kinematic viscosity of the oil [m2/s].
    p : BearingParameters
        Bearing.

    Returns
    -------
    float
        Torque that opposes the rotation when subtracted from the shaft [N m].

    Notes
    -----
    The constant branch of M0 is given below
    nu n = 2000 cSt/min, where it lies 0.8 % above the other one; taking the larger of the two
    removes the jump. The factor in w, with w0 = 1 rad/s, makes the torque smooth through zero
    speed.

    References
    ----------
    [palmgren_1959]; [harris_kotzalas_2007]; [iso_tr_14179_1]
    """
    viscous = max(_VISCOUS * math.pow(nu * abs(speed), 2.0 / 3.0), _VISCOUS_FLOOR)
    dm = p.mean_diameter
    load = max(p.axial_factor * abs(axial_load), radial_load)
    magnitude = p.f0 * viscous * dm * dm * dm + p.f1 * load * dm
    return magnitude * speed / math.sqrt(speed * speed + SMOOTHING_SPEED * SMOOTHING_SPEED)
