"""Line contact on finer grids: orders of film and pressure, balances, one answer of all schemes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.oil.film_oil_data import film_oil, jamali_2015_oil
from tests.helpers.each import each
from tests.helpers.ehl_line_cases import thesis_line

THESIS = thesis_line(lubricant=jamali_2015_oil(newtonian=True), domain=(-1.0e-3, 0.38e-3))
# M 2, L 2.5: the spike is as wide as the contact and resolved from 250 nodes on
MILD = LineProblem(
    lubricant=film_oil(eta0=0.04, alpha=20e-9),
    radius=0.01,
    line_load=6238.0,
    reduced_modulus=2.2e11,
    speed_1=2.87e-3,
    speed_2=2.87e-3,
    domain=(-3.8e-4, 1.1e-4),
)


def measures(contact: LineProblem, nodes: int, stencil: str) -> np.ndarray:
    film = solve_line(contact, LineSettings(nodes=nodes, stencil=stencil))
    return np.array([film.central_film, film.minimum_film, film.maximum_pressure])


def observed_orders(contact: LineProblem, stencil: str, counts: tuple[int, ...]) -> np.ndarray:
    values = np.array([measures(contact, n, stencil) for n in counts])
    steps = np.abs(np.diff(values, axis=0))
    return np.log2(steps[-2] / steps[-1])


@each("stencil", ["central", "upwind-2", "galerkin"])
def test_film_converges_with_second_order(stencil):
    orders = observed_orders(THESIS, stencil, (251, 501, 1001))
    # asymptotic order; the parabola through the least film wanders between nodes
    assert orders[0] == pytest.approx(2.0, abs=0.15)
    assert orders[1] == pytest.approx(2.0, abs=0.25)


@pytest.mark.parametrize("stencil", ["central", "galerkin"])
def test_pressure_of_a_mild_contact_converges_with_second_order(stencil):
    orders = observed_orders(MILD, stencil, (251, 501, 1001))
    assert np.all(orders > 1.6)


def test_upwind_stencil_of_first_order_has_it():
    # on these grids the order is still rising towards one; a second-order scheme shows 2
    orders = observed_orders(MILD, "upwind-1", (501, 1001, 2001))
    assert orders[0] == pytest.approx(0.9, abs=0.15)


def test_all_stencils_tend_to_one_film():
    # extrapolated with each one's order, so that what is left is of higher order
    limits = {}
    for stencil in ("central", "upwind-2", "galerkin"):
        coarse, fine = measures(THESIS, 501, stencil), measures(THESIS, 1001, stencil)
        limits[stencil] = fine + (fine - coarse) / 3.0
    for stencil in ("upwind-2", "galerkin"):
        assert limits[stencil][:2] == pytest.approx(limits["central"][:2], rel=3e-4)
        assert limits[stencil][2] == pytest.approx(limits["central"][2], rel=1e-4)


@each("stencil", ["central", "upwind-1", "upwind-2"])
def test_mass_flow_and_load_are_balanced(stencil):
    film = solve_line(THESIS, LineSettings(nodes=501, stencil=stencil))
    assert film.mass_balance < 1e-8
    assert abs(film.load_error) < 1e-8
    assert film.pressure.sum() * (film.x[1] - film.x[0]) == pytest.approx(360e3, rel=1e-8)
    assert np.all(film.pressure >= 0.0)
    assert np.all(film.film > 0.0)


def test_inlet_of_the_chosen_domain_is_flooded():
    chosen = solve_line(replace(THESIS, domain=None), LineSettings(nodes=1001))
    wide = solve_line(replace(THESIS, domain=(-2.0e-3, 0.38e-3)), LineSettings(nodes=1601))
    # the inlet's end starves the film by the inverse of gap over film there, squared or so
    assert chosen.central_film == pytest.approx(wide.central_film, rel=1.5e-3)


def test_reversed_entrainment_mirrors_the_film():
    forward = solve_line(THESIS, LineSettings(nodes=301))
    mirror = replace(
        THESIS, speed_1=-THESIS.speed_1, speed_2=-THESIS.speed_2, domain=(-0.38e-3, 1.0e-3)
    )
    backward = solve_line(mirror, LineSettings(nodes=301))
    # rounding, grown by the condition of the Jacobian
    assert backward.film[::-1] == pytest.approx(forward.film, rel=1e-7)
    assert backward.pressure[::-1] == pytest.approx(forward.pressure, rel=1e-6, abs=1.0)


def test_sheared_films_are_near_their_limit_on_coarse_grids() -> None:
    oil = film_oil(eta0=0.04, alpha=2e-8, eyring_stress=5e6)
    problem = LineProblem(
        lubricant=oil,
        radius=0.01,
        line_load=5e5,
        reduced_modulus=2.26e11,
        speed_1=2.5,
        speed_2=7.5,
    )
    coarse, fine = (solve_line(problem, LineSettings(nodes=n)).film.min() for n in (201, 1001))
    # 4.4 %; with means of viscosity and flow factor apart 9 %
    assert coarse == pytest.approx(fine, rel=0.06)
