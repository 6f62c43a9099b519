"""Balances and symmetries of the point contact film."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from tests.helpers.ehl_point_cases import flow_out, moes_contact

TIGHT = PointSolverSettings(tolerance=1e-10, load_tolerance=1e-10, wedge="central")


@pytest.mark.slow
def test_oil_and_load_are_balanced() -> None:
    problem = moes_contact(20.0, 5.0, nodes=(65, 65))
    solution = solve_point_contact(problem, TIGHT)
    pressed = np.flatnonzero(solution.pressure[:, 32] > 0.0)
    # the largest box of loaded nodes around the middle rows, up to the exit
    i0, j0, j1 = max(1, int(pressed[0])), 24, 40
    loaded = (solution.pressure[i0:, j0 : j1 + 1] > 0.0).all(axis=1)
    i1 = i0 + int(np.argmin(loaded)) - 1
    assert i1 - i0 > 30
    # the bar of the issue; the solution's own residual is 1e-10 of the same flow
    assert abs(flow_out(solution, i0, i1, j0, j1)) < 1e-8
    # load tolerance 1e-10
    assert solution.load == pytest.approx(problem.load, rel=1e-9)


def test_the_film_turns_with_its_motion() -> None:
    forward = moes_contact(30.0, 5.0, nodes=(33, 29), radius_ratio=2.0, angle=0.6)
    u, v = forward.entrainment
    first = solve_point_contact(forward, PointSolverSettings(tolerance=1e-9))
    shape = EllipticParaboloid(forward.hertz.R_y, forward.hertz.R_x)
    turned: PointContactProblem = dataclasses.replace(
        forward,
        gap=shape,
        hertz=shape,
        entrainment=(-v, u),
        x_limits=(-forward.y_limits[1], -forward.y_limits[0]),
        y_limits=forward.x_limits,
        nodes=(29, 33),
    )
    second = solve_point_contact(turned, PointSolverSettings(tolerance=1e-9))
    # the same discrete problem; what differs is the end of two iterations at 1e-9
    expected = first.film.T[::-1]
    assert np.abs(second.film / expected - 1.0).max() < 1e-7


def test_the_film_is_symmetric_about_its_motion() -> None:
    solution = solve_point_contact(
        moes_contact(50.0, 10.0, nodes=(49, 49)), PointSolverSettings(tolerance=1e-9)
    )
    # symmetric data, an equation that does not know left from right; ends of the iteration
    assert np.abs(solution.film / solution.film[:, ::-1] - 1.0).max() < 1e-7
    assert (solution.pressure >= 0.0).all()


@pytest.mark.slow
def test_equal_groups_give_equal_films_in_other_units() -> None:
    problem = moes_contact(20.0, 5.0, nodes=(33, 33))
    oil = problem.lubricant
    # twice the length, four times the load, speed times two: U, W unchanged
    scaled = dataclasses.replace(
        problem,
        gap=EllipticParaboloid(0.02, 0.02),
        hertz=EllipticParaboloid(0.02, 0.02),
        load=4.0 * problem.load,
        entrainment=(2.0 * problem.entrainment[0], 0.0),
        x_limits=tuple(2.0 * np.array(problem.x_limits)),
        y_limits=tuple(2.0 * np.array(problem.y_limits)),
    )
    first, second = solve_point_contact(problem), solve_point_contact(scaled)
    assert oil == scaled.lubricant
    # lengths double, nothing else changes; tolerance of the iterations
    assert second.central_film == pytest.approx(2.0 * first.central_film, rel=1e-5)
    assert math.isclose(second.maximum_pressure, first.maximum_pressure, rel_tol=1e-5)
