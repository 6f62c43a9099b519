"""Waves at an angle in the parallel film of a section of a line contact, after Hooke 2006.

His line, a/A = 1/(1 - i Q), holds for waves along the motion. With a wave vector (k_x, k_y) of
length k the flow by pressure goes along both axes and the solids yield by 2 p/(E* k), so that

    Q = 24 eta (v - u) k_x/(E* h^3 k^3)

which is his for k_y = 0.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.ehl.point.contact_domain import line_section
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import moving_section
from gearlube_core.oil.film_oil_data import film_oil

# 0.5 GPa, alpha p = 6: as good as parallel, viscosity even over a short wave at the centre
PRESSURE, MODULUS, RADIUS = 0.5e9, 110e9, 0.02
HALF_WIDTH = 2.0 * PRESSURE * RADIUS / MODULUS
SETTINGS = PointSolverSettings(estimate_error=False, wedge="upwind-2", tolerance=1e-8)


def contact(eta_centre, speed_1, speed_2, length, nodes):
    oil = film_oil(
        eta0=eta_centre * math.exp(-6.0),
        alpha=6.0 / PRESSURE,
        law="barus",
        density_law="incompressible",
    )
    return line_section(
        R_x=RADIUS,
        length=length,
        line_load=0.5 * math.pi * HALF_WIDTH * PRESSURE,
        speed_1=speed_1,
        speed_2=speed_2,
        contact_modulus=MODULUS,
        lubricant=oil,
        nodes=nodes,
        domain=(-2.2, 1.3),
    )


def response(film, eta_centre, k_x, k_y, slip):
    pressure = film.pressure[np.argmin(np.abs(film.problem.x)), 0]
    eta = eta_centre * math.exp(6.0 * (pressure / PRESSURE - 1.0))
    k = math.hypot(k_x, k_y)
    Q = 24.0 * eta * slip * k_x / (MODULUS * film.central_film**3 * k**3)
    return 1.0 / (1.0 - 1j * Q)


@pytest.mark.parametrize(
    "tangent",
    [1.0, pytest.param(0.0, marks=pytest.mark.slow), pytest.param(0.5, marks=pytest.mark.slow)],
)
def test_standing_wave_at_an_angle_is_left_in_the_film(tangent):
    # the rough body stands, the smooth one slides: v = 0
    wave = 0.15 * HALF_WIDTH
    k_x, k_y = 2.0 * math.pi / wave, 2.0 * math.pi / wave * tangent
    length = wave / tangent if tangent else wave
    part = contact(10.0, 2.0, 0.0, length, (801, 16))
    smooth = solve_point_contact(part, SETTINGS)
    A = 0.01 * smooth.central_film
    rough = solve_point_contact(
        replace(part, gap=lambda x, y: part.gap(x, y) + A * np.cos(k_x * x + k_y * y)), SETTINGS
    )
    near = np.abs(part.x) < 0.75 * wave
    x, y = np.meshgrid(part.x[near], part.y, indexing="ij")
    phase = (k_x * x + k_y * y).ravel()
    basis = np.column_stack([np.cos(phase), np.sin(phase), np.ones(phase.size), x.ravel() / wave])
    change = ((rough.film - smooth.film)[near] / A).ravel()
    c = np.linalg.lstsq(basis, change, rcond=None)[0]
    # the viscosity varies by 6 0.15^2/2 = 7 % over a wave's half, and the wave meets 34 nodes
    expected = response(smooth, 10.0, k_x, k_y, -1.0)
    assert c[0] - 1j * c[1] == pytest.approx(expected, abs=0.015)


@pytest.mark.slow
def test_travelling_wave_at_an_angle_and_its_complement():
    # v = 1.3 u; the wave that the inlet sends ahead has length wave u/v and travels at u
    b, u, v, steps, tangent = HALF_WIDTH, 1.0, 1.3, 30, 1.0
    wave = 0.15 * b
    k_x, k_y = 2.0 * math.pi / wave, 2.0 * math.pi / wave * tangent
    period = wave / v
    part = contact(5.0, v, 2.0 * u - v, wave / tangent, (601, 16))
    smooth = solve_point_contact(part, SETTINGS)
    A = 0.01 * smooth.central_film

    def heights(x, y, t):
        phase = k_x * (x[:, None] - v * t) + k_y * y[None, :]
        return -A * min(1.0, t / period) * np.cos(phase)

    march = FilmMarch(moving_section(part, heights), period / steps)
    near = np.abs(part.x) < wave
    x, y = np.meshgrid(part.x[near], part.y, indexing="ij")
    bases, changes = [], []
    total = int(1.6 * b / u / march.time_step)
    for step in range(total):
        film = march.step()
        if step >= total - steps:
            own = (k_x * (x - v * march.time) + k_y * y).ravel()
            other = (k_x * v / u * (x - u * march.time) + k_y * y).ravel()
            ones = np.ones(own.size)
            waves = [np.cos(own), np.sin(own), np.cos(other), np.sin(other)]
            bases.append(np.column_stack([*waves, ones, x.ravel() / b]))
            changes.append(((film.film - smooth.film)[near] / A).ravel())
    c = np.linalg.lstsq(np.vstack(bases), np.concatenate(changes), rcond=None)[0]
    expected = response(smooth, 5.0, k_x, k_y, v - u)
    # 30 steps and 26 nodes a wave: second-order errors (2 pi/30)^2 and (2 pi/26)^2/2
    assert c[0] - 1j * c[1] == pytest.approx(expected, abs=0.06)
    # the complement is there
    assert math.hypot(c[2], c[3]) > 0.002
