"""The integrals of He et al. 2007 along a contact line, corrected, against the quadrature (H5)."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    DENSITY,
    LENGTH,
    LINE,
    LOAD,
    X,
    Z,
)
from gearlube_core.helical_geometry.contact_line import ContactPlane
from tests.helpers.each import each
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_dynamics_cases import loaded_points, random_state


def _constants(q: np.ndarray, plane: ContactPlane) -> tuple[float, float, float]:
    """[he_2007 (18c)] [he_2007 (18d)] [he_2007 (18e)] with x_g for the misprinted x_e."""
    c1 = (q[0] - q[6]) - (plane.r_bp * q[5] + plane.r_bg * q[11])
    c2 = q[4] - q[10]
    c3 = (q[2] - q[8]) + (plane.r_bp * q[3] + plane.r_bg * q[9]) - plane.x_g * q[10]
    return c1, c2, c3


def _compression(q: np.ndarray, plane: ContactPlane, ends: tuple[float, ...]) -> float:
    """[he_2007 (10b)] between (x_l, z_l) and (x_h, z_h), sign reversed to compression."""
    x_l, z_l, x_h, z_h = ends
    c1, c2, c3 = _constants(q, plane)
    printed = (
        -(z_h - z_l) * c1
        - 0.5 * (z_h**2 - z_l**2) * c2
        + (x_h - x_l) * c3
        - 0.5 * (x_h**2 - x_l**2) * c2
    )
    return -printed


def _moments(
    q: np.ndarray, plane: ContactPlane, ends: tuple[float, ...], x_f: float, z_f: float
) -> tuple[float, float]:
    """[he_2007 (18a)] [he_2007 (18b)], sign reversed; (x_f, z_f) ends the whole line."""
    x_l, z_l, x_h, z_h = ends
    c1, c2, c3 = _constants(q, plane)
    tan_b = plane.sin_b / plane.cos_b
    along_x = (
        -0.5 * (x_h + x_l) * (z_h - z_l) * (c1 + c2 * z_f)
        + 0.5 * (x_h**2 - x_l**2) * c3
        - (x_h**3 - x_l**3) / 3.0 * c2
        - (z_h - z_f) ** 2 * ((x_h - x_f) / 3.0 + 0.5 * x_f) * c2
        + (z_l - z_f) ** 2 * ((x_l - x_f) / 3.0 + 0.5 * x_f) * c2
    )
    squares, cubes = z_h**2 - z_l**2, (z_h**3 - z_l**3) / 3.0
    along_z = (
        (-c1 + c3 * tan_b) * 0.5 * squares
        - c2 * cubes
        - c2 * 0.5 * x_f * tan_b * squares
        - c2 * tan_b**2 * (cubes - 0.5 * z_f * squares)
    )
    return -along_x, -along_z


def _zones(plane: ContactPlane) -> dict[int, tuple[int, float, float]]:
    """Line and X at the beginning and end of the zones of eq. (24), 1 to 7."""
    A, P, D = plane.A, plane.P, plane.D
    lag = plane.W * plane.sin_b / plane.cos_b
    C, Q, E, H, G = A + plane.pitch, A + lag, A + 2.0 * plane.pitch, P + lag, D + lag
    return {
        1: (0, A, P), 2: (0, P, C), 3: (1, C, Q), 4: (1, Q, D), 5: (1, D, E), 6: (2, E, H),
        7: (2, H, G),
    }  # fmt: skip


def _expected_ends(zone: int, position: float, plane: ContactPlane) -> tuple[float, ...]:
    """x_m, z_m, x_f, z_f of eq. (24), x_2 for the misprinted x_1 in (24f)."""
    half, tan_b = 0.5 * plane.W, plane.sin_b / plane.cos_b
    if zone <= 3:
        return plane.A, half - (position - plane.A) / tan_b, position, half
    x_m = position - plane.W * tan_b
    if zone == 4:
        return x_m, -half, position, half
    return x_m, -half, plane.D, half - (position - plane.D) / tan_b


@each("zone", range(1, 8))
def test_corrected_integrals_equal_the_quadrature_in_every_zone(zone: int) -> None:
    parameters = he_2007_pair(0.0)
    plane, density = parameters.pair.plane, parameters.mesh.density.max()
    line, start, end = _zones(plane)[zone]
    rng = np.random.default_rng(zone)
    for share in (0.05, 0.5, 0.95):
        position = start + share * (end - start)
        phase = (position - plane.A) / plane.pitch - line
        q = random_state(rng)
        points = loaded_points(parameters, phase, q)[0]
        points = points[points[:, LINE] == line]
        x_m, z_m, x_f, z_f = _expected_ends(zone, position, plane)
        z_p = 0.5 * plane.W - (position - plane.P) * plane.cos_b / plane.sin_b
        parts = [(x_m, z_m, x_f, z_f)]
        if x_m < plane.P < x_f:
            parts = [(x_m, z_m, plane.P, z_p), (plane.P, z_p, x_f, z_f)]
        for part in parts:
            x_l, _, x_h, _ = part
            inside = points[(points[:, X] > x_l) & (points[:, X] < x_h)]
            weight = inside[:, LOAD] * inside[:, LENGTH] / density
            size = np.sum(np.abs(weight))
            along_x, along_z = _moments(q, plane, part, x_f, z_f)
            assert math.isclose(  # rounding
                weight.sum(), _compression(q, plane, part), rel_tol=1e-10, abs_tol=1e-10 * size
            )
            assert math.isclose(
                weight @ inside[:, X], along_x, rel_tol=1e-10, abs_tol=1e-10 * size * plane.D
            )
            assert math.isclose(
                weight @ inside[:, Z], along_z, rel_tol=1e-10, abs_tol=1e-10 * size * plane.W
            )
        length = points[:, LENGTH].sum()
        assert math.isclose(length, (x_f - x_m) / plane.sin_b, rel_tol=1e-12)
        assert np.allclose(points[:, DENSITY], density, rtol=1e-14)


def test_compression_is_the_approach_of_the_bodies_along_the_normal() -> None:
    parameters = he_2007_pair(0.0)
    plane, rng = parameters.pair.plane, np.random.default_rng(5)
    normal = np.array([-plane.cos_b, 0.0, plane.sin_b])  # of the force on the pinion
    gear_centre = np.array([plane.x_g, plane.r_bp + plane.r_bg, 0.0])
    for phase in (0.1, 0.4, 0.8):
        q = random_state(rng)
        for point in loaded_points(parameters, phase, q)[0]:
            place = np.array([point[X], plane.r_bp, point[Z]])
            pinion = q[:3] + np.cross(q[3:6], place)
            gear = q[6:9] + np.cross(q[9:], place - gear_centre)
            # the pinion presses where it moves against the force on it: eq. (4) has the other sign
            delta = -(pinion - gear) @ normal
            # cancellation in sums of terms of 1e-5 m
            assert math.isclose(point[LOAD] / point[DENSITY], delta, rel_tol=1e-9, abs_tol=1e-18)
