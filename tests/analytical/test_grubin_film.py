"""Grubin film of a point contact against its integral, its gap and other film formulas."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from gearlube_core.errors import ParameterError
from gearlube_core.film.grubin_1949 import (
    CONSISTENT_COEFFICIENT,
    GRUBIN_INTEGRAL,
    grubin_convention,
    grubin_film_thickness,
    grubin_geometry,
    inlet_heating_factor,
)
from gearlube_core.film.point_film import central_film_thickness, film_geometry

E_STAR = 115.4e9
CONSISTENT = grubin_convention("consistent", E_STAR)
PRINTED = grubin_convention("as_printed", E_STAR)


def test_grubin_integral_by_quadrature() -> None:
    def integrand(t: float) -> float:
        return t**1.5 / (1.0 + t**1.5) ** 3

    integral = quad(integrand, 0.0, 1.0)[0] + quad(integrand, 1.0, math.inf)[0]
    # quadrature tolerance 1.5e-8
    assert pytest.approx(integral, rel=1e-7) == GRUBIN_INTEGRAL
    # (2/3) B(5/3, 4/3)
    assert pytest.approx(0.268711, abs=5e-7) == GRUBIN_INTEGRAL


def hertz_gap(x: float, a: float, R: float) -> float:
    """Gap beside a circular Hertz contact, Johnson 1985 eq. (3.42) with the parabola."""
    r = x / a
    inside = (2.0 - r * r) * math.asin(1.0 / r) + math.sqrt(r * r - 1.0)
    # p0 = 2 a E*/(pi R); u_z = p0/(2 E* a) (...), less the approach a^2/R
    return a * a / (math.pi * R) * inside - a * a / R + x * x / (2.0 * R)


def test_coefficient_from_quadrature_of_reynolds_equation_in_the_hertz_gap() -> None:
    a, R = 1.0, 1.0
    t = 1e-4
    edge = hertz_gap(a * (1.0 + t), a, R) / (a * t) ** 1.5
    # the next order of the gap is smaller by a factor of order t
    assert edge == pytest.approx(8.0 * math.sqrt(2.0) / (3.0 * math.pi), rel=1e-3)

    # 1/alpha = 12 eta u int (h - h0)/h^3 dx over the edge gap, for one contact with numbers
    eta, alpha, u, W, R = 0.05, 1.6e-8, 2.0, 100.0, 0.012
    a = (0.75 * W * R / E_STAR) ** (1.0 / 3.0)
    C = 8.0 * math.sqrt(2.0) / (3.0 * math.pi) * math.sqrt(a) / R
    h0 = grubin_film_thickness(R, 1.0, eta, alpha, u, W, CONSISTENT)
    scale = (h0 / C) ** (2.0 / 3.0)

    def integrand(t: float) -> float:
        gap = C * (t * scale) ** 1.5
        return gap / (h0 + gap) ** 3 * scale

    q = 12.0 * eta * u * (quad(integrand, 0.0, 1.0)[0] + quad(integrand, 1.0, math.inf)[0])
    # quadrature tolerance
    assert q == pytest.approx(1.0 / alpha, rel=1e-7)


def test_printed_coefficient_belongs_to_the_sum_of_speeds() -> None:
    assert pytest.approx(2.250, abs=5e-4) == CONSISTENT_COEFFICIENT
    for_sum_and_pi_modulus = CONSISTENT_COEFFICIENT / 2.0**0.75 * math.pi ** (-1.0 / 12.0)
    assert for_sum_and_pi_modulus == pytest.approx(1.2159, abs=1e-4)
    args = (0.012, 1.0, 0.05, 1.6e-8, 3.0, 800.0)
    ratio = grubin_film_thickness(*args, CONSISTENT) / grubin_film_thickness(*args, PRINTED)
    # 2^(3/4) for the speed and 1.2159/1.212: identity
    assert ratio == pytest.approx(2.0**0.75 * for_sum_and_pi_modulus / 1.212, rel=1e-12)


def test_geometry_of_a_circle_and_along_both_axes() -> None:
    R_e, leakage = grubin_geometry(0.01, 0.01, 0.7)
    # psi = 1/(1 + 2/3) = 0.6
    assert R_e == pytest.approx(0.01, rel=1e-14)
    assert leakage == pytest.approx(0.6 ** (2.0 / 3.0), rel=1e-13)
    R_e, leakage = grubin_geometry(0.01, 0.5, 0.5 * math.pi)
    assert R_e == pytest.approx(0.5, rel=1e-12)
    assert leakage == pytest.approx((1.0 + 2.0 / 3.0 * 50.0) ** (-2.0 / 3.0), rel=1e-12)
    # long ellipses lose nothing sideways
    assert grubin_geometry(0.01, 1e3, 0.0)[1] == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("R_y", [0.3, 0.6])
def test_film_is_near_that_of_chittenden_for_slender_ellipses(R_y: float) -> None:
    R_x, eta, alpha, u, W = 0.011, 0.095, 1.44e-8, 4.6, 1200.0
    R_e, leakage = grubin_geometry(R_x, R_y, 0.0)
    grubin = grubin_film_thickness(R_e, leakage, eta, alpha, u, W, CONSISTENT)
    chittenden = central_film_thickness(
        *film_geometry(R_x, R_y, 0.0), eta, alpha, u, W, 2.0 * E_STAR
    )
    # two approximate theories: 10 % is what they are known to differ by
    assert grubin == pytest.approx(chittenden, rel=0.12)


def test_exponents_of_load_speed_and_viscosity() -> None:
    args = [0.012, 0.98, 0.05, 1.6e-8, 3.0, 800.0]
    base = grubin_film_thickness(*args, CONSISTENT)
    for position, exponent in ((2, 0.75), (3, 0.75), (4, 0.75), (5, -1.0 / 12.0)):
        changed = list(args)
        changed[position] *= 2.0
        ratio = grubin_film_thickness(*changed, CONSISTENT) / base
        # power law: rounding
        assert math.log2(ratio) == pytest.approx(exponent, abs=1e-12)


def test_film_scales_with_length_at_constant_pressure_and_speed_group() -> None:
    # lengths x 3, loads x 9, speed x 3: all groups stay, so does h/R
    one = grubin_film_thickness(0.01, 0.9, 0.05, 1.6e-8, 2.0, 500.0, CONSISTENT)
    three = grubin_film_thickness(0.03, 0.9, 0.05, 1.6e-8, 6.0, 4500.0, CONSISTENT)
    assert three == pytest.approx(3.0 * one, rel=1e-13)


def test_inlet_heating_in_pure_rolling_is_near_murch_and_wilson() -> None:
    for L in np.geomspace(0.01, 20.0, 12):
        factor = inlet_heating_factor(L, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0)
        # two fits to different numerical solutions; 8 % at L = 20 as the docstring says
        assert factor == pytest.approx(3.94 / (3.94 + L**0.62), rel=0.08)


def test_inlet_heating_of_a_hand_calculation() -> None:
    # L = 0.04 x 0.1 x 25/0.1 = 1, S = 1, p0/E' = 0.003: (1 - 0.0396)/(1 + 0.213 x 3.23)
    factor = inlet_heating_factor(0.1, 0.04, 0.1, 5.0, -5.0, 0.69e9, 230e9)
    assert factor == pytest.approx((1.0 - 13.2 * 0.003) / (1.0 + 0.213 * 3.23), rel=1e-12)


def test_inlet_heating_only_thins_and_vanishes_at_rest() -> None:
    speeds = np.geomspace(1e-6, 60.0, 40)
    factors = [
        inlet_heating_factor(0.095, 0.042, 0.11, float(u), 0.6 * float(u), 9e8, 230e9)
        for u in speeds
    ]
    assert all(np.diff(factors) < 0.0)
    # L^0.42 at 1e-6 m/s is 5e-6
    assert 0.0 <= min(factors) <= max(factors) == pytest.approx(1.0, abs=1e-5)
    assert inlet_heating_factor(0.1, 0.0, 0.1, 5.0, 1.0, 1e9, 230e9) == 1.0
    slides = [inlet_heating_factor(0.095, 0.042, 0.11, 5.0, s, 9e8, 230e9) for s in (0, 1, 5)]
    assert slides[0] > slides[1] > slides[2]


def test_unknown_convention_is_refused() -> None:
    with pytest.raises(ParameterError, match="as_printed"):
        grubin_convention("printed", E_STAR)
    with pytest.raises(ParameterError, match="contact_modulus"):
        grubin_convention("consistent", -1.0)
