"""Designed pairs, judged by the contact analysis of their gear files."""

import math
import tomllib

import pytest

from gearlube.output.toml_text import toml_text
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.refusal import check_pair, pair_warnings
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.design import design_pair, misses
from gearlube_core.hypoid_design.flank_target import measured_contact
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

# relief as given: that which is chosen needs elastic teeth (test_chosen_relief.py)
GIVEN = {"relief.tip_relief_um": 20.0, "relief.end_relief_um": 30.0}
SAMPLE = BlankFile.named("hypoid_13_42").varied(GIVEN)
SIDES = ("drive", "coast")
# transmission error [-], path direction [rad], centre [m] that a design may miss
NEAR = {"drive": (0.10, math.radians(2.0), 0.5e-3), "coast": (0.15, math.radians(2.0), 0.5e-3)}
BEVEL = {  # teeth and size of the bevel sample F.2 of ISO 23509
    "pair.pinion_teeth": 14,
    "pair.gear_teeth": 39,
    "pair.offset_mm": 0.0,
    "pair.face_width_mm": 25.4,
    "pair.outer_pitch_diameter_mm": 176.893,
    "pair.pinion_spiral_angle_deg": None,
    "pair.gear_spiral_angle_deg": 35.0,
    "cutter.radius_mm": 114.3,
}


@pytest.fixture(scope="module")
def design():
    return design_pair(SAMPLE)


def check_near(design):
    for side in SIDES:
        found = measured_contact(design.as_cut, side)
        for missed, limit in zip(
            misses(design.targets[side], found, design.designed), NEAR[side], strict=False
        ):
            assert abs(missed) < limit, side


def test_the_contact_analysis_finds_what_was_asked(design):
    check_near(design)


def test_the_gear_file_is_taken_as_it_is(design):
    text = toml_text(design.file.model_dump(exclude_none=True))
    file = HypoidGearFile.from_data(tomllib.loads(text), "the design")
    assert file == design.file
    check_pair(file)
    assert pair_warnings(file) == []


def test_both_members_have_sound_teeth_without_undercut(design):
    for role in ("pinion", "gear"):
        said = " ".join(tooth_form(design.file, role).report())
        assert "undercut" not in said
        assert "pointed" not in said
        assert "slot closes" not in said


def test_every_number_of_the_gear_file_says_that_it_was_not_given(design):
    file = design.file
    assert file.origin("pinion.machine.tilt_angle_deg") == "completed"
    assert file.origin("gear.pitch_angle_deg") == "inferred"
    assert file.origin("gear.teeth") == "table"


def test_a_path_along_the_lines_of_contact_is_refused_with_the_direction_to_take():
    with pytest.raises(ParameterError, match="away from the lines of contact"):
        design_pair(SAMPLE.varied({"contact.drive_path_angle_deg": 156.0}))


GENERATED = {"machine.gear": "generated"}
MITRE = {"pair.pinion_teeth": 20, "pair.gear_teeth": 20, "pair.face_width_mm": 15.0,
         "pair.outer_pitch_diameter_mm": 80.0, "cutter.radius_mm": 57.15}  # fmt: skip
ZEROL = {"pair.pinion_teeth": 20, "pair.gear_teeth": 40, "pair.face_width_mm": 22.0,
         "pair.outer_pitch_diameter_mm": 120.0, "pair.gear_spiral_angle_deg": 0.0,
         "cutter.radius_mm": 76.2}  # fmt: skip
DUPLEX = {
    "machine.curved_blades": False,
    "machine.modified_roll": True,
    "machine.helical_motion": True,
}


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes",
    [
        BEVEL,
        {"cutter.blade_groups": 5},
        GENERATED,
        BEVEL | GENERATED,
        GENERATED | {"cutter.blade_groups": 5},
        DUPLEX,
        GENERATED | DUPLEX,
        BEVEL | MITRE | GENERATED,
        BEVEL | ZEROL,
    ],
)
def test_other_processes_have_the_contact_that_was_asked(changes):
    design = design_pair(SAMPLE.varied(changes))
    check_near(design)
    check_pair(design.file)
