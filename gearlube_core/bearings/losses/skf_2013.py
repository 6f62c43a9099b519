"""Friction of tapered roller bearings after the SKF catalogue."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.kernels.jit import kernel

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


class SkfBearing(NamedTuple):
    """What the law needs of a bearing; all floats, SI."""

    bore: float  # d [m]
    outside: float  # D [m]
    R1: float  # of the series [-]
    S1: float  # of the series [-]
    Y: float  # axial load factor [-]


@kernel
def skf_torque(
    b: SkfBearing, speed: float, axial_load: float, radial_load: float, nu: float
) -> tuple[float, float]:
    """Return the rolling and the sliding moment of a tapered roller bearing.

    M_rr = phi_ish phi_rs R1 d_m^2.38 (F_r + R2 Y F_a)^0.31 (nu n)^0.6
    M_sl = S1 d_m^0.82 (F_r + S2 Y F_a) [f mu_bl + (1 - f) 0.002],  f = exp[-2.6e-8 (n nu)^1.4 d_m]
    phi_ish = 1/[1 + 1.84e-9 (n d_m)^1.28 nu^0.64]
    phi_rs = exp{-K_rs nu n (d + D) [K_Z/(2 (D - d))]^(1/2)}
    in N mm, mm, rpm, mm2/s, N

    Parameters
    ----------
    b
        Bearing.
    speed
        Of the shaft, not negative [rad/s].
    axial_load, radial_load
        F_a, F_r, not negative [N].
    nu
        Kinematic viscosity of the oil [m2/s].

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
    d, D = 1e3 * b.bore, 1e3 * b.outside
    d_m = 0.5 * (d + D)
    n = speed * _RPM
    v = 1e6 * nu
    heating = 1.0 / (1.0 + 1.84e-9 * (n * d_m) ** 1.28 * v**0.64)
    starving = math.exp(-STARVATION * v * n * (d + D) * math.sqrt(GEOMETRY / (2.0 * (D - d))))
    rolling_load = (radial_load + R2 * b.Y * axial_load) ** 0.31
    M_rr = heating * starving * b.R1 * d_m**2.38 * rolling_load * (v * n) ** 0.6
    share = math.exp(-2.6e-8 * (n * v) ** 1.4 * d_m)
    mu = share * BOUNDARY_FRICTION + (1.0 - share) * FULL_FILM_FRICTION
    M_sl = b.S1 * d_m**0.82 * (radial_load + S2 * b.Y * axial_load) * mu
    return 1e-3 * M_rr, 1e-3 * M_sl
