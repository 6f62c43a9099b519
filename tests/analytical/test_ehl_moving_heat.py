"""Surface temperature under moving heat against Jaeger's integrals and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import k0

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.ehl.point.thermal.surfaces import MovingHeat, moving_heat_coefficients
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

K = STEEL.conductivity
KAPPA = K / (STEEL.density * STEEL.heat_capacity)


@each("velocity", [(0.0, 0.0), (0.5, 0.0), (5.0, -2.0), (-0.3, 2.0)])
def test_cells_away_are_warmed_as_by_moving_point_sources(velocity):
    dx, dy, n = 8e-6, 6e-6, 65
    table = moving_heat_coefficients(STEEL, velocity, (dx, dy), (n, n))
    u, v = velocity
    speed = math.hypot(u, v)
    node, weight = np.polynomial.legendre.leggauss(60)
    for i, j in ((1, 0), (3, 1), (20, -8), (-4, 6), (-1, 0)):
        x, y = i * dx - 0.5 * dx * node[:, None], j * dy - 0.5 * dy * node
        r = np.hypot(x, y)
        one = np.exp(-(speed * r - u * x - v * y) / (2.0 * KAPPA)) / (2.0 * math.pi * K * r)
        whole = (np.outer(weight, weight) * one).sum() * 0.25 * dx * dy
        # what is left of the time after 1e7 crossing times: a square root of it
        error = table[n - 1 + j, n - 1 + i] - whole
        assert abs(error) < 2e-6 * table.max()


def test_square_at_rest_has_the_temperature_of_the_potential_of_a_plate():
    n, side = 41, 2e-4
    body = MovingHeat(STEEL, (0.0, 0.0), (side / n, side / n), (n, n))
    rise = body(np.ones((n, n)))[n // 2, n // 2]
    # q integral of dA/(2 pi k r) over a square of half side a: 4 a asinh(1)/(pi k)
    # every cell lacks what comes after 1e7 crossing times
    assert rise == pytest.approx(2.0 * side * math.asinh(1.0) / (math.pi * K), rel=1e-4)


@each("speed", [0.05, 0.5, 5.0])
def test_band_is_as_hot_as_jaegers_at_any_peclet_number(speed):
    half, cells, rows = 1e-4, 80, 41
    dx = 2.0 * half / cells
    body = MovingHeat(STEEL, (speed, 0.0), (dx, 100.0 * dx), (cells, rows))
    rise = body(np.ones((rows, cells)))[rows // 2]
    # Carslaw and Jaeger 10.7: T = 2 q kappa/(pi k U) integral of exp(-u) K0|u| from X - B to X + B
    L = half * speed / (2.0 * KAPPA)
    expected = []
    for i in range(cells):
        X = -((i + 0.5) * dx - half) * speed / (2.0 * KAPPA)
        total = quad(lambda s: math.exp(s) * k0(abs(s)), X - L, X + L, points=[0.0], limit=400)[0]
        expected.append(2.0 * KAPPA / (math.pi * K * speed) * total)
    # the band is 50 widths long
    assert rise.max() == pytest.approx(max(expected), rel=2e-3)
    if speed == 5.0:
        fast = 2.0 * math.sqrt(2.0 * half / (math.pi * K * K / KAPPA * speed))
        # Peclet number u b/(2 kappa) 20, and the last node lies half a cell before the end
        assert rise.max() == pytest.approx(fast, rel=0.02)


def test_fast_elliptic_heat_has_the_temperature_of_half_an_integral():
    a, n, speed = 2e-4, 101, 40.0
    dx = 2.0 * a / n
    x = (np.arange(n) - n // 2) * dx
    heat = np.sqrt(np.maximum(1.0 - (x[None, :] ** 2 + x[:, None] ** 2) / a**2, 0.0))
    rise = MovingHeat(STEEL, (speed, 0.0), (dx, dx), (n, n))(heat)[n // 2]
    factor = 1.0 / math.sqrt(math.pi * K * K / KAPPA * speed)
    # s = x - r^2 takes the root off the denominator

    def heated(r: float, X: float) -> float:
        return math.sqrt(max(1.0 - ((X - r * r) / a) ** 2, 0.0))

    along = [2.0 * factor * quad(heated, 0.0, math.sqrt(X + a), args=(X,))[0] for X in x]
    # Peclet number 640: sideways conduction and the cells' steps
    assert rise.max() == pytest.approx(max(along), rel=0.01)
    assert x[rise.argmax()] == pytest.approx(x[int(np.argmax(along))], abs=1.5 * dx)


def test_a_body_without_a_finite_velocity_is_refused():
    with pytest.raises(ParameterError, match="velocity along y"):
        moving_heat_coefficients(STEEL, (1.0, math.nan), (1e-6, 1e-6), (3, 3))
