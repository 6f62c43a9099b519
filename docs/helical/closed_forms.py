"""The integrals (10b), (18a), (18b) of He et al. 2007 along a line, against quadrature.

Written from the paper. Their sign is that of the printed eq. (4); compression is the negative.
"""

from __future__ import annotations

import numpy as np

from docs.helical.cases import pressed_points, random_state
from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    DENSITY,
    LENGTH,
    LINE,
    LOAD,
    X,
    Z,
)
from gearlube_core.helical_geometry.contact_line import ContactPlane
from tests.helpers.he_2007 import he_2007_pair

_STATES, _SHARES = 3, (0.05, 0.5, 0.95)
_FIRST_SEED = 2007


def zone_differences() -> Array:
    """Return the largest differences of closed form and quadrature, (zones of eq. (24), 3) [-].

    Deflection, moments of x and z, each over the sum of the moduli of what is integrated, for
    random displacements.
    """
    return np.array([_zone(number) for number in range(1, 8)])


def _zone(zone: int) -> Array:
    parameters = he_2007_pair(0.0)
    plane = parameters.pair.plane
    line, start, end = _limits(plane)[zone]
    rng = np.random.default_rng(_FIRST_SEED + zone)
    worst = np.zeros(3)
    for share in _SHARES:
        position = start + share * (end - start)
        x_m, z_m, x_f, z_f, z_p = _ends(zone, position, plane)
        parts = [(x_m, z_m, x_f, z_f)]
        if x_m < plane.P < x_f:
            parts = [(x_m, z_m, plane.P, z_p), (plane.P, z_p, x_f, z_f)]
        phase = (position - plane.A) / plane.pitch - line
        for _ in range(_STATES):
            q = random_state(rng)
            points = pressed_points(parameters, phase, q)[0]
            points = points[points[:, LINE] == line]
            for part in parts:
                inside = points[(points[:, X] > part[0]) & (points[:, X] < part[2])]
                worst = np.maximum(worst, _differences(inside, q, plane, part, (x_f, z_f)))
    return worst


def _differences(
    points: Array, q: Array, plane: ContactPlane, part: tuple[float, ...], end: tuple[float, float]
) -> Array:
    weight = points[:, LOAD] / points[:, DENSITY] * points[:, LENGTH]
    size = np.sum(np.abs(weight))
    along_x, along_z = _moments(q, plane, part, end, plane.x_g)
    return np.array(
        [
            abs(weight.sum() + _deflection(q, plane, part, plane.x_g)) / size,
            abs(weight @ points[:, X] + along_x) / (size * plane.D),
            abs(weight @ points[:, Z] + along_z) / (size * plane.W),
        ]
    )


def _constants(q: Array, plane: ContactPlane, x_g: float) -> tuple[float, float, float]:
    """Return c1, c2, c3 of (18c)-(18e); printed with x_e, the end of contact, for x_g."""
    c1 = (q[0] - q[6]) - (plane.r_bp * q[5] + plane.r_bg * q[11])
    c2 = q[4] - q[10]
    c3 = (q[2] - q[8]) + (plane.r_bp * q[3] + plane.r_bg * q[9]) - x_g * q[10]
    return c1, c2, c3


def _deflection(q: Array, plane: ContactPlane, part: tuple[float, ...], x_g: float) -> float:
    """[he_2007 (10b)] between (x_l, z_l) and (x_h, z_h)."""
    x_l, z_l, x_h, z_h = part
    c1, c2, c3 = _constants(q, plane, x_g)
    return float(
        -(z_h - z_l) * c1
        - 0.5 * (z_h**2 - z_l**2) * c2
        + (x_h - x_l) * c3
        - 0.5 * (x_h**2 - x_l**2) * c2
    )


def _moments(
    q: Array, plane: ContactPlane, part: tuple[float, ...], end: tuple[float, float], x_g: float
) -> tuple[float, float]:
    """[he_2007 (18a)] [he_2007 (18b)]; `end` is (x_f, z_f) of the whole line."""
    x_l, z_l, x_h, z_h = part
    x_f, z_f = end
    c1, c2, c3 = _constants(q, plane, x_g)
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
    return float(along_x), float(along_z)


def _limits(plane: ContactPlane) -> dict[int, tuple[int, float, float]]:
    """Return line and X at the beginning and end of the zones of eq. (24)."""
    A, P, D = plane.A, plane.P, plane.D
    lag = plane.W * plane.sin_b / plane.cos_b
    C, Q, E, H, G = A + plane.pitch, A + lag, A + 2.0 * plane.pitch, P + lag, D + lag
    return {
        1: (0, A, P), 2: (0, P, C), 3: (1, C, Q), 4: (1, Q, D), 5: (1, D, E), 6: (2, E, H),
        7: (2, H, G),
    }  # fmt: skip


def _ends(zone: int, position: float, plane: ContactPlane) -> tuple[float, ...]:
    """Return x_m, z_m, x_f, z_f, z_p of eq. (24), x_2 for the misprinted x_1 in (24f)."""
    half, tan_b = 0.5 * plane.W, plane.sin_b / plane.cos_b
    z_p = half - (position - plane.P) / tan_b
    if zone <= 3:
        return plane.A, half - (position - plane.A) / tan_b, position, half, z_p
    x_m = position - plane.W * tan_b
    if zone == 4:
        return x_m, -half, position, half, z_p
    return x_m, -half, plane.D, half - (position - plane.D) / tan_b, z_p
