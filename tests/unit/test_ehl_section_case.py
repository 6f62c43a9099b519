"""Case files of parts of a line contact between closed sides."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube.studies.films.run_steady import run_point
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

SMALL = {"solver.nodes_x": 97, "solver.nodes_y": 16 + 2}


def section(**changes) -> PointCase:
    return PointCase.named("jamali_2015_section").varied(SMALL | changes)


def test_the_section_of_the_thesis_is_its_line_contact():
    part, line = PointCase.named("jamali_2015_section").problem(), LineCase.named("jamali_2015")
    smooth = line.problem()
    assert part.line_load == pytest.approx(smooth.line_load)
    assert part.hertz_contact[0] == pytest.approx(smooth.half_width)
    assert part.hertz_contact[2] == pytest.approx(smooth.hertz_pressure)
    assert part.entrainment == pytest.approx((smooth.entrainment_speed, 0.0))
    assert part.x_limits == pytest.approx((-2.5 * smooth.half_width, 1.5 * smooth.half_width))
    assert part.sides == "cyclic"


def test_its_dataset_has_the_dry_pressure_and_the_formulas_of_a_line():
    found = run_point(section())
    x = found["x"].values
    dry = found["hertz_pressure"].values
    half_width, most = found.attrs["semi_axis_x"], found.attrs["hertz_pressure_max"]
    expected = most * np.sqrt(np.maximum(1.0 - (x / half_width) ** 2, 0.0))
    assert dry == pytest.approx(np.tile(expected[:, None], 18))
    assert math.isinf(found.attrs["radius_y"])
    names = {str(one) for one in found["formula_source"].values}
    assert names == {"Dowson and Toyoda 1979", "Dowson 1968"}
    assert found.attrs["friction_coefficient"] == pytest.approx(0.031, abs=1e-3)


def test_waves_that_repeat_over_the_length_are_taken_and_others_refused():
    # crests along x: 2 mm are 4 waves of 0.5 mm
    waves = {"amplitude_um": 0.1, "wavelength_mm": 0.5, "direction_deg": 90.0}
    grid = {"solver.nodes_y": 64}
    repeating = section(waviness=waves, **grid).problem()
    first, last = (repeating.gap(np.zeros(1), np.array([y])) for y in repeating.y_limits)
    assert first == pytest.approx(last)
    with pytest.raises(ParameterError, match="must repeat over the length of 2 mm"):
        section(waviness=waves | {"wavelength_mm": 0.6}, **grid)


@each(
    ("changes", "words"),
    [
        ({"length_mm": None}, "length_mm must be given and radius_y_mm left out"),
        ({"radius_y_mm": 14.0}, "length_mm must be given and radius_y_mm left out"),
        ({"side_conditions": "ambient"}, "radius_y_mm must be given and length_mm left out"),
        ({"solver.nodes_y": 33}, "nodes along y must be even"),
        ({"side_speed_1_m_s": 1.0}, "entrainment along y must be 0 m/s"),
        ({"domain.oil_beyond": True}, "oil_beyond and inlet_layer cannot be combined with"),
        ({"solver.cavitation": "mass_conserving"}, "needs sides ambient, got cyclic"),
    ],
)
def test_wrong_sections_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        section(**changes)


def test_thermal_sections_are_refused():
    oil = {"oil.law": "houpert", "oil.temperature_exponent": 1.0}
    with pytest.raises(ParameterError, match="a thermal film needs sides ambient, got cyclic"):
        section(temperature="thermal", **oil)
