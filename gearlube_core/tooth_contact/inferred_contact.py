"""What a blank alone tells of the contact along a tooth: kinematics, curvature, contact ratio."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.blank.hypoid_blank import HypoidBlank
from gearlube_core.tooth_contact.conjugate_curvature import conjugate_relative_curvature

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class FlankKinematics:
    """Motion of the drive flanks along the path of contact, per unit pinion speed.

    Parameters
    ----------
    entrainment_arm : ndarray of shape (N,)
        Magnitude of the mean surface velocity in the tangent plane [m].
    psi : ndarray of shape (N,)
        Angle of entrainment from the minor axis of the ellipse [rad].
    friction_arm_p, friction_arm_g : ndarray of shape (N,)
        Arms of the friction force about the member's axis [m].
    xi : ndarray of shape (N, 3)
        Unit direction of the pinion's sliding over the gear [-].
    R_p : ndarray of shape (N,)
        Arm of the normal force about the pinion axis [m].
    """

    entrainment_arm: Array
    psi: Array
    friction_arm_p: Array
    friction_arm_g: Array
    xi: Array
    R_p: Array


def profile_direction(blank: HypoidBlank) -> Array:
    """Return the unit vector in the flank, across the tooth trace, towards the pinion tip."""
    direction = np.cross(blank.drive_flank_normal(), blank.tooth_trace())
    return -direction * np.sign(direction @ blank.pitch_normal())


def relative_curvature_radius(blank: HypoidBlank) -> tuple[float, Array]:
    """Return the relative radius across the line of contact [m] and its direction, shape (3,).

    The Formate gear flank is straight in profile and follows the cutter lengthwise; the pinion is
    taken as its conjugate, so the result is that of line contact (no mismatch in profile).
    """
    normal, trace, point = blank.drive_flank_normal(), blank.tooth_trace(), blank.mean_point()
    lengthwise = math.cos(blank.normal_pressure_angle) / blank.gear_cutter_radius
    omega_p, omega_g = blank.pinion_axis, blank.gear_axis / blank.ratio
    result = conjugate_relative_curvature(
        shape_operator=lengthwise * np.outer(trace, trace),
        normal=normal,
        velocity_1=np.cross(omega_g, point - blank.gear_apex),
        velocity_2=np.cross(omega_p, point - blank.pinion_apex),
        omega_1=omega_g,
        omega_2=omega_p,
    )
    return 1.0 / result.curvature, result.across


def kinematics_along_profile(blank: HypoidBlank, position: Array) -> FlankKinematics:
    """Return the motion where the contact stands `position` [m] towards the pinion tip, (N,)."""
    normal = blank.drive_flank_normal()
    across = relative_curvature_radius(blank)[1]
    points = blank.mean_point() + position[:, None] * profile_direction(blank)
    arm_p = np.cross(blank.pinion_axis, points - blank.pinion_apex)
    arm_g = np.cross(blank.gear_axis, points - blank.gear_apex)

    def tangential(v: Array) -> Array:
        return v - np.outer(v @ normal, normal)

    v_p, v_g = tangential(arm_p), tangential(arm_g / blank.ratio)
    entrainment = 0.5 * (v_p + v_g)
    speed = np.linalg.norm(entrainment, axis=1)
    sliding = v_p - v_g
    xi = sliding / np.linalg.norm(sliding, axis=1)[:, None]
    return FlankKinematics(
        entrainment_arm=speed,
        psi=np.arccos(np.minimum(1.0, np.abs(entrainment @ across) / speed)),
        friction_arm_p=np.einsum("ij,ij->i", xi, arm_p),
        friction_arm_g=np.einsum("ij,ij->i", xi, arm_g),
        xi=xi,
        R_p=arm_p @ normal,
    )


def contact_ratio_bounds(blank: HypoidBlank) -> tuple[float, float]:
    """Return a lower and an upper bound of the contact ratio [-].

    Profile and face contact ratios eps_a, eps_b of the virtual helical pair at the mean spiral
    angle (the mean of the members'); the modified ratio sqrt(eps_a^2 + eps_b^2) holds for contact
    that runs diagonally over the flank, the sum for contact that fills it.

    References
    ----------
    ISO 10300-1 (virtual cylindrical gears); Stadtfeld 1993 (modified contact ratio).
    """
    beta = 0.5 * (abs(blank.pinion.spiral_angle) + abs(blank.gear.spiral_angle))
    alpha_t = math.atan(math.tan(blank.normal_pressure_angle) / math.cos(beta))
    radii = [m.mean_pitch_radius / math.cos(m.pitch_angle) for m in (blank.pinion, blank.gear)]
    addenda = [blank.pinion.addendum, blank.gear.addendum]
    path = -sum(radii) * math.sin(alpha_t)
    for radius, addendum in zip(radii, addenda, strict=True):
        path += math.sqrt((radius + addendum) ** 2 - (radius * math.cos(alpha_t)) ** 2)
    module = blank.mean_normal_module
    profile = path * math.cos(beta) / (math.pi * module * math.cos(alpha_t))
    face = blank.gear.face_width * math.sin(beta) / (math.pi * module)
    return math.hypot(profile, face), profile + face
