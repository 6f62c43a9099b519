"""The stated error of a thermal point film and the search for a film, with made-up films."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import pytest

from gearlube_core.ehl import grid_error
from gearlube_core.ehl.point.thermal import solver as module
from gearlube_core.ehl.point.thermal.solver import solve_thermal_point
from gearlube_core.errors import ConvergenceError


@dataclass(frozen=True)
class Film:
    """What the search reads of a film."""

    nodes: tuple[int, int]
    converged: bool
    outcome: str = "Converged."
    coarser: tuple = ()
    seconds: float = 0.0
    wider: object = None

    @property
    def film(self):
        return SimpleNamespace(problem=SimpleNamespace(widened=lambda: None))

    @property
    def error(self):
        return SimpleNamespace(sentence=f" {len(self.coarser)} coarser.")


PROBLEM = SimpleNamespace(nodes=(33, 17), with_nodes=lambda *nodes: nodes)
SETTINGS = SimpleNamespace(estimate_error=False)


@pytest.fixture
def grids(monkeypatch):
    """Numbers of nodes that were solved on; those of 17 along x find no film."""
    solved = []

    def on_grid(nodes, solids, settings, thermal):
        assert (solids, settings) == (("below", "above"), SETTINGS)
        solved.append(nodes)
        return Film(nodes, nodes[0] != 17)

    def coarser_films(film, on_coarser_grid, closed):
        assert on_coarser_grid((17, 9), film) is None
        return (on_coarser_grid((25, 13), film),)

    def refined_film(film, film_error, most_nodes, on_grid, closed):
        assert (film_error, most_nodes) == (0.01, 129)
        finer = replace(on_grid((65, 33)), coarser=(film, *film.coarser))
        return finer, " Refined once."

    monkeypatch.setattr(module, "_on_grid", on_grid)
    monkeypatch.setattr(grid_error, "coarser_films", coarser_films)
    monkeypatch.setattr(grid_error, "refined_film", refined_film)
    monkeypatch.setattr(module, "check_thermal", lambda problem, settings: None)
    monkeypatch.setattr(SETTINGS, "estimate_error", False)
    return solved


def solve(problem=PROBLEM, **options):
    return solve_thermal_point(problem, "below", "above", settings=SETTINGS, **options)


@pytest.mark.usefixtures("grids")
def test_film_that_is_refined_tells_its_error_and_its_search():
    film = solve(film_error=0.01, most_nodes=129)
    assert film.nodes == (65, 33)
    assert film.outcome == "Converged. 2 coarser. Refined once."
    assert film.seconds > 0.0


def test_film_on_one_grid_tells_its_error_where_it_is_asked_for(grids, monkeypatch):
    monkeypatch.setattr(SETTINGS, "estimate_error", True)
    film = solve()
    assert (film.nodes, film.outcome) == ((33, 17), "Converged. 1 coarser.")
    assert grids == [(33, 17), (17, 9), (25, 13)]


def test_film_alone_says_no_more_than_that_it_converged(grids):
    assert solve() == Film((33, 17), True)
    assert grids == [(33, 17)]


def test_film_that_is_not_found_is_returned_on_demand_and_never_refined(grids):
    problem = SimpleNamespace(nodes=(17, 17), with_nodes=lambda *nodes: nodes)
    assert solve(problem, film_error=0.01, most_nodes=129, throw=False) == Film((17, 17), False)
    with pytest.raises(ConvergenceError, match="Converged"):
        solve(problem)
    assert grids == [(17, 17)] * 2
