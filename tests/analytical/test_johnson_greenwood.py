"""Thermal Eyring film: limits, an independent solution across the film, the largest traction."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from gearlube_core.friction.evans_johnson_1986 import plateau_stress_ratio
from gearlube_core.friction.johnson_greenwood_1980 import (
    CONVERGED,
    NOT_CONVERGED,
    thermal_eyring_film,
    thermal_newtonian_stress,
)
from tests.helpers.each import each

# ln eta, beta, K, tau0, h: the oil of Karagiannis et al. 2012 at 40 degC and about 0.5 GPa
LOG_ETA, BETA, K, TAU0, H = math.log(9.5), 0.063, 0.112, 2e6, 0.5e-6
FILM = (LOG_ETA, BETA, K, TAU0, H)


def test_newtonian_isothermal_at_small_sliding() -> None:
    slip = 1e-8
    film = thermal_eyring_film(*FILM, slip)
    tau = film.stress_ratio * TAU0
    # asinh(x) = x - x^3/6 with x = eta dU/(tau0 h) = 0.1 ppm
    assert tau == pytest.approx(9.5 * slip / H, rel=1e-9)
    # uniform heat tau dU/h: dT_centre = q h/(8 K)
    assert film.rise_centre == pytest.approx(tau * slip * H / (8.0 * K), rel=1e-9)
    # effective is the mean over the film, two thirds of the centre
    assert film.rise_effective == pytest.approx(2.0 / 3.0 * film.rise_centre, rel=1e-9)
    assert film.viscosity_ratio == pytest.approx(1.0, abs=1e-12)


@each("slip", [1e-4, 1e-2, 1.0, 30.0])
def test_eyring_isothermal_with_perfect_conduction(slip: float) -> None:
    film = thermal_eyring_film(LOG_ETA, BETA, 1e12, TAU0, H, slip)
    # heat of order dU^2 eta beta/K = 1e-9 left
    expected = math.asinh(9.5 * slip / (TAU0 * H))
    assert film.stress_ratio == pytest.approx(expected, rel=1e-8)


@each("slip", [0.01, 0.3, 3.0, 40.0])
def test_newtonian_thermal_with_large_eyring_stress(slip: float) -> None:
    film = thermal_eyring_film(LOG_ETA, BETA, K, 1e13, H, slip)
    # sinh(s)/s - 1 = s^2/6 with s = tau/tau0 below 1e-5
    expected = thermal_newtonian_stress(LOG_ETA, BETA, K, H, slip)
    assert film.stress_ratio * 1e13 == pytest.approx(expected, rel=1e-9)


def test_newtonian_thermal_against_the_classical_plane_film() -> None:
    # Couette flow with exponential viscosity: tau U h integral, Br = eta beta U^2/K
    slip = 2.0
    br = 9.5 * BETA * slip**2 / K
    expected = 9.5 * slip / H * math.asinh(math.sqrt(br / 8.0)) / math.sqrt(br / 8.0 * (1 + br / 8))
    # closed form, Gavis and Laurence 1968: rounding
    assert thermal_newtonian_stress(LOG_ETA, BETA, K, H, slip) == pytest.approx(expected, rel=1e-12)


def film_by_collocation(slip: float, log_eta: float) -> tuple[float, float]:
    """Solve K T'' = -tau u', u' = (tau0/eta(T)) sinh(tau/tau0) with u(h) - u(0) = slip.

    States in z/h: beta T, its slope and u/slip; the unknown parameter is s = tau/tau0.
    """

    def equations(_z: np.ndarray, y: np.ndarray, parameter: np.ndarray) -> np.ndarray:
        s = parameter[0]
        shear = TAU0 * H / slip * np.exp(y[0] - log_eta) * math.sinh(s)
        heat = BETA * H * TAU0 * s * slip / K * shear
        return np.vstack([y[1], -heat, shear])

    def ends(left: np.ndarray, right: np.ndarray, _p: np.ndarray) -> np.ndarray:
        return np.array([left[0], right[0], left[2], right[2] - 1.0])

    z = np.linspace(0.0, 1.0, 401)
    s = 0.5
    y = np.vstack([np.zeros_like(z), np.zeros_like(z), z])
    # heat is brought in by continuation in the temperature coefficient hidden in y[0]
    solution = solve_bvp(equations, ends, z, y, p=[s], tol=1e-9, max_nodes=20000)
    assert solution.success
    return float(solution.p[0]), float(solution.sol(0.5)[0]) / BETA


@each(("slip", "log_eta"), [(0.05, 0.0), (0.3, 1.0), (1.0, 2.25), (3.2, 2.25), (8.0, 0.5)])
def test_root_against_collocation_of_the_energy_equation(slip: float, log_eta: float) -> None:
    s, rise_centre = film_by_collocation(slip, log_eta)
    film = thermal_eyring_film(log_eta, BETA, K, TAU0, H, slip)
    assert film.status == CONVERGED
    # tolerance of the collocation
    assert film.stress_ratio == pytest.approx(s, rel=1e-6)
    assert film.rise_centre == pytest.approx(rise_centre, rel=1e-5)


def film_by_differences(slip: float, nodes: int, beta_of_t: bool) -> float:
    """Return s from finite differences of the energy equation, Newton on T and s together.

    `beta_of_t` replaces exp(-beta dT) by a Houpert-like curve with the same slope at the surface.
    """
    z = np.linspace(0.0, 1.0, nodes)
    dz = z[1]
    T, s = np.zeros(nodes), 1.0
    log_ref = LOG_ETA + 9.67

    def log_eta(T: np.ndarray) -> np.ndarray:
        if beta_of_t:
            scale = log_ref / BETA  # (T_s - 138)/S0 with S0 = 1
            return log_ref / (1.0 + T / scale) - 9.67
        return LOG_ETA - BETA * T

    def residual(v: np.ndarray) -> np.ndarray:
        T, s = v[:-1], v[-1]
        shear = TAU0 * math.sinh(s) * np.exp(-log_eta(T))
        out = np.empty_like(v)
        out[0], out[nodes - 1] = T[0], T[-1]
        out[1:-2] = (T[2:] - 2 * T[1:-1] + T[:-2]) / dz**2 + H**2 * TAU0 * s / K * shear[1:-1]
        mean = dz * (np.sum(shear) - 0.5 * (shear[0] + shear[-1]))
        out[-1] = math.log(mean * H / slip)
        return out

    v = np.append(T, s)
    for _ in range(60):
        r = residual(v)
        J = np.empty((v.size, v.size))
        for j in range(v.size):
            w = v.copy()
            w[j] += 1e-6
            J[:, j] = (residual(w) - r) / 1e-6
        step = np.linalg.solve(J, -r)
        step *= min(1.0, 0.5 / abs(step[-1]) if step[-1] else 1.0)
        v = v + step
        if np.max(np.abs(step)) < 1e-8:
            return float(v[-1])
    raise AssertionError("finite differences did not converge")


@each("slip", [0.2, 1.0, 3.2])
def test_root_against_finite_differences_with_second_order(slip: float) -> None:
    s = thermal_eyring_film(*FILM, slip).stress_ratio
    errors = [film_by_differences(slip, n, False) - s for n in (21, 41)]
    assert abs(errors[1]) < 2e-3 * s
    # second order: halving the step quarters the error
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


def test_exponential_fall_of_viscosity_against_a_curved_law() -> None:
    # the law of Houpert is less steep when hot: the closed form loses too much stress, by little
    slip = 3.2
    closed = thermal_eyring_film(*FILM, slip).stress_ratio
    curved = film_by_differences(slip, 81, True)
    assert closed < curved
    # second order of beta dT_effective times dT/(T - 138) = 13/180, over s
    assert closed == pytest.approx(curved, rel=0.03)


@each("argument", [6.0, 8.0, 10.0, 12.0])
def test_largest_traction_is_the_plateau_of_evans_and_johnson(argument: float) -> None:
    log_a_squared = math.log(2.0 * K / (BETA * TAU0**2 * H**2))
    log_eta = argument - log_a_squared
    slips = np.geomspace(1e-3, 1e3, 4001)
    largest = max(
        thermal_eyring_film(log_eta, BETA, K, TAU0, H, float(u)).stress_ratio for u in slips
    )
    # eta0 = 1 and alpha p = ln eta; their straight line is within 1 % from 5 to 11.8, 1.1 % at 12
    plateau = plateau_stress_ratio(H, 1.0, 1.0, log_eta, BETA, TAU0, K, 0.0)
    assert plateau == pytest.approx(largest, rel=0.011)


def test_equations_18_and_20_as_printed() -> None:
    slip = 2.7
    film = thermal_eyring_film(*FILM, slip)
    X = math.sinh(film.Y)
    X_star = math.asinh(X) / math.sqrt(1.0 + X * X)
    A_squared = 2.0 * K * 9.5 / (BETA * TAU0**2 * H**2)
    dU_star = 9.5 * slip / (TAU0 * H)
    argument = 4.0 * A_squared * X_star * X / dU_star
    # root tolerance
    assert math.sinh(argument) == pytest.approx(dU_star * X_star / X, rel=1e-11)
    assert film.stress_ratio == pytest.approx(argument, rel=1e-11)
    assert film.viscosity_ratio == pytest.approx(X_star / X, rel=1e-11)
    assert film.rise_centre == pytest.approx(math.log(1.0 + X * X) / BETA, rel=1e-11)
    assert film.rise_effective == pytest.approx(math.log(X / X_star) / BETA, rel=1e-11)
    # effective viscosity: tau* = eta_e dU/h
    effective = 9.5 * film.viscosity_ratio * slip / H
    assert TAU0 * math.sinh(film.stress_ratio) == pytest.approx(effective, rel=1e-11)


def test_root_over_forty_decades_of_viscosity() -> None:
    rng = np.random.default_rng(5)
    for _ in range(2000):
        log_eta, beta = rng.uniform(-10, 80), rng.uniform(0.005, 0.15)
        tau0, h, slip = 10 ** rng.uniform([5, -8, -12], [8, -5, 3])
        film = thermal_eyring_film(log_eta, beta, K, tau0, h, slip)
        assert film.status == CONVERGED
        c = 8.0 * K / (beta * tau0 * h * slip)
        s, Y = film.stress_ratio, film.Y
        assert s == pytest.approx(c * Y * math.tanh(Y), rel=1e-12)
        log_sinh_s = s + math.log(-math.expm1(-2.0 * s)) - math.log(2.0)
        log_slip = log_eta + math.log(slip / (tau0 * h))
        # a few roundings of terms of size 1 + |ln dU*|
        balance = log_sinh_s - math.log(film.viscosity_ratio) - log_slip
        assert abs(balance) < 1e-12 * (1.0 + abs(log_slip))


def test_rest_and_bad_numbers() -> None:
    rest = thermal_eyring_film(*FILM, 0.0)
    assert rest.stress_ratio == rest.rise_centre == rest.status == 0.0
    assert thermal_newtonian_stress(LOG_ETA, BETA, K, H, 0.0) == 0.0
    bad = thermal_eyring_film(float("nan"), BETA, K, TAU0, H, 1.0)
    assert bad.status == NOT_CONVERGED
    assert math.isnan(bad.stress_ratio)
    backwards = thermal_eyring_film(*FILM, -2.0)
    assert backwards == thermal_eyring_film(*FILM, 2.0)
