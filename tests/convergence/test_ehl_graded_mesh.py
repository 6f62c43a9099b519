"""Films of a helical line on meshes that are denser where the film leaves the contact."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from gearlube_core.ehl.gears.helical_film import EXIT_GRADING, solve_helical_line
from gearlube_core.ehl.point import start as point_continuation
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.transient.march import MARCH_SETTINGS, FilmMarch
from gearlube_core.ehl.transient.solution import FilmSolution
from tests.helpers.jamali_2015 import jamali_2015_film

ROWS = 33


@cache
def _line(step: float, nodes: int, **options: Any) -> FilmSolution:
    film = jamali_2015_film("a", nodes=(nodes, ROWS), **options)
    return solve_helical_line(film, step, PointSolverSettings(wedge="quick"))


def _smallest_film(solution: FilmSolution) -> float:
    """Return the film where it is smallest on the row of the thinnest node, between nodes."""
    i, j = np.unravel_index(int(solution.film.argmin()), solution.film.shape)
    x, film = solution.x[i - 1 : i + 2], solution.film[i - 1 : i + 2, j]
    bend, slope, height = np.polyfit((x - x[1]) / (x[2] - x[0]), film, 2)
    return float(height - 0.25 * slope**2 / bend)


def _film_in_the_middle(solution: FilmSolution) -> float:
    return float(np.interp(0.0, solution.x, solution.film[:, ROWS // 2]))


@pytest.mark.slow
@pytest.mark.parametrize(
    "step",
    [
        pytest.param(75, marks=pytest.mark.slow),
        300,
        pytest.param(500, marks=pytest.mark.slow),
    ],
)
def test_a_graded_mesh_is_as_right_as_a_uniform_one_of_its_finest_spacing(step: int) -> None:
    graded = _line(step, 129, grading=EXIT_GRADING)
    thesis, fine = _line(step, 182), _line(step, 385)
    # 182 nodes: a/40; the smallest film is 1 to 2 % below that of a/85 with it
    error = abs(_smallest_film(thesis) / _smallest_film(fine) - 1.0)
    assert error < 0.025
    assert abs(_smallest_film(graded) / _smallest_film(fine) - 1.0) < 1.1 * error
    # half as dense in the contact, a quarter in the inlet: pressure there to 1e-3, film to 2e-3
    assert graded.maximum_pressure == pytest.approx(fine.maximum_pressure, rel=1e-3)
    assert _film_in_the_middle(graded) == pytest.approx(_film_in_the_middle(fine), rel=2e-3)


@pytest.mark.slow
def test_errors_on_a_graded_mesh_fall_with_its_nodes() -> None:
    fine = _line(300, 385)
    errors = []
    for nodes in (65, 129):
        graded = _line(300, nodes, grading=EXIT_GRADING)
        errors.append(
            (
                abs(_film_in_the_middle(graded) / _film_in_the_middle(fine) - 1.0),
                abs(graded.maximum_pressure / fine.maximum_pressure - 1.0),
                abs(_smallest_film(graded) / _smallest_film(fine) - 1.0),
            )
        )
    (central, pressure, smallest), finer = errors
    # second order and better where the film is smooth, first order at the edge of the contact
    assert finer[0] < 0.3 * central
    # the largest pressure is that of a node, up to 1e-4 below the peak
    assert max(pressure, finer[1]) < 1e-4
    assert finer[2] < 0.7 * smallest


@pytest.mark.slow  # shorter graded meshes are in the default run
def test_long_graded_meshes_find_the_film_of_the_stencil_asked_for() -> None:
    film = jamali_2015_film("a", nodes=(97, 193), grading=EXIT_GRADING)
    solution = solve_helical_line(film, 490, MARCH_SETTINGS)
    assert solution.converged
    # the first-order film is thicker by a fifth; rows solved in part found no other
    assert "upwind-1" not in solution.outcome
    coarse = solve_helical_line(jamali_2015_film("a", nodes=(97, 97)), 490, MARCH_SETTINGS)
    assert solution.minimum_film == pytest.approx(coarse.minimum_film, rel=0.06)


def test_a_film_of_first_order_differences_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    film = jamali_2015_film("a", newtonian=True, nodes=(33, 49))
    known = point_continuation.newton

    def of_first_order(hierarchy: Any, state: Any, **options: Any) -> Any:
        solved, record = known(hierarchy, state, **options)
        # as if no film of the stencil asked for could be found
        record.converged &= hierarchy.levels[-1].stencil.here == 1.0
        return solved, record

    second = solve_helical_line(film, 300)
    monkeypatch.setattr(point_continuation, "newton", of_first_order)
    first = solve_helical_line(film, 300)
    assert "With upwind-1" in first.outcome
    assert "With upwind-1" not in second.outcome
    assert abs(first.minimum_film / second.minimum_film - 1.0) > 0.02


@pytest.mark.slow
def test_a_march_on_a_graded_mesh_follows_that_on_a_uniform_one() -> None:
    found = []
    for nodes, grading in ((97, EXIT_GRADING), (182, ())):
        film = jamali_2015_film("a", nodes=(nodes, ROWS), grading=grading)
        march = FilmMarch(film.moving_film(), film.time_step, start_time=300 * film.time_step)
        for _ in range(2):
            solution = march.step()
        found.append((march, solution))
    (march, graded), (_, uniform) = found
    # a/40 at the exit of both
    assert graded.minimum_film == pytest.approx(uniform.minimum_film, rel=0.015)
    assert graded.maximum_pressure == pytest.approx(uniform.maximum_pressure, rel=1e-3)
    # the load is the integral of the pressure over x and y as anyone would take it
    whole = np.trapezoid(np.trapezoid(graded.pressure, graded.x, axis=0), graded.y)
    assert whole == pytest.approx(graded.load, rel=1e-3)
    assert graded.load == pytest.approx(
        march.film.conditions(graded.x, graded.y, march.time).load, rel=1e-3
    )
