"""The Eyring stress that grows with pressure: its values, its film, its derivative."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.bearings.losses.rib import RibParameters, rib_friction
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.uncertain import changed_axle, uncertain_of
from gearlube_core.ehl.gears.hypoid_cycle import heated_stress
from gearlube_core.ehl.line.energy import FilmFields, fill_shear
from gearlube_core.ehl.line.problem import LineSettings
from gearlube_core.ehl.line.rows import RowCoefficients, fill_rows, local_rows
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.traction import fill_mean_stress
from gearlube_core.errors import ParameterError
from gearlube_core.friction.flank_data import CONSISTENT
from gearlube_core.friction.line_points import line_friction
from gearlube_core.friction.mixed_friction import FormulaBounds, formula_error
from gearlube_core.friction.traction_fit import steel_on_steel
from gearlube_core.oil.eyring_1936 import Eyring
from gearlube_core.oil.film_oil import stress_ratio, thermal_viscosity, viscosity
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.lubricant_state import eyring_stress_under
from gearlube_core.oil.modulus_law import ModulusLaw, NaphthenicModulus, PolyalphaolefinModulus
from gearlube_core.oil.oil_file import OilFile
from tests.helpers.each import each
from tests.helpers.ehl_line_cases import thesis_line

WARM = 333.15  # K
RIB = RibParameters(0.03, 0.02, 0.2, 0.3, 0.2, 1.0, 1e-8, 1.9, 0.99, 0.15, 2.3e11)


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


SHEET = {
    "name": "a sheet",
    "base_oil": "pao",
    "density_kg_m3": 850.0,
    "viscosity_40_degc_mm2_s": 220.0,
    "viscosity_100_degc_mm2_s": 25.0,
}


def sheet_oil(**given):
    return OilFile.from_data(SHEET | given, "the test").described().lubricant


@each("p", [2e8, 1e9])
def test_formulas_and_films_of_a_sheet_have_one_stress(p):
    state = sheet_oil().state(WARM)
    film = film_oil_of(sheet_oil(), WARM)
    expected = 2.0 * 0.035 * p / math.log(viscosity(film, p) / film.eta0)
    assert eyring_stress_under(state, p) == pytest.approx(expected, rel=1e-12)
    assert local_stress(film, p) == pytest.approx(expected, rel=1e-12)
    assert film.limit_slope == 0.035


@each("given", [{"eyring_stress_mpa": 5.5}, {"shear_law": "newtonian", "eyring_stress_mpa": 5.5}])
def test_a_number_on_the_sheet_holds_at_all_pressures(given):
    oil = sheet_oil(**given)
    assert [eyring_stress_under(oil.state(WARM), p) for p in (1e8, 2e9)] == [5.5e6, 5.5e6]
    assert film_oil_of(oil, WARM).eyring_slope == 0.0


def test_an_own_shear_law_keeps_its_one_stress():
    oil = sheet_oil(shear_law="newtonian")
    assert film_oil_of(oil, WARM) == film_oil_of(sheet_oil(), WARM, newtonian=True)


def test_friction_formulas_take_the_stress_of_their_own_pressure():
    """As those of an oil whose one stress is that of the pressure of the contact."""
    local = sheet_oil().state(WARM)
    surface, solid = gear_flanks(2e-7), steel_on_steel()
    for load in (1e5, 8e5):
        line = load, 0.02, 8.0, 1.5
        found = line_friction(*line, local, surface, solid)
        tau0 = eyring_stress_under(local, found.mean_pressure)
        constant = local._replace(tau0=tau0, eyring_slope=0.0)
        assert found == line_friction(*line, constant, surface, solid)
        bounds = FormulaBounds(0.1, 1.1)
        errors = [
            formula_error(load, 1.5, found, oil, surface, solid, CONSISTENT, bounds)
            for oil in (local, constant)
        ]
        assert errors[0] == errors[1]
        rib = RIB, 1e-3 * load, 300.0
        p = hertz_ellipse(RIB.R_meridian, RIB.R_sliding, 0.5 * RIB.reduced_modulus, rib[1])[2]
        one = local._replace(tau0=eyring_stress_under(local, p), eyring_slope=0.0)
        assert rib_friction(*rib, local) == rib_friction(*rib, one)


def test_error_bars_of_a_local_stress_are_those_of_lambda():
    axle = replace(mohammadpour_2015_axle(), oil=sheet_oil())
    one = next(one for one in uncertain_of(axle) if one.name == "eyring_stress")
    # 0.003 of 0.035
    assert one.factor == pytest.approx(1.0 + 0.003 / 0.035, abs=0.006)
    more = changed_axle(one, axle, 2.0, np.ones(len(LOSS_SOURCES))).oil.state(WARM)
    ratio = eyring_stress_under(more, 8e8) / eyring_stress_under(axle.oil.state(WARM), 8e8)
    assert ratio == pytest.approx(one.factor, rel=1e-12)  # two standard deviations
    own = replace(axle, oil=sheet_oil(limiting_coefficient=0.04))
    assert {one.name: one.factor for one in uncertain_of(own)}["eyring_stress"] == 1.2


def test_a_heated_film_of_a_flank_has_the_stress_of_each_place():
    p, one = np.array([3e8, 9e8]), np.ones(2)
    place = 2e-7 * one, thermal_viscosity(ROELANDS, 5e8, WARM) * one
    found = heated_stress(p, *place, 1.5, ROELANDS, 0.04)
    for i in range(2):
        local = Eyring(local_stress(ROELANDS, p[i]))
        constant = ROELANDS._replace(shear=local, eyring_slope=0.0)
        expected = heated_stress(p, *place, 1.5, constant, 0.04)[i]
        assert found[i] == pytest.approx(expected, rel=1e-12)
    assert local_stress(ROELANDS, p[1]) > 1.1 * local_stress(ROELANDS, p[0])


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
