"""Where a line contact's domain ends, its nest of grids, and the dry contact that it starts from."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from gearlube_core.ehl.line.problem import LineProblem, LineSettings, _hertz_distance
from gearlube_core.ehl.line.solver import grid_nest, hertz_start
from gearlube_core.ehl.line.system import LineSystem
from gearlube_core.oil.film_oil_data import film_oil

CONTACT = LineProblem(
    lubricant=film_oil(eta0=0.04, alpha=2e-8), radius=0.01, line_load=2e5, reduced_modulus=2.3e11,
    speed_1=3.0, speed_2=1.0,
)  # fmt: skip


@pytest.mark.parametrize("X", [1.02, 1.5, 4.0, 30.0])
def test_gap_beside_a_dry_contact_is_the_integral_of_its_slope(X: float) -> None:
    """dh/dX = (X^2 - 1)^(1/2) in units of b^2/R beside the Hertz contact."""
    gap = quad(lambda t: math.sqrt(t * t - 1.0), 1.0, X, epsabs=0.0, epsrel=1e-10)[0]
    assert _hertz_distance(gap) == pytest.approx(X, rel=2e-6)  # of the root finder: 1e-6


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_domain_reaches_to_gaps_of_150_films_ahead_and_4_behind(way: float) -> None:
    # thick films, or least distances of 2 and 1.3 half widths hold
    viscous = film_oil(eta0=4.0, alpha=2e-8)
    contact = replace(CONTACT, lubricant=viscous, speed_1=3.0 * way, speed_2=way)
    b, R = contact.half_width, contact.radius
    first, last = contact.extent()
    inlet, outlet = (-first, last) if way > 0.0 else (last, -first)
    for place, films in ((inlet, 150.0), (outlet, 4.0)):
        gap = quad(lambda t: math.sqrt(t * t - 1.0), 1.0, place / b)[0] * b * b / R
        # rtol 1e-6 of the distance, twice that of the gap and more near the contact
        assert gap == pytest.approx(films * contact.film_guess(), rel=1e-5, abs=0.0)
    thin = replace(contact, lubricant=film_oil(eta0=1e-4, alpha=2e-8))
    near = (-2.0 * b, 1.3 * b) if way > 0.0 else (-1.3 * b, 2.0 * b)
    assert thin.extent() == pytest.approx(near, rel=1e-12, abs=0.0)


@pytest.mark.parametrize(("nodes", "coarsest"), [(1601, 51), (1601, 50), (481, 61), (641, 700)])
def test_grids_of_the_nest_share_every_second_node(nodes: int, coarsest: int) -> None:
    counts = grid_nest(LineSettings(nodes=nodes, coarsest=coarsest))
    assert counts[-1] == nodes
    for few, many in zip(counts, counts[1:], strict=False):
        assert many - 1 == 2 * (few - 1)
    # none below the coarsest, and no room for one more
    assert counts[0] >= min(coarsest, nodes)
    assert (counts[0] - 1) // 2 + 1 < coarsest


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("film", [2e-7, 4e-5])
def test_start_is_the_dry_contact_with_the_film_at_its_middle(way: float, film: float) -> None:
    contact = replace(CONTACT, speed_1=3.0 * way, speed_2=way, domain=(-2e-3, 2e-3))
    system = LineSystem(contact, 401, "upwind-2", False)
    state = hertz_start(system, film)
    x, P = system.x, state.P
    # a thick film carries as far as a quarter of it opens, x^2/(2 R) = film/4
    width = max(contact.half_width, math.sqrt(0.5 * film * contact.radius))
    inside = np.abs(x) < width
    shape = np.sqrt(1.0 - (x[inside] / width) ** 2)
    np.testing.assert_allclose(P[inside] / P.max(), shape / shape.max(), atol=1e-12)
    # the load is closed up to the oil ahead, 1e-6 of the pressure
    assert P[inside].sum() * system.step == pytest.approx(0.5 * math.pi, rel=1e-12)
    ahead = (way * x < 0.0) & ~inside
    assert np.all(P[ahead][1:-1] == 1e-6)
    assert np.all(P[(way * x > 0.0) & ~inside] == 0.0)
    assert P[0] == P[-1] == 0.0
    middle = np.interp(0.0, x, system.film(state)) * system.scales.film
    # the oil ahead deflects by 1e-6 of b^2/R
    slack = 1e-5 * contact.half_width**2 / contact.radius
    assert middle == pytest.approx(film, rel=0.0, abs=slack)
