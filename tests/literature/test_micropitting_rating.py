"""Micropitting and flank fracture against a commercial report, and closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import gearlube as gl
from gearlube_core.contact.dang_van import QUENCHED_42CRMO4, dang_van_number, passage_history
from gearlube_core.contact.half_space_stress import HalfSpaceStress
from gearlube_core.errors import ParameterError
from gearlube_core.oil.walther_1931 import walther_coefficients, walther_kinematic_viscosity
from gearlube_core.rating.micropitting import TEST_POINT
from tests.literature.test_iso_6336_rating import STAGE_3, STAGE_3_GEARS

GEARS = tuple(replace(g, arithmetic_roughness=0.6e-6) for g in STAGE_3_GEARS)
WALTHER = walther_coefficients(220e-6, 313.15, 19e-6, 373.15)


def ETA(T: float) -> float:
    """The oil of the report, density 890 kg/m3 at 15 degC, by the standard's law of density."""
    return walther_kinematic_viscosity(*WALTHER, T) * (890.0 - 0.7 * (T - 289.0))


OIL = gl.rating.FlankOil(temperature=353.15, viscosity=ETA, viscosity_40=220e-6)
LOAD = gl.rating.FlankLoad(
    pair=STAGE_3, gears=GEARS, oil=OIL, line_load=666.85e3, load_factor=1.25 * 1.092 * 1.15 * 1.069,
    pinion_speed=1165.9 * math.pi / 30.0,
)  # fmt: skip


def test_the_oil_of_the_report_has_its_viscosity():
    assert ETA(353.15) == pytest.approx(30.09e-3, rel=1e-3)
    assert ETA(358.15) == pytest.approx(25.2e-3, rel=5e-3)  # T_M has three digits


def test_films_of_the_third_stage_are_the_printed_ones():
    assert LOAD.bulk_temperature - 273.15 == pytest.approx(85.0, abs=0.06)
    found = gl.rating.micropitting_rating(LOAD, permissible=0.143)
    points = found.points
    assert points.pressure[0] == pytest.approx(1014.7e6, rel=1e-3)
    assert int(points.specific.argmin()) == 0  # the point A
    # T_M has three digits, which moves the viscosity by 0.3 %
    assert points.film[0] == pytest.approx(0.632e-6, rel=6e-3)
    assert points.specific[0] == pytest.approx(1.053, rel=6e-3)
    assert found.safety == pytest.approx(7.360, rel=6e-3)
    assert found.outside == ("module within 3 to 11 mm, got 14.00 mm",)


def test_the_test_gear_has_its_printed_film():
    found = gl.rating.permissible_film(
        265.1, bulk=127.7 + 273.15, contact=251.7 + 273.15, viscosity=ETA
    )
    assert found / 1.4 == pytest.approx(0.102, rel=0.01)  # three digits, of temperatures four
    soft = gl.rating.permissible_film(
        265.1, bulk=400.85, contact=524.85, viscosity=ETA, material=0.75
    )
    assert soft == pytest.approx(0.75 * found)
    radius, speeds, load, _ = TEST_POINT
    pressure = math.sqrt(226.374e9 * load * 265.1 / (2.0 * math.pi * radius))
    assert pressure == pytest.approx(1477.6e6, rel=1e-3)
    assert speeds[1] / 37.5 > speeds[0] / 37.5  # the gear's tip is faster than the pinion's root


def test_a_hotter_contact_thins_the_film_and_oils_differ_by_alpha():
    def film(**changes):
        given = {
            "radius": 5e-3, "pressure": 1e9, "speeds": (3.0, 5.0), "viscosity": ETA, "bulk": 370.0,
            "friction": 0.05, "roughness": 0.5e-6, **changes,
        }  # fmt: skip
        return float(gl.rating.specific_film(**given).film)

    assert film(friction=0.1) < film() < film(friction=0.0)
    # without flash: h ~ U^0.7
    assert film(friction=0.0, speeds=(6.0, 10.0)) == pytest.approx(2.0**0.7 * film(friction=0.0))
    assert film(oil="pao") < film()
    with pytest.raises(ParameterError, match="oil must be one of mineral, pao, pag"):
        film(oil="ester")


def hertz_line(p0: float, a: float) -> tuple[np.ndarray, HalfSpaceStress]:
    x = np.linspace(-6.0 * a, 6.0 * a, 769)
    pressure = p0 * np.sqrt(np.maximum(1.0 - (x / a) ** 2, 0.0))
    stress = HalfSpaceStress(
        pressure=pressure[:, None] + np.zeros(2), spacing=(x[1] - x[0], 1e-3), poisson_ratio=0.3,
        periodic=(False, True),
    )  # fmt: skip
    return x, stress


def test_the_amplitude_of_shear_under_a_line_load_is_the_closed_one():
    p0, a = 1.0e9, 1e-3
    _, stress = hertz_line(p0, a)
    depths = a * np.linspace(0.3, 0.8, 26)
    found = np.array([gl.rating.shear_amplitude(passage_history(stress(z)))[0] for z in depths])
    assert found.max() == pytest.approx(0.25 * p0, rel=0.01)  # grid of a/64, planes of 2 degrees
    assert depths[found.argmax()] == pytest.approx(0.5 * a, abs=0.03 * a)


def test_utilisation_of_the_report_is_met():
    HV = gl.rating.hardness_profile(
        np.array([1.1e-3]), surface=720.0, core=342.0, case_depth=0.5e-3
    )
    depth, tau = np.array([1.1e-3]), np.array([165.518e6])
    for material, strength, used in ((1.026, 146.951e6, 1.166), (1.042, 149.164e6, 1.150)):
        found = gl.rating.flank_fracture(depth, tau, HV, half_width=0.6655e-3, material=material)
        assert found.strength[0] == pytest.approx(strength, rel=5e-4)  # K_mat has four digits
        assert found.worst[0] == pytest.approx(used, rel=1e-3)


def test_shear_of_the_report_is_of_the_size_of_ours():
    # of its stress the standard takes off residual stress, which the report does not print
    p0, a = 1014.7e6, 0.6655e-3
    _, stress = hertz_line(p0, a)
    ours = float(gl.rating.shear_amplitude(passage_history(stress(1.1e-3)))[0])
    assert ours == pytest.approx(165.518e6, rel=0.15)


def test_the_method_of_flank_fracture_begins_at_the_half_width_and_needs_hardness():
    z = np.array([1e-4, 1e-3])
    found = gl.rating.flank_fracture(z, np.full(2, 1e8), np.full(2, 400.0), half_width=5e-4)
    assert math.isnan(found.utilisation[0])
    assert found.worst[1] == 1e-3
    none = gl.rating.flank_fracture(z, np.full(2, 1e8), np.full(2, 400.0), half_width=5e-3)
    assert "depths from the half width" in none.outside[0]
    with pytest.raises(ParameterError, match="Without hardness over depth"):
        gl.rating.flank_fracture(z, np.full(2, 1e8), np.full(2, np.nan), half_width=5e-4)
    with pytest.raises(ParameterError, match="surface must be within 342 to 1200 HV, got 300"):
        gl.rating.hardness_profile(z, surface=300.0, core=342.0, case_depth=5e-4)


def test_compression_that_does_not_help_bounds_the_number_of_dang_van():
    p0, a = 1.0e9, 1e-3
    _, stress = hertz_line(p0, a)
    history = passage_history(stress(0.5 * a))
    helped = dang_van_number(history, QUENCHED_42CRMO4)
    bound = dang_van_number(history, QUENCHED_42CRMO4, compression=False)
    assert (bound > helped).all()
    # torsion to and fro has no hydrostatic stress
    turn = np.zeros((25, 6))
    turn[:, 3] = 200e6 * np.cos(np.linspace(0.0, 2.0 * np.pi, 25))
    assert dang_van_number(turn, QUENCHED_42CRMO4, compression=False) == pytest.approx(
        200.0 / 260.0
    )
