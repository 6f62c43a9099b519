"""Position of a member, its rotation and misalignment, and a flank placed so."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion
from gearlube_core.hypoid_geometry.flank.flank import Flank, FlankSample
from gearlube_core.hypoid_geometry.flank.vectors import Vector, add, rotate, subtract
from gearlube_core.kernels.jit import kernel

_LENGTH = "Misalignments are small; give metres."
_ANGLE = "Misalignments are small; give radians."


@dataclass(frozen=True, slots=True, kw_only=True)
class Misalignment:
    """Displacement of the members from their nominal places.

    Parameters
    ----------
    pinion_offset : float
        Growth of the distance of the axes (E) [m].
    pinion_axial : float
        Pinion away from the crossing point (P) [m].
    gear_axial : float
        Gear away from the crossing point (G) [m].
    shaft_angle : float
        Growth of the shaft angle [rad].
    """

    pinion_offset: float = 0.0
    pinion_axial: float = 0.0
    gear_axial: float = 0.0
    shaft_angle: float = 0.0

    def __post_init__(self) -> None:
        for name in ("pinion_offset", "pinion_axial", "gear_axial"):
            check_within(name, getattr(self, name), -5e-3, 5e-3, "m", _LENGTH)
        check_within("shaft_angle", self.shaft_angle, -0.05, 0.05, "rad", _ANGLE)


ALIGNED = Misalignment()


class Placement(NamedTuple):
    """Rigid motion from a member's own frame (rotation zero) to the fixed frame.

    Rotation about the member's axis, then a tilt about y, then a shift.
    """

    point: Vector
    axis: Vector
    cosine: float
    sine: float
    tilt_cosine: float
    tilt_sine: float
    shift: Vector


@kernel
def place_direction(placement: Placement, a: Vector) -> Vector:
    """Return the direction `a` of the member in the fixed frame."""
    a = rotate(a, placement.axis, placement.cosine, placement.sine)
    c, s = placement.tilt_cosine, placement.tilt_sine
    return Vector(c * a.x + s * a.z, a.y, c * a.z - s * a.x)


@kernel
def place_point(placement: Placement, r: Vector) -> Vector:
    """Return the point `r` [m] of the member in the fixed frame."""
    w = rotate(subtract(r, placement.point), placement.axis, placement.cosine, placement.sine)
    w = add(w, placement.point)
    c, s = placement.tilt_cosine, placement.tilt_sine
    return add(Vector(c * w.x + s * w.z, w.y, c * w.z - s * w.x), placement.shift)


@kernel
def turned(placement: Placement, angle: float) -> Placement:
    """Return the placement with the member at the rotation `angle` [rad] about its work axis."""
    return Placement(
        placement.point,
        placement.axis,
        math.cos(angle),
        math.sin(angle),
        placement.tilt_cosine,
        placement.tilt_sine,
        placement.shift,
    )


def pinion_placement(motion: CuttingMotion, misalignment: Misalignment) -> Placement:
    """Return the placement of the pinion at rotation zero."""
    c, s = math.cos(misalignment.shaft_angle), math.sin(misalignment.shaft_angle)
    axial = misalignment.pinion_axial
    shift = Vector(axial * c, misalignment.pinion_offset, -axial * s)
    return Placement(motion.work_point, motion.work_axis, 1.0, 0.0, c, s, shift)


def gear_placement(motion: CuttingMotion, misalignment: Misalignment) -> Placement:
    """Return the placement of the gear at rotation zero."""
    shift = Vector(0.0, 0.0, misalignment.gear_axial)
    return Placement(motion.work_point, motion.work_axis, 1.0, 0.0, 1.0, 0.0, shift)


def placed_sample(flank: Flank, base: Placement, turns: Array, parameters: Array) -> FlankSample:
    """Return the flank at cutting parameters, in the fixed frame.

    Parameters
    ----------
    flank : Flank
    base : Placement
        Of the member at rotation zero.
    turns : ndarray of shape (N,)
        Rotation about the work axis [rad] of each point.
    parameters : ndarray of shape (N, 3)
        u [m], th, ph [rad]; NaN gives NaN.
    """
    own = flank.sample_parameters(parameters)
    spin = Rotation.from_rotvec(np.asarray(turns)[:, None] * flank.axis)
    tilt = _tilt(base)

    def direction(a: Array) -> Array:
        return spin.apply(a) @ tilt.T

    r = (spin.apply(own.r - flank.axis_point) + flank.axis_point) @ tilt.T + np.array(base.shift)
    return FlankSample(
        r,
        direction(own.normal),
        direction(own.tangent_1),
        direction(own.tangent_2),
        own.curvature,
        own.regularity,
    )


def placed_axis(flank: Flank, base: Placement) -> tuple[Array, Array]:
    """Return the work axis in the fixed frame: unit vector and a point [m], each (3,)."""
    tilt = _tilt(base)
    return tilt @ flank.axis, tilt @ flank.axis_point + np.array(base.shift)


def tooth_position(flank: Flank, r: Array) -> tuple[Array, Array]:
    """Return profile and face position s, t [-] of points (..., 3) [m] in the member's frame."""
    return flank.position(r)


def shape_operator(sample: FlankSample) -> Array:
    """Return the shape operators as matrices in the fixed frame [1/m], (N, 3, 3)."""
    tangents = np.stack([sample.tangent_1, sample.tangent_2], axis=-1)
    return np.einsum("nia,nab,njb->nij", tangents, sample.curvature, tangents)


def _tilt(base: Placement) -> Array:
    """Return the rotation of a member at rotation zero into the fixed frame, (3, 3)."""
    columns = [place_direction(base, Vector(*row)) for row in np.eye(3).tolist()]
    return np.array(columns).T
