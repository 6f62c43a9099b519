"""Films in time entrained and sliding at an angle to x, on one grid with the steady solver."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.ehl.transient.steady import solve_steady_film
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil_data import film_oil

SETTINGS = PointSolverSettings(wedge="quick", tolerance=1e-8, load_tolerance=1e-9)


def oblique_problem(psi, sliding=None):
    return elliptical_contact(
        R_x=0.0177,
        R_y=0.5,
        entrainment=(2.5 * math.cos(psi), 2.5 * math.sin(psi)),
        load=1500.0,
        contact_modulus=115.4e9,
        lubricant=film_oil(
            eta0=0.0171, alpha=2.38e-8, eyring_stress=None if sliding is None else 2e6
        ),
        sliding=sliding,
        nodes=(33, 25),
    )


def as_moving_film(problem, slope):
    u = problem.entrainment[0]
    slip, side_slip = problem.sliding or (0.0, 0.0)

    def conditions(x, y, time):
        return FilmConditions(
            gap=problem.gap(x[:, None], y[None, :]),
            load=problem.load,
            speed_1=np.full(y.size, u - 0.5 * slip),
            speed_2=np.full(y.size, u + 0.5 * slip),
            slope=slope,
            side_sliding=side_slip,
        )

    return MovingFilm(
        conditions=conditions,
        lubricant=problem.lubricant,
        contact_modulus=problem.contact_modulus,
        x_limits=problem.x_limits,
        y_limits=problem.y_limits,
        nodes=problem.nodes,
        hertz=problem.hertz,
        load=problem.load,
        speed=u,
    )


def test_at_rest_it_is_the_film_of_the_steady_solver():
    psi = math.radians(50.0)
    problem = oblique_problem(psi)
    steady = solve_point_contact(problem, SETTINGS)
    moving = solve_steady_film(as_moving_film(problem, math.tan(psi)), 0.0, SETTINGS)
    # two starts, one system of equations, both solved to 1e-8
    np.testing.assert_allclose(moving.film, steady.film, rtol=1e-6)
    # flow along the contact skews the film: it is not that of its component across
    assert np.abs(steady.film / steady.film[:, ::-1] - 1.0).max() > 0.05


SLIDINGS = [(1.2, 0.9), (-0.7, 1.4), (0.0, 1.6)]  # to both sides of the minor axis and across it


@pytest.mark.parametrize("sliding", SLIDINGS)
def test_an_eyring_film_in_time_slides_at_any_angle_as_the_steady_one(sliding):
    psi = math.radians(50.0)
    problem = oblique_problem(psi, sliding)
    steady = solve_point_contact(problem, SETTINGS)
    film = as_moving_film(problem, math.tan(psi))
    moving = solve_steady_film(film, 0.0, SETTINGS)
    np.testing.assert_allclose(moving.film, steady.film, rtol=1e-6)
    # and it is another film than one that slides along x at the same speed
    along = oblique_problem(psi, (math.hypot(*sliding), 0.0))
    other = solve_steady_film(as_moving_film(along, math.tan(psi)), 0.0, SETTINGS)
    assert np.abs(other.film / moving.film - 1.0).max() > 1e-3


def test_rows_that_slide_in_different_directions_are_refused():
    film = as_moving_film(oblique_problem(0.3, (0.5, 0.5)), 0.3)

    def uneven(x, y, time):
        now = film.conditions(x, y, time)
        return replace(now, speed_2=now.speed_2 + np.linspace(0.0, 0.1, y.size))

    with pytest.raises(ParameterError, match=r"must not vary .* got a spread of 0\.1 m/s"):
        solve_steady_film(replace(film, conditions=uneven), 0.0, SETTINGS)


def test_entrainment_towards_smaller_y_is_refused():
    problem = oblique_problem(0.3)
    with pytest.raises(ParameterError, match="slope must be"):
        solve_steady_film(as_moving_film(problem, -0.3), 0.0, SETTINGS)
