"""Viscosity of measured oils under pressure, and the coefficients that one law has."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_laws import log_viscosity, roelands
from gearlube_core.oil.formula_laws import log_viscosity_under, mean_slope
from gearlube_core.oil.houpert_1985 import houpert_log_viscosity, houpert_parameters
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.named_laws import ViscosityLaw
from gearlube_core.oil.pressure_coefficients import pressure_coefficient, slope_for
from tests.helpers.each import each

MEASURED = ("arana_2019_m100", "arana_2019_n100", "arana_2019_pao100")


def law_of(oil, temperature):
    law, eta0 = oil.viscosity_law.at(oil, temperature)
    return law(eta0, oil.alpha)


@each(
    ("name", "grown"),
    # p/(A + B p) of [arana_2019 Table 3] by hand at 333.15 K and 1 GPa
    [("arana_2019_n100", 23.51), ("arana_2019_m100", 13.07), ("arana_2019_pao100", 8.964)],
)
def test_oils_of_arana_have_their_factor_in_films_and_in_formulas(name, grown):
    oil = Lubricant.named(name)
    # alpha has four digits
    assert log_viscosity(law_of(oil, 333.15), 1e9, 1.0)[0] == pytest.approx(grown, rel=4e-4)
    state = oil.state(333.15)
    assert 1e9 * mean_slope(state.viscosity, state, 1e9) == pytest.approx(grown, rel=4e-4)
    under = log_viscosity_under(state.viscosity, state, 1e9)
    assert under - math.log(state.eta0) == pytest.approx(grown, rel=4e-4)


def test_fva_3_has_the_viscosities_of_its_formula():
    """62e-6 exp[1021.7/(t + 101.5517) + P/(327.79 + 2.9862 t + (4.419e-3 + 3.0115e-4 t) P)]."""
    oil = Lubricant.named("fva_3")
    law, eta0 = law_of(oil, 333.15), oil.dynamic_viscosity(333.15)
    for bar, t in ((5e3, 60.0), (1e4, 60.0), (1.5e4, 60.0)):
        factor = bar / (327.79 + 2.9862 * t + (4.419e-3 + 3.0115e-4 * t) * bar)
        # alpha has four digits: 1e-4 of an exponent of 7 to 14
        assert log_viscosity(law, 1e5 * bar, 1.0)[0] == pytest.approx(factor, rel=3e-4)
    # the line of Walther through 40 and 100 degC is 0.7 % low there
    assert eta0 == pytest.approx(62e-6 * math.exp(1021.7 / 161.5517), rel=0.01)


def film_integral(law, end):
    thin, _ = quad(lambda p: math.exp(-log_viscosity(law, p * 1e9, 1.0)[0]), 0.0, end, limit=200)
    return 1e-9 / thin


@each("law", [roelands(0.03, 2e-8), roelands(0.1, 1.2e-8), roelands(0.005, 3e-8)])
def test_coefficient_of_films_is_the_integral_over_pressure(law):
    # at 20 GPa less than 1e-9 of the oil's thinness is left
    expected = film_integral(law, 20.0)
    assert pressure_coefficient(law, "film") == pytest.approx(expected, rel=1e-7)


@each("name", MEASURED)
def test_films_take_the_integral_and_it_falls_with_temperature(name):
    oil = Lubricant.named(name)
    found = []
    for T in (293.15, 333.15, 373.15):
        # before ln eta saturates; what is left beyond is below 1e-4
        expected = film_integral(law_of(oil, T), 1.5)
        found.append(oil.state(T).alpha)
        assert found[-1] == pytest.approx(expected, rel=1e-3)
    assert found[0] > found[1] > found[2]


@each("alpha_is", ("film", "slope", "mean"))
@each("law", ("modulus", "modulus_naphthenic", "modulus_pao", "modulus_fva_3", "roelands"))
def test_the_law_of_an_oil_has_its_alpha_whichever_it_is(alpha_is, law):
    named = ViscosityLaw.kind.named("law", law, {})
    base = Lubricant.named("arana_2019_m100")
    oil = replace(base, alpha=1.8e-8, alpha_is=alpha_is, viscosity_law=named)
    T = oil.alpha_temperature
    made = named.at(oil, T)[0](oil.dynamic_viscosity(T), oil.state(T).slope)
    # the series of the integral: 1e-3 at most
    tolerance = 1e-3 if alpha_is == "film" else 1e-9
    found = pressure_coefficient(made, alpha_is, oil.alpha_pressure)
    assert found == pytest.approx(1.8e-8, rel=tolerance)


@each("alpha_is", ("film", "slope", "mean"))
def test_houpert_s_law_has_the_alpha_of_the_oil_whichever_it_is(alpha_is):
    base = replace(Lubricant.named("arana_2019_m100"), viscosity_law=None)
    oil = replace(base, alpha=1.8e-8, alpha_is=alpha_is)
    fit, T = houpert_parameters(oil), oil.alpha_temperature
    eta0 = math.exp(houpert_log_viscosity(fit, 0.0, T) - 9.67)
    law = roelands(eta0, fit.Z * 5.1e-9 * (math.log(eta0) + 9.67))
    # constants of Roelands' law differ by 4e-5; at 40 degC Houpert's and Walther's lines meet
    assert pressure_coefficient(law, alpha_is) == pytest.approx(1.8e-8, rel=1e-4)


def test_what_alpha_is_moves_the_viscosity_of_a_flank():
    """One number, read as slope or as from films: 1.3 to 3 times at 1 GPa."""
    oil = replace(Lubricant.named("arana_2019_pao100"), alpha=1.5e-8)
    as_slope, as_film = (replace(oil, alpha_is=one) for one in ("slope", "film"))
    grown = [log_viscosity(law_of(one, 333.15), 1e9, 1.0)[0] for one in (as_slope, as_film)]
    assert 1.3 < math.exp(grown[1] - grown[0]) < 3.0


@each("name", ("fva_3", "arana_2019_m100", "arana_2019_pao100"))
def test_viscosity_at_1_gpa_moves_and_the_alpha_of_films_stays(name):
    oil, T = Lubricant.named(name), 353.15
    own = law_of(oil, T)
    for by in (1.0 / 2.2, 1.35, 2.2):
        made = law_of(oil.with_high_pressure(by), T)
        grown = [log_viscosity(law, 1e9, 1.0)[0] for law in (own, made)]
        assert grown[1] - grown[0] == pytest.approx(math.log(by), rel=1e-9)
        # the integral over pressure against its expansion for small B
        assert pressure_coefficient(made, "film") == pytest.approx(
            pressure_coefficient(own, "film"), rel=3e-3
        )


def test_a_viscosity_that_grows_exponentially_cannot_grow_more_with_the_same_alpha():
    oil, T = Lubricant.named("arana_2019_n100"), 353.15
    up, own, down = (
        log_viscosity(law_of(oil.with_high_pressure(by), T), 1e9, 1.0)[0] for by in (2.0, 1.0, 0.5)
    )
    assert up == pytest.approx(own, rel=1e-9)
    assert own - down == pytest.approx(math.log(2.0), rel=1e-6)
    papers = Lubricant.named("karagiannis_2012")  # Roelands: nothing to change
    assert papers.with_high_pressure(2.0) is papers


def test_derivatives_of_the_law_are_those_of_its_values():
    law = law_of(Lubricant.named("arana_2019_pao100"), 333.15)
    p, T, step = 8e8, 350.0, 1e-3
    cooling = law.cooling_factor(T, 333.15)
    value, slope = log_viscosity(law, p, cooling)
    above, below = (log_viscosity(law, p + dp, cooling)[0] for dp in (1e4, -1e4))
    # central differences: rounding of 8 over 2e4
    assert slope == pytest.approx((above - below) / 2e4, rel=1e-7)
    hot, cold = (log_viscosity(law, p, (T + dT) / 333.15)[0] for dT in (step, -step))
    decline = law.viscosity_decline(p, T, 333.15)
    assert decline == pytest.approx(-(hot - cold) / (2.0 * step), rel=1e-6)
    assert law.cooling_at(p, value) == pytest.approx(cooling, rel=1e-12)
    assert log_viscosity(law, -1e6, 1.0)[0] == pytest.approx(-1e6 / 7.2623e7, rel=1e-3)
    inside = law.in_units(1e9)
    assert log_viscosity(inside, 0.8, cooling)[0] == pytest.approx(value, rel=1e-12)


def test_cold_oil_thickens_on_and_never_saturates_below_zero():
    """The line of B reaches zero at -27 degC of the paraffinic oil."""
    oil = Lubricant.named("arana_2019_m100")
    pressures = np.linspace(0.0, 2e9, 41)
    for T in (233.15, 246.0, 253.15):
        made = law_of(replace(oil, temperature_low=230.0), T)
        grown = [log_viscosity(made, float(p), 1.0)[0] for p in pressures]
        assert np.all(np.diff(grown) > 0.0)


def test_alpha_that_no_law_can_have_is_refused():
    law = ViscosityLaw.kind.named("law", "modulus_pao", {})
    oil = replace(
        Lubricant.named("arana_2019_pao100"), alpha=9e-8, alpha_is="mean", alpha_pressure=1e9,
        viscosity_law=law,
    )  # fmt: skip
    with pytest.raises(ParameterError, match=r"mean slope to 1 GPa must be below .* got 90 1/GPa"):
        oil.state(313.15)
    with pytest.raises(ParameterError, match="No slope of the viscosity law"):
        slope_for(lambda slope: roelands(0.03, 2e-8), 9e-8, "film")
