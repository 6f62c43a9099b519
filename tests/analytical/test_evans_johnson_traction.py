"""Plateau traction against the maximum of the thermal Eyring film of Johnson and Greenwood.

A film of thickness h at uniform shear stress tau between surfaces at temperature T_s, with
eta = eta_s exp(-beta dT), obeys K dT'' = -tau (tau*/eta_s) exp(beta dT) with
tau* = tau0 sinh(tau/tau0).
Its solution is dT = (1/beta) ln[cosh^2 Y/cosh^2(2 Y z/h)] with
Y/cosh Y = (h/2) [beta tau tau*/(2 K eta_s)]^(1/2), so that s sinh s = 4 A^2 (Y/cosh Y)^2 for
s = tau/tau0 and A^2 = 2 K eta_s/(beta tau0^2 h^2).
"""

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from gearlube_core.friction.evans_johnson_1986 import (
    limited_stress_ratio,
    plateau_stress_ratio,
    solid_resistance,
    surface_heating_number,
    viscous_friction_coefficient,
)
from tests.helpers.each import each

H, ETA0, BETA, TAU0, K = 4e-7, 0.0171, 0.024, 2e6, 0.14
Y = np.linspace(1e-3, 4.0, 4001)
LOG_A_SQUARED = math.log(2.0 * K * ETA0 / (BETA * TAU0**2 * H**2))  # without pressure


def exact_plateau(alpha_p: float, zeta: float = 0.0) -> float:
    """Scan the centre-temperature parameter Y for the largest s."""
    surface_rise = 8.0 * (2.0 * math.sqrt(2.0) / 3.0) * zeta * Y * np.tanh(Y)  # beta dT_s
    log_rhs = math.log(4.0) + LOG_A_SQUARED + alpha_p - surface_rise + 2.0 * np.log(Y / np.cosh(Y))
    largest = float(log_rhs.max())
    # s sinh s grows with s, so the largest right-hand side belongs to the largest s
    return float(brentq(lambda s: math.log(s * math.sinh(s)) - largest, 1e-9, 200.0))


def plateau(alpha_p: float, zeta: float = 0.0) -> float:
    p = 1e9
    return float(plateau_stress_ratio(H, p, ETA0, alpha_p / p, BETA, TAU0, K, zeta))


@each("argument", [5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 11.8])
def test_plateau_is_the_maximum_traction_of_a_thermal_eyring_film(argument: float) -> None:
    alpha_p = argument - LOG_A_SQUARED
    # a straight line through the exact curve: 0.9 % low at 5, 0.1 % high at 7, 1 % low at 11.8
    assert plateau(alpha_p) == pytest.approx(exact_plateau(alpha_p), rel=0.01)


def test_plateau_line_is_a_few_percent_low_at_very_high_pressure() -> None:
    exact = exact_plateau(20.0 - LOG_A_SQUARED)
    # s grows with slope 1 - 1/s, the line with 0.87: the gap opens beyond the fitted range
    assert plateau(20.0 - LOG_A_SQUARED) / exact == pytest.approx(0.966, abs=1e-3)


def test_plateau_line_fails_for_thick_films_at_low_pressure() -> None:
    # below the fitted range the line crosses zero while the true traction only becomes small
    assert plateau(2.0 - LOG_A_SQUARED) / exact_plateau(2.0 - LOG_A_SQUARED) < 0.9
    assert plateau(-1.0 - LOG_A_SQUARED) < 0.0 < exact_plateau(-1.0 - LOG_A_SQUARED)


def test_largest_traction_is_the_thermal_explosion_limit_of_frank_kamenetskii() -> None:
    s = exact_plateau(10.0)
    eta = ETA0 * math.exp(10.0)
    delta = BETA * TAU0**2 * s * math.sinh(s) * (0.5 * H) ** 2 / (K * eta)
    # critical parameter of a slab 0.878 (Frank-Kamenetskii 1955); the scan has steps of 1e-3 in Y
    assert delta == pytest.approx(0.8785, abs=2e-4)


def test_closed_solution_of_the_film_satisfies_the_energy_equation() -> None:
    # beta dT = theta, z in half thicknesses: theta'' = -delta exp(theta), theta(1) = 0
    y = 0.8
    delta = 2.0 * (y / math.cosh(y)) ** 2
    centre = 2.0 * math.log(math.cosh(y))
    path = solve_ivp(
        lambda _, v: [v[1], -delta * math.exp(v[0])], (0, 1), [centre, 0], rtol=1e-10, atol=1e-12
    )
    # integration tolerance
    assert path.y[0, -1] == pytest.approx(0.0, abs=1e-8)


@each("zeta", [0.05, 0.2, 0.5, 1.0])
@each("argument", [8.0, 10.0, 12.0])
def test_surface_heating_lowers_the_plateau_as_a_moving_band_source_does(
    zeta: float, argument: float
) -> None:
    alpha_p = argument - LOG_A_SQUARED
    # 1 % for the line as above, and 9.6 stands for a factor of 7.6 to 9.0: 0.5 ln(9.6/7.6) = 0.12
    # in s of about 8
    assert plateau(alpha_p, zeta) == pytest.approx(exact_plateau(alpha_p, zeta), rel=0.025)


def test_heating_number_is_film_conductance_times_solid_resistance() -> None:
    R, p, U, E_reduced, e2 = 0.011, 7.2e8, 3.0, 230.8e9, 46.0 * 7850.0 * 470.0
    printed = 4.0 / math.pi * K / (H / R) * (p / (E_reduced * R * e2 * U)) ** 0.5
    resistance = solid_resistance(R, p, U, E_reduced, e2)
    assert surface_heating_number(H, K, resistance) == pytest.approx(printed, rel=1e-14)


def test_surface_rise_used_here_is_that_of_a_band_source() -> None:
    # mean rise of the band (4/3) q [2b/(pi e2 U)]^(1/2), from T(x) = q/sqrt(pi e2) int dt/sqrt t
    b, U, e2, q = 1.7e-4, 3.0, 1.7e8, 1.0
    mean = quad(lambda x: 2 * q * math.sqrt(x / U / (math.pi * e2)), 0.0, 2.0 * b, epsabs=0.0)[
        0
    ] / (2.0 * b)
    assert mean == pytest.approx(4.0 / 3.0 * q * math.sqrt(2.0 * b / (math.pi * e2 * U)), rel=1e-9)
    # beta dT_s = 8 K m/h Y tanh Y with m half of that for b = (16/pi) p R/E', zeta = (4/pi) K r/h
    R, p, E_reduced = 0.011, 7.2e8, 230.8e9
    r = solid_resistance(R, p, U, E_reduced, e2)
    half_width = 16.0 / math.pi * p * R / E_reduced
    m = 0.5 * 4.0 / 3.0 * math.sqrt(2.0 * half_width / (math.pi * e2 * U))
    zeta = surface_heating_number(H, K, r)
    assert 8.0 * K * m / H == pytest.approx(8.0 * 2.0 * math.sqrt(2.0) / 3.0 * zeta, rel=1e-13)


def test_printed_equation_without_beta_changes_with_the_unit_of_temperature() -> None:
    # kelvin to rankine: K and beta shrink by 1.8; the ratio K/beta must not notice
    arguments = (H, 7e8, ETA0, 2.4e-8)
    kelvin = plateau_stress_ratio(*arguments, BETA, TAU0, K, 0.0)
    rankine = plateau_stress_ratio(*arguments, BETA / 1.8, TAU0, K / 1.8, 0.0)
    assert rankine == pytest.approx(kelvin, rel=1e-14)
    printed_kelvin = plateau_stress_ratio(*arguments, 1.0, TAU0, K, 0.0)
    printed_rankine = plateau_stress_ratio(*arguments, 1.0, TAU0, K / 1.8, 0.0)
    assert printed_kelvin - printed_rankine == pytest.approx(0.87 * math.log(1.8), rel=1e-12)
    # beta = 1 1/K costs 0.87 ln(1/beta) in s
    assert kelvin - printed_kelvin == pytest.approx(-0.87 * math.log(BETA), rel=1e-12)


def test_friction_is_newtonian_at_vanishing_sliding() -> None:
    p, alpha, sliding = 7e8, 2.0e-8, 1e-12
    mu = viscous_friction_coefficient(H, p, sliding, ETA0, alpha, BETA, TAU0, K, 0.1)
    newtonian = ETA0 * math.exp(alpha * p) * sliding / (H * p)
    # asinh(x) = x - x^3/6 with x below 1e-7
    assert mu == pytest.approx(newtonian, rel=1e-12)
    assert viscous_friction_coefficient(H, p, 0.0, ETA0, alpha, BETA, TAU0, K, 0.1) == 0.0


def test_clamp_passes_continuously_from_isothermal_to_plateau() -> None:
    s, alpha_p = 8.0, 14.0
    edge = math.sinh(s) * math.exp(-alpha_p)
    for factor in (0.5, 0.999999, 1.000001, 2.0):
        expected = min(s, math.asinh(factor * edge * math.exp(alpha_p)))
        assert limited_stress_ratio(s, factor * edge, alpha_p) == pytest.approx(expected, rel=1e-13)


def test_negative_plateau_gives_no_friction() -> None:
    assert limited_stress_ratio(-3.0, 1.0, 2.0) == 0.0
    assert limited_stress_ratio(9.0, 1.0, 1e5) == 9.0
