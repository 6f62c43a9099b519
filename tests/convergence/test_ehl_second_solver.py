"""Films of lines and points against a second solver, which shares no code with the first."""

from __future__ import annotations

import math

import pytest

from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.point.contact_domain import ContactDomain
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.ehl_point_cases import ALPHA, ETA0, RADIUS, REDUCED_MODULUS, moes_contact
from tests.references import dense_line_film, dense_point_film

# of Moes; the last is U 1e-11, G 5000, W 1e-4 of Dowson and Higginson's chart
LINES = ((5.0, 5.0), (20.0, 10.0), (22.36, 10.57))
# M 20, L 5: what pairs of 33, 49, 65 and 97 nodes of the second solver go to. H_c from the
# finest pair on is 2.9496 to 2.9506; H_min is 1.994 to 2.001, as the least node moves
POINT_DOMAIN = (-4.0, 2.0, 3.0)
POINT_CENTRAL, POINT_MINIMUM = 2.9500, 1.9985


def limit(fine: float, coarse: float, ratio: float) -> float:
    """Return what two grids go to at second order."""
    return fine + (fine - coarse) / (ratio**2 - 1.0)


def speed_group(L: float) -> float:
    return 0.5 * (L / (ALPHA * REDUCED_MODULUS)) ** 4


def second_point(nodes: int) -> tuple[float, float]:
    U, M = speed_group(5.0), 20.0
    ball = dense_point_film.Ball(
        radius=RADIUS,
        load=M * (2.0 * U) ** 0.75 * REDUCED_MODULUS * RADIUS**2,
        speed=U * REDUCED_MODULUS * RADIUS / ETA0,
        reduced_modulus=REDUCED_MODULUS,
        eta0=ETA0,
        alpha=ALPHA,
    )
    central, minimum = dense_point_film.film(ball, nodes, POINT_DOMAIN)
    scale = RADIUS * math.sqrt(2.0 * U)
    return central / scale, minimum / scale


@pytest.mark.parametrize(("M", "L"), LINES)
def test_line_films_are_those_of_a_second_solver(M: float, L: float) -> None:
    U = speed_group(L)
    load = M * math.sqrt(2.0 * U) * REDUCED_MODULUS * RADIUS
    speed = U * REDUCED_MODULUS * RADIUS / ETA0
    b = math.sqrt(8.0 * load * RADIUS / (math.pi * REDUCED_MODULUS))
    line = dense_line_film.Cylinder(RADIUS, load, speed, REDUCED_MODULUS, ETA0, ALPHA)
    coarse, fine = (dense_line_film.film(line, nodes, (-4.0, 2.0)) for nodes in (151, 301))
    contact = LineProblem(
        lubricant=film_oil(eta0=ETA0, alpha=ALPHA),
        radius=RADIUS,
        line_load=load,
        reduced_modulus=REDUCED_MODULUS,
        speed_1=speed,
        speed_2=speed,
        domain=(-4.0 * b, 2.0 * b),
    )
    solved = solve_line(contact, LineSettings(nodes=801))
    before = solved.coarser[0]
    # extrapolated over 3.3 % at most; what is left is of third order in 1/301, 0.1 %
    assert limit(solved.central_film, before.central_film, 2.0) == pytest.approx(
        limit(fine[0], coarse[0], 2.0), rel=1e-3
    )
    # the parabola through the least node moves with the grid: 3.9 % is extrapolated, by a tenth off
    assert limit(solved.minimum_film, before.minimum_film, 2.0) == pytest.approx(
        limit(fine[1], coarse[1], 2.0), rel=4e-3
    )


def test_point_films_are_within_half_a_per_cent_of_a_second_solver() -> None:
    inlet, outlet, side = POINT_DOMAIN
    domain = ContactDomain(inlet=-inlet, outlet=outlet, side=side)
    problem = moes_contact(20.0, 5.0, nodes=(97, 97), domain=domain)
    settings = PointSolverSettings(wedge="quick", estimate_error=False)
    solution = solve_point_contact(problem, settings)
    scale = RADIUS * math.sqrt(2.0 * speed_group(5.0))
    # 0.1 % of this grid and 0.1 % of the extrapolation
    assert solution.central_film / scale == pytest.approx(POINT_CENTRAL, rel=2e-3)
    # the least node lies beside the least film: 0.1 % here, 0.2 % in the extrapolation
    assert solution.minimum_film / scale == pytest.approx(POINT_MINIMUM, rel=5e-3)


def test_the_second_solver_goes_to_the_film_that_stands_here() -> None:
    (coarse, _), (fine, _) = second_point(25), second_point(33)
    # a fifth of the film is extrapolated; third order leaves a hundredth of that
    assert limit(fine, coarse, 4.0 / 3.0) == pytest.approx(POINT_CENTRAL, rel=3e-3)


@pytest.mark.slow
def test_the_second_solver_on_finer_grids_goes_there_more_closely() -> None:
    coarse, fine = second_point(49), second_point(65)
    # 3.3 % and 2.4 % are extrapolated
    assert limit(fine[0], coarse[0], 4.0 / 3.0) == pytest.approx(POINT_CENTRAL, rel=1e-3)
    assert limit(fine[1], coarse[1], 4.0 / 3.0) == pytest.approx(POINT_MINIMUM, rel=2e-3)
