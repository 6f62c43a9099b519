"""Where the domain of a line contact begins and ends."""

import math
from dataclasses import replace

import pytest
from scipy.integrate import quad

from gearlube_core.ehl.line.problem import LineProblem, _hertz_distance
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
