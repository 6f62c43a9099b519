"""Compression of the flanks, line loads, and the forces that they exert: kernels.

With y = (y0, y1) the strains of the plane of contact and p = x sin b + z cos b the coordinate along
the contact lines, delta = y0 + p y1. Forces follow from five sums over the lines,

    sums = (w, w p, r, r x, r z)  integrated over dl,  r = -mu w sign(v_s)

of which the first two are the flank loads' and the others friction's. Everything that sets up
forces or matrices of the mesh goes through `plane_strain` and `mesh_wrench`.

The linear mesh as fourteen numbers of the phase: moments of stiffness along the lines.

For linear contact the sums of `mesh_wrench` are

    sums = G y - g,   y = (y0, y1) of `mesh_strain`

with G of shape (5, 2) and g of shape (5,) moments of k and k e over the lines. K_mesh = -W G E,
W of shape (12, 5) and E of shape (2, 12) constant: rank two without friction, because delta varies
along the lines only.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.kernel_parameters import MeshArrays
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    DENSITY,
    LENGTH,
    MU,
    OFFSET,
    SLIDING,
    X,
    Z,
    constant_friction,
    contact_points,
)
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel

N_SUMS = 5


class Wrench(NamedTuple):
    """Forces and moments of the mesh on both members."""

    F_x: float  # on the pinion; the gear has the opposite [N]
    F_y: float
    F_z: float
    M_px: float  # on the pinion [N.m]
    M_py: float
    M_pz: float
    M_gx: float  # on the gear
    M_gy: float
    M_gz: float


@kernel
def plane_strain(
    closing: float,
    axial: float,
    th_xp: float,
    th_yp: float,
    th_xg: float,
    th_yg: float,
    plane: ContactPlane,
) -> tuple[float, float]:
    """Return y0 [m] and y1 [rad] of the compression delta = y0 + (x sin b + z cos b) y1.

    Parameters
    ----------
    closing
        u_xp - u_xg and the rotations' part -(r_bp th_zp + r_bg th_zg) [m].
    axial
        u_zp - u_zg [m].
    th_xp, th_yp, th_xg, th_yg
        [rad]

    Notes
    -----
    Source: [he_2007 (3a)] [he_2007 (3b)] [he_2007 (4)] [he_2007 (18c)] [he_2007 (18d)]
    [he_2007 (18e)]
    The sign of (4) is reversed, so that compression is positive, as the forces need it: with the
    printed sign flanks that press attract each other. Of the motions (3a), (3b) only the difference
    along the normal counts; (3b) prints th_zp for th_zg. y0 and y1 hold c1, c2 and c3 of (18c) to
    (18e), with x_g for the misprinted x_e.
    """
    tilted = axial + (plane.r_bp * th_xp + plane.r_bg * th_xg) - plane.x_g * th_yg
    return plane.cos_b * closing - plane.sin_b * tilted, th_yp - th_yg


@kernel
def mesh_strain(q: Array, plane: ContactPlane) -> tuple[float, float]:
    """Return `plane_strain` of displacements `q` in the order of `COORDINATES`, shape (12,)."""
    closing = (q[0] - q[6]) - (plane.r_bp * q[5] + plane.r_bg * q[11])
    return plane_strain(closing, q[2] - q[8], q[3], q[4], q[9], q[10], plane)


@kernel
def sign(value: float) -> float:
    """Return -1, 0 or 1."""
    return (1.0 if value > 0.0 else 0.0) - (1.0 if value < 0.0 else 0.0)


@kernel
def mesh_wrench(w: float, wp: float, r: float, rx: float, rz: float, plane: ContactPlane) -> Wrench:
    """Return the forces and moments of the five sums on both members.

    Notes
    -----
    Source: [he_2007 (7)] [he_2007 (11a)] [he_2007 (11b)] [he_2007 (15)] [he_2007 (16)]
    [he_2007 (20)] [he_2007 (21)] [he_2007 (22)]
    (21) with x_g for the misprinted x_e; in the third row of (22) the first term lacks mu.
    """
    return Wrench(
        -plane.cos_b * w,
        r,
        plane.sin_b * w,
        plane.r_bp * plane.sin_b * w - rz,
        -wp,
        rx + plane.r_bp * plane.cos_b * w,
        plane.r_bg * plane.sin_b * w + rz,
        wp - plane.x_g * plane.sin_b * w,
        plane.x_g * r - rx + plane.r_bg * plane.cos_b * w,
    )


@kernel
def wrench_of_sums(sums: Array, plane: ContactPlane, wrench: Array) -> None:
    """Fill the forces and moments on pinion, then gear, shape (12,) [N, N.m]."""
    m = mesh_wrench(sums[0], sums[1], sums[2], sums[3], sums[4], plane)
    wrench[0], wrench[1], wrench[2] = m.F_x, m.F_y, m.F_z
    wrench[3], wrench[4], wrench[5] = m.M_px, m.M_py, m.M_pz
    wrench[6], wrench[7], wrench[8] = -m.F_x, -m.F_y, -m.F_z
    wrench[9], wrench[10], wrench[11] = m.M_gx, m.M_gy, m.M_gz


@kernel
def point_moments(plane: ContactPlane, points: Array, n: int, moments: Array) -> None:
    """Fill G and, as third column, g from points whose MU is set; `moments` has shape (5, 3).

    Friction is linear in the load here: lines that pull are taken to slide with negative load.

    Notes
    -----
    Source: [he_2007 (8)] [he_2007 (10a)] [he_2007 (10b)] [he_2007 (12)] [he_2007 (13a)]
    [he_2007 (13b)] [he_2007 (13c)] [he_2007 (14)] [he_2007 (17)] [he_2007 (18a)] [he_2007 (18b)]
    [he_2007 (19a)] [he_2007 (19b)] [he_2007 (19c)] [he_2007 (19d)]
    The closed forms (10b), (13b), (13c), (18a) and (18b) are taken as sums over Gauss points that
    are exact for them, with x_g for the misprinted x_e and with compression positive.
    """
    moments[:, :] = 0.0
    for i in range(n):
        x, z = points[i, X], points[i, Z]
        k = points[i, DENSITY] * points[i, LENGTH]
        r = -points[i, MU] * k * sign(points[i, SLIDING])
        p = x * plane.sin_b + z * plane.cos_b
        for column in range(3):
            factor = 1.0 if column == 0 else (p if column == 1 else points[i, OFFSET])
            moments[0, column] += k * factor
            moments[1, column] += k * factor * p
            moments[2, column] += r * factor
            moments[3, column] += r * factor * x
            moments[4, column] += r * factor * z


@kernel
def phase_moments(
    phase: float,
    pinion_speed: float,
    mu: float,
    plane: ContactPlane,
    mesh: MeshArrays,
    points: Array,
    moments: Array,
) -> None:
    """Fill the moments at a mesh phase with constant friction."""
    n = contact_points(phase, pinion_speed, plane, mesh, points)
    constant_friction(mu, points, n)
    point_moments(plane, points, n, moments)


def strain_rows(plane: ContactPlane) -> Array:
    """Return E = dy/dq, shape (2, 12)."""
    columns = [mesh_strain(unit, plane) for unit in np.eye(12)]
    return np.ascontiguousarray(np.array(columns).T)


def wrench_columns(plane: ContactPlane) -> Array:
    """Return W = d(wrench)/d(sums), shape (12, 5)."""
    columns = np.empty((N_SUMS, 12))
    for unit, column in zip(np.eye(N_SUMS), columns, strict=True):
        wrench_of_sums(unit, plane, column)
    return np.ascontiguousarray(columns.T)
