"""Parameters of one bearing for the roller kernels, as plain floats.

Motion of a shaft seen by its rollers, and the moment that the rollers exert on their cage.

Coordinates: (r1, r2, a) right-handed, a along the shaft; u = (r1, r2, xa). Roller i stands at the
angle cage_angle + 2 pi i/N from r1 towards r2. Positive shaft speed turns r1 towards r2. The
bearing with side s = +1 is loaded by positive axial displacement, the one with s = -1 unloaded.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.kernels.jit import kernel

ROLLERS_MAX = 40  # largest number of rollers the trigonometric tables hold

# The load of a film below which its load dependence is held constant, given as an approach [m].
FILM_FLOOR_APPROACH = 0.5e-6
# Above this multiple of FILM_FLOOR_APPROACH it is held constant again [-].
FILM_RANGE = 256.0

_ANGLES = (
    2.0 * np.pi * np.arange(ROLLERS_MAX) / np.maximum(np.arange(ROLLERS_MAX + 1), 1)[:, np.newaxis]
)
COS_TABLE = np.cos(_ANGLES)  # cosine of the angle of roller i among N at [N, i]
SIN_TABLE = np.sin(_ANGLES)  # sine likewise


class BearingParameters(NamedTuple):
    """One roller bearing; the two opposed bearings of a shaft share it.

    The floats of `TaperedRollerParameters`, which `TaperedRollerBearing.parameters` builds.
    """

    kn: float  # inner race - roller - outer race stiffness [N/m^n]
    n: float  # load-approach exponent [-], 10/9 for lines
    n_rollers: float  # number of rollers, integral, 3 to ROLLERS_MAX [-]
    sin_contact: float  # sine of the contact angle [-]
    cos_contact: float  # cosine of the contact angle [-]
    interference: float  # approach at zero displacement and zero film, < 0 clearance [m]
    cage_ratio: float  # cage speed over shaft speed [-]
    loss: float  # hysteresis coefficient of [mohammadpour_2015 (25)], 0.009 [-]
    approach_factor: float  # 1 full approach, 0.5 as printed in [mohammadpour_2015 (26)] [-]
    clip: float  # 1 no tension, 0 as printed [-]
    film_constant: float  # film at the floor load / ((eta0 u)^0.647 alpha^0.46), 0 off
    film_speed_radius: float  # mean entraining speed over shaft speed [m]
    squeeze: float  # 1 with the squeeze factor of [mohammadpour_2015 (27)], 0 without [-]
    mean_diameter: float  # (bore + outside diameter)/2, for the drag [m]
    ring_section: float  # outside diameter less bore [m]
    skf_rolling: float  # R1 of the series in `skf_2013` [-]
    skf_sliding: float  # S1 the same [-]
    f0: float  # viscous factor of the drag [-], 0 off
    f1: float  # load factor of the drag [-], 0 off
    axial_factor: float  # 2 Y = 0.8 cot(contact angle), load of the drag over axial load [-]
    roller_length: float  # [m]
    roller_radius: float  # at the middle [m]
    inner_radius: float  # of the inner race there, from the shaft's axis [m]
    outer_radius: float  # the same of the outer race [m]
    reduced_modulus: float  # E' = 2 E* of rollers and races [Pa]
    rib_height: float  # of the contact of roller end and rib above the inner race [m]; 0: no rib
    rib_friction: float  # of the asperities there [-]
    rib_roughness: float  # composite rms there [m]
    conductivity: float  # of rollers and races [W/(m K)]
    density: float  # of theirs [kg/m3]
    heat_capacity: float  # [J/(kg K)]
    contact_angle: float  # [rad]


class ApproachTerms(NamedTuple):
    """Approach and rate of roller i at b = 2 pi i/N from the cage frame, side s = +-1.

    g_i = g0 + s ga + g1 cos b + g2 sin b,  g_i' = s va + v1 cos b + v2 sin b, in units of
    FILM_FLOOR_APPROACH and of it a second. The rates contain the turning of the cage.
    """

    g0: float
    g1: float
    g2: float
    ga: float
    v1: float
    v2: float
    va: float


@kernel
def approach_terms(
    motion: ShaftMotion, cos_c: float, sin_c: float, p: BearingParameters
) -> ApproachTerms:
    """Return approach and rate of all rollers; `cos_c` and `sin_c` are of the cage angle.

    Notes
    -----
    Source: [mohammadpour_2015 (26)] with the full approach; approach_factor 1/2 halves it as
    printed.
    """
    scale = p.approach_factor / FILM_FLOOR_APPROACH
    radial = scale * p.cos_contact
    cage_speed = p.cage_ratio * motion.speed
    g1 = radial * (motion.r1 * cos_c + motion.r2 * sin_c)
    g2 = radial * (motion.r2 * cos_c - motion.r1 * sin_c)
    v1 = radial * (motion.v1 * cos_c + motion.v2 * sin_c) + cage_speed * g2
    v2 = radial * (motion.v2 * cos_c - motion.v1 * sin_c) - cage_speed * g1
    axial = scale * p.sin_contact
    g0 = p.interference / FILM_FLOOR_APPROACH
    return ApproachTerms(g0, g1, g2, axial * motion.axial, v1, v2, axial * motion.v_axial)


@kernel
def cage_torque(r1: float, r2: float, F_r1: float, F_r2: float) -> float:
    """Return the torque that the rollers of a bearing exert on the cage.

    T_c = r1 (-F_r2) - r2 (-F_r1) = -dV/d(cage angle) without hysteresis.

    Parameters
    ----------
    r1, r2 : float
        Radial displacement of the shaft [m].
    F_r1, F_r2 : float
        Force of the bearing on the shaft, or the sum over the bearings of a shaft [N].

    Returns
    -------
    float
        T_c [N m], positive in the direction of growing cage angle.

    Notes
    -----
    Mohammadpour et al. 2015 turn the cage without a torque. Where the cage angle follows the
    shaft, adding cage_ratio T_c to the torque on the shaft closes the energy balance exactly.
    """
    return r2 * F_r1 - r1 * F_r2
