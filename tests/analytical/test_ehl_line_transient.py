"""Line contact in time: steady states kept, rigid squeeze, order in time, mass."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.ehl.line.oil_beyond import beyond_sentence, oil_beyond
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.transient import LineHistory, LineMarch
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_line_cases import thesis_line

THESIS = thesis_line(domain=(-1.0e-3, 0.38e-3))


@each("scheme", ["bdf2", "crank_nicolson"])
@each("cavitation", ["reynolds", "mass_conserving"])
def test_steady_film_stays(scheme, cavitation):
    film = solve_line(THESIS, LineSettings(nodes=201, cavitation=cavitation))
    march = LineMarch(film, LineHistory(), 1e-6, scheme)
    for _ in range(5):
        later = march.step()
    # residual of the start, 1e-8 of the flow
    full = film.pressure > 0.0
    assert later.film[full] == pytest.approx(film.film[full], rel=1e-6)
    assert later.pressure == pytest.approx(film.pressure, abs=1e-6 * film.maximum_pressure)


def test_a_step_tells_the_start_s_errors_of_domain_and_oil_that_is_not_counted():
    start = solve_line(replace(THESIS, domain=None), LineSettings(nodes=129))
    u1, u2 = THESIS.speed_1, THESIS.speed_2
    forth = LineMarch(start, LineHistory(), 1e-6).step()
    assert forth.outcome.endswith(f" At the start:{start.error.sentence}")
    assert "Of the domain, from one twice as wide" in forth.outcome
    assert "not counted" not in forth.outcome
    back = LineMarch(start, LineHistory(speeds=lambda t: (-u1, -u2)), 1e-6).step(throw=False)
    assert "Oil beyond the domain is not counted: the surfaces carry it the other" in back.outcome
    # a border within the contact: half its half width
    narrow = replace(THESIS, domain=(-0.5 * start.problem.half_width, 1e-3), oil_beyond=True)
    found = oil_beyond(narrow, narrow.domain, u1, u2)
    assert "the domain cuts the contact. Widen it." in beyond_sentence(narrow, narrow, found)


def test_error_in_time_is_told_how_far_the_film_moves_in_a_step(monkeypatch):
    film = solve_line(THESIS, LineSettings(nodes=101))
    march = LineMarch(film, LineHistory(), 1e-6)
    seen = []
    follow = march._time_error.step
    monkeypatch.setattr(
        march._time_error, "step", lambda *given: (seen.append(given), follow(*given))
    )
    march.step()
    stored, pressure, way = seen[0]
    system = march._system
    moved = 0.5 * (THESIS.speed_1 + THESIS.speed_2) * 1e-6
    assert way * system.scales.length == pytest.approx([moved], rel=1e-12)
    np.testing.assert_allclose(pressure[0] * system.scales.pressure, film.pressure, atol=1e3)
    filled = film.pressure > 0.0
    mass = (film.density * film.film)[filled] / (film.density[0] * system.scales.film)
    np.testing.assert_allclose(stored[0][filled], mass, rtol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["bdf2", "crank_nicolson"])
def test_rigid_cylinder_falls_through_oil_as_the_integral_says(scheme):
    # Reynolds with speeds 0: dp/dx = 12 eta (dh0/dt) x/h^3
    R, eta, w = 0.01, 0.1, 2000.0
    contact = LineProblem(
        lubricant=film_oil(eta0=eta, alpha=0.0, density_law="incompressible"),
        radius=R,
        line_load=w,
        reduced_modulus=1e13,
        speed_1=1.0,
        speed_2=1.0,
        domain=(-6e-3, 6e-3),
    )
    start = solve_line(contact, LineSettings(nodes=601, stencil="central"))
    dt, steps = 2e-6, 60
    halt = LineHistory(speeds=lambda t: (0.0, 0.0))
    march = LineMarch(start, halt, dt, scheme)
    heights = [march.step().minimum_film for _ in range(steps)]
    # by quadrature, and closed: w = 12 eta V (2 R h0)^1.5/h0^3 pi/8
    h0 = heights[-1]
    x = start.x
    h = h0 + x * x / (2.0 * R)
    slope = 12.0 * eta * x / h**3
    pressure = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(x))])
    per_speed = -np.trapezoid(pressure, x)
    closed = 3.0 * math.pi * math.sqrt(2.0) * eta * (R / h0) ** 1.5
    # the domain ends at 1e2 films
    assert per_speed == pytest.approx(closed, rel=0.01)
    # dh0/dt = -w/per_speed with per_speed ~ h0^-1.5: h0^-0.5 grows linearly in time
    rate = 0.5 * w / (closed * h0**1.5)
    first, last = heights[steps // 2] ** -0.5, heights[-1] ** -0.5
    # domain ends 1 %, second-order time 1e-3
    assert last - first == pytest.approx(rate * dt * (steps - 1 - steps // 2), rel=0.015)


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["bdf2", "crank_nicolson"])
def test_order_in_time_is_two(scheme):
    # load swings by 10 %, with a start whose rate is continuous
    start = solve_line(THESIS, LineSettings(nodes=151, tolerance=1e-10))
    T = 1e-4

    def load(t):
        return 3.6e5 * (1.0 + 0.1 * math.sin(math.pi * t / T) ** 2)

    films = []
    for steps in (20, 40, 80, 160):
        march = LineMarch(start, LineHistory(line_load=load), T / steps, scheme)
        for _ in range(steps):
            film = march.step()
        films.append(film.film[start.pressure > 0.3 * start.maximum_pressure])
    errors = [np.abs(a - b).max() for a, b in itertools.pairwise(films)]
    # a rupture that jumps from node to node disturbs the asymptotic order
    assert math.log2(errors[1] / errors[2]) == pytest.approx(2.0, abs=0.35)


def test_mass_is_kept_by_a_march_with_voids():
    start = solve_line(THESIS, LineSettings(nodes=201, cavitation="mass_conserving"))
    dt = 2e-7
    history = LineHistory(line_load=lambda t: 3.6e5 * (1.0 + 0.2 * math.sin(2e5 * t)))
    march = LineMarch(start, history, dt, "crank_nicolson")
    step = start.x[1] - start.x[0]

    def held(film):
        # cells of the inner nodes
        return step * float((film.density * film.film * (1.0 - film.void))[1:-1].sum())

    before = start
    for _ in range(20):
        after = march.step()
        gained = held(after) - held(before)
        # flows at the new time are stored at half weight by the scheme
        now = 2.0 * after.mass_flow
        then = 2.0 * before.mass_flow if before is not start else before.mass_flow
        passed = 0.5 * dt * ((now[0] - now[-1]) + (then[0] - then[-1]))
        assert gained == pytest.approx(passed, abs=1e-7 * dt * abs(now[0]) + 1e-9 * abs(passed))
        before = after


def test_march_from_a_failed_start_is_refused():
    failed = solve_line(THESIS, LineSettings(nodes=101, max_iterations=1), throw=False)
    with pytest.raises(ParameterError, match="must have converged"):
        LineMarch(failed, LineHistory(), 1e-6)
    good = solve_line(replace(THESIS), LineSettings(nodes=101))
    with pytest.raises(ParameterError, match="time_step"):
        LineMarch(good, LineHistory(), 0.0)
    with pytest.raises(ParameterError, match="scheme"):
        LineMarch(good, LineHistory(), 1e-6, "euler")
