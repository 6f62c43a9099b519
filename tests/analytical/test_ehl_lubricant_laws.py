"""The oil of a film: laws against their printed form, slopes against differences, limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from gearlube_core.errors import ParameterError
from gearlube_core.oil.eyring_1936 import eyring_flow_factor, eyring_mean_stress
from gearlube_core.oil.film_oil import (
    density,
    film_properties,
    limiting_stress,
    pressure_viscosity,
    thermal_viscosity,
    viscosity,
)
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of, jamali_2015_oil
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.each import each
from tests.helpers.oil_slopes import density_slope, viscosity_slope

PRESSURES = (0.0, 1e6, 2e8, 1e9, 3e9)


def test_roelands_viscosity_is_the_printed_form_of_the_thesis():
    oil = jamali_2015_oil()
    A = math.log(0.00625 / 63.15e-6)
    Z = 13.3e-9 / (5.1e-9 * A)
    for p in PRESSURES:
        printed = 0.00625 * math.exp(A * ((1.0 + 5.1e-9 * p) ** Z - 1.0))
        # rounding of a power, times the exponent
        assert viscosity(oil, p) == pytest.approx(printed, rel=1e-13)


def test_barus_viscosity_is_exponential():
    oil = film_oil(eta0=0.05, alpha=20e-9, law="barus")
    for p in PRESSURES:
        assert viscosity(oil, p) == pytest.approx(0.05 * math.exp(20e-9 * p), rel=1e-13)


@each("law", ["barus", "roelands", "houpert"])
def test_slopes_are_the_derivatives_of_the_values(law):
    oil = film_oil(eta0=0.05, alpha=20e-9, law=law)
    for p in (1e7, 2e8, 1e9):
        d = 1e-5 * p
        # central difference: second-order error (d alpha)^2/6 below 1e-7
        slope = (viscosity(oil, p + d) - viscosity(oil, p - d)) / (2.0 * d)
        assert viscosity_slope(oil, p) == pytest.approx(slope, rel=1e-6)
        slope = (density(oil, p + d) - density(oil, p - d)) / (2.0 * d)
        assert density_slope(oil, p) == pytest.approx(slope, rel=1e-6)


def test_slope_at_ambient_pressure_is_alpha():
    for law in ("barus", "roelands", "houpert"):
        oil = film_oil(eta0=0.05, alpha=20e-9, law=law)
        assert viscosity_slope(oil, 0.0) / oil.eta0 == pytest.approx(20e-9, rel=1e-12)
        assert pressure_viscosity(oil) == pytest.approx(20e-9, rel=1e-12)


def test_density_of_dowson_and_higginson_at_one_gigapascal():
    oil = jamali_2015_oil()
    assert density(oil, 1e9) / oil.rho0 == pytest.approx(3.266 / 2.683, rel=1e-14)
    still = film_oil(eta0=0.05, alpha=20e-9, density_law="incompressible")
    assert density(still, 1e9) == still.rho0
    assert density_slope(still, 1e9) == 0.0


def test_any_pressure_of_an_iteration_gives_a_finite_growing_viscosity():
    oil = film_oil(eta0=0.05, alpha=40e-9, law="barus")
    p = np.array([-1e12, -1e9, 0.0, 1e9, 4.9e9, 5.1e9, 1e11, 1e13])
    eta, _, rho, _ = film_properties(oil, p)
    assert np.all(np.isfinite(eta))
    assert np.all(np.diff(eta) >= 0.0)
    assert np.all(rho >= oil.rho0)
    # the tail is met with value and slope: alpha p = 200 at 5 GPa
    assert viscosity(oil, 5.001e9) == pytest.approx(0.05 * math.exp(200.0) * 1.04, rel=1e-9)


def test_houpert_follows_the_oil_of_the_library_in_temperature():
    lubricant = Lubricant.named("karagiannis_2012")
    at_40 = film_oil_of(lubricant, 313.15, law="houpert")
    hot = film_oil_of(lubricant, 353.15, law="houpert")
    for p in (0.0, 5e8, 1e9):
        # kappa of the thesis against exp(-9.67): 4e-5 in ln eta, grown by the pressure
        assert thermal_viscosity(at_40, p, 353.15) == pytest.approx(viscosity(hot, p), rel=2e-3)
        assert thermal_viscosity(at_40, p, 313.15) == pytest.approx(viscosity(at_40, p), rel=1e-12)
    roelands = film_oil_of(lubricant, 353.15)
    # the law through 40 and 100 degC departs from Walther's line by less than 3 %
    assert viscosity(hot, 0.0) == pytest.approx(viscosity(roelands, 0.0), rel=0.03)


@each(
    ("sigma", "a", "expected"), [(1.0, 0.0, 1.103638), (1.0, 10.0, 9.455686), (0.5, 5.0, 5.024314)]
)
def test_eyring_factor_has_the_values_of_conry(sigma, a, expected):
    # seven printed digits
    assert eyring_flow_factor(sigma, a)[0] == pytest.approx(expected, abs=5e-7)


@each("sigma", [0.05, 0.299, 0.301, 2.0, -3.0])
@each("a", [0.0, 0.7, -30.0])
def test_eyring_factor_is_the_integral_across_the_film(sigma, a):
    def rate(z, mean):
        return math.sinh(mean + 2.0 * sigma * z)

    mean = brentq(lambda t: quad(rate, -0.5, 0.5, args=(t,))[0] - a, -60.0, 60.0, xtol=1e-13)
    pumped = quad(lambda z: z * rate(z, mean), -0.5, 0.5, epsabs=1e-13)[0]
    factor = eyring_flow_factor(sigma, a)[0]
    # accuracy of quadrature and root
    assert factor == pytest.approx(6.0 * pumped / sigma, rel=1e-8)
    assert eyring_mean_stress(sigma, a, 5e6) == pytest.approx(5e6 * mean, rel=1e-9, abs=1e-3)


@each("sigma", [1e-3, 0.2, 0.31, 4.0, -1.5])
@each("a", [0.3, -8.0])
def test_slopes_of_the_eyring_factor(sigma, a):
    d = 1e-5
    value, by_sigma, by_a = eyring_flow_factor(sigma, a)
    up, down = eyring_flow_factor(sigma + d, a)[0], eyring_flow_factor(sigma - d, a)[0]
    # difference quotient: rounding 1e-11, curvature 1e-10
    assert by_sigma == pytest.approx((up - down) / (2.0 * d), rel=1e-6, abs=1e-9 * value)
    up, down = eyring_flow_factor(sigma, a + d)[0], eyring_flow_factor(sigma, a - d)[0]
    assert by_a == pytest.approx((up - down) / (2.0 * d), rel=1e-6, abs=1e-9 * value)


def test_eyring_film_of_little_stress_is_newtonian():
    factor, by_sigma, by_a = eyring_flow_factor(1e-9, 1e-9)
    # S - 1 is of second order in both arguments
    assert factor == pytest.approx(1.0, abs=1e-15)
    assert abs(by_sigma) < 1e-8
    assert abs(by_a) < 1e-8


def test_compiled_flow_factor_equals_its_python():
    for arguments in ((0.2, 3.0), (-5.0, 40.0), (1e3, 1.0)):
        assert eyring_flow_factor(*arguments) == pytest.approx(
            eyring_flow_factor.py_func(*arguments), rel=1e-14
        )


def test_limiting_stress_is_off_unless_asked_for():
    assert limiting_stress(jamali_2015_oil(), 1e9) == math.inf
    oil = film_oil(eta0=0.05, alpha=20e-9, limiting_shear=(2e6, 0.05))
    assert limiting_stress(oil, 1e9) == pytest.approx(52e6)


def test_units_are_named_when_an_input_is_out_of_range():
    with pytest.raises(ParameterError, match="2e-8 1/Pa"):
        film_oil(eta0=0.05, alpha=20.0)
    with pytest.raises(ParameterError, match="law must be one of"):
        film_oil(eta0=0.05, alpha=20e-9, law="cross")
    with pytest.raises(ParameterError, match="houpert"):
        film_oil(eta0=0.05, alpha=20e-9, temperature_exponent=1.0)
