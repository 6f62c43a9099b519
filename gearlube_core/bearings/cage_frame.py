"""Motion of a shaft seen by its rollers, and the moment that the rollers exert on their cage.

Coordinates: (r1, r2, a) right-handed, a along the shaft; u = (r1, r2, xa). Roller i stands at the
angle cage_angle + 2 pi i/N from r1 towards r2. Positive shaft speed turns r1 towards r2. The
bearing with side s = +1 is loaded by positive axial displacement, the one with s = -1 unloaded.
"""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.parameters import FILM_FLOOR_APPROACH, BearingParameters
from gearlube_core.kernels.jit import kernel


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
