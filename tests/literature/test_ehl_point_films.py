"""Point contact films against published formulas and a published computation."""

from __future__ import annotations

import math

import pytest

from gearlube_core.ehl.point.problem import ContactDomain, elliptical_contact
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.dowson_higginson_1966 import DowsonHigginson
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.ehl_point_cases import moes_contact, moes_film

# films [m] of Mourier's contact by nodes along a side, ErikHansenGit/EHL: first-order upwind
# differences, three radii of oil to every side, rho/rho0 = (5.9e8 + 1.34 p)/(5.9e8 + p)
PUBLISHED = {65: (232.9e-9, 125.8e-9), 129: (225.8e-9, 125.5e-9), 257: (219.9e-9, 123.0e-9)}


def mouriers_film(nodes: int, wedge: str) -> PointSolution:
    density = DowsonHigginson(1.34 / 5.9e8, 1.0 / 5.9e8)
    problem = elliptical_contact(
        R_x=0.0125,
        R_y=0.0125,
        entrainment=(0.09, 0.0),
        load=15.0,
        contact_modulus=0.5 * 110e9,
        lubricant=film_oil(eta0=0.25, alpha=22e-9, density_law=density),
        nodes=(nodes, nodes),
        domain=ContactDomain(inlet=3.0, outlet=3.0, side=3.0),
    )
    return solve_point_contact(problem, PointSolverSettings(wedge=wedge, estimate_error=False))


@pytest.mark.parametrize(
    ("nodes", "near"),
    # both first order, with other means of h^3/eta at a face: 1.4 % and 1.7 % apart on 129 nodes,
    # 0.4 % and 0.5 % on 257
    [(129, 0.018), pytest.param(257, 0.006, marks=pytest.mark.slow)],
)
def test_mouriers_film_is_that_of_a_published_solver_on_its_grid(nodes: int, near: float) -> None:
    solution = mouriers_film(nodes, "upwind-1")
    central, minimum = PUBLISHED[nodes]
    assert solution.central_film == pytest.approx(central, rel=near)
    assert solution.minimum_film == pytest.approx(minimum, rel=near)


def test_mouriers_film_is_where_the_published_grids_go() -> None:
    solution = mouriers_film(97, "quick")
    limits = [
        2.0 * fine - coarse for fine, coarse in zip(PUBLISHED[257], PUBLISHED[129], strict=True)
    ]
    # 214.0 and 120.5 nm. The pair of coarser grids goes to 218.7 nm: worth 2 %, the grid here 0.1 %
    assert solution.central_film == pytest.approx(limits[0], rel=0.015)
    # and the least node 1 %
    assert solution.minimum_film == pytest.approx(limits[1], rel=0.02)


@pytest.mark.parametrize(
    ("M", "L", "expected"),
    [
        (20.0, 5.0, 2.866),
        pytest.param(20.0, 10.0, 4.265, marks=pytest.mark.slow),
        (50.0, 10.0, 4.195),
        pytest.param(200.0, 10.0, 4.042, marks=pytest.mark.slow),
    ],
)
def test_central_films_follow_nijenbanning_venner_moes(M: float, L: float, expected: float) -> None:
    problem = moes_contact(M, L, nodes=(129, 129))
    solution = solve_point_contact(problem)
    # a fit over M, L and ellipticity, quoted with 10 % to 15 %; solved films are held to 0.5 % in
    # tests/convergence/test_ehl_second_solver.py and test_ehl_film_table.py
    assert moes_film(problem, solution.central_film) == pytest.approx(expected, rel=0.15)


def test_films_follow_hamrock_and_dowson() -> None:
    problem = moes_contact(60.0, 8.0, nodes=(129, 129))
    solution = solve_point_contact(problem)
    E, R = 2.0 * problem.contact_modulus, 0.01
    U = problem.lubricant.eta0 * problem.entrainment[0] / (E * R)
    W, G = problem.load / (E * R**2), 2e-8 * E
    central = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * math.exp(-0.73))
    smallest = 3.63 * U**0.68 * G**0.49 * W**-0.073 * (1.0 - math.exp(-0.68))
    # the formulas scatter by 10 % to 20 % about computed films
    assert solution.central_film / R == pytest.approx(central, rel=0.15)
    assert solution.minimum_film / R == pytest.approx(smallest, rel=0.2)
