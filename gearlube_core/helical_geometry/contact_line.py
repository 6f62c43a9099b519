"""Contact lines of a helical pair on the plane of contact, clipped to it: kernels.

Frame of [he_2007 fig. 1]: the plane is tangent to both base cylinders; x runs along the line
of action from the pinion's tangent point, z along the axes with its origin at mid-face. A line
is named by X, its x on the face z = +W/2 as if the plane were unbounded; it lies at

    x = X - (W/2 - z) tan(b)

and moves with dX = r_bp dphi_p. Contact exists for A <= x <= D, |z| <= W/2.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.kernels.jit import kernel


class ContactPlane(NamedTuple):
    """The plane of contact; all floats, SI."""

    A: float  # x where contact starts: tip of the gear [m]
    D: float  # x where contact ends: tip of the pinion [m]
    P: float  # x of the pitch line [m]
    W: float  # face width [m]
    x_g: float  # x of the gear's tangent point [m]
    pitch: float  # transverse base pitch [m]
    sin_b: float  # of the base helix angle [-]
    cos_b: float
    r_bp: float  # base radii [m]
    r_bg: float


class LineSegment(NamedTuple):
    """The part of a contact line inside the plane; empty where z_high <= z_low."""

    z_low: float  # [m]
    z_high: float
    x_low: float  # at z_low [m]
    x_high: float  # at z_high [m]


@kernel
def line_count(plane: ContactPlane) -> int:
    """Return how many lines may be in contact at once: the total contact ratio, rounded up."""
    # the path of contact [jamali_2015 (2.1)] and what a line travels in contact [jamali_2015 (2.4)]
    travel = plane.D - plane.A + plane.W * plane.sin_b / plane.cos_b
    return math.ceil(travel / plane.pitch - 1.0e-12)


@kernel
def line_position(phase: float, pair: int, plane: ContactPlane) -> float:
    """Return X of line `pair` at a mesh phase.

    X_i = A + (phi - floor(phi) + i) lambda

    Parameters
    ----------
    phase
        Mesh phase [mesh periods]: r_bp times pinion rotation over base pitch; any number. At
        zero, line 0 enters at A.
    pair
        i = 0, 1, ...: lines by age; i of `line_count` lines can touch.
    plane
        Plane of contact of the pair.

    Returns
    -------
    float
        [m].

    Notes
    -----
    Source: [he_2007 (23a)] [he_2007 (23b)] [he_2007 (23c)]
    """
    return plane.A + (phase - math.floor(phase) + pair) * plane.pitch


@kernel
def clip_line(X: float, plane: ContactPlane) -> LineSegment:
    """Return the segment of line X inside the plane of contact.

    Parameters
    ----------
    X
        Of the line, on the face z = +W/2 [m].
    plane
        Any pair, any contact ratio; spur gears (b = 0) carry over the whole face at once.

    Returns
    -------
    LineSegment
        x rises with z.

    Notes
    -----
    One rule in place of the eight zones of He and the three cases of [jamali_2015 sec. 2.2.1].
    Source: [he_2007 (9a)] [he_2007 (9b)] [he_2007 (9c)] [he_2007 (24a)] [he_2007 (24b)]
    [he_2007 (24c)] [he_2007 (24d)] [he_2007 (24e)] [he_2007 (24f)] [he_2007 (24g)] [he_2007 (24h)]
    The line x = X - (W/2 - z) tan b is the law of (9a), (9b) and (9c); (24f) prints x_1 for x_2.
    """
    half = 0.5 * plane.W
    tan_b = plane.sin_b / plane.cos_b
    z_low, z_high = -half, half
    if plane.sin_b > 0.0:
        per_tan = plane.cos_b / plane.sin_b
        z_low = max(z_low, half - (X - plane.A) * per_tan)
        z_high = min(z_high, half - (X - plane.D) * per_tan)
    elif X < plane.A or X > plane.D:
        z_high = z_low
    if z_high <= z_low:
        return LineSegment(z_low, z_low, X, X)
    return LineSegment(z_low, z_high, X - (half - z_low) * tan_b, X - (half - z_high) * tan_b)


@kernel
def segment_length(segment: LineSegment, plane: ContactPlane) -> float:
    """Return the length of a segment along the line [m]."""
    return max(0.0, segment.z_high - segment.z_low) / plane.cos_b


@kernel
def pitch_crossing(X: float, segment: LineSegment, plane: ContactPlane) -> float:
    """Return z where a segment crosses the pitch line [m], moved to its nearer end otherwise.

    Sliding reverses there. Below it (towards z_low) the pinion's dedendum slides.
    """
    if plane.sin_b <= 0.0:
        return segment.z_low if X >= plane.P else segment.z_high
    z = 0.5 * plane.W - (X - plane.P) * (plane.cos_b / plane.sin_b)
    return min(max(z, segment.z_low), segment.z_high)


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
        Plane of contact of the pair.

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
