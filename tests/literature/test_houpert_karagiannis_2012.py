"""The two unprinted parameters of Houpert's law from Table 2 of Karagiannis et al. 2012."""

import math

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.oil.houpert_1985 import (
    fit_houpert,
    houpert_log_viscosity,
    houpert_parameters,
    houpert_temperature_coefficient,
    houpert_viscosity,
)
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.roelands_1966 import roelands_viscosity
from tests.helpers.each import each

TABLE_2 = (0.09483, 313.15, 0.0145, 373.15, 1.44e-8, 313.15)
LAW = fit_houpert(*TABLE_2)


def test_exponents_of_table_2() -> None:
    # by hand with T = theta + 273: S0 = ln(7.3143/5.4364)/ln(235/175); 273.15 adds 0.07 %
    assert pytest.approx(1.0065, rel=1e-3) == LAW.S0
    # 1.44e-8/(5.1e-9 x 7.3143)
    assert pytest.approx(0.3860, abs=5e-5) == LAW.Z


def test_law_passes_through_table_2() -> None:
    # interpolation: rounding only
    assert houpert_viscosity(LAW, 0.0, 313.15) == pytest.approx(0.09483, rel=1e-12)
    assert houpert_viscosity(LAW, 0.0, 373.15) == pytest.approx(0.0145, rel=1e-12)
    step = 1e4
    slope = math.log(houpert_viscosity(LAW, step, 313.15) / houpert_viscosity(LAW, -step, 313.15))
    # difference over 20 kPa: curvature (5.1e-9 step)^2
    assert slope / (2.0 * step) == pytest.approx(1.44e-8, rel=1e-6)


@pytest.mark.parametrize(("temperature", "beta"), [(313.15, 0.0421), (373.15, 0.0233)])
def test_temperature_coefficient_of_table_2(temperature: float, beta: float) -> None:
    log = houpert_log_viscosity(LAW, 0.0, temperature)
    # three printed digits
    assert houpert_temperature_coefficient(LAW, log, temperature) == pytest.approx(beta, rel=3e-3)


@each("pressure", [0.0, 0.3e9, 0.8e9])
def test_temperature_coefficient_is_the_slope_of_the_law(pressure: float) -> None:
    T, step = 330.0, 1e-3
    hot, cold = (houpert_log_viscosity(LAW, pressure, T + d) for d in (step, -step))
    beta = houpert_temperature_coefficient(LAW, houpert_log_viscosity(LAW, pressure, T), T)
    # central difference
    assert beta == pytest.approx((cold - hot) / (2.0 * step), rel=1e-8)


def test_law_is_that_of_roelands_at_one_temperature() -> None:
    for p in (0.0, 1e8, 5e8, 9e8):
        expected = roelands_viscosity(0.09483, LAW.Z, p)
        assert houpert_viscosity(LAW, p, 313.15) == pytest.approx(expected, rel=1e-12)


def test_pressure_coefficient_falls_with_temperature() -> None:
    alpha_hot = 5.1e-9 * LAW.Z * houpert_log_viscosity(LAW, 0.0, 373.15)
    # Z (ln 0.0145 + 9.67) 5.1e-9 = 1.07e-8: Table 2 prints one value for both temperatures
    assert alpha_hot == pytest.approx(1.07e-8, rel=2e-3)


@pytest.mark.parametrize("name", ["karagiannis_2012", "mohammadpour_2015"])
def test_oils_of_the_library_follow_the_law_between_the_fitted_temperatures(name: str) -> None:
    oil = Lubricant.named(name)
    law = houpert_parameters(oil)
    for T in range(313, 374, 5):
        # the two laws differ by 3 % at most between common points, as stated in the docstring
        assert houpert_viscosity(law, 0.0, T) == pytest.approx(oil.dynamic_viscosity(T), rel=0.03)
    T = oil.alpha_temperature
    alpha = 5.1e-9 * law.Z * houpert_log_viscosity(law, 0.0, T)
    # alpha refers to the viscosity of this law, which differs from the line's by 3 %
    assert alpha == pytest.approx(oil.alpha, rel=1e-12)


@each(
    ("position", "value", "message"),
    [
        (0, 94830.0, "94.8 mPa s is 0.0948 Pa s"),
        (0, float("nan"), "eta_1"),
        (1, 40.0, "313.15 K"),
        (2, 0.2, "fall with temperature"),
        (4, -1e-8, "alpha"),
        (5, 100.0, "alpha_temperature"),
    ],
)
def test_bad_data_are_refused(position: int, value: float, message: str) -> None:
    data = list(TABLE_2)
    data[position] = value
    with pytest.raises(ParameterError, match=message):
        fit_houpert(*data)
