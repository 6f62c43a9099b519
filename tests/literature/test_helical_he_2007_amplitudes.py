"""Amplitudes of He et al. 2007 at mesh orders 1 to 5 in m and N, 1000 rpm, mu = 0.01 and 0.1.

The paper draws its amplitudes (figs 6 to 8) and prints none of them in words, and neither stiffness
density nor bearings, on which they hang. So these are held by a route that shares nothing with the
model but the printed and completed data: harmonic balance with lines clipped apart.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    PeriodicResponse,
    harmonics,
    periodic_response,
)
from tests.helpers.each import each
from tests.helpers.helical_balance import SPEED, amplitudes
from tests.helpers.helical_dynamics_cases import estimated_pair

DENSITY, ORDERS = 1.316e10, 5  # N/m2 as in `estimated_pair`, -
MOTIONS = ("u_xp", "u_yp", "u_zp", "u_xg", "u_yg", "u_zg", "delta_x", "delta_y", "delta_z")
FORCES = {"F_xp": 0, "F_yp": 1, "F_zp": 2, "F_xg": 6, "F_yg": 7, "F_zg": 8}  # column of each


@cache
def _response(mu: float) -> PeriodicResponse:
    return periodic_response(estimated_pair(mu), SPEED)


@cache
def _expected(mu: float) -> dict[str, Array]:
    return amplitudes(DENSITY, mu, ORDERS)


def _same(found: Array, expected: Array) -> None:
    # 256 samples of a mesh with kinks alias 2e-4 of an order, the same of its neighbours adds to
    # the orders that are next to nothing
    assert found == pytest.approx(expected, rel=5e-4, abs=1e-5 * expected.max())


@each("mu", [0.01, 0.1])
@each("name", MOTIONS)
def test_amplitudes_of_motion_are_those_of_a_harmonic_balance(name: str, mu: float) -> None:
    """Transmission error delta_z, tilts and bodies along, off and across the line of action."""
    _same(harmonics(_response(mu).signal(name), ORDERS), _expected(mu)[name])


@each("mu", [0.01, 0.1])
@each("name", FORCES)
def test_amplitudes_of_bearing_forces_are_those_of_a_harmonic_balance(name: str, mu: float) -> None:
    _same(harmonics(_response(mu).bearing_force, ORDERS)[:, FORCES[name]], _expected(mu)[name])


def test_transmission_error_is_the_mesh_spring_under_its_load_at_the_first_order() -> None:
    """One spring k cos^2 b L(t) with its whole load, F = T/r_bp, and the pair's inertia on it.

    The bodies' own motion, some nm along the line of action of 840, is left out: half a per cent.
    """
    plane = _response(0.01).parameters.pair.plane
    phase = (np.arange(4000) + 0.5) / 4000
    X = plane.A + (phase[:, None] + np.arange(4)) * plane.pitch
    low = np.maximum(plane.A, X - plane.W * plane.sin_b / plane.cos_b)
    length = np.maximum(np.minimum(X, plane.D) - low, 0.0).sum(axis=1) / plane.sin_b
    force = _response(0.01).parameters.kernel_parameters().T_p / plane.r_bp
    static = force / (DENSITY * plane.cos_b**2 * length)
    inertia = 1.0 / (plane.r_bp**2 / 941.1636e-6 + plane.r_bg**2 / 1852.951e-6)
    stiffness = DENSITY * plane.cos_b**2 * length.mean()
    way = (2.0 * np.pi / _response(0.01).period) ** 2 * inertia / stiffness
    expected = harmonics(static, 1)[0] / (1.0 - way)
    found = harmonics(_response(0.01).signal("delta_z"), 1)[0]
    assert found == pytest.approx(expected, rel=0.01)
