"""Gear files of hypoid pairs, reliefs and blanks."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.blank.iso_23509 import HypoidDesign, method_2
from gearlube_core.hypoid_geometry.blank.pitch_cones import CutterHead, PitchCones, ToothTrace
from gearlube_core.hypoid_geometry.flank.correction import EdgeRelief
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes
from tests.helpers.each import each
from tests.helpers.member_profile import MemberProfile

FILE = HypoidGearFile.named("mohammadpour_2015")
NOTES = field_notes(HypoidGearFile)
BOUNDED = [name for name, note in NOTES.items() if note.limits and note.kind != "text"]


def limits_of(name):
    number = r"(-?[\d.]+(?:e[+-]?\d+)?)"
    low, high = re.search(f"{number} to {number}", NOTES[name].limits).groups()
    return float(low), float(high)


def test_values_beyond_their_range_are_named_with_range_and_unit():
    for name in BOUNDED:
        low, high = limits_of(name)
        for value in (low - 1, high + 1):
            wrong = int(value) if NOTES[name].kind == "whole number" else value
            with pytest.raises(ParameterError) as caught:
                FILE.varied({name: wrong})
            message = str(caught.value)
            assert f"{name} must be a {NOTES[name].kind}, {NOTES[name].limits}" in message
            assert f"got {wrong!r}" in message
            assert NOTES[name].unit in message


def test_every_number_has_a_unit_or_needs_none_and_a_meaning():
    plain = ("teeth", "blade_groups", "ratio_of_roll", "modified_roll_2c", "modified_roll_6d")
    for name in BOUNDED:
        note = NOTES[name]
        assert note.unit in ("mm", "um", "deg", "mm/rad") or name.rsplit(".", 1)[1] in plain, name
        assert len(note.meaning) > 10, name


def test_missing_field_is_named_with_its_meaning():
    data = FILE.model_dump(exclude_none=True)
    del data["gear"]["machine"]["vertical_setting_mm"]
    with pytest.raises(ParameterError, match=r"gear\.machine\.vertical_setting_mm is missing: Dis"):
        HypoidGearFile.from_data(data, "mine.toml")


def test_misspelled_field_is_answered_with_the_nearest():
    with pytest.raises(ParameterError, match=r"is it pinion\.machine\.tilt_angle_deg\?"):
        FILE.varied({"pinion.machine.tilt_angle": 30.0})


def test_all_wrong_fields_are_listed_at_once():
    with pytest.raises(ParameterError, match=r"2 wrong field.*pinion\.teeth.*gear\.teeth"):
        FILE.varied({"pinion.teeth": 1, "gear.teeth": 1})


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"gear.face_width_mm": 95.598}, r"gear\.face_width_mm must be below .* 95\.598 mm"),
        ({"gear.face_apex_mm": 1.0}, r"working depth.* must be above 0 mm, got -1\.\d+ mm"),
        ({"gear.cutter.blade_groups": 0}, r"must be both 0 .* got 11 and 0"),
        ({"inferred": ("gear.colour",)}, r"'gear\.colour', which is not a field"),
    ],
)
def test_fields_that_contradict_each_other_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        FILE.varied(changes)


def test_unreadable_and_unknown_files_are_told_apart(tmp_path):
    broken = tmp_path / "broken.toml"
    broken.write_text("teeth = = 3", encoding="utf-8")
    with pytest.raises(ParameterError, match=r"broken\.toml is not a readable TOML file"):
        HypoidGearFile.from_toml(broken)
    with pytest.raises(ParameterError, match="No gear file is called 'none'"):
        HypoidGearFile.named("none")


def test_every_datum_says_where_it_is_from():
    assert FILE.origin("gear.cutter.point_radius_mm") == "table"
    assert FILE.origin("gear.cutter.blade_groups") == "inferred"
    assert FILE.origin("gear.cutter.blade_edge_radius_mm") == "completed"


def test_varied_copy_leaves_the_file_as_it_was():
    varied = FILE.varied({"pinion.teeth": 12, "gear.cutter.blade_edge_radius_mm": None})
    assert (varied.pinion.teeth, FILE.pinion.teeth) == (12, 13)
    assert varied.gear.cutter.blade_edge_radius_mm is None
    assert varied.varied({"pinion.teeth": 13}).pinion == FILE.pinion


def with_fields(**fields):
    return FILE.varied({f"pinion.coast_flank.{name}": value for name, value in fields.items()})


def test_fields_become_metres_on_their_own_flank_alone():
    file = with_fields(
        root_relief_um=12.0, root_relief_depth_mm=1.5, end_edge_radius_mm=0.4, twist_um=-5.0
    )
    found = file.correction("pinion", "coast")
    assert found.reliefs[0] == EdgeRelief(edge="root", amount=12e-6, extent=1.5e-3)
    assert [(one.edge, one.extent) for one in found.reliefs[1:]] == [
        ("toe", pytest.approx(0.4e-3)),
        ("heel", pytest.approx(0.4e-3)),
    ]
    assert found.twist == pytest.approx(-5e-6)
    assert file.correction("pinion", "drive").is_none
    assert file.correction("gear", "coast").is_none


@each(
    ("fields", "parts"),
    [
        ({"tip_relief_um": -5.0}, ["tip_relief_um must be a number, 0 to 500 um, got -5"]),
        ({"tip_relief_um": 20.0}, ["tip_relief_depth_mm is missing"]),
        (
            {"tip_relief_um": 20.0, "tip_relief_depth_mm": -1.0},
            ["tip_relief_depth_mm must be a number, above 0 to 200 mm, got -1"],
        ),
        (
            {"tip_relief_um": 0.02, "tip_relief_depth_mm": 2.0},
            ["tip_relief_um must be 0 or 0.5 to 500 um, got 0.02 um", "0.02 mm is 20 um"],
        ),
        ({"lead_crown_um": -0.01}, ["lead_crown_um must be 0 or 0.5", "0.01 mm is 10 um"]),
        (
            {"tip_relief_um": 20.0, "tip_relief_depth_mm": 9.0},
            # whole depth 7.615 mm: working depth 6.769 mm and an eighth of it
            ["pinion.coast_flank: the reliefs must fit", "7.615 mm, got tip_relief_depth_mm 9 mm"],
        ),
        (
            {
                "toe_relief_um": 20.0, "toe_relief_length_mm": 20.0, "heel_relief_um": 20.0,
                "heel_relief_length_mm": 20.0,
            },
            ["at most pinion.face_width_mm", "toe_relief_length_mm 20 mm and heel_relief"],
        ),
        (
            {"tip_relief_um": 200.0, "tip_relief_depth_mm": 1.0},
            ["tip_relief_um must be at most 10 % of tip_relief_depth_mm, 100 um, got 200 um"],
        ),
        ({"tip_edge_radius_mm": 30.0}, ["tip_edge_radius_mm must be a number, 0 to 2 mm, got 30"]),
    ],
)  # fmt: skip
def test_a_wrong_relief_is_refused_with_value_limit_and_cure(fields, parts):
    with pytest.raises(ParameterError) as caught:
        with_fields(**fields)
    for part in parts:
        assert part in str(caught.value), str(caught.value)


def test_derivatives_of_the_unloaded_contact_are_refused_for_corrected_flanks():
    pair = FlankPair.from_file(with_fields(twist_um=5.0), "coast")
    with pytest.raises(ParameterError, match=r"corrected coast flanks\. Take `pair\.uncorrected"):
        pair.check_uncorrected()
    pair.uncorrected().check_uncorrected()


BLANK = HypoidGearFile.named("mohammadpour_2015").blank()


def test_a_file_of_millimetres_and_degrees_becomes_metres_and_radians():
    # the printed numbers times 1e-3 and pi/180, to rounding
    assert BLANK.pinion.outer_cone_distance == pytest.approx(0.083084, rel=1e-15)
    assert BLANK.gear.pitch_angle == pytest.approx(59.653 * math.pi / 180.0, rel=1e-15)
    assert BLANK.offset == pytest.approx(0.024, rel=1e-15)
    assert (BLANK.pinion.teeth, BLANK.gear.teeth) == (13, 36)


@each("field", ["face_width", "outer_cone_distance", "pitch_apex", "face_apex"])
@each("member", ["pinion", "gear"])
def test_millimetres_given_as_metres_are_refused_by_name(member, field):
    body = getattr(BLANK, member)
    with pytest.raises(ParameterError, match=rf"{field} must be .* m, got .* m\. Give metres"):
        replace(body, **{field: 1e3 * getattr(body, field)})


def test_an_offset_in_millimetres_given_as_metres_is_refused():
    with pytest.raises(ParameterError, match=r"offset must be .* m, got .* m\. Give metres"):
        replace(BLANK, offset=1e3 * BLANK.offset)


@pytest.mark.parametrize("field", ["pitch_angle", "spiral_angle"])
def test_degrees_given_as_radians_are_refused_by_name(field):
    with pytest.raises(ParameterError, match=rf"{field} must be .* rad, got .* Give radians"):
        replace(BLANK.gear, **{field: math.degrees(getattr(BLANK.gear, field))})


@each(
    "field",
    ["face_width", "outer_cone_distance", "pitch_angle", "spiral_angle", "pitch_apex", "face_apex"],
)
def test_a_length_or_angle_that_is_not_a_number_is_refused(field):
    with pytest.raises(ParameterError, match=f"{field} must be finite, got nan"):
        replace(BLANK.pinion, **{field: math.nan})


def test_a_face_wider_than_the_cone_is_refused():
    with pytest.raises(ParameterError, match=r"must exceed face_width 0\.09 m, got"):
        replace(BLANK.pinion, face_width=0.09)


def test_a_gear_of_two_teeth_is_refused():
    with pytest.raises(ParameterError, match="teeth must be within 3 to 400, got 2"):
        replace(BLANK.pinion, teeth=2)


def test_an_offset_beyond_the_reach_of_the_cones_is_refused():
    with pytest.raises(ParameterError, match="Reduce offset"):
        replace(BLANK, offset=0.4).mean_point()


def test_without_offset_the_mean_point_lies_in_the_plane_of_the_axes():
    point = replace(BLANK, offset=0.0).mean_point()
    assert point[1] == 0.0
    # mid-face pitch radius and height over the apex of the gear cone, by hand in mm
    cone = 95.598 - 0.5 * 29.999
    expected = [
        cone * math.sin(math.radians(59.653)),
        -8.987 + cone * math.cos(math.radians(59.653)),
    ]
    np.testing.assert_allclose(1e3 * point[[0, 2]], expected, rtol=1e-14)


def test_directions_at_the_mean_point_are_orthogonal_unit_vectors():
    generator, pitch = BLANK.gear_generator(), BLANK.pitch_normal()
    np.testing.assert_allclose(np.linalg.norm([generator, pitch], axis=1), 1.0, rtol=1e-15)
    assert abs(generator @ pitch) < 1e-15


PROFILES = [MemberProfile.of_pinion(BLANK), MemberProfile.of_gear(BLANK)]
DESIGN = HypoidDesign(
    pinion_teeth=9,
    gear_teeth=34,
    offset=0.03175,
    shaft_angle=0.5 * math.pi,
    gear_face_width=0.026,
    cutter=CutterHead(radius=0.076, blade_groups=13),
)
TOUCHING = {
    "pinion_teeth": 9,
    "gear_teeth": 34,
    "offset": 0.03175,
    "shaft_angle": 0.5 * math.pi,
    "gear_pitch_angle": 1.1,
    "gear_pitch_radius": 0.07335,
}


@pytest.mark.parametrize("profile", PROFILES)
def test_corners_lie_on_the_face_and_root_cones(profile):
    for cone, corners in (
        (profile.face_cone, (profile.outer_tip, profile.inner_tip)),
        (profile.root_cone, (profile.outer_root, profile.inner_root)),
    ):
        for axial, radius in corners:
            assert cone.radius(axial) == pytest.approx(radius, rel=1e-12)


@pytest.mark.parametrize("profile", PROFILES)
def test_tip_and_root_stand_a_whole_depth_apart_across_the_pitch_cone(profile):
    across = np.subtract(profile.outer_tip, profile.outer_root)
    assert np.linalg.norm(across) == pytest.approx(BLANK.whole_depth, rel=1e-12)
    assert profile.whole_depth == pytest.approx(BLANK.whole_depth, rel=1e-12)
    angle = profile.member.pitch_angle
    assert across @ (math.cos(angle), math.sin(angle)) == pytest.approx(0.0, abs=1e-15)


def test_the_gear_mean_point_lies_on_its_pitch_cone():
    x, y, z = BLANK.mean_point()
    assert PROFILES[1].pitch_cone.radius(z) == pytest.approx(math.hypot(x, y), rel=1e-12)


def test_face_and_root_cones_of_the_mates_leave_the_clearance():
    """Across the pitch plane at the mean point the mates' cones stand a clearance apart."""
    pinion, gear = PROFILES
    for mine, mate in ((pinion, gear), (gear, pinion)):
        assert mine.dedendum - mate.member.addendum == pytest.approx(
            BLANK.root_clearance, rel=1e-12
        )


def test_a_given_clearance_replaces_the_completed_one():
    file = HypoidGearFile.named("mohammadpour_2015")
    blank = file.varied({"pair.clearance_mm": 0.9}).blank()
    assert blank.root_clearance == pytest.approx(0.9e-3, rel=1e-15)
    assert blank.gear_dedendum == pytest.approx(BLANK.pinion.addendum + 0.9e-3, rel=1e-15)
    assert replace(blank, clearance=None) == BLANK


def test_a_clearance_in_millimetres_is_refused():
    with pytest.raises(ParameterError, match=r"clearance must be .* m, got 0\.8 m\. Give metres"):
        replace(BLANK, clearance=0.8)


def test_a_dedendum_below_the_tip_is_refused():
    with pytest.raises(ParameterError, match="dedendum must be within"):
        MemberProfile(member=BLANK.gear, dedendum=-0.002)


def test_one_spiral_angle_must_be_given():
    with pytest.raises(ParameterError, match="Give exactly one of gear_spiral_angle"):
        PitchCones.touching(**TOUCHING)
    with pytest.raises(ParameterError, match="Give exactly one of gear_spiral_angle"):
        PitchCones.touching(**TOUCHING, gear_spiral_angle=0.4, pinion_spiral_angle=0.8)


def test_an_offset_beyond_the_gear_is_refused():
    with pytest.raises(ParameterError, match="Reduce offset"):
        PitchCones.touching(**TOUCHING | {"offset": 0.08}, gear_spiral_angle=0.4)


def test_a_design_without_offset_is_refused():
    with pytest.raises(ParameterError, match="offset must be within"):
        replace(DESIGN, offset=0.0)


@pytest.mark.parametrize(("field", "value"), [("radius", 76.0), ("blade_groups", -1)])
def test_a_cutter_in_millimetres_or_of_negative_groups_is_refused(field, value):
    with pytest.raises(ParameterError, match=f"{field} must be within"):
        replace(DESIGN.cutter, **{field: value})


def test_a_cutter_too_small_for_its_lead_is_refused():
    with pytest.raises(ParameterError, match="Enlarge the cutter"):
        CutterHead(radius=0.02, blade_groups=13).lead_angle(4e-3)


def test_a_trace_out_of_the_reach_of_the_cutter_is_refused():
    trace = ToothTrace(
        cutter=DESIGN.cutter, crown_teeth=38.0, mean_cone_distance=0.082, mean_spiral_angle=0.37
    )
    with pytest.raises(ParameterError, match=r"reach of the cutter, got 0\.3 m"):
        trace.spiral_angle(0.3)


def test_a_cutter_that_no_pitch_angle_suits_says_so():
    with pytest.raises(ConvergenceError, match="closes the cutter condition"):
        method_2(
            replace(DESIGN, cutter=CutterHead(radius=0.02, blade_groups=0)),
            mean_pitch_diameter=0.1467,
            gear_spiral_angle=0.3,
        )


def test_the_limit_curvature_of_a_bevel_pair_is_refused():
    cones = PitchCones.touching(**TOUCHING | {"offset": 0.0}, gear_spiral_angle=0.4)
    with pytest.raises(ParameterError, match="Give an offset above 0"):
        _ = cones.limit_curvature
