"""The axial section of a blank, and what the pitch cone methods refuse."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.hypoid_geometry.blank.iso_23509 import HypoidDesign, method_2
from gearlube_core.hypoid_geometry.blank.pitch_cones import CutterHead, PitchCones, ToothTrace
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.member_profile import MemberProfile

BLANK = HypoidGearFile.named("mohammadpour_2015").blank()
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
