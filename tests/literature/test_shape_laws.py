"""Laws of measured oils over pressure: McEwen, Yasutomi improved by Bair, and Tait's density."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from gearlube.studies.films.film_formulas import line_film_formulas
from gearlube_core.errors import ParameterError
from gearlube_core.film.line_film import line_film_thickness
from gearlube_core.oil.film_laws import (
    cooling_at,
    cooling_factor,
    log_viscosity,
    viscosity_decline,
)
from gearlube_core.oil.film_oil import density, thermal_viscosity
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.formula_laws import alpha_at, log_viscosity_under
from gearlube_core.oil.mcewen_law import McEwen
from gearlube_core.oil.oil_file import OilFile
from gearlube_core.oil.pressure_coefficients import pressure_coefficient
from gearlube_core.oil.shape_law import OilLine, ShapedViscosity, growth
from gearlube_core.oil.tait_law import TaitDensity
from gearlube_core.oil.yasutomi_law import Yasutomi
from tests.helpers.each import each
from tests.helpers.small_films import line_contact, line_film, point_film

SHEET = {
    "name": "sheet", "base_oil": "pao", "density_kg_m3": 850.0, "viscosity_40_degc_mm2_s": 100.0,
    "viscosity_100_degc_mm2_s": 14.0, "alpha_per_gpa": 15.0,
}  # fmt: skip
LAWS = ("mcewen", "yasutomi")
NO_LINE = OilLine(0.0, 0.0, 1.0, 1.0)
HOT, PRESSURE = 353.15, 1e9  # K, Pa
# of a gear oil 80W-90, as another program quotes them
GEAR_OIL = Yasutomi(201.45, 210.60, 0.455e-9, 7.606e-9, -0.4193, 16.372, 29.99)


def lubricant(law, **changes):
    sheet = SHEET | {"viscosity_law": law, "density_law": "tait"} | changes
    return OilFile.from_data(sheet, "the oil").described().lubricant


def film_oil_in(law, temperature=HOT, **changes):
    return film_oil_of(lubricant(law, **changes), temperature)


def viscosity_of_gear_oil(p, temperature):
    """The printed law by hand; Pa s."""
    above = temperature - 201.45 - 210.60 * math.log(1.0 + 0.455e-9 * p)
    X = above * (1.0 + 7.606e-9 * p) ** -0.4193
    return 1e12 * 10.0 ** (-16.372 * X / (29.99 + X))


def test_yasutomi_s_law_grows_as_printed():
    for p in (1e8, 5e8, 1.5e9):
        ratio = viscosity_of_gear_oil(p, 373.15) / viscosity_of_gear_oil(0.0, 373.15)
        # rounding of powers
        assert growth(GEAR_OIL, p, 373.15, 1.0)[0] == pytest.approx(math.log(ratio), rel=1e-12)


@each(
    ("p", "expected"),
    # viscosities and coefficients that were computed elsewhere with these numbers, 4 digits
    [(0.5e9, 5.165), (1e9, 779.7), (1.5e9, 1.39e5)],
)
def test_yasutomi_s_law_has_the_viscosities_of_a_gear_oil(p, expected):
    found = 0.01155 * math.exp(growth(GEAR_OIL, p, 373.15, 1.0)[0])
    assert found == pytest.approx(expected, rel=2e-3)
    assert 1e9 * growth(GEAR_OIL, 0.0, 373.15, 1.0)[1] == pytest.approx(17.88, abs=0.005)
    law = ShapedViscosity(GEAR_OIL, 1.0, 1.0, NO_LINE, 373.15, 1.0, 1.0)
    assert 1e9 * alpha_at(law, 0.0) == pytest.approx(15.09, abs=0.005)


def test_at_the_glass_transition_the_viscosity_is_that_of_glass_and_grows_on():
    """ln eta = ln 1e12 where Tg(p) = T, whatever the temperature."""
    for T in (260.0, 320.0):
        p = (math.exp((T - 201.45) / 210.60) - 1.0) / 0.455e-9
        value, slope = growth(GEAR_OIL, p, T, 1.0)
        assert math.log(viscosity_of_gear_oil(0.0, T)) + value == pytest.approx(math.log(1e12))
        # no pole beyond: the tangent goes on, with no step in it
        above, steep = growth(GEAR_OIL, 1.0001 * p, T, 1.0)
        assert above - value == pytest.approx(0.0001 * p * slope, rel=1e-3)
        assert steep == pytest.approx(slope, rel=1e-2)
        assert growth(GEAR_OIL, 5.0 * p, T, 1.0)[0] > above


@each("shape", [McEwen(10.6), GEAR_OIL])
def test_slopes_of_shapes_are_those_of_their_values(shape):
    unit = 1.0 if isinstance(shape, McEwen) else 1e8
    for x in (0.5 * unit, 8.0 * unit):
        low, high = (growth(shape, x * by, HOT, 1.0)[0] for by in (1.0 - 1e-5, 1.0 + 1e-5))
        # second order in 1e-5
        assert growth(shape, x, HOT, 1.0)[1] == pytest.approx((high - low) / (2e-5 * x), rel=1e-6)


@each("q", [3.0, 10.6, 100.0])
def test_the_alpha_of_films_of_mcewen_s_law_is_less_by_one_part_in_q(q):
    """The integral of (1 + alpha0 p/q)^-q is q/[(q - 1) alpha0]."""
    law = ShapedViscosity(McEwen(q), 2e-8, 1.0, NO_LINE, HOT, 1.0, 1.0)
    # the sum of 48 points
    assert alpha_at(law, 0.0) == pytest.approx(2e-8 * (q - 1.0) / q, rel=1e-5)
    assert alpha_at(law._replace(films=0.0), 0.0) == pytest.approx(2e-8)


@each("law", LAWS)
@each("alpha_is", ["film", "slope", "mean"])
def test_an_oil_keeps_its_alpha_in_films_and_in_formulas_at_every_temperature(law, alpha_is):
    oil = lubricant(law, alpha_is=alpha_is)
    for T in (313.15, HOT, 393.15):
        state, film = oil.state(T), film_oil_of(oil, T)
        found = pressure_coefficient(film.viscosity, "slope" if alpha_is == "slope" else "film")
        # the integral of the kernels has 48 points
        assert state.alpha == pytest.approx(found, rel=1e-5)
        grown = log_viscosity(film.viscosity, PRESSURE, 1.0)[0]
        under = log_viscosity_under(state.viscosity, state, PRESSURE)
        # the temperature goes through the viscosity and back
        assert under - math.log(state.eta0) == pytest.approx(grown, rel=1e-9)
        if T == 313.15:  # that of the sheet's alpha
            found = pressure_coefficient(film.viscosity, alpha_is)
            assert found == pytest.approx(15e-9, rel=1e-5)


@each("law", LAWS)
def test_heat_acts_under_pressure_as_another_oil_temperature_does(law):
    oil, hot = film_oil_in(law), film_oil_of(lubricant(law), 363.15)
    found = thermal_viscosity(oil, 5e8, 363.15)
    # the temperature goes through the viscosity and back
    assert found == pytest.approx(thermal_viscosity(hot, 5e8, 363.15), rel=1e-9)
    cooling = cooling_factor(oil.viscosity, 363.15, HOT)
    grown = log_viscosity(oil.viscosity, 5e8, cooling)[0]
    # 60 halvings of the range
    assert cooling_at(oil.viscosity, 5e8, grown) == pytest.approx(cooling, rel=1e-12)
    steps = [math.log(thermal_viscosity(oil, 5e8, HOT + d)) for d in (-0.5, 0.5)]
    declines = viscosity_decline(oil.viscosity, 5e8, HOT, HOT)
    assert declines == pytest.approx(steps[0] - steps[1], rel=1e-4)


def test_mcewen_s_power_by_hand():
    oil = film_oil_in("mcewen", alpha_is="slope", law_numbers={"q": 20.0})
    alpha = lubricant("mcewen", alpha_is="slope").state(HOT).alpha
    expected = 20.0 * math.log(1.0 + alpha * PRESSURE / 20.0)
    assert log_viscosity(oil.viscosity, PRESSURE, 1.0)[0] == pytest.approx(expected, rel=1e-12)


def test_tait_s_oil_has_its_bulk_modulus_and_the_slope_of_it():
    law = TaitDensity(K00=8.658e9, bK=6.332e-3, K1=11.74).at(313.15)()
    # K0 and V/V0 computed elsewhere with these numbers of squalane
    assert pytest.approx(1.1920, abs=5e-5) == 1e-9 * law.K0
    volumes = [1.0 / law.density_ratio(p)[0] for p in (5e8, 1e9, 1.5e9)]
    assert volumes == pytest.approx([0.85498, 0.80702, 0.77746], abs=6e-6)

    def modulus(p):
        ratio, slope, _ = law.density_ratio(p)
        return ratio / slope

    assert modulus(0.0) == pytest.approx(law.K0)
    # a difference, first order in p/K0
    assert (modulus(1e5) - modulus(0.0)) / 1e5 == pytest.approx(11.74, rel=1e-3)
    for p in (1e8, 1e9):
        d = 1e-4 * p
        low, here, high = (law.density_ratio(one)[0] for one in (p - d, p, p + d))
        assert law.density_ratio(p)[1] == pytest.approx((high - low) / (2.0 * d), rel=1e-6)
        bend = (high - 2.0 * here + low) / d**2
        assert law.density_ratio(p)[2] == pytest.approx(bend, rel=1e-3)
    assert law.density_ratio(-1e6) == (1.0, 0.0, 0.0)


def test_tait_s_oil_is_softer_where_it_is_warmer():
    cold, warm = (
        film_oil(eta0=0.05, alpha=15e-9, density_law="tait", temperature=T) for T in (300, 400)
    )
    # K0 is less by exp(5.018e-3 100 K)
    assert pytest.approx(math.exp(-0.5018)) == warm.density.K0 / cold.density.K0
    assert density(warm, 5e8) > density(cold, 5e8)


@pytest.mark.slow
@each("law", LAWS)
@each("film", [line_film, point_film])
def test_films_answer_to_the_alpha_of_films_whatever_the_law(law, film):
    """Film coefficients of one size give films of one size, with Tait's denser oil as well."""
    found, roelands = (
        film(film_oil_in(one, 313.15).newtonian()).central_film for one in (law, "roelands")
    )
    # shapes within 1 %; Tait's density at 0.5 GPa is 2 % below that of Dowson and Higginson
    assert found == pytest.approx(roelands, rel=0.03)


@each("law", [*LAWS, "modulus_pao"])
def test_film_formulas_beside_solved_films_take_the_alpha_of_films(law):
    contact = line_contact(film_oil_in(law))
    state = lubricant(law).state(HOT)
    # the sum of 48 points, of the pressure factor an expansion that is right to 1e-3
    expected = line_film_thickness(
        contact.radius, state.eta0, state.alpha, 0.5, contact.line_load, contact.reduced_modulus
    )
    assert line_film_formulas(contact)[0].film == pytest.approx(expected, rel=1e-3)


def test_an_oil_that_is_glass_under_little_pressure_is_refused():
    glass = {"law_numbers": {"Tg0": 260.0, "A1": 200.0}}
    with pytest.raises(ParameterError, match=r"liquid to 0\.2 GPa, got a glass temperature of 2"):
        lubricant("yasutomi", **glass)
    oil = lubricant("yasutomi", temperature_low_degc=25.0, **glass)
    with pytest.raises(ParameterError, match="Raise the lowest temperature"):
        replace(oil, temperature_low=262.0).state(298.15)
    with pytest.raises(ParameterError, match=r"b2 must be within -1 to 0, got 0\.4"):
        lubricant("yasutomi", law_numbers={"b2": 0.4})
