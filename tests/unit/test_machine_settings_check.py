"""Settings that would not mesh, and the single changes that would."""

import math

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.machine_frames import pinion_cut
from gearlube_core.hypoid_geometry.flank.setting_check import (
    pressure_angle_mismatch,
    reference_misfit,
    setting_report,
    suggest_corrections,
    suggest_settings,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

FILE = HypoidGearFile.named("mohammadpour_2015")


def test_the_shipped_pair_needs_no_change():
    assert setting_report(FILE) == []
    assert suggest_settings(FILE) == []


def test_gear_cutters_path_lies_in_the_middle_of_the_working_depth():
    # printed apexes and angles: 1 um and 0.001 deg of 80 mm
    assert reference_misfit(FILE, "gear") == pytest.approx(0.0, abs=2e-6)


def test_sliding_base_moves_the_plane_by_its_cosine_of_the_tilt():
    """The cutter axis leans by the tilt from the cradle axis, along which the base slides.

    The plane is met at another cradle angle, so that this holds to first order.
    """
    moved = FILE.varied({"pinion.machine.sliding_base_mm": 20.647 + 0.1})
    change = reference_misfit(moved, "pinion") - reference_misfit(FILE, "pinion")
    assert change == pytest.approx(0.1e-3 * math.cos(math.radians(31.736)), rel=0.05)


@pytest.fixture(scope="module")
def off_base():
    """The shipped pair with its sliding base off by a millimetre, and what is suggested."""
    file = FILE.varied({"pinion.machine.sliding_base_mm": 21.647})
    return file, {one.field: one for one in suggest_settings(file)}


def test_the_wrong_setting_is_suggested_back_to_its_value(off_base):
    _, suggestions = off_base
    found = suggestions["pinion.machine.sliding_base_mm"]
    assert (found.value_now, found.unit) == (21.647, "mm")
    # the printed settings are 1.6 um off themselves
    assert found.value_that_meets == pytest.approx(20.647, abs=3e-3)


def test_every_suggestion_alone_puts_the_plane_back(off_base):
    file, suggestions = off_base
    assert len(suggestions) >= 4
    for field, one in suggestions.items():
        cured = file.varied({field: one.value_that_meets})
        # roots are found to 1e-9 mm or deg
        assert reference_misfit(cured, "pinion") == pytest.approx(0.0, abs=1e-9)


def test_report_says_the_misfit_and_its_cures(off_base):
    file, _ = off_base
    (sentence,) = setting_report(file)
    misfit = reference_misfit(file, "pinion")
    assert f"misses the middle of the working depth by {misfit * 1e3:.3f} mm" in sentence
    assert "pinion.machine.sliding_base_mm from 21.647 to 20.6" in sentence


def test_gear_settings_are_suggested_for_the_gears_own_misfit():
    file = FILE.varied({"gear.machine.machine_center_to_back_mm": 6.5})
    found = {one.field: one for one in suggest_settings(file)}
    back = found["gear.machine.machine_center_to_back_mm"]
    # along the axis 0.526 mm, of which the plane feels the sine of its root angle
    assert reference_misfit(file, "gear") == pytest.approx(
        -0.526e-3 * math.sin(math.radians(59.653)), rel=0.01
    )
    assert back.value_that_meets == pytest.approx(7.026, abs=3e-3)


def test_blade_angle_that_misses_its_mate_is_corrected_by_as_much():
    """A wider gear blade makes a wider gear flank; the pinion's correction takes up the same."""
    assert suggest_corrections(FILE) == []
    wider = FILE.varied({"gear.cutter.convex_flank_angle_correction_deg": 1.5})
    before = pressure_angle_mismatch(FILE, "drive")
    change = pressure_angle_mismatch(wider, "drive") - before
    # cos of the blade offset angle foreshortens the blade angle by 4 % at most
    assert math.degrees(change) == pytest.approx(-1.5, rel=0.05)
    assert pressure_angle_mismatch(wider, "coast") == pressure_angle_mismatch(FILE, "coast")
    (one,) = suggest_corrections(wider)
    assert one.field == "pinion.cutter.concave_flank_angle_correction_deg"
    cured = wider.varied({one.field: one.value_that_meets})
    assert pressure_angle_mismatch(cured, "drive") == pytest.approx(0.0, abs=1e-10)


def test_cutter_far_from_the_tooth_is_refused_with_its_distance_and_cure():
    far = FILE.varied({"pinion.machine.radial_setting_mm": 400.0})
    with pytest.raises(ParameterError, match=r"passes it by \d+ mm. Check radial_setting_mm"):
        pinion_cut(far, "concave")
    far = FILE.varied({"gear.machine.horizontal_setting_mm": 400.0})
    with pytest.raises(ParameterError, match="horizontal_setting_mm"):
        Flank.from_file(far, "gear", "drive")
