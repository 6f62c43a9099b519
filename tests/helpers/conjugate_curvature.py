"""Relative curvature of two conjugate surfaces from the motion and one surface's curvature."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError


class RelativeCurvature(NamedTuple):
    """Curvature across the line of contact [1/m] and its unit direction, shape (3,)."""

    curvature: float
    across: Array


def conjugate_relative_curvature(
    *,
    shape_operator: Array,
    normal: Array,
    velocity_1: Array,
    velocity_2: Array,
    omega_1: Array,
    omega_2: Array,
) -> RelativeCurvature:
    """Return the relative curvature of two conjugate (line contact) surfaces at a point.

    With w = K1 v12 + omega12 x n (in the tangent plane), differentiating the equation of meshing
    n . v12 = 0 along the motion gives

        kappa = w.w / [ (omega1 x n).v12 + n.(omega12 x v1) + w.v12 ]

    across the line of contact, in the direction w / abs(w).

    Parameters
    ----------
    shape_operator : ndarray of shape (3, 3)
        Shape operator K1 of surface 1 [1/m], dn = -K1 dr, positive if the centre of curvature
        lies on the side to which `normal` points.
    normal : ndarray of shape (3,)
        Common unit normal, from surface 2 into body 1.
    velocity_1, velocity_2 : ndarray of shape (3,)
        Velocities of the bodies' points at the contact [m/s].
    omega_1, omega_2 : ndarray of shape (3,)
        Angular velocities [rad/s], constant.

    Raises
    ------
    ParameterError
        When n . v12 is not zero: the point is not a point of contact.

    References
    ----------
    Litvin and Fuentes 2004, Gear Geometry and Applied Theory, chapter 8 (same result, there in
    coordinates a31, a32, a33).
    """
    v12 = velocity_1 - velocity_2
    approach = abs(float(normal @ v12))
    scale = float(np.linalg.norm(velocity_1) + np.linalg.norm(velocity_2))
    if approach > 1e-2 * scale:
        raise ParameterError(
            f"n . v12 must be zero within 1 % of the speeds {scale:g} m/s, got {approach:g} m/s. "
            "The point is no point of contact; check the ratio and the normal."
        )
    omega_12 = omega_1 - omega_2
    w = shape_operator @ v12 + np.cross(omega_12, normal)
    w = w - (w @ normal) * normal
    migration = np.cross(omega_1, normal) @ v12 + normal @ np.cross(omega_12, velocity_1)
    kappa = float(w @ w / (migration + w @ v12))
    return RelativeCurvature(kappa, w / np.linalg.norm(w))
