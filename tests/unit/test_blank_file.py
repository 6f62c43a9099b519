"""Blank files: which method they belong to, where numbers are from, blanks that cannot exist."""

import math

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.blank_limits import check_blank, section_tooth
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from tests.helpers.each import each

SAMPLE = BlankFile.named("hypoid_13_42")


def refusal(**changes):
    changes = {name.replace("__", "."): value for name, value in changes.items()}
    with pytest.raises(ParameterError) as caught:
        check_blank(DesignedBlank.from_file(SAMPLE.varied(changes)))
    return str(caught.value)


def with_gear_spiral(**changes):
    changes = {"pair.pinion_spiral_angle_deg": None, "pair.gear_spiral_angle_deg": 35.0, **changes}
    return SAMPLE.varied(changes)


def test_the_given_fields_choose_the_method():
    assert SAMPLE.design_method == 1
    assert with_gear_spiral().design_method == 3
    assert with_gear_spiral(**{"pair.offset_mm": 0.0}).design_method == 0
    sizes = {"pair.outer_pitch_diameter_mm": None, "pair.mean_pitch_diameter_mm": 140.0}
    assert with_gear_spiral(**sizes).design_method == 2


def test_every_number_says_where_it_is_from():
    notes = {note.field: note for note in SAMPLE.inputs()}
    assert notes["pair.offset_mm"].origin == "given"
    assert notes["method"].origin == "assumed"
    assert notes["depth.gear_addendum_factor"].origin == "assumed"
    assert "pair.gear_spiral_angle_deg" not in notes  # neither given nor chosen
    assert all(note.why for note in notes.values() if note.origin == "assumed")
    results = DesignedBlank.from_file(SAMPLE).results()
    assert {note.origin for note in results} == {"inferred"}


@each(
    ("changes", "said"),
    [
        ({"method": 0}, "method 0 is for bevel gears"),
        ({"method": 3}, "method 3 needs pair.outer_pitch_diameter_mm and pair.gear_spiral_angle"),
        ({"pair__offset_mm": 0.0}, "method 0 needs"),
        ({"pair__gear_spiral_angle_deg": 30.0}, "no other diameter or spiral angle"),
        ({"pair__gear_teeth": 12}, "Swap them"),
        ({"pair__offset_mm": 90.0}, "below half the gear's diameter, 85 mm"),
        # blanks that cannot exist
        ({"pair__offset_mm": 80.0}, "No blank of method 1 has pair.offset_mm 80 mm"),
        ({"pair__offset_mm": 70.0}, "none is left for the gear"),
        ({"pair__offset_mm": 60.0}, "The blade angle of the drive flank must be within 5 to 40"),
        ({"cutter__radius_mm": 15.0}, "cutter.radius_mm 15 mm"),
        # 0.45 of 85 mm (1 + (13/42)^2)^(1/2) = 40.04 mm, the cone of the pair without offset
        ({"pair__face_width_mm": 120.0}, "pair.face_width_mm must be at most 39.2 mm, 0.45 of"),
        ({"pair__face_width_mm": 200.0}, "pair.face_width_mm must be at most 40.04 mm, 0.45 of"),
        (
            {
                "pair__face_width_mm": 150.0,
                "pair__offset_mm": 0.0,
                "pair__gear_spiral_angle_deg": 35.0,
                "pair__pinion_spiral_angle_deg": None,
            },
            "at most 40.04 mm, 0.45 of the gear's outer cone distance, got 150 mm. Reduce it, or "
            "enlarge pair.outer_pitch_diameter_mm.",
        ),
        # b = 0.45 (R_m + b/2): 0.45 / 0.775 of R_m = 80 mm / sin(67.6 deg)
        (
            {
                "pair__face_width_mm": 150.0,
                "pair__mean_pitch_diameter_mm": 160.0,
                "pair__outer_pitch_diameter_mm": None,
                "pair__gear_spiral_angle_deg": 30.0,
                "pair__pinion_spiral_angle_deg": None,
            },
            "at most 50.25 mm",
        ),
        ({"cutter__blade_groups": 7}, "share no factor with pair.gear_teeth, got 7 and 42"),
        (
            {
                "cutter__drive_pressure_angle_deg": 30.0,
                "cutter__coast_pressure_angle_deg": 30.0,
                "depth__depth_factor": 2.6,
            },
            "teeth are pointed",
        ),
        ({"pair__pinion_teeth": 5, "depth__gear_addendum_factor": 0.8}, "undercut"),
    ],
)
def test_a_blank_that_cannot_exist_is_refused_with_its_cure(changes, said):
    assert said in refusal(**changes)


def test_a_wide_face_is_warned_of():
    wide = SAMPLE.varied({"pair.face_width_mm": 36.0})
    assert "face width is 0.39" in " ".join(check_blank(DesignedBlank.from_file(wide)))


def test_straight_bevel_teeth_across_the_face_are_no_error_and_a_small_clearance_is_told():
    bevel = {"pair.offset_mm": 0.0, "pair.pinion_spiral_angle_deg": None}
    zerol = SAMPLE.varied(bevel | {"pair.gear_spiral_angle_deg": 0.0})
    assert check_blank(DesignedBlank.from_file(zerol)) == []
    tight = SAMPLE.varied({"depth.clearance_factor": 0.03})  # 0.06 normal modules
    told = " ".join(check_blank(DesignedBlank.from_file(tight)))
    assert "tips over the gear's roots is 0.1" in told
    assert "below 0.1 normal modules" in told


def test_undercut_begins_where_a_rack_undercuts_the_virtual_spur_gear():
    """A rack of addendum h undercuts a gear of radius r below h = r sin^2(alpha)."""
    one = DesignedBlank.from_file(SAMPLE)
    cones = one.cones
    radius = cones.pinion_pitch_radius / math.cos(cones.pinion_pitch_angle)
    radius /= math.cos(cones.pinion_spiral_angle) ** 2
    limit = radius * math.sin(math.radians(20.0)) ** 2
    found = section_tooth(one, "pinion").undercut
    assert found == pytest.approx(one.blank.gear.addendum - limit, rel=1e-9)


def test_a_tooth_without_height_has_the_pitch_thickness_as_topland():
    """At the pitch line the involute terms cancel; k_d = 1 with all addendum at the pinion."""
    flat = SAMPLE.varied({"depth.depth_factor": 1.0, "depth.gear_addendum_factor": 0.0})
    one = DesignedBlank.from_file(flat)
    assert section_tooth(one, "gear").topland == pytest.approx(one.gear_thickness, rel=1e-12)


@each(
    ("field", "words"),
    [
        ("cutter.duplex", "cut in one set-up.*helical motion"),
        ("machine.completing", "one set-up.*Leave it out"),
        ("depth.taper", "equally deep.*depth at mid-face"),
        ("depth.root_angle_deg", "tapered depth"),
        ("pair.shaft_angle_deg", "90 deg"),
        ("pair.hand", "pair.pinion_hand"),
    ],
)
def test_what_is_not_modelled_is_said(field, words):
    with pytest.raises(ParameterError, match=rf"{field} is not a field of this file: .*{words}"):
        BlankFile.named("hypoid_13_42").varied({field: 1.0})


def test_a_process_that_is_not_modelled_is_known_by_its_name_too():
    with pytest.raises(ParameterError, match=r"machine\.process is not .*duplex taper"):
        BlankFile.named("hypoid_13_42").varied({"machine.process": "Duplex"})
