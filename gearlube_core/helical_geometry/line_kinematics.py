"""Curvature and surface velocities at a point of a contact line: kernels."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel


class LineKinematics(NamedTuple):
    """Contact of the flanks at one point of a line; all floats, SI."""

    R_p: float  # transverse radius of curvature of the pinion flank [m]
    R_g: float  # and of the gear flank [m]
    R: float  # relative radius of curvature in the normal plane [m]
    u_p: float  # surface speeds relative to the line, across it [m/s]
    u_g: float
    entrainment: float  # (u_p + u_g)/2 [m/s]
    sliding: float  # u_p - u_g, negative before the pitch line [m/s]
    slide_roll: float  # sliding over entrainment [-]


@kernel
def line_kinematics(x: float, pinion_speed: float, plane: ContactPlane) -> LineKinematics:
    """Return curvature and velocities at x of the plane of contact.

    R_p = x,  R_g = x_g - x,  R = R_p R_g/((R_p + R_g) cos b),  u_p = x w_p,  u_g = (x_g - x) w_g

    Parameters
    ----------
    x
        Along the line of action from the pinion's tangent point [m]; 0 < x < x_g.
    pinion_speed
        [rad/s].
    plane
        Plane of contact.

    Returns
    -------
    LineKinematics
        Slide-roll ratio zero at rest.

    Notes
    -----
    The relative sliding is `u_p - u_g` = -v_s of [he_2007 (6)], whose y axis points the
    other way. The normal radius is the transverse one over cos(b).
    Radii: [jamali_2015 (2.7)] [jamali_2015 (2.8)] with s = x - r_bp tan(alpha_w);
    speeds: [jamali_2015 (4.1)] [jamali_2015 (4.2)].
    """
    R_p, R_g = x, plane.x_g - x
    gear_speed = pinion_speed * plane.r_bp / plane.r_bg
    u_p, u_g = R_p * pinion_speed, R_g * gear_speed
    entrainment = 0.5 * (u_p + u_g)
    slide_roll = (u_p - u_g) / entrainment if entrainment != 0.0 else 0.0
    return LineKinematics(
        R_p, R_g, R_p * R_g / ((R_p + R_g) * plane.cos_b), u_p, u_g, entrainment, u_p - u_g,
        slide_roll,
    )  # fmt: skip
