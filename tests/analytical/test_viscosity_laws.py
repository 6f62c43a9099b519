"""Viscosity against temperature, pressure and shear, checked by other arithmetic."""

import cmath
import math

import pytest

from gearlube_core.oil.eyring_1936 import eyring_stress_ratio
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.oil.roelands_1966 import roelands_viscosity
from gearlube_core.oil.walther_1931 import walther_coefficients, walther_viscosity
from tests.helpers.each import each

OILS = ("karagiannis_2012", "mohammadpour_2015")


@each("temperature", [280.0, 313.15, 368.15, 420.0])
def test_temperature_slope_of_viscosity_is_its_complex_step_derivative(temperature: float) -> None:
    A, B = walther_coefficients(109.1e-6, 313.15, 16.7e-6, 373.15)
    step = 1e-30
    nu = 10 ** (10 ** (A - B * cmath.log10(complex(temperature, step)))) - 0.7
    expected = -(nu.imag / step) / nu.real
    # the complex step has no truncation error; rounding of two nested exponentials remains
    assert walther_viscosity(A, B, temperature)[1] == pytest.approx(expected, rel=1e-12)


def test_walther_line_passes_through_both_points_of_the_data_sheet() -> None:
    A, B = walther_coefficients(109.1e-6, 313.15, 16.7e-6, 373.15)
    # rounding of two nested exponentials
    assert walther_viscosity(A, B, 313.15)[0] == pytest.approx(109.1e-6, rel=1e-12)
    assert walther_viscosity(A, B, 373.15)[0] == pytest.approx(16.7e-6, rel=1e-12)


@each("oil", OILS)
@each("temperature", [293.15, 363.15])
def test_state_slope_is_the_central_difference_of_its_own_viscosity(
    oil: str, temperature: float
) -> None:
    parameters = Lubricant.named(oil).parameters()
    step = 0.05
    warm = lubricant_state(parameters, temperature + step).eta0
    cold = lubricant_state(parameters, temperature - step).eta0
    slope = -math.log(warm / cold) / (2.0 * step)
    # second-order difference: (step/T)^2 = 3e-8 times a factor of order ten
    assert lubricant_state(parameters, temperature).beta == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("oil", OILS)
def test_pressure_coefficient_is_the_initial_slope_of_the_roelands_law(oil: str) -> None:
    parameters = Lubricant.named(oil).parameters()
    state = lubricant_state(parameters, 350.0)
    step = 1e4  # Pa
    higher = roelands_viscosity(state.eta0, parameters.roelands_z, step)
    lower = roelands_viscosity(state.eta0, parameters.roelands_z, -step)
    # second-order difference: (5.1e-9 step)^2 = 3e-9, and rounding 1e-16/(alpha step) = 1e-12
    expected = math.log(higher / lower) / (2.0 * step)
    assert state.alpha == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("oil", OILS)
def test_pressure_coefficient_at_its_reference_temperature_is_the_datum(oil: str) -> None:
    lubricant = Lubricant.named(oil)
    state = lubricant_state(lubricant.parameters(), lubricant.alpha_temperature)
    assert state.alpha == pytest.approx(lubricant.alpha, rel=1e-13)


def test_kernel_and_lubricant_object_give_one_viscosity() -> None:
    lubricant = Lubricant.named("karagiannis_2012")
    state = lubricant_state(lubricant.parameters(), 340.0)
    assert state.eta0 == pytest.approx(lubricant.dynamic_viscosity(340.0), rel=1e-13)
    assert state.nu == pytest.approx(state.eta0 / lubricant.density, rel=1e-15)


def test_eyring_stress_is_newtonian_at_small_and_logarithmic_at_large_rates() -> None:
    assert eyring_stress_ratio(1e-9, 0.0) == pytest.approx(1e-9, rel=1e-12)
    # ln 2x + 1/(4 x^2): the neglected term is 2.5e-9 at x = 1e4
    assert eyring_stress_ratio(1.0, math.log(1e4)) == pytest.approx(math.log(2e4), rel=1e-9)


@each("x", [1e-6, 0.3, 5.0, 1e3, 0.99e8, 1.01e8])
def test_eyring_stress_is_the_inverse_of_the_sinh_law(x: float) -> None:
    s = eyring_stress_ratio(x * math.exp(-3.0), 3.0)
    # an error of rounding in s is magnified by s in sinh s
    assert math.sinh(s) == pytest.approx(x, rel=1e-13)


def test_eyring_stress_stays_finite_where_the_viscosity_would_overflow() -> None:
    assert eyring_stress_ratio(1.0, 5000.0) == pytest.approx(5000.0 + math.log(2.0), rel=1e-15)
    assert eyring_stress_ratio(0.0, 5000.0) == 0.0
