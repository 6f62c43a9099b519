"""Curvature and motion at opposite points of two flanks: data for film, friction and forces."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_path import ContactPath
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import placed_axis, placed_sample, shape_operator
from gearlube_core.hypoid_geometry.flank.flank import Flank, FlankSample

_LARGEST_LEAN = 0.1  # rad, between normals that still count as opposite: edges lean
_LARGEST_GAP = 1e-3  # m, between points that still count as opposite


@dataclass(frozen=True, slots=True)
class ContactKinematics:
    """Geometry and motion of the contact at N positions, fixed frame, per unit pinion speed.

    Signs as in docs/conventions.md: `normal` points from the pinion into the gear on the drive
    flanks and from the gear into the pinion on the coast flanks, so that R_p and R_g are positive.
    Velocities are those of the bodies' points; lengths per rad of pinion angle, so in m.

    Parameters
    ----------
    r, normal : ndarray of shape (N, 3)
        Midway between the two points [m]; common unit normal [-].
    R_p, R_g : ndarray of shape (N,)
        Arms of the normal force n . (j x r) about the pinion's and the gear's axis [m].
    relative_curvature : ndarray of shape (N, 3, 3)
        Curvature of the gap in the tangent plane, in the fixed frame [1/m].
    R_x, R_y : ndarray of shape (N,)
        Principal radii of the gap [m], along the minor and the major axis of the ellipse; R_y is
        negative where the flanks do not touch like a bowl.
    minor_axis, major_axis : ndarray of shape (N, 3)
        Unit vectors [-]; minor towards the entrainment, major = normal x minor.
    velocity_p, velocity_g : ndarray of shape (N, 3)
        Tangential velocities of pinion and gear, the gear at the teeth ratio [m].
    ratio : float
        Teeth ratio gear / pinion [-].
    """

    r: Array
    normal: Array
    R_p: Array
    R_g: Array
    relative_curvature: Array
    R_x: Array
    R_y: Array
    minor_axis: Array
    major_axis: Array
    velocity_p: Array
    velocity_g: Array
    ratio: float

    @property
    def entrainment(self) -> Array:
        """Mean tangential velocity of both surfaces [m], (N, 3)."""
        return 0.5 * (self.velocity_p + self.velocity_g)

    @property
    def entrainment_arm(self) -> Array:
        """Magnitude of the entrainment [m], (N,)."""
        return np.asarray(np.linalg.norm(self.entrainment, axis=1))

    @property
    def sliding(self) -> Array:
        """Velocity of the pinion over the gear flank [m], (N, 3)."""
        return self.velocity_p - self.velocity_g

    @property
    def xi(self) -> Array:
        """Unit direction of the pinion's sliding over the gear flank [-], (N, 3)."""
        sliding = self.sliding
        return np.asarray(sliding / np.linalg.norm(sliding, axis=1)[:, None])

    @property
    def psi(self) -> Array:
        """Angle of the entrainment from the minor axis [rad], 0 to pi/2, (N,)."""
        along = np.abs(_dot(self.entrainment, self.minor_axis))
        return np.arctan2(np.abs(_dot(self.entrainment, self.major_axis)), along)

    @property
    def friction_arm_p(self) -> Array:
        """Arm of a force along xi about the pinion axis [m], (N,); [karagiannis_2012 (8)]."""
        return _dot(self.xi, self.velocity_p)

    @property
    def friction_arm_g(self) -> Array:
        """Arm of a force along xi about the gear axis [m], (N,); [karagiannis_2012 (9)]."""
        return _dot(self.xi, self.velocity_g) * self.ratio

    @property
    def R_sliding(self) -> Array:
        """Radius of the gap along the sliding direction [m], (N,); [karagiannis_2012 fig. 18a]."""
        return self.radius_along(self.xi)

    def radius_along(self, direction: Array) -> Array:
        """Return the radius of the gap [m] in the section along unit tangents (N, 3)."""
        K = self.relative_curvature
        return np.asarray(1.0 / np.einsum("ni,nij,nj->n", direction, K, direction))


def path_kinematics(path: ContactPath) -> ContactKinematics:
    """Return the kinematics along a path of contact; NaN where the path has no contact."""
    return contact_kinematics(
        path.pair,
        path.gear_angle,
        path.pinion_angle,
        path.gear_parameters,
        path.pinion_parameters,
    )


def contact_kinematics(
    pair: FlankPair,
    gear_angle: Array,
    pinion_angle: Array,
    gear_parameters: Array,
    pinion_parameters: Array,
) -> ContactKinematics:
    """Return curvature and motion at opposite points of both flanks.

    1/R = eigenvalues of -(K_p + K_g),  v_p = j_p x r,  v_g = (z_p / z_g) j_g x r

    with both shape operators for outward normals and velocities projected on the tangent plane.
    Corrections of the flanks tilt the normals by the slope of their removal, at most 0.1, and add
    its second derivatives to the curvature.

    Parameters
    ----------
    pair : FlankPair
    gear_angle, pinion_angle : ndarray of shape (N,)
        [rad].
    gear_parameters, pinion_parameters : ndarray of shape (N, 3)
        u [m], th, ph [rad] of the opposite points: of a contact, or of two points that face each
        other across the gap near one.

    Raises
    ------
    ParameterError
        When points lie more than 1 mm or normals more than 0.02 rad from opposite.

    References
    ----------
    [karagiannis_2012 (7)]; [litvin_fuentes_2004 ch. 9.3] (contact ellipse).
    """
    gear = placed_sample(pair.gear, pair.gear_base, pair.gear_turn(gear_angle), gear_parameters)
    turns = pair.pinion_turn(pinion_angle)
    pinion = placed_sample(pair.pinion, pair.pinion_base, turns, pinion_parameters)
    _check_opposite(pinion.r - gear.r, pinion.normal + gear.normal)
    normal = pair.touching_sign * (pinion.normal - gear.normal)
    if pair.is_corrected:
        lean = _lean(pair.pinion, pinion, pinion_parameters)
        lean -= _lean(pair.gear, gear, gear_parameters)
        normal += pair.touching_sign * lean
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    r = 0.5 * (pinion.r + gear.r)
    arm_p = _swing(*placed_axis(pair.pinion, pair.pinion_base), r, -1.0)
    arm_g = _swing(*placed_axis(pair.gear, pair.gear_base), r, 1.0)
    velocity_p = _tangential(arm_p, normal)
    velocity_g = _tangential(arm_g, normal) / pair.ratio
    entrainment = 0.5 * (velocity_p + velocity_g)
    curvature = -(shape_operator(pinion) + shape_operator(gear))
    if pair.is_corrected:
        for flank, placed, own in (
            (pair.pinion, pinion, pinion_parameters),
            (pair.gear, gear, gear_parameters),
        ):
            bend = flank.removal_bend(flank.sample_parameters(own))
            curvature += shape_operator(replace(placed, curvature=bend))
    project = np.eye(3) - normal[:, :, None] * normal[:, None, :]
    curvature = project @ curvature @ project
    R_x, R_y, minor = _principal(curvature, normal, entrainment)
    return ContactKinematics(
        r=r,
        normal=normal,
        R_p=_dot(arm_p, normal),
        R_g=_dot(arm_g, normal),
        relative_curvature=curvature,
        R_x=R_x,
        R_y=R_y,
        minor_axis=minor,
        major_axis=np.cross(normal, minor),
        velocity_p=velocity_p,
        velocity_g=velocity_g,
        ratio=pair.ratio,
    )


def _lean(flank: Flank, placed: FlankSample, parameters: Array) -> Array:
    """Return by how much corrections tilt a flank's outward normal [-], (N, 3), fixed frame."""
    slope = flank.removal_slope(flank.sample_parameters(parameters))
    size = np.linalg.norm(slope, axis=1)
    slope *= np.minimum(1.0, _LARGEST_LEAN / np.maximum(size, _LARGEST_LEAN))[:, None]
    return slope[:, :1] * placed.tangent_1 + slope[:, 1:] * placed.tangent_2


def _principal(curvature: Array, normal: Array, towards: Array) -> tuple[Array, Array, Array]:
    """Return R_x, R_y [m] and the unit minor axis, turned `towards` a direction."""
    t1 = towards / np.linalg.norm(towards, axis=1)[:, None]
    t2 = np.cross(normal, t1)
    a, b, c = (
        np.einsum("ni,nij,nj->n", p, curvature, q) for p, q in ((t1, t1), (t1, t2), (t2, t2))
    )
    # the larger eigenvalue's direction stands at half the angle of Mohr's circle
    angle = 0.5 * np.arctan2(2.0 * b, a - c)
    mean, radius = 0.5 * (a + c), np.hypot(0.5 * (a - c), b)
    minor = np.cos(angle)[:, None] * t1 + np.sin(angle)[:, None] * t2
    return 1.0 / (mean + radius), 1.0 / (mean - radius), minor


def _swing(axis: Array, point: Array, r: Array, sign: float) -> Array:
    """Return j x r about an axis, j being `sign` times the work axis: the drive direction."""
    return np.cross(sign * axis, r - point)


def _tangential(v: Array, normal: Array) -> Array:
    return v - _dot(v, normal)[:, None] * normal


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(np.einsum("ni,ni->n", a, b))


def _check_opposite(gap: Array, lean: Array) -> None:
    for what, values, limit, unit in (
        ("points of both flanks", gap, _LARGEST_GAP, "m"),
        ("normals of both flanks", lean, _LARGEST_LEAN, "rad"),
    ):
        size = np.linalg.norm(values, axis=1)
        if (size > limit).any():
            raise ParameterError(
                f"The {what} must be opposite within {limit:g} {unit}, got "
                f"{np.nanmax(size):.3g} {unit} at position {int(np.nanargmax(size))}. Give points "
                "that face each other and the angles at which they do."
            )
