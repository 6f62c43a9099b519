"""Stiffness and damping of a member on two bearings: kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.helical_geometry.gear_body import SupportStiffness
from gearlube_core.kernels.jit import kernel


class MemberStiffness(NamedTuple):
    """Stiffness against displacement and tilt of a member; symmetric, all other terms are zero."""

    K_xx: float  # [N/m]
    K_yy: float
    K_zz: float
    K_ax: float  # against tilting about x [N.m/rad]
    K_ay: float
    K_x_ay: float  # coupling [N/rad]
    K_y_ax: float


@kernel
def bearing_at_gear(bearing: SupportStiffness) -> MemberStiffness:
    """Return T^T K_SB T of one bearing, see `support_matrices.support_stiffness`."""
    arm = bearing.position
    K_x_ay = arm * bearing.K_xx + bearing.K_x_theta_y
    K_y_ax = -arm * bearing.K_yy + bearing.K_y_theta_x
    return MemberStiffness(
        bearing.K_xx,
        bearing.K_yy,
        bearing.K_zz,
        -arm * K_y_ax + (-arm * bearing.K_y_theta_x + bearing.K_theta_x),
        arm * K_x_ay + (arm * bearing.K_x_theta_y + bearing.K_theta_y),
        K_x_ay,
        K_y_ax,
    )


@kernel
def member_stiffness(first: SupportStiffness, second: SupportStiffness) -> MemberStiffness:
    """Return the stiffness of both bearings of a member together."""
    a = bearing_at_gear(first)
    b = bearing_at_gear(second)
    return MemberStiffness(
        a.K_xx + b.K_xx,
        a.K_yy + b.K_yy,
        a.K_zz + b.K_zz,
        a.K_ax + b.K_ax,
        a.K_ay + b.K_ay,
        a.K_x_ay + b.K_x_ay,
        a.K_y_ax + b.K_y_ax,
    )


@kernel
def damping_constant(stiffness: float, mass: float, ratio: float) -> float:
    """Return c = 2 zeta sqrt(K m) [N s/m], or [N.m s/rad] of stiffness and inertia of a tilt."""
    return 2.0 * ratio * math.sqrt(stiffness * mass)


@kernel
def coupling_limit(stiffness: float, tilting_stiffness: float) -> float:
    """Return the largest coupling [N/rad] with which a bearing gives no energy away.

    Parameters
    ----------
    stiffness
        Along one axis [N/m].
    tilting_stiffness
        About the other [N.m/rad].
    """
    return math.sqrt(stiffness * tilting_stiffness)


@kernel
def replaced_bearing(
    bearing: SupportStiffness, side: float, radial: float, axial: float, distance: float
) -> SupportStiffness:
    """Return a bearing with what is not zero in the place of its own.

    Parameters
    ----------
    bearing
        Of the gear file.
    side
        +1 of the bearing at z > 0, -1 of the other [-].
    radial, axial
        Stiffness of both bearings of the member together [N/m].
    distance
        From mid-face [m].
    """
    return SupportStiffness(
        side * distance if distance > 0.0 else bearing.position,
        0.5 * radial if radial > 0.0 else bearing.K_xx,
        0.5 * radial if radial > 0.0 else bearing.K_yy,
        0.5 * axial if axial > 0.0 else bearing.K_zz,
        bearing.K_theta_x,
        bearing.K_theta_y,
        bearing.K_x_theta_y,
        bearing.K_y_theta_x,
    )
