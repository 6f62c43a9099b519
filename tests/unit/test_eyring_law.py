"""The shear law of Eyring against the definition and against sums over layers."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from gearlube_core.oil.eyring_1936 import NEWTONIAN, Eyring, eyring_stress_ratio
from tests.helpers.each import each
from tests.helpers.source_of import source_of

TAU0 = 5e6  # Pa
LAW = Eyring(TAU0)
FILM = 3e-7  # m


def sliding_of(stress, eta, slope, tau0=TAU0):
    """Sum of shear rates over the film by the trapezoidal rule [m/s], stress at mid-film."""
    z = np.linspace(-0.5, 0.5, eta.size)
    rate = tau0 / eta * np.sinh((stress + slope * FILM * z) / tau0)
    return FILM * np.trapezoid(rate, z)


@each("sliding", [-2.0, 0.0, 0.3, 5.0])
@each("slope", [-6e13, 0.0, 2e13])
@each("layers", [2, 3, 12])
def test_layers_shear_by_the_sliding_together(layers, slope, sliding):
    eta = 30.0 * np.exp(np.cos(np.linspace(0.3, 4.0, layers)))
    expected = brentq(lambda t: sliding_of(t, eta, slope) - sliding, -1e9, 1e9, xtol=1e-6)
    found = source_of(Eyring.layered_stress)(LAW, eta, FILM, slope, sliding)
    assert found == pytest.approx(expected, rel=1e-10, abs=1e-4)


@pytest.mark.parametrize("slope", [-3e13, 0.0, 2e13])
def test_newtonian_layers_share_the_sliding_by_their_fluidity(slope):
    eta = np.array([10.0, 20.0, 5.0])
    found = source_of(Eyring.layered_stress)(NEWTONIAN, eta, FILM, slope, 0.4)
    # weights 1/4, 1/2, 1/4: fluidity 0.025 + 0.025 + 0.05, its moment (0.05 - 0.025)/2
    expected = (0.4 / FILM - slope * FILM * 0.0125) / 0.1
    assert found == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize("slope", [-1e15, 1e15])
def test_all_flow_in_a_thin_wall_layer_has_a_finite_stress(slope):
    eta = np.array([1e18, 1e18, 1.0])
    one = source_of(Eyring.layered_stress)(LAW, eta, FILM, slope, 0.3)
    other = source_of(Eyring.layered_stress)(LAW, eta[::-1].copy(), FILM, slope, -0.3)
    assert math.isfinite(one)
    assert other == pytest.approx(-one, rel=1e-12)


@each("t", [1e-3, 0.3, 0.499, 0.501, 2.0, 30.0])
def test_rate_ratio_is_sinh_over_its_argument_with_its_slope(t):
    ratio, slope = source_of(Eyring.rate_ratio)(LAW, t * t)
    assert ratio == pytest.approx(math.sinh(t) / t, rel=1e-14)
    # dG/dq of the series 1 + q/3! + q^2/5! + ...
    series = sum(k * t ** (2 * k - 2) / math.factorial(2 * k + 1) for k in range(1, 60))
    # cosh t - G loses digits just above the series' end
    assert slope == pytest.approx(series, rel=1e-13)


@each(("x", "y"), [(1e-3, 0.0), (2.0, 3.0), (5.0, -4.0), (3.0, 17.0), (2.0, 19.0)])
def test_stress_ratio_is_the_inverse_of_sinh(x, y):
    found = source_of(eyring_stress_ratio)(x, y)
    assert math.sinh(found) == pytest.approx(x * math.exp(y), rel=1e-11)


def test_stress_ratio_has_no_limit_and_none_without_shear():
    ratio = source_of(eyring_stress_ratio)
    assert ratio(3.0, 5000.0) == pytest.approx(5000.0 + math.log(6.0), rel=1e-14)
    assert ratio(0.5, 0.0) == pytest.approx(math.asinh(0.5), rel=1e-14)
    assert ratio(0.0, 3.0) == 0.0


@pytest.mark.parametrize("stress", [-4e6, -1e2, 3e3, 2e7])
def test_shear_rate_and_share_are_those_of_the_law(stress):
    rate = source_of(Eyring.shear_rate)
    assert rate(LAW, stress, 2.0) == pytest.approx(TAU0 / 2.0 * math.sinh(stress / TAU0), rel=1e-14)
    assert rate(NEWTONIAN, stress, 2.0) == 0.5 * stress
    assert math.isfinite(rate(LAW, 1e12, 2.0))
    share = source_of(Eyring.stress_share)
    size = abs(stress)
    # d ln tau/d ln eta at one rate: tanh(t)/t, since cosh(t) dt = sinh(t) d ln eta
    t = size / TAU0
    assert share(LAW, size) == pytest.approx(math.tanh(t) / t, rel=1e-6)
    assert share(NEWTONIAN, size) == share(LAW, 0.0) == 1.0
