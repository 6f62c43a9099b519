"""What must hold of the equations whatever the numbers: action and reaction, symmetry, limits."""

from __future__ import annotations

import numpy as np

from docs.helical.cases import (
    HE,
    HIGH,
    LOW,
    SPUR,
    pressed_points,
    random_state,
    steady,
)
from gearlube_core.dynamics.helical_pair.linear.periodic_response import harmonics
from gearlube_core.dynamics.helical_pair.mesh.contact_points import SLIDING, X
from gearlube_core.helical_geometry.contact_line import line_kinematics
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_mesh_points import mesh_stiffness_matrix

PHASES = np.linspace(0.0, 0.99, 34)
MUS = (0.0, LOW, HIGH, 0.3)
TRANSVERSE = ("u_xp", "u_yp", "u_xg", "u_yg")


def reaction() -> tuple[float, float, float]:
    """Return sums of forces and of moments over those on the pinion, |F_z + F_x tan b|/|F_x| [-].

    The worst over phases, friction and random displacements, helical and spur.
    """
    rng = np.random.default_rng(7)
    force = moment = axial = 0.0
    for pair in (HE, SPUR):
        plane = pair.plane
        centre_g = np.array([plane.x_g, plane.r_bp + plane.r_bg, 0.0])
        for mu in MUS:
            parameters = he_2007_pair(mu, pair)
            for phase in PHASES:
                w = pressed_points(parameters, float(phase), random_state(rng))[1]
                size = float(np.abs(w[:3]).max())
                about = rng.normal(size=3)
                total = w[3:6] - np.cross(about, w[:3])
                total += w[9:] + np.cross(centre_g - about, w[6:9])
                force = max(force, float(np.abs(w[:3] + w[6:9]).max()) / size)
                moment = max(moment, float(np.abs(total).max()) / size)  # arms of about 1 m
                helix = abs(w[2] + w[0] * plane.sin_b / plane.cos_b)
                axial = max(axial, helix / abs(w[0]))
    return force, moment, axial


def symmetry() -> tuple[float, float, tuple[int, ...], float]:
    """Return of the mesh stiffness without friction, over its largest entry [-].

    Asymmetry, least eigenvalue, ranks, largest entry off the line of action; the worst over mesh
    phases, helical and spur.
    """
    asymmetry = least = off = 0.0
    ranks = set()
    for pair in (HE, SPUR):
        parameters = he_2007_pair(0.0, pair)
        for phase in PHASES:
            K = mesh_stiffness_matrix(float(phase), pair.plane, parameters.mesh_arrays())
            size = float(np.abs(K).max())
            values = np.linalg.eigvalsh(0.5 * (K + K.T)) / size
            asymmetry = max(asymmetry, float(np.abs(K - K.T).max()) / size)
            least = min(least, float(values[0]))
            ranks.add(int((np.abs(values) > 1e-9).sum()))
            off = max(off, float(np.abs(K[[1, 7]]).max()) / size)
    return asymmetry, least, tuple(sorted(ranks)), off


def sliding_reversal() -> tuple[float, bool]:
    """Return |v_s| at the pitch line over that at A, and whether v_s changes sign there alone."""
    plane = HE.plane
    ratio = abs(line_kinematics(plane.P, 1.0, plane).sliding)
    ratio /= abs(line_kinematics(plane.A, 1.0, plane).sliding)
    pressed = np.zeros(12)
    pressed[0] = 1e-5
    for phase in PHASES:
        points = pressed_points(he_2007_pair(HIGH), float(phase), pressed)[0]
        if (np.sign(points[:, SLIDING]) != np.sign(plane.P - points[:, X])).any():
            return ratio, False
    return ratio, True


def six_against_twelve(mu: float, orders: int = 6) -> dict[str, float]:
    """Return by translation the largest relative difference of mesh orders 1 to `orders`."""
    six, twelve = steady(mu, "six_dof"), steady(mu)
    return {
        name: float(
            np.abs(
                harmonics(six.signal(name), orders) / harmonics(twelve.signal(name), orders) - 1.0
            ).max()
        )
        for name in TRANSVERSE
    }
