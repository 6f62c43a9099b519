"""Bearings and shafts that carry a member."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.contact.solid import YOUNGS_MODULUS
from gearlube_core.dynamics.helical_pair.kernel_parameters import SupportArrays
from gearlube_core.helical_geometry.gear_body import (
    COUPLING,
    POSITION,
    STIFFNESS,
    TILTING,
    SupportStiffness,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Checked, Positive, check_fields

Series = Literal["beam", "term_by_term"]
COUPLING_CURE = "A larger coupling would give energy away; raise the stiffness against tilting."
_X, _Y, _Z, _THX, _THY = range(5)
BEARING_FORCES = tuple(
    f"{kind}_{axis}{member}" for member in "pg" for kind in "FM" for axis in "xyz"
)


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
    """Return T^T K_SB T of one bearing, see `support_stiffness`."""
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
    """Return a bearing with what is not zero instead of its own.

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Bearing:
    """Linear stiffness of one bearing and where it sits.

    Parameters
    ----------
    position : float
        z of the bearing from the gear's mid-face [m]: +l1 or -l2.
    K_xx, K_yy, K_zz : float
        Along the line of action, off it and axial [N/m].
    K_theta_x, K_theta_y : float
        Against tilting [N.m/rad].
    K_x_theta_y, K_y_theta_x : float
        Coupling [N/rad].

    References
    ----------
    [he_2007 (26)]; its K_xz and K_z_theta_y drop out of (27) and are left out here.
    """

    position: Annotated[float, POSITION]
    K_xx: Annotated[float, STIFFNESS]
    K_yy: Annotated[float, STIFFNESS]
    K_zz: Annotated[float, STIFFNESS]
    K_theta_x: Annotated[float, TILTING] = 0.0
    K_theta_y: Annotated[float, TILTING] = 0.0
    K_x_theta_y: Annotated[float, COUPLING] = 0.0
    K_y_theta_x: Annotated[float, COUPLING] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        for a, b, c in (("xx", "theta_y", "x_theta_y"), ("yy", "theta_x", "y_theta_x")):
            limit = coupling_limit(float(getattr(self, f"K_{a}")), float(getattr(self, f"K_{b}")))
            check_within(f"K_{c}", getattr(self, f"K_{c}"), -limit, limit, "N/rad", COUPLING_CURE)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftEnds(Checked):
    """Two stretches of a solid round shaft, from the gear body to each bearing.

    Parameters
    ----------
    radius : float
        [m]
    youngs_modulus : float
        [Pa]
    series : {"beam", "term_by_term"}
        Flexibilities of shaft end and bearing added as matrices; or term by term, [he_2007 (27)].

    References
    ----------
    [he_2007 (25)], taken per side: 3 E I/l^3, 3 E I/l^2, 3 E I/l, A E/l.
    """

    radius: Annotated[float, Positive("m", "Give metres, not millimetres.")]
    youngs_modulus: Annotated[float, YOUNGS_MODULUS]
    series: Series = "beam"

    @property
    def bending(self) -> float:
        """E I [N m2]."""
        return self.youngs_modulus * math.pi * self.radius**4 / 4.0

    @property
    def extension(self) -> float:
        """E A [N]."""
        return self.youngs_modulus * math.pi * self.radius**2


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftSupport:
    """Two bearings and, between them and the gear body, an elastic shaft or none.

    Parameters
    ----------
    first, second : Bearing
        At z = +l1 and z = -l2.
    shaft : ShaftEnds, optional
        Rigid without.
    """

    first: Bearing
    second: Bearing
    shaft: ShaftEnds | None = None

    def __post_init__(self) -> None:
        cure = "Bearing 1 sits at z = +l1, bearing 2 at z = -l2."
        check_positive("first.position", self.first.position, "m", cure)
        check_positive("-second.position", -self.second.position, "m", cure)


def bearing_matrix(bearing: Bearing, shaft: ShaftEnds | None) -> Array:
    """Return K_SB of one bearing, with its shaft end in series, at the bearing; shape (6, 6).

    Notes
    -----
    "beam": K_B (1 + S K_B)^-1 with the flexibility S of a beam that is clamped in the gear body,
    l^3/(3 E I), l^2/(2 E I), l/(E I) and l/(E A). "term_by_term": [he_2007 (27)] with
    the terms of [he_2007 (25)] per side; a zero in either matrix stays zero. The lever arm between
    the two frames belongs to `support_stiffness`.
    """
    K = np.zeros((6, 6))
    K[_X, _X], K[_Y, _Y], K[_Z, _Z] = bearing.K_xx, bearing.K_yy, bearing.K_zz
    K[_THX, _THX], K[_THY, _THY] = bearing.K_theta_x, bearing.K_theta_y
    K[_X, _THY] = K[_THY, _X] = bearing.K_x_theta_y
    K[_Y, _THX] = K[_THX, _Y] = bearing.K_y_theta_x
    if shaft is None:
        return K
    length, side = abs(bearing.position), np.sign(bearing.position)
    bending, extension = shaft.bending, shaft.extension
    if shaft.series == "beam":
        S = np.zeros((6, 6))
        S[_X, _X] = S[_Y, _Y] = length**3 / (3.0 * bending)
        S[_THX, _THX] = S[_THY, _THY] = length / bending
        # a force along +x turns the shaft end at z > 0 by +th_y, one along +y by -th_x
        S[_X, _THY] = S[_THY, _X] = side * length**2 / (2.0 * bending)
        S[_Y, _THX] = S[_THX, _Y] = -side * length**2 / (2.0 * bending)
        S[_Z, _Z] = length / extension
        return np.asarray(K @ np.linalg.inv(np.eye(6) + S @ K))
    translation, coupling = 3.0 * bending / length**3, 3.0 * bending / length**2
    for i, j, shaft_term in (
        (_X, _X, translation), (_Y, _Y, translation), (_Z, _Z, extension / length),
        (_THX, _THX, 3.0 * bending / length), (_THY, _THY, 3.0 * bending / length),
        (_X, _THY, coupling), (_Y, _THX, coupling),
    ):  # fmt: skip
        size = abs(K[i, j])
        K[i, j] = K[j, i] = np.sign(K[i, j]) * size * shaft_term / (size + shaft_term)
    return K


def shaft_springs(support: ShaftSupport) -> tuple[SupportStiffness, SupportStiffness]:
    """Return both bearings of a member with their shaft ends in series, as kernels take them."""

    def spring(bearing: Bearing) -> SupportStiffness:
        K = bearing_matrix(bearing, support.shaft)
        floats = (
            bearing.position, K[_X, _X], K[_Y, _Y], K[_Z, _Z], K[_THX, _THX], K[_THY, _THY],
            K[_X, _THY], K[_Y, _THX],
        )  # fmt: skip
        return SupportStiffness(*map(float, floats))

    return spring(support.first), spring(support.second)


def support_stiffness(support: ShaftSupport) -> Array:
    """Return the stiffness K = sum T^T K_SB T against (u, theta) of the member, shape (6, 6).

    T carries the member's motion to the bearing at z = l: u_x + l th_y, u_y - l th_x.

    Notes
    -----
    Symmetric, on pinion and gear alike.
    Source: [he_2007 (28)] [he_2007 (29)] [he_2007 (30)] [he_2007 (31)]
    (28) agrees; in (29), (30) and (31) misprints are put right, see `printed_support_stiffness`.
    """
    first, second = shaft_springs(support)
    member = member_stiffness(first, second)
    K = np.zeros((6, 6))
    np.fill_diagonal(K, (*member[:5], 0.0))
    K[_X, _THY] = K[_THY, _X] = member.K_x_ay
    K[_Y, _THX] = K[_THX, _Y] = member.K_y_ax
    return K


def printed_support_stiffness(support: ShaftSupport) -> Array:
    """Return the matrix of [he_2007 (28)] and [he_2007 (29)] as printed, shape (6, 6).

    Notes
    -----
    The second bearing's moments have the wrong sign, so that its lever arm cancels the first's;
    tilting stiffness K_theta and the reciprocal coupling terms are missing. Not symmetric.
    (30), (31) are the gear's and repeat this with further misprints of indices, not kept.
    """
    K = np.zeros((6, 6))
    for bearing in (support.first, support.second):
        K_SB, lever, arm = (
            bearing_matrix(bearing, support.shaft), bearing.position, abs(bearing.position),
        )  # fmt: skip
        K[_X, _X] += K_SB[_X, _X]
        K[_X, _THY] += K_SB[_X, _X] * lever + K_SB[_X, _THY]
        K[_Y, _Y] += K_SB[_Y, _Y]
        K[_Y, _THX] += -K_SB[_Y, _Y] * lever + K_SB[_Y, _THX]
        K[_Z, _Z] += K_SB[_Z, _Z]
        K[_THX, _Y] += -arm * K_SB[_Y, _Y]
        K[_THX, _THX] += arm * lever * K_SB[_Y, _Y] - arm * K_SB[_Y, _THX]
        K[_THY, _X] += arm * K_SB[_X, _X]
        K[_THY, _THY] += arm * lever * K_SB[_X, _X] + arm * K_SB[_X, _THY]
    return K


def support_damping(
    support: ShaftSupport, mass: float, inertia: float, ratio: float, per_bearing: bool
) -> Array:
    """Return the damping constants [N s/m, N.m s/rad] of (u, theta), shape (6,); th_z has none.

    c = 2 zeta sqrt(K m) with the total stiffness and mass or inertia of each motion, or
    2 zeta sum_j sqrt(K_j m) with the translations' stiffness per bearing.

    Notes
    -----
    The sum per bearing (as printed) is sqrt(2) times the total's for
    two equal bearings, and at odds with the paper's own bearing force, which has the total. (33)
    prints 2 m_g for m_g.
    Source: [he_2007 (32)] [he_2007 (33)] [he_2007 (34a)] [he_2007 (34b)] [he_2007 (35a)]
    [he_2007 (35b)]
    """
    total = np.diag(support_stiffness(support)).tolist()
    masses = (*3 * (float(mass),), *2 * (float(inertia),), 0.0)
    pairs = zip(total, masses, strict=True)
    c = np.array([damping_constant(K, m, float(ratio)) for K, m in pairs])
    if per_bearing:
        each = [bearing_matrix(b, support.shaft) for b in (support.first, support.second)]
        roots = sum(np.sqrt(np.diag(K)[:3] * mass) for K in each)
        c[:3] = 2.0 * ratio * roots
    return c


def bearing_forces(supports: SupportArrays, displacement: Array, rate: Array) -> Array:
    """Return forces and moments of both members' bearings on them, shape (N, 12) [N, N.m].

    F = -K u - c du/dt, in the order of `BEARING_FORCES`

    Parameters
    ----------
    supports
        Matrices of both members.
    displacement, rate : ndarray of shape (N, 11)
        Of the coordinates `linear_system.RELATIVE`, whose rotation no bearing feels.

    Notes
    -----
    Source: [he_2007 sec. 6], where du/dt is missing.
    """
    forces = np.zeros((displacement.shape[0], 12))
    for member in range(2):
        columns, first = slice(5 * member, 5 * member + 5), 6 * member
        forces[:, first : first + 6] = (
            -displacement[:, columns] @ supports.stiffness[member, :, :5].T
        )
        forces[:, first : first + 5] -= rate[:, columns] * supports.damping[member, :5]
    return forces
