"""The viscosity law of Barus, Roelands and Houpert against its printed forms."""

import math

import pytest

from gearlube_core.oil.film_laws import RoelandsHoupert, barus, roelands
from tests.helpers.each import each
from tests.helpers.source_of import source_of

ETA0, ALPHA, S0, OIL = 0.05, 2.1e-8, 1.2, 350.0  # Pa s, 1/Pa, -, K
LAW = roelands(ETA0, ALPHA, S0)
# of Roelands: kappa = exp(-9.67) Pa s, 1/chi = 1.96e8 Pa, 138 K
A = math.log(ETA0) + 9.67
CHI = 5.1e-9
Z = ALPHA / (CHI * A)


def viscosity(p, T=OIL):
    """Printed by Houpert."""
    t = (T - 138.0) / (OIL - 138.0)
    return ETA0 * math.exp(A * ((1.0 + CHI * p) ** Z * t**-S0 - 1.0))


def log_viscosity(law, p, cooling=1.0):
    return source_of(RoelandsHoupert.log_viscosity)(law, p, cooling)


def cooling(T, law=LAW):
    return source_of(RoelandsHoupert.cooling_factor)(law, T, OIL)


@each("T", [300.0, OIL, 420.0])
@each("p", [0.0, 1e6, 4e8, 1.5e9])
def test_viscosity_and_its_slopes_are_those_of_houpert(p, T):
    value, slope = log_viscosity(LAW, p, cooling(T))
    # kappa is kept to the digits of exp(-9.67)
    assert value == pytest.approx(math.log(viscosity(p, T) / ETA0), rel=1e-6, abs=1e-9)
    step = 1e4
    change = math.log(viscosity(p + step, T) / viscosity(p - step, T))
    # differences of second order, rounding of 1e-16 over 2e4 Pa
    assert slope == pytest.approx(change / (2.0 * step), rel=1e-6)
    decline = source_of(RoelandsHoupert.viscosity_decline)(LAW, p, T, OIL)
    change = math.log(viscosity(p, T - 0.01) / viscosity(p, T + 0.01))
    assert decline == pytest.approx(change / 0.02, rel=1e-6)


@each("T", [330.0, OIL, 390.0])
@each("p", [0.0, 6e8])
def test_cooling_is_found_back_from_the_viscosity(p, T):
    value, _ = log_viscosity(LAW, p, cooling(T))
    back = source_of(RoelandsHoupert.cooling_at)(LAW, p, value)
    assert back == pytest.approx(((T - 138.0) / (OIL - 138.0)) ** -S0, rel=1e-12)
    assert source_of(RoelandsHoupert.cooling_at)(LAW, -1e7, value) == pytest.approx(
        source_of(RoelandsHoupert.cooling_at)(LAW, 0.0, value), rel=1e-14
    )
    assert source_of(RoelandsHoupert.cooling_at)(roelands(ETA0, ALPHA), p, value) == 1.0


def test_below_ambient_pressure_the_viscosity_goes_on_as_a_tangent():
    value, slope = log_viscosity(roelands(ETA0, ALPHA), -2e7)
    assert slope == pytest.approx(ALPHA, rel=1e-6)
    assert value == pytest.approx(-2e7 * ALPHA, rel=1e-6)


@pytest.mark.parametrize("p", [-1e7, 0.0, 5e8])
def test_barus_is_an_exponential_of_the_pressure(p):
    law = barus(ALPHA)
    assert log_viscosity(law, p) == pytest.approx((ALPHA * p, ALPHA), rel=1e-13)
    assert source_of(RoelandsHoupert.viscosity_decline)(law, p, 330.0, OIL) == 0.0
    assert cooling(330.0, law) == 1.0


def test_unit_of_pressure_leaves_the_law():
    scaled = LAW.in_units(1e9)
    value, slope = log_viscosity(scaled, 0.7, 0.9)
    expected, per_pascal = log_viscosity(LAW, 7e8, 0.9)
    assert value == pytest.approx(expected, rel=1e-13)
    assert slope == pytest.approx(1e9 * per_pascal, rel=1e-13)
