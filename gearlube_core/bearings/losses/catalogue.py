"""Friction torque of roller bearings after catalogues: Palmgren and SKF."""

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
# R1 and S1 of each series [-]; not checked against the printed source
SERIES = {
    "302": (1.76e-6, 0.017),
    "303": (1.69e-6, 0.017),
    "313": (1.84e-6, 0.048),
    "320X": (2.38e-6, 0.014),
    "322": (2.27e-6, 0.018),
}
OTHER_SERIES = (2.31e-6, 0.019)
SERIES_NAMES = (*SERIES, "other")
R2, S2 = 10.9, 2.0  # likewise
BOUNDARY_FRICTION = 0.12  # mu_bl; another edition has 0.15
FULL_FILM_FRICTION = 0.002  # of a full film between tapered rollers and rib
STARVATION = 3e-8  # K_rs of oil bath and jet; 6e-8 of grease
GEOMETRY = 6.0  # K_Z of tapered roller bearings
_RPM = 30.0 / math.pi


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


@kernel
def skf_torque(
    speed: float, axial_load: float, radial_load: float, nu: float, p: BearingParameters
) -> tuple[float, float]:
    """Return the rolling and the sliding moment of a tapered roller bearing.

    M_rr = phi_ish phi_rs R1 d_m^2.38 (F_r + R2 Y F_a)^0.31 (nu n)^0.6
    M_sl = S1 d_m^0.82 (F_r + S2 Y F_a) [f mu_bl + (1 - f) 0.002],  f = exp[-2.6e-8 (n nu)^1.4 d_m]
    phi_ish = 1/[1 + 1.84e-9 (n d_m)^1.28 nu^0.64]
    phi_rs = exp{-K_rs nu n (d + D) [K_Z/(2 (D - d))]^(1/2)}
    in N mm, mm, rpm, mm2/s, N

    Parameters
    ----------
    speed
        Of the shaft, not negative [rad/s].
    axial_load, radial_load
        F_a, F_r, not negative [N].
    nu
        Kinematic viscosity of the oil [m2/s].
    p
        Numbers of the roller bearing.

    Returns
    -------
    tuple of float
        M_rr, M_sl [N m].

    Notes
    -----
    For normal loads and speeds of the catalogue. Its drag term is left out: its constants could not
    be found. The constants of the series are not checked against the printed source.
    Source: [skf_2013]
    """
    d_m, section, Y = 1e3 * p.mean_diameter, 1e3 * p.ring_section, 0.5 * p.axial_factor
    n = speed * _RPM
    v = 1e6 * nu
    heating = 1.0 / (1.0 + 1.84e-9 * (n * d_m) ** 1.28 * v**0.64)
    starving = math.exp(-STARVATION * v * n * 2.0 * d_m * math.sqrt(GEOMETRY / (2.0 * section)))
    rolling_load = (radial_load + R2 * Y * axial_load) ** 0.31
    M_rr = heating * starving * p.skf_rolling * d_m**2.38 * rolling_load * (v * n) ** 0.6
    share = math.exp(-2.6e-8 * (n * v) ** 1.4 * d_m)
    mu = share * BOUNDARY_FRICTION + (1.0 - share) * FULL_FILM_FRICTION
    M_sl = p.skf_sliding * d_m**0.82 * (radial_load + S2 * Y * axial_load) * mu
    return 1e-3 * M_rr, 1e-3 * M_sl
