"""Problem files: what may change, errors, settings, and what is refused."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.hypoid_contact.placement import Misalignment
from tests.helpers.each import each

CROWN = {"pinion.flank.crown_um": {"low": 0.0, "high": 9.0}}
TWIST = {"pinion.drive_flank.twist_um": {"low": -9.0, "high": 9.0, "start": 0.0}}


def problem(gear="he_2007", parameters=CROWN, **more):
    data = {"name": "p", "gear": gear, "torques_n_m": [50.0], "parameters": parameters, **more}
    return Problem.of(OptimisationFile.from_data(data, "p"))


@pytest.mark.parametrize("name", OptimisationFile.shipped())
def test_the_shipped_problems_can_be_posed(name):
    found = Problem.of(OptimisationFile.named(name))
    assert (found.low <= found.start).all()
    assert (found.start <= found.high).all()
    assert found.scenarios[0].name == "none"


def test_errors_are_taken_with_both_signs_one_at_a_time():
    helical = problem(errors={"lead_slope_um": 8.0, "fields": {"gear": {"flank": {"crown_um": 2}}}})
    added = [one.added for one in helical.scenarios]
    slope, crown = "gear.flank.lead_slope_um", "gear.flank.crown_um"
    assert added == [{}, {slope: 8.0}, {slope: -8.0}, {crown: 2.0}, {crown: -2.0}]
    hypoid = problem("mohammadpour_2015", TWIST, errors={"shaft_angle_mrad": 0.5})
    moved = [one.misalignment for one in hypoid.scenarios]
    assert moved == [Misalignment(shaft_angle=angle) for angle in (0.0, 5e-4, -5e-4)]


def test_settings_of_the_pinion_are_freed_and_gear_and_blades_kept():
    found = problem("mohammadpour_2015", {}, settings={"within_mm": 0.2, "within_deg": 0.1})
    assert {name.rsplit(".", 1)[0] for name in found.names} == {"pinion.machine"}
    at = dict(zip(found.names, found.high - found.start, strict=True))
    assert at["pinion.machine.radial_setting_mm"] == pytest.approx(0.2)
    assert at["pinion.machine.tilt_angle_deg"] == pytest.approx(0.1)
    assert at["pinion.machine.ratio_of_roll"] == pytest.approx(0.02762)
    assert not any("cradle" in name for name in found.names)  # only a phase
    blades = problem("mohammadpour_2015", {}, settings={"blades": True})
    cutter = {name for name in blades.names if ".cutter." in name}
    # the concave pinion flank drives
    assert "pinion.cutter.concave_flank_blade_angle_deg" in cutter
    assert "pinion.cutter.convex_flank_blade_angle_deg" not in cutter


def test_amounts_that_a_gear_file_does_not_take_are_tried_but_not_written():
    found = problem("mohammadpour_2015", TWIST)
    tried = found.tried(np.array([0.2]), found.scenarios[0])
    assert tried.correction("pinion", "drive").twist == pytest.approx(0.2e-6, rel=1e-12, abs=0.0)
    assert found.rounded(np.array([0.2])).tolist() == [0.0]
    assert found.rounded(np.array([-3.123456789])).tolist() == [-3.12346]


@each(
    ("gear", "more", "said"),
    [
        ("he_2007", {"torques_n_m": [5.0, 5.0]}, "torques_n_m must rise"),
        ("he_2007", {"orders": [5]}, "positions must be at least 11 for order 5, got 8"),
        ("he_2007", {"orders": [1, 1]}, "each order once"),
        ("he_2007", {"parameters": {}}, r"\[parameters\] must name a field"),
        ("he_2007", {"parameters": {"x.y": {"low": 1.0, "high": 0.0}}}, "low must be below high"),
        (
            "he_2007",
            {"parameters": {"x.y": {"low": 1.0, "high": 2.0, "start": 3.0}}},
            "start must lie within low and high, 1 to 2, got 3",
        ),
        (
            "he_2007",
            {"parameters": {"pinion.flank.crwn_um": {"low": 0.0, "high": 1.0}}},
            "Is it pinion.flank.crown_um?",
        ),
        (
            "he_2007",
            {"parameters": {"pinion.tip_diameter_mm": {"low": 80.0, "high": 90.0}}},
            "The blank cannot change",
        ),
        (
            "he_2007",
            {"parameters": {"pinion.flank.tip_relief_depth_mm": {"low": 1.0, "high": 2.0}}},
            "must have a start",
        ),
        (
            "he_2007",
            {"parameters": {"pinion.flank.crown_um": {"low": 2.0, "high": 3.0}}},
            "within low and high, 2 to 3, got 0",
        ),
        ("he_2007", {"errors": {"pinion_axial_um": 5.0}}, "is not for a helical pair"),
        ("he_2007", {"settings": {}}, "is only for a hypoid pair"),
        (
            "mohammadpour_2015",
            {"parameters": TWIST, "errors": {"lead_slope_um": 5.0}},
            "is not for a hypoid pair",
        ),
        (
            "mohammadpour_2015",
            {"parameters": {"pinion.coast_flank.twist_um": {"low": 1.0, "high": 2.0}}},
            "flanks without load",
        ),
        (
            "mohammadpour_2015",
            {
                "parameters": {
                    "pinion.drive_flank.tip_relief_um": {"low": 1, "high": 90, "start": 9},
                    "pinion.drive_flank.tip_relief_depth_mm": {"low": 0.5, "high": 2, "start": 1},
                }
            },
            "at most 10 % of tip_relief_depth_mm",
        ),
        ("no_such_pair", {}, "Or give a path"),
        ("missing.toml", {}, "gear file missing.toml was not found in"),
    ],
)
def test_wrong_problems_are_refused_with_a_sentence(gear, more, said):
    data = {"name": "p", "gear": gear, "torques_n_m": [50.0], "parameters": CROWN}
    with pytest.raises(ParameterError, match=said):
        Problem.of(OptimisationFile.from_data({**data, **more}, "p"))
