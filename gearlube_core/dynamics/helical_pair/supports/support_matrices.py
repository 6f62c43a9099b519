"""Stiffness and damping of the members' supports as matrices."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.supports.shaft_support import (
    Bearing,
    ShaftEnds,
    ShaftSupport,
)
from gearlube_core.dynamics.helical_pair.supports.support_kernels import (
    damping_constant,
    member_stiffness,
)
from gearlube_core.helical_geometry.gear_body import SupportStiffness

_X, _Y, _Z, _THX, _THY = range(5)


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
