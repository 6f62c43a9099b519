"""Traction of solved films: one curve of isothermal Eyring films, and the order of base oils.

Nothing here is fitted: viscosity, Eyring stress and limiting stress are those of the sources.
"""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.thermal import ThermalSettings, thermal_line_on_grid
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.friction.flank_data import CONSISTENT
from gearlube_core.friction.mixed_friction import mixed_friction
from gearlube_core.oil.film_oil import viscosity
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import celsius_to_kelvin
from tests.helpers.each import each

BASE_OILS = ("arana_2019_n100", "arana_2019_m100", "arana_2019_pao100")
SMOOTH = SurfaceParameters(sigma=1e-9, xi_beta_sigma=0.05, sigma_over_beta=0.001)
HERTZ_PRESSURE, RADIUS, MODULUS = 1e9, 0.02, 227e9


@pytest.mark.slow
@each(
    ("eta0", "alpha", "speed", "ratio", "load"),
    [(0.01, 1.5e-8, 1.0, 1.0, 100.0), (0.02, 1.3e-8, 1.0, 2.0, 200.0)],
)
def test_isothermal_eyring_films_fall_on_one_curve_of_traction(eta0, alpha, speed, ratio, load):
    """Mean of tau0 asinh[eta(p) dU/(h tau0)] over Hertz's ellipse, over four decades of sliding.

    The form of Jacod, Venner and Lugt 2001 (doi 10.1115/1.1308021). The film is 1 to 3 percent of
    what the solids flatten, and its pressure, so its traction, is Hertz's to about that.
    """
    stresses, expected = [], []
    for tau0 in (3e6, 10e6):
        for slide_roll in (1e-4, 1e-2, 1.0):
            oil = film_oil(eta0=eta0, alpha=alpha, law="roelands", eyring_stress=tau0)
            contact = elliptical_contact(
                R_x=0.012,
                R_y=0.012 * ratio,
                entrainment=(speed, 0.0),
                sliding=(slide_roll * speed, 0.0),
                load=load,
                contact_modulus=1.15e11,
                lubricant=oil,
                nodes=(65, 65),
            )
            film = solve_point_contact(contact)
            mean = 2.0 / 3.0 * contact.hertz_contact[2]
            # the ellipse's area is spread evenly over (p/p_max)^2
            p = 1.5 * mean * np.sqrt((np.arange(400) + 0.5) / 400)
            eta = np.array([viscosity(oil, one) for one in p])
            rate = eta * slide_roll * speed / (film.central_film * tau0)
            stresses.append(film.friction_coefficient * mean / tau0)
            expected.append(np.arcsinh(rate).mean())
    assert np.ptp(np.log(expected)) > np.log(3.0)
    assert stresses == pytest.approx(expected, rel=0.04)


def traction(name: str, speed: float, slide_roll: float) -> float:
    oil = film_oil_of(Lubricant.named(name), celsius_to_kelvin(60.0))
    problem = LineProblem(
        lubricant=oil,
        radius=RADIUS,
        line_load=2.0 * np.pi * HERTZ_PRESSURE**2 * RADIUS / MODULUS,
        reduced_modulus=MODULUS,
        speed_1=speed * (1.0 - 0.5 * slide_roll),
        speed_2=speed * (1.0 + 0.5 * slide_roll),
    )
    steel = STEEL_MOHAMMADPOUR_2015
    settings = (
        LineSettings(nodes=257, tolerance=1e-7),
        ThermalSettings(tolerance=3e-3, max_turns=80),
    )
    warm = thermal_line_on_grid(problem, (steel, steel), *settings)
    assert warm.converged
    return warm.film.friction_coefficient


@pytest.mark.slow
@each("speed", [2.0, 8.0])
@each("slide_roll", [0.02, 0.1, 0.3])
def test_naphthenic_oil_has_more_traction_than_paraffinic_and_that_more_than_pao(speed, slide_roll):
    """The order on twin discs at 1 GPa and 60 degC [arana_2019], and of base fluids in general
    (Zhang, Tan and Spikes 2017, doi 10.1007/s11249-016-0791-7).
    """
    naphthenic, paraffinic, pao = (traction(name, speed, slide_roll) for name in BASE_OILS)
    assert naphthenic > 1.1 * paraffinic > 1.1 * 1.1 * pao


def test_heat_takes_traction_of_fast_films_in_much_sliding_and_not_of_slow_ones():
    """[arana_2019]: traction over sliding has a maximum and then falls by heat."""
    slow = [traction("arana_2019_m100", 2.0, s) for s in (0.02, 0.1)]
    fast = [traction("arana_2019_m100", 8.0, s) for s in (0.05, 0.2)]
    assert slow[1] > 1.1 * slow[0]
    assert fast[1] < 0.9 * fast[0]


@each(("name", "Lambda"), [("arana_2019_n100", 0.053), ("fva_3", 0.047)])
def test_formulas_limit_the_friction_of_an_oil_film_to_lambda(name, Lambda):
    """A smooth flank under 2 GPa whose film of the naphthenic oil is far beyond its limit."""
    oil = Lubricant.named(name).state(celsius_to_kelvin(40.0))
    solid = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
    # heat is left out: the film hardly slides
    mu = mixed_friction(
        100.0, 100.0, 2e9, 0.5e-6, 3.0, 0.05, 0.01, 5e-8, oil, SMOOTH, solid, CONSISTENT
    ).friction_coefficient
    assert mu == pytest.approx(Lambda, rel=1e-12)
