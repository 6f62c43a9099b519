"""Estimated errors of films against the same films on much finer grids."""

import numpy as np
import pytest

from docs.film_error.contacts import random_contacts
from gearlube_core.ehl.line.problem import LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.transient import LineHistory, LineMarch
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.history import MarchRecord
from gearlube_core.ehl.transient.march import MARCH_SETTINGS, FilmMarch
from gearlube_core.ehl.transient.steady import solve_steady_film
from gearlube_core.errors import ParameterError
from tests.helpers.each import each
from tests.helpers.ehl_line_cases import thesis_line
from tests.helpers.ehl_point_cases import moes_contact
from tests.helpers.jamali_2015 import jamali_2015_film


@pytest.fixture(scope="module")
def exact_line():
    """Film and friction of the line on 2001 nodes, with an error a hundredth of that on 201."""
    return solve_line(thesis_line(), LineSettings(nodes=2001)).numbers


@pytest.mark.slow
@each("stencil", ["upwind-2", "central", "upwind-1"])
def test_the_errors_of_a_line_bound_the_true_ones(stencil, exact_line):
    film = solve_line(thesis_line(), LineSettings(nodes=201, stencil=stencil))
    assert film.error.nodes == ((201,), (101,), (51,))
    for name in ("central_film", "minimum_film", "friction"):
        value, exact = getattr(film.numbers, name), getattr(exact_line, name)
        true = abs(value - exact) / abs(value)
        # twice it where the order is seen, at most ten times where it is not yet
        assert true <= getattr(film.error, name) < 10.0 * true, name
    assert "Estimated error of the grid, from 101, 51 nodes" in film.outcome


def test_a_line_is_refined_to_the_error_asked_for(exact_line):
    film = solve_line(thesis_line(), LineSettings(nodes=101), film_error=0.01)
    assert film.error.film <= 0.01
    assert abs(film.minimum_film / exact_line.minimum_film - 1.0) < 0.01
    assert "Refined from 101 to 801 nodes" in film.outcome


def test_a_search_stops_at_the_largest_grid_and_says_so():
    film = solve_line(thesis_line(), LineSettings(nodes=101), film_error=1e-3, most_nodes=300)
    assert film.nodes == (201,)
    assert film.converged
    assert "0.1 % that was asked for is not met" in film.outcome
    assert "more than 300" in film.outcome


def test_an_error_out_of_range_is_refused():
    with pytest.raises(ParameterError, match="film_error"):
        solve_line(thesis_line(), film_error=2.0)


@pytest.mark.slow
def test_a_contact_on_too_few_nodes_warns():
    # its smallest film grows by 29 % from 129 to 257 nodes, by the reference of the study
    contact = random_contacts(82)[81]
    film = solve_point_contact(contact.problem(129))
    assert film.converged
    assert film.error.minimum_film > 0.29
    assert "That is above 5 %: take more nodes." in film.outcome.sentence


@pytest.mark.slow
def test_a_point_contact_is_refined_to_the_error_asked_for():
    contact = moes_contact(20.0, 5.0, nodes=(33, 33))
    film = solve_point_contact(contact, film_error=0.05)
    assert film.nodes == (65, 65)
    assert film.error.film <= 0.05
    assert [one.nodes for one in film.coarser] == [(33, 33), (17, 17)]
    assert "Refined from 33 x 33 to 65 x 65 nodes" in film.outcome.sentence
    # the film on the coarser grid is a solution of its own
    alone = solve_point_contact(contact, PointSolverSettings(estimate_error=False))
    assert film.coarser[0].minimum_film == pytest.approx(alone.minimum_film, rel=1e-5)
    assert not alone.coarser


@pytest.mark.slow
def test_coarser_films_from_a_finer_one_are_those_of_a_nest_of_their_own():
    contact = moes_contact(100.0, 8.0, nodes=(65, 65))
    film = solve_point_contact(contact)
    nested = solve_point_contact(
        contact.with_nodes(33, 33), PointSolverSettings(estimate_error=False)
    )
    # both within the tolerance of their flow, 1e-5
    assert film.coarser[0].central_film == pytest.approx(nested.central_film, rel=1e-4)
    assert film.coarser[0].minimum_film == pytest.approx(nested.minimum_film, rel=1e-4)


@pytest.mark.slow
def test_a_line_at_rest_tells_the_error_of_its_grid_and_a_march_that_of_its_steps(tmp_path):
    film = jamali_2015_film("a", nodes=(49, 33), solids=None)
    moving, start = film.moving_film(), 470.0 * film.time_step
    rest = solve_steady_film(moving, start, MARCH_SETTINGS)
    assert [one.nodes for one in rest.coarser] == [(25, 17)]
    assert rest.error.minimum_film > 0.0
    marches = {}
    for parts in (1, 2):
        march = FilmMarch(moving, film.time_step / parts, start_time=start)
        for _ in range(6 * parts):
            march.step()
        marches[parts] = march
    whole, halves = (one.solution for one in marches.values())
    # what half the step changes is not more than the error of the whole one
    changed = abs(whole.minimum_film / halves.minimum_film - 1.0)
    assert changed < whole.time_error
    assert halves.time_error < whole.time_error
    # the record of a march keeps what the estimate needs
    marches[1].save(tmp_path / "march.npz")
    record = MarchRecord.read(tmp_path / "march.npz")
    resumed = FilmMarch(moving, film.time_step, start_time=start, record=record)
    one, other = marches[1].step(), resumed.step()
    assert other.time_error == pytest.approx(one.time_error, rel=1e-3)


@pytest.mark.slow
def test_a_line_marched_in_time_tells_the_error_of_its_steps():
    problem = thesis_line()
    start = solve_line(problem, LineSettings(nodes=101))
    passing = start.problem.half_width / problem.entrainment_speed

    def waves(x, time):
        place = (x - problem.speed_1 * time) / problem.half_width
        rising = 1.0 - 1.0 / (1.0 + (2.0 * time / passing) ** 2)
        return problem.undeformed_gap(x) + 1e-8 * rising * np.cos(2.0 * np.pi * place)

    least, told = {}, {}
    for count in (20, 40, 120):
        march = LineMarch(start, LineHistory(gap=waves), 2.0 * passing / count)
        films = [march.step() for _ in range(count)]
        # at the times that all three share, once the waves fill half of the contact
        shared = films[count // 20 - 1 :: count // 20][10:]
        least[count] = np.array([one.minimum_film for one in shared])
        told[count] = max(one.time_error for one in shared)
    for count in (20, 40):
        true = float(np.abs(least[count] / least[120] - 1.0).max())
        assert true < told[count] < 30.0 * true
    assert told[40] < 0.5 * told[20]
