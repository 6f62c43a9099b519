"""Pressure factors of oils from viscosities under pressure, against published formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.oil.oil_file import OilFile
from gearlube_core.oil.pressure_factor import PressureFactor
from gearlube_core.oil.viscometer import fit_pressure_factor
from tests.helpers.each import each

PAO = PressureFactor(-5.73e7, 3.90e5, -39.5e-3, 23.54e-5)
SHEET = {
    "name": "sheet", "base_oil": "pao", "density_kg_m3": 850.0, "viscosity_40_degc_mm2_s": 94.0,
    "viscosity_100_degc_mm2_s": 14.0,
}  # fmt: skip


def fva_3(bar, t):
    """Viscosity [Pa s] of the reference oil by the published formula; bar, degC."""
    grown = bar / (327.79 + 2.9862 * t + (4.419e-3 + 3.0115e-4 * t) * bar)
    return 62e-6 * math.exp(1021.7 / (t + 101.5517) + grown)


def table(temperatures=(40.0, 80.0), bars=(1000.0, 2000.0, 3000.0, 4000.0), scatter=0.0):
    rng = np.random.default_rng(4)
    return np.array(
        [
            [1e5 * bar, t + 273.15, fva_3(bar, t) * math.exp(scatter * rng.normal())]
            for t in temperatures
            for bar in bars
        ]
    )


def test_two_curves_give_the_published_formula_back():
    fitted = fit_pressure_factor(table(), lambda T: fva_3(0.0, T - 273.15), PAO)
    f = fitted.factor
    # 1e-5 Pa/bar; the formula is of the same form
    assert (f.a1 + 273.15 * f.a2, f.a2) == pytest.approx((327.79e5, 2.9862e5), rel=1e-6)
    assert (f.b1 + 273.15 * f.b2, f.b2) == pytest.approx((4.419e-3, 3.0115e-4), rel=1e-5)
    assert fitted.rms < 1e-9


def test_scatter_of_three_percent_leaves_the_film_coefficient_within_its_error():
    """Eight points of 3 %: ln(eta/eta0) of 2 to 8 at each, so alpha is known to about 1 %."""
    fitted = fit_pressure_factor(table(scatter=0.03), lambda T: fva_3(0.0, T - 273.15), PAO)
    f, T = fitted.factor, 333.15
    assert 1.0 / (f.a1 + f.a2 * T) == pytest.approx(19.73e-9, rel=0.05)
    assert 0.005 < fitted.rms < 0.06


def test_one_curve_is_met_and_the_rest_is_as_the_other_oil():
    points = table(temperatures=(60.0,))
    f = fit_pressure_factor(points, lambda T: fva_3(0.0, T - 273.15), PAO).factor
    A = 1e5 * (327.79 + 2.9862 * 60.0)
    assert f.a1 + f.a2 * 333.15 == pytest.approx(A, rel=1e-6)
    warm = (f.a1 + f.a2 * 353.15) / A
    assert warm == pytest.approx((-5.73e7 + 3.9e5 * 353.15) / (-5.73e7 + 3.9e5 * 333.15), rel=1e-6)


def test_points_without_pressure_are_the_viscosity_there():
    ambient = np.array([[0.0, t + 273.15, fva_3(0.0, t)] for t in (40.0, 80.0)])
    fitted = fit_pressure_factor(np.vstack([table(), ambient]), lambda T: math.nan, PAO)
    assert fitted.factor.a2 == pytest.approx(2.9862e5, rel=1e-6)


@each(
    ("points", "words"),
    [
        (table()[:3], "At least 4 viscosities under pressure at two pressures .* got 3 at 3"),
        (table(bars=(1000.0,), temperatures=(20.0, 40.0, 60.0, 80.0)), "got 4 at 1"),
        (
            table()[[0, 2, 1, 3]] * [[1.0, 1.0, one] for one in (1.0, 0.02, 1.0, 1.0)],
            r"must grow with pressure, got .* at 0.3 GPa and .* at 0.2 GPa, both at 40 degC",
        ),
    ],
)
def test_points_that_say_nothing_are_refused(points, words):
    with pytest.raises(ParameterError, match=words):
        fit_pressure_factor(points, lambda T: fva_3(0.0, T - 273.15), PAO)


def measured(**changes):
    points = table()
    lists = {
        "pressure_gpa": (1e-9 * points[:, 0]).tolist(),
        "temperature_degc": (points[:, 1] - 273.15).tolist(),
        "viscosity_pa_s": points[:, 2].tolist(),
    }
    return SHEET | {"viscometer": lists} | changes


def test_an_oil_file_takes_the_points():
    sheet = {"viscosity_40_degc_mm2_s": 97.6, "viscosity_100_degc_mm2_s": 11.4}
    described = OilFile.from_data(measured(**sheet, density_kg_m3=900.0), "oil").described()
    state = described.lubricant.state(333.15)
    # ambient viscosities by the sheet, up to 3 % off: 3 % of ln(eta/eta0) of 2 at the first points
    assert 1.0 / state.modulus == pytest.approx(19.73e-9, rel=0.04)
    notes = {note.field: note for note in described.inputs}
    assert notes["viscosity_law"].origin == notes["law_numbers.a1"].origin == "inferred"
    assert "viscometer" in notes["viscosity_law"].why
    # 2 Lambda/alpha with the measured alpha
    oil = described.lubricant
    assert oil.eyring_stress == pytest.approx(2.0 * 0.035 / oil.alpha, rel=1e-9)


@each(
    ("changes", "words"),
    [
        ({"alpha_per_gpa": 15.0}, "alpha_per_gpa must be left out with viscometer"),
        ({"viscosity_law": "modulus"}, "viscosity_law must be left out with viscometer"),
        ({"alpha_is": "slope"}, "alpha_is must be left out without alpha_per_gpa"),
        (
            {"viscometer": {"pressure_gpa": [1.0], "temperature_degc": [], "viscosity_pa_s": [1]}},
            "one number for each point, got 1, 0 and 1",
        ),
    ],
)
def test_an_oil_file_that_says_things_twice_is_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        OilFile.from_data(measured(**changes), "oil")
