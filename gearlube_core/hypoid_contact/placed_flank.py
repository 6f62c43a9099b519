"""Flank points, normals and curvatures in the fixed frame, each at its own rotation."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.placement import Placement, place_direction
from gearlube_core.hypoid_geometry.flank.flank import Flank, FlankSample
from gearlube_core.hypoid_geometry.flank.vectors import Vector


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
