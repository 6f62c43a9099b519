"""Mid-film stress of a sheared film at any ratio of sliding to stress, against nested bisection."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from gearlube_core.oil.eyring_1936 import Eyring
from gearlube_core.oil.shear_flow import shear_flow
from tests.helpers.each import each

LAW = Eyring(1.0)
Z, WEIGHTS = np.polynomial.legendre.leggauss(300)  # exact to rounding up to Sigma of 100


def mean_rates(T_s: float, T_r: float, sigma_s: float, sigma_r: float) -> np.ndarray:
    """Return the mean shear rates along and across sliding, tau/|tau| sinh|tau|."""
    s, r = T_s + sigma_s * Z, T_r + sigma_r * Z
    size = np.maximum(np.hypot(s, r), 1e-300)
    return 0.5 * np.array([s, r]) * np.sinh(size) / size @ WEIGHTS


def across(T_s: float, sigma_s: float, sigma_r: float) -> float:
    """Return T_r at which oil does not slide across."""
    if sigma_r == 0.0:
        return 0.0
    bound = abs(sigma_r)
    return brentq(lambda T: mean_rates(T_s, T, sigma_s, sigma_r)[1], -bound, bound, xtol=1e-14)


def stress(sigma_s: float, sigma_r: float, a: float, limit: float) -> tuple[float, float]:
    """Return T_s and T_r: the rate along sliding rises with T_s, and sinh(T_s - |Sigma_s|) < a."""

    def off(T: float) -> float:
        rate = mean_rates(T, across(T, sigma_s, sigma_r), sigma_s, sigma_r)[0]
        return math.asinh(rate) - math.asinh(a)

    bound = abs(sigma_s) + math.asinh(abs(a)) + 1.0
    T = math.copysign(min(abs(brentq(off, -bound, bound, xtol=1e-14)), limit), a)
    return T, across(T, sigma_s, sigma_r)


# amount of Sigma, its angle to sliding, a, limit; the first ones are those of a viscous film
FILMS = [
    *((size, angle, 150.0, math.inf) for size in (20.0, 100.0) for angle in (0.0, 0.3, 1.0, 1.57)),
    (17.9, 3.86, 1.23e9, 3.08),
    (11.4, 4.80, -6.6e6, 0.77),
    (19.6, 4.94, -1.2e10, 4.2),
    (11.3, 5.27, -2.8e3, 0.24),
    (40.0, 1.58, 7.8e13, 0.18),
    (7.3, 1.60, -9.6e10, 12.4),
    (28.0, 1.50, 1e6, math.inf),
    (45.2, 4.54, -1.5e9, 0.27),
    (51.5, 5.18, 1.3e11, math.inf),
    (67.42806836, 0.93471186, 3.64805201e13, math.inf),
    (58.58121076, 0.70282044, -2.02730853e10, math.inf),
    (49.84892939, 1.27628817, 6.01073164e13, math.inf),
    (0.02, 1.0, 1e12, math.inf),
]


@each("film", FILMS)
def test_mid_film_stress_is_found_at_any_viscosity(film):
    size, angle, a, limit = film
    sigma = size * math.cos(angle), size * math.sin(angle)
    found = shear_flow(LAW, *sigma, a, limit)
    # 1e-9 is what is promised
    assert (found.stress_s, found.stress_r) == pytest.approx(stress(*sigma, a, limit), abs=1e-9)


@pytest.mark.slow
def test_mid_film_stress_of_random_films():
    rng = np.random.default_rng(5)
    for _ in range(200):
        size, angle = 10.0 ** rng.uniform(-2.0, 2.0), rng.uniform(0.0, 2.0 * math.pi)
        a = rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-2.0, 14.0)
        limit = rng.choice([math.inf, 10.0 ** rng.uniform(-1.0, 1.3)])
        sigma = size * math.cos(angle), size * math.sin(angle)
        found = shear_flow(LAW, *sigma, a, limit)
        expected = stress(*sigma, a, limit)
        assert (found.stress_s, found.stress_r) == pytest.approx(expected, abs=1e-9)
