"""A shear law written outside the package serves every film solution."""

from __future__ import annotations

import math
from itertools import product
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq

from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.eyring_1936 import Eyring
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.oil.shear_flow import shear_flow
from gearlube_core.oil.sheared_film import (
    _layered_stress,
    _shear_rate,
    flow_factor,
    layered_stress,
    mid_stress,
    shear_rate,
    stress_share,
)
from tests.helpers.each import each
from tests.helpers.small_films import SLIP, SPEED, films_in_time, line_film, point_film
from tests.helpers.source_of import source_of

TAU0 = 5e6


class PlainEyring(NamedTuple):
    """G = sinh(t)/t, without a closed form for anything."""

    tau0: float

    @kernel
    def rate_ratio(self, q: float) -> tuple[float, float]:
        if q < 0.01:
            return 1.0 + q / 6.0 + q * q / 120.0 + q**3 / 5040.0, (
                1.0 / 6.0 + q / 60.0 + q * q / 1680.0 + q**3 / 90720.0
            )
        t = math.sqrt(q)
        G = math.sinh(t) / t
        return G, 0.5 * (math.cosh(t) - G) / q


class Rabinowitsch(NamedTuple):
    """du/dz = (tau/eta) [1 + (tau/tau0)^2]."""

    tau0: float

    @kernel
    def rate_ratio(self, q: float) -> tuple[float, float]:
        return 1.0 + q, 1.0


PLAIN, CLOSED = PlainEyring(TAU0), Eyring(TAU0)


def oil(shear_law):
    return film_oil(eta0=0.05, alpha=15e-9, shear_law=shear_law)


@each("sigma", [0.0, 1e-3, 0.4, -3.0])
def test_quadrature_of_any_law_meets_eyrings_closed_forms(sigma):
    for a in (0.0, 0.3, -20.0, 1e6):
        factor, by_sigma, by_a = flow_factor(PLAIN, sigma, a)
        value, slope, slope_a = flow_factor(CLOSED, sigma, a)
        # the quadrature is exact to 1e-9; a slope at small Sigma is a difference over 1e-4
        assert factor == pytest.approx(value, rel=1e-8)
        assert by_sigma == pytest.approx(slope, rel=1e-5, abs=2e-4 * value)
        assert by_a == pytest.approx(slope_a, rel=1e-6, abs=1e-6)
        assert mid_stress(PLAIN, sigma, a) == pytest.approx(mid_stress(CLOSED, sigma, a), abs=1e-9)


def test_layers_of_uneven_viscosity_meet_eyrings_closed_form():
    eta = 40.0 * np.exp(np.sin(np.linspace(0.0, 3.0, 17)))
    for slope in (0.0, 4e13, -1e14):
        for sliding in (0.0, 0.3, -2.0):
            here = (eta, 3e-7, slope, sliding)
            # Newton's method stops at 1e-12 of the stress
            assert layered_stress(PLAIN, *here) == pytest.approx(
                layered_stress(CLOSED, *here), rel=1e-9, abs=1e-5
            )
    for stress in (1e4, 8e6, 3e7):
        assert shear_rate(PLAIN, stress, 2.0) == pytest.approx(shear_rate(CLOSED, stress, 2.0))
        assert stress_share(PLAIN, stress) == pytest.approx(stress_share(CLOSED, stress), rel=1e-6)


@each("law", [PLAIN, Rabinowitsch(TAU0)])
def test_layers_of_any_law_shear_as_far_as_the_walls_slide(law):
    """Drops of stress up to 240 tau0, where Newton's method alone swings about the root."""
    h, z = 3e-7, np.linspace(0.0, 1.0, 9)
    steepness, slopes = (0.0, 2.0, 30.0, -30.0), (0.0, 1e13, -2e15, 4e15)
    for steep, slope, sliding in product(steepness, slopes, (0.0, 1e-3, -4.0)):
        eta = 4.0 * np.exp(steep * z)
        middle = source_of(_layered_stress)(law, eta, h, slope, sliding)

        def slid(stress, slope=slope, eta=eta):
            local = stress + slope * h * (z - 0.5)
            rates = [source_of(_shear_rate)(law, *of) for of in zip(local, eta, strict=True)]
            return h * np.trapezoid(rates, z)

        # it rises with the stress: the root lies within 1e-9 of the largest stress there is
        near = 1e-9 * (abs(middle) + abs(slope) * h + TAU0)
        assert slid(middle - near) < sliding < slid(middle + near), (steep, slope, sliding)


@each("slope", [-1e15, 1e13, 1e15])
def test_stress_in_a_film_with_one_thin_wall_layer_is_finite_and_mirrored(slope):
    """Turned over, with the surfaces' speeds exchanged, a film has the opposite stress."""
    eta = np.array([1e18, 1e18, 1.0])  # all flow in the last layer, up to the last digit
    here = layered_stress(CLOSED, eta, 3e-7, slope, 0.3)
    there = layered_stress(CLOSED, eta[::-1].copy(), 3e-7, slope, -0.3)
    assert math.isfinite(here)
    assert there == pytest.approx(-here, rel=1e-12)


# both solvers are compiled again for the law. In the default run a line film has such a law, and
# the tests of a density law show that these solvers take the laws of their oil from outside
@pytest.mark.slow
def test_films_of_a_ball_are_eyrings_without_its_closed_forms():
    # the quadrature is exact to 1e-9, films are solved to 1e-9
    ours, theirs = oil(PLAIN), oil(CLOSED)
    assert point_film(ours).film == pytest.approx(point_film(theirs).film, rel=1e-7)
    one, other = films_in_time(ours)[2], films_in_time(theirs)[2]
    assert one.film == pytest.approx(other.film, rel=1e-7)


def rabinowitsch_stress(sigma: float, a: float) -> float:
    """T at mid-film: a = T + T^3 + T Sigma^2."""
    return brentq(lambda t: t + t**3 + t * sigma**2 - a, -1.0, 1.0 + a, xtol=1e-14)


def test_rabinowitsch_flow_factor_is_its_closed_form():
    # S = 1 + 3 T^2 + 3/5 Sigma^2, means of powers of Z by hand
    law = Rabinowitsch(TAU0)
    for sigma, a in product((0.0, 0.2, 5.0), (0.0, 0.1, 30.0)):
        T = rabinowitsch_stress(sigma, a)
        factor, _, _ = flow_factor(law, sigma, a)
        assert factor == pytest.approx(1.0 + 3.0 * T * T + 0.6 * sigma**2, rel=1e-8)
        assert mid_stress(law, sigma, a) == pytest.approx(T, abs=1e-8)
        across = shear_flow(law, sigma, 0.0, a, math.inf).across
        # g0 = 1 + T^2 + Sigma^2/3, g1 = 2 T Sigma/3, g2 = 1/3 + T^2/3 + Sigma^2/5
        g0, g1 = 1.0 + T * T + sigma**2 / 3.0, 2.0 * T * sigma / 3.0
        g2 = (1.0 + T * T) / 3.0 + sigma**2 / 5.0
        assert across == pytest.approx(3.0 * (g2 - g1 * g1 / g0), rel=1e-8)


def test_line_film_of_rabinowitsch_shears_and_flows_as_its_law_says():
    tau0 = 3e5
    film = line_film(oil(Rabinowitsch(tau0)), nodes=201)
    x, p, h, rho, eta = film.x, film.pressure, film.film, film.density, film.viscosity
    centre = int(np.argmax(p))
    tau = film.mean_stress[centre]
    # where the pressure is even: eta (u2 - u1)/h = tau [1 + (tau/tau0)^2]
    expected = eta[centre] * -SLIP / h[centre]
    assert tau * (1.0 + (tau / tau0) ** 2) == pytest.approx(expected, rel=1e-3)
    # dp/dx = 12 eta (rho u h - m)/(rho h^3 S) up to 0.8 of the largest pressure, where S is 7
    sigma, a = 0.5 * h * np.abs(np.gradient(p, x)) / tau0, eta * SLIP / (h * tau0)
    T = np.array([rabinowitsch_stress(*here) for here in zip(sigma, a, strict=True)])
    factor = 1.0 + 3.0 * T**2 + 0.6 * sigma**2
    slope = 12.0 * eta * (rho * SPEED * h - film.mass_flow[100]) / (rho * h**3 * factor)
    rising = (x < 0.0) & (p < 0.8 * p.max())
    rise = cumulative_trapezoid(slope[rising], x[rising], initial=0.0)
    # carried mass on 200 cells is good to 4 %; without S the rise is three times as large
    assert rise[-1] == pytest.approx(p[rising][-1] - p[rising][0], rel=0.06)


def test_a_shear_law_beside_an_eyring_stress_is_refused():
    with pytest.raises(ParameterError, match="eyring_stress and eyring_slope must be left out"):
        film_oil(eta0=0.05, alpha=15e-9, shear_law=PLAIN, eyring_stress=1e6)
    with pytest.raises(ParameterError, match="tau0"):
        oil(PlainEyring(0.0))
