"""Point contact films against published formulas and a published computation."""

from __future__ import annotations

import math

import pytest

from gearlube_core.ehl.point.problem import elliptical_contact
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.ehl_point_cases import moes_contact, moes_film


def test_the_film_of_mouriers_contact_is_that_of_a_published_solver() -> None:
    problem = elliptical_contact(
        R_x=0.0125,
        R_y=0.0125,
        entrainment=(0.09, 0.0),
        load=15.0,
        contact_modulus=0.5 * 110e9,
        lubricant=film_oil(eta0=0.25, alpha=22e-9),
        nodes=(129, 129),
    )
    solution = solve_point_contact(problem)
    # ErikHansenGit/EHL: 225.8 and 125.5 nm at 129 x 129, 219.9 and 123.0 at 257 x 257, still
    # falling with the grid by 3 % a halving; 8 % for that and the laws of viscosity and density
    assert solution.central_film == pytest.approx(219.9e-9, rel=0.08)
    assert solution.minimum_film == pytest.approx(123.0e-9, rel=0.10)


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
    # a fit over M, L and ellipticity, quoted with 10 % to 15 %
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
