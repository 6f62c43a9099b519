"""A film in time whose entrainment lies at an angle to x, on one grid with the steady solver."""

import math

import numpy as np
import pytest

from gearlube_core.ehl.lubricant import ehl_lubricant
from gearlube_core.ehl.point_solver import solve_point_contact
from gearlube_core.ehl.problem import elliptical_contact
from gearlube_core.ehl.settings import PointSolverSettings
from gearlube_core.ehl.transient_film import MovingFilm
from gearlube_core.ehl.transient_level import FilmConditions
from gearlube_core.ehl.transient_steady import solve_steady_film
from gearlube_core.errors import ParameterError

SETTINGS = PointSolverSettings(wedge="quick", tolerance=1e-8, load_tolerance=1e-9)


def oblique_problem(psi):
    return elliptical_contact(
        R_x=0.0177,
        R_y=0.5,
        entrainment=(2.5 * math.cos(psi), 2.5 * math.sin(psi)),
        load=1500.0,
        contact_modulus=115.4e9,
        lubricant=ehl_lubricant(eta0=0.0171, alpha=2.38e-8),
        nodes=(49, 33),
    )


def as_moving_film(problem, slope):
    u = problem.entrainment[0]

    def conditions(x, y, time):
        gap = problem.gap(x[:, None], y[None, :])
        return FilmConditions(gap, problem.load, np.full(y.size, u), np.full(y.size, u), slope)

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


def test_entrainment_towards_smaller_y_is_refused():
    problem = oblique_problem(0.3)
    with pytest.raises(ParameterError, match="slope must be"):
        solve_steady_film(as_moving_film(problem, -0.3), 0.0, SETTINGS)
