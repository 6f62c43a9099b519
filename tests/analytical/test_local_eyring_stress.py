"""The Eyring stress that grows with pressure: its values, its film, its derivative."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.ehl.line.energy import FilmFields, fill_shear
from gearlube_core.ehl.line.problem import LineSettings
from gearlube_core.ehl.line.rows import RowCoefficients, fill_rows, local_rows
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.traction import fill_mean_stress
from gearlube_core.errors import ParameterError
from gearlube_core.oil.eyring_1936 import Eyring
from gearlube_core.oil.film_oil import stress_ratio, thermal_viscosity
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.oil.modulus_law import ModulusLaw, NaphthenicModulus, PolyalphaolefinModulus
from tests.helpers.each import each
from tests.helpers.ehl_line_cases import thesis_line

WARM = 333.15  # K


def local_stress(oil, p: float, cooling: float = 1.0) -> float:
    return oil.shear.tau0 * stress_ratio(oil, p, cooling)[0]


@each(
    ("law", "slope", "stress"),
    [
        (PolyalphaolefinModulus(), 0.035, 7.81e6),
        (ModulusLaw(), 0.047, 7.19e6),
        (NaphthenicModulus(), 0.053, 4.51e6),
    ],
)
def test_measured_oils_have_twice_lambda_over_their_secant(law, slope, stress):
    """2 Lambda (A + B p) at 60 degC and 1 GPa, by hand to three digits."""
    A, B = law.a1 + law.a2 * WARM, law.b1 + law.b2 * WARM
    alpha = 1.0 / (A * (1.0 + 2.0 * B + 6.0 * B**2 + 24.0 * B**3 + 120.0 * B**4))
    oil = film_oil(
        eta0=0.04, alpha=alpha, law=type(law)(factor_temperature=WARM), eyring_slope=slope
    )
    assert local_stress(oil, 1e9) == pytest.approx(stress, rel=7e-4)
    assert local_stress(oil, 0.0) == pytest.approx(2.0 * slope * A, rel=1e-3)


ROELANDS = film_oil(
    eta0=0.04, alpha=2e-8, law="houpert", temperature_exponent=1.1, temperature=WARM,
    eyring_slope=0.05,
)  # fmt: skip


def test_stress_goes_by_the_viscosity_at_its_own_temperature():
    p, T = 7e8, 360.0
    t = (T - 138.0) / (WARM - 138.0)
    cooling = t**-1.1
    secant = math.log(thermal_viscosity(ROELANDS, p, T) / thermal_viscosity(ROELANDS, 0.0, T)) / p
    assert local_stress(ROELANDS, p, cooling) == pytest.approx(0.1 / secant, rel=1e-12)
    step = 1e3
    up, down = (math.log(local_stress(ROELANDS, p + s, cooling)) for s in (step, -step))
    slope = stress_ratio(ROELANDS, p, cooling)[1]
    # differences of logarithms lose eleven of sixteen digits
    assert slope == pytest.approx((up - down) / (2.0 * step), rel=1e-5)


def test_film_between_plates_has_the_inverse_sinh_of_its_local_stress():
    """8.03 Pa.s at 0.92 GPa, 1.257 m/s over 0.23 um: 0.0196 of the pressure with 7.2 MPa."""
    p, eta0, eta, us, h = 0.92e9, 0.0106, 8.03, 1.257, 0.23e-6
    grown = math.log(eta / eta0)
    oil = film_oil(
        eta0=eta0, alpha=grown / p, law="barus", eyring_slope=7.2e6 * grown / (2.0 * p),
        limiting_shear=(0.0, 0.0),
    )  # fmt: skip
    oil = oil._replace(shear=Eyring(3e6))  # a unit; the stress is the local one
    tau, one = np.empty(1), np.ones(1)
    fill_mean_stress(p * one, 0.0 * one, h * one, 0.0 * one, eta * one, us, oil, tau)
    expected = 7.2e6 * math.asinh(eta * us / (h * 7.2e6))
    assert tau[0] == pytest.approx(expected, rel=1e-12)
    assert tau[0] / p == pytest.approx(0.0196, abs=5e-5)
    field = FilmFields(p * one, 0.0 * one, h * one, 870.0 * one, one, one)
    heat = np.empty(9)
    T = np.full((1, 9), oil.temperature)
    warm, flowing = fill_shear(T, 0, field, us, oil, heat)
    assert warm == pytest.approx(expected, rel=1e-12)
    assert flowing == pytest.approx(eta, rel=1e-12)
    # all work of the surfaces is heat
    assert heat == pytest.approx(expected * us / h, rel=1e-12)


def test_friction_is_lambda_where_all_of_the_film_is_at_its_limit():
    oil = film_oil(eta0=1.0, alpha=2e-8, law="barus", eyring_slope=0.047)
    p, n = np.linspace(1.2e9, 2e9, 5), np.ones(5)
    tau, eta = np.empty(5), np.exp(2e-8 * p)
    fill_mean_stress(p, 0.0 * n, 1e-7 * n, 0.0 * n, eta, -2.0, oil, tau)
    assert tau == pytest.approx(-0.047 * p, rel=1e-14)
    field = FilmFields(p, 0.0 * n, 1e-7 * n, 870.0 * n, n, n)
    heat, T = np.empty(9), np.full((5, 9), oil.temperature)
    assert fill_shear(T, 2, field, 2.0, oil, heat)[0] == pytest.approx(0.047 * p[2], rel=1e-14)
    assert heat.mean() == pytest.approx(0.047 * p[2] * 2.0 / 1e-7, rel=1e-12)


def test_balances_of_a_line_have_the_derivative_of_the_local_stress():
    rng = np.random.default_rng(4)
    n = 12
    P, H = 0.2 + 0.3 * rng.random(n), 0.5 + rng.random(n)
    cooling, none = 0.95 + 0.1 * rng.random(n), np.zeros(n)
    pressure = 1e9
    c = RowCoefficients(0.2, 1.0, 30.0, pressure, 2.0, 0.05, 1.0, 0.0, 1, 0.0)
    rows = local_rows(n)

    def residual(at: np.ndarray) -> np.ndarray:
        fill_rows(at, H, none, cooling, np.ones(n), none, c, ROELANDS, rows)
        return rows.residual[2:-2].copy()

    residual(P)
    slopes, step = rows.by_pressure.copy(), 1e-5
    for j in range(4, 8):
        side = np.eye(n)[j]
        near, far = (residual(P + k * step * side) - residual(P - k * step * side) for k in (1, 2))
        expected = (8.0 * near - far) / (12.0 * step)
        found = np.zeros(n)
        for i in range(j - 2, j + 3):
            found[i] = slopes[i, j - i + 2]
        scale = np.abs(expected).max()
        assert np.abs(found[2:-2] - expected).max() < 1e-8 * scale


def test_newton_steps_of_a_line_end_quadratically():
    oil = film_oil(eta0=0.00625, alpha=13.3e-9, eyring_slope=0.05)
    settings = LineSettings(nodes=257, tolerance=1e-11)
    solution = solve_line(thesis_line(lubricant=oil, line_load=200e3), settings)
    assert solution.converged
    last = np.array(solution.records[-1][1].residual)
    # the share that a step leaves falls with the step; a derivative without a part keeps it
    small = last[last < 1e-3]
    assert np.all(small[1:] < 0.03 * small[:-1])


@each(
    ("given", "words"),
    [
        ({"eyring_stress": 5e6}, "eyring_stress must be left out if eyring_slope"),
        ({"alpha": 0.0}, "alpha"),
        ({"eyring_slope": 0.9}, "eyring_slope"),
    ],
)
def test_what_does_not_go_with_a_local_stress_is_refused(given, words):
    with pytest.raises(ParameterError, match=words):
        film_oil(**({"eta0": 0.04, "alpha": 2e-8, "eyring_slope": 0.05} | given))
