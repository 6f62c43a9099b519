"""Films of hypoid flanks against what must hold whatever the axes, the time or the load."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.ehl.gears.hypoid_cycle import flank_traction, march_flank, steady_films
from gearlube_core.ehl.gears.hypoid_film import FLOWS
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.friction.johnson_greenwood_1980 import thermal_eyring_film
from gearlube_core.oil.eyring_1936 import Eyring
from tests.helpers.hypoid_film_cases import BETA, flank_cycle, hypoid_film, lasting


@pytest.mark.slow
def test_a_turned_gap_under_straight_entrainment_is_the_oblique_contact():
    """Axes are a choice: the ellipse turned by psi with u along x, or psi between both."""
    R_x, R_y, psi, speed = 0.012, 0.036, math.radians(40.0), 2.0
    oil = hypoid_film(flank_cycle()).lubricant.newtonian()
    a_x, a_y, _ = hertz_ellipse(R_x, R_y, 115.4e9, 60.0)
    shared = {"load": 60.0, "contact_modulus": 115.4e9, "lubricant": oil}
    aligned = PointContactProblem(
        gap=EllipticParaboloid(R_x, R_y),
        hertz=EllipticParaboloid(R_x, R_y),
        entrainment=(speed * math.cos(psi), speed * math.sin(psi)),
        x_limits=(-5.5 * a_x, 3.0 * a_x),
        y_limits=(-3.0 * a_y, 2.0 * a_y),
        nodes=(97, 97),
        **shared,
    )

    def turned_gap(x, y):
        minor = math.cos(psi) * x - math.sin(psi) * y
        major = math.sin(psi) * x + math.cos(psi) * y
        return minor**2 / (2.0 * R_x) + major**2 / (2.0 * R_y)

    turned = PointContactProblem(
        gap=turned_gap,
        hertz=EllipticParaboloid(R_x, R_y),
        entrainment=(speed, 0.0),
        x_limits=(-3.0 * a_y, 2.0 * a_y),
        y_limits=(-2.5 * a_y, 2.5 * a_y),
        nodes=(113, 113),
        **shared,
    )
    settings = PointSolverSettings(wedge="quick", estimate_error=False)
    first, second = (solve_point_contact(one, settings) for one in (aligned, turned))
    # with 4/3 of the nodes the central films move by 3e-4, the smallest by 1.1 %
    assert second.central_film == pytest.approx(first.central_film, rel=3e-3)
    assert second.minimum_film == pytest.approx(first.minimum_film, rel=0.015)
    assert second.load == pytest.approx(first.load, rel=1e-6)


def test_without_sliding_to_speak_of_only_slopes_of_pressure_thin_the_oil():
    """Eyring's flow is the Newtonian one where no stress nears tau0, at rest and in time."""
    cycle = flank_cycle()
    film = hypoid_film(lasting(cycle, float(cycle.time[15]), np.linspace(0.0, 3e-4, 5)))
    stiff = replace(film, lubricant=film.lubricant._replace(shear=Eyring(1e12)))
    stiff, newtonian = (march_flank(replace(stiff, flow=flow), 2, BETA) for flow in FLOWS)
    # stresses reach 1e9 Pa, 1e-3 of tau0: factors of 1 + 1e-6 where the film feels them least
    np.testing.assert_allclose(stiff["central_film"], newtonian["central_film"], rtol=1e-5)
    np.testing.assert_allclose(stiff["minimum_film"], newtonian["minimum_film"], rtol=1e-5)


@pytest.mark.slow
def test_oil_sheared_thin_leaves_less_film_the_faster_it_slides():
    cycle = flank_cycle()
    film = hypoid_film(lasting(cycle, float(cycle.time[15]), np.linspace(0.0, 3e-4, 5)))
    faster = replace(film.cycle, sliding=3.0 * film.cycle.sliding)
    films = [
        steady_films(one, one.cycle.time[:1], BETA)["central_film"][0]
        for one in (replace(film, flow="newtonian"), film, replace(film, cycle=faster))
    ]
    assert films[0] > 1.005 * films[1] > 1.01 * films[2]


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["bdf2", "crank_nicolson"])
def test_a_march_under_lasting_conditions_stays_at_the_steady_film(scheme):
    cycle = flank_cycle()
    film = hypoid_film(lasting(cycle, float(cycle.time[15]), np.linspace(0.0, 3e-4, 5)))
    march = march_flank(film, 4, BETA, scheme=scheme)
    # the residual is 1e-5 of the flow; so is what a film can drift in a passage of the contact
    np.testing.assert_allclose(march["minimum_film"], march["minimum_film"][0], rtol=1e-4)
    np.testing.assert_allclose(march["central_film"], march["central_film"][0], rtol=1e-4)


@pytest.mark.slow
def test_slow_running_leaves_no_squeeze():
    """Conditions that change slowly against the passage give the steady film, fast ones do not."""
    phase = np.linspace(0.3, 0.8, 7)
    fast = flank_cycle(phase)
    film = hypoid_film(fast)
    slow = hypoid_film(
        type(fast)(
            **{name: getattr(fast, name) for name in fast.__dataclass_fields__ if name != "time"},
            time=100.0 * fast.time,
        )
    )

    def excess(one):
        march = march_flank(one, 5, BETA)
        steady = steady_films(one, one.cycle.time[[0, -1]], BETA)
        return march["central_film"][-1] / steady["central_film"][-1] - 1.0

    swift, lazy = excess(film), excess(slow)
    # the speed rises, the film follows later: squeeze falls with the rate of change
    assert swift < -2e-3
    assert abs(lazy) < 0.05 * abs(swift)


def test_traction_of_an_even_film_is_that_of_one_film():
    """Uniform pressure and film: three laws in closed form, or by the kernel of one film."""
    oil = hypoid_film(flank_cycle()).lubricant
    x, y = np.linspace(-1e-4, 1e-4, 11), np.linspace(-1e-3, 1e-3, 13)
    p, h, slip = 0.5e9, 0.3e-6, 1.6
    pressure, film = np.full((11, 13), p), np.full((11, 13), h)
    area = (x[1] - x[0]) * (y[1] - y[0]) * 11 * 13
    solution = FilmSolution(
        time=0.0, x=x, y=y, pressure=pressure, film=film, approach=0.0, load=p * area,
        load_error=0.0, residual=0.0, converged=True, outcome="", newton_steps=0, krylov_steps=0,
        seconds=0.0,
    )  # fmt: skip
    found = flank_traction(solution, oil, (0.6 * slip, -0.8 * slip), BETA)
    # Roelands with his constants: ln eta + 9.67 = (ln eta0 + 9.67)(1 + 5.1e-9 p)^Z
    scale = math.log(0.0171) + math.log(1.0 / 63.15e-6)
    log_eta = scale * (1.0 + 5.1e-9 * p) ** (2.383e-8 / (5.1e-9 * scale)) + math.log(63.15e-6)
    newtonian = math.exp(log_eta) * slip / h
    assert found.newtonian == pytest.approx(newtonian / p, rel=1e-3)
    assert found.eyring == pytest.approx(2e6 * math.asinh(newtonian / 2e6) / p, rel=1e-4)
    beta = BETA * (log_eta + 9.67) / (math.log(0.0171) + 9.67)
    heated = thermal_eyring_film(log_eta, beta, oil.conductivity, 2e6, h, slip)
    assert found.heated == pytest.approx(heated.stress_ratio * 2e6 / p, rel=1e-3)
    assert found.heated < found.eyring
