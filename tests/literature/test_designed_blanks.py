"""Blanks from their blank files against the samples of ISO 23509:2016, annex F, and a real pair.

Printed values in mm and degrees; see test_iso_23509_samples.py for their source.
"""

import math

import pytest

from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.blank_limits import check_blank
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.member_profile import MemberProfile


def designed(cutter, depth=None, **pair):
    radius, groups = cutter
    data = {
        "name": "sample",
        "pair": pair,
        "cutter": {"radius_mm": radius, "blade_groups": groups},
        "depth": depth or {},
    }
    return DesignedBlank.from_file(BlankFile.from_data(data, "sample"))


def sample_f3():
    return DesignedBlank.from_file(BlankFile.named("hypoid_13_42"))


def sample_f4():
    return designed(
        (76.0, 13),
        {"gear_addendum_factor": 0.275},
        pinion_teeth=9,
        gear_teeth=34,
        offset_mm=31.75,
        face_width_mm=26.0,
        mean_pitch_diameter_mm=146.7,
        gear_spiral_angle_deg=21.009,
    )


def sample_f5():
    return designed(
        (135.0, 5),
        {"gear_addendum_factor": 0.4},
        pinion_teeth=12,
        gear_teeth=49,
        offset_mm=40.0,
        face_width_mm=60.0,
        outer_pitch_diameter_mm=400.0,
        gear_spiral_angle_deg=30.0,
    )


def test_the_sample_with_offset_15_has_its_printed_cones():
    """F.3 and sample 2 of ISO/TR 10300-30: the printed spiral angle ends 0.002 deg short of 50."""
    cones = sample_f3().cones
    found = (
        math.degrees(cones.pinion_pitch_angle),
        math.degrees(cones.gear_pitch_angle),
        math.degrees(cones.gear_spiral_angle),
        math.degrees(cones.limit_pressure_angle),
    )
    assert found == pytest.approx((21.288, 68.323, 38.609, -2.253), abs=0.0025)
    assert 2e3 * cones.pinion_pitch_radius == pytest.approx(53.383, abs=0.003)


def test_the_face_of_its_pinion_ends_where_the_sample_says():
    """Cone distance on the gear below the pinion's heel, printed 92.163 mm."""
    one = sample_f3()
    mean, offset = one.cones.gear_mean_cone_distance, one.cones.offset_angle
    out = one.pinion_face.outer
    reached = math.sqrt(mean**2 + out**2 + 2.0 * mean * out * math.cos(offset))
    # the offset angle in the root plane, here taken as the axial one, and the sample's taper:
    # a degree of it is 0.07 mm
    assert 1e3 * reached == pytest.approx(92.163, abs=0.03)
    assert 1e3 * one.blank.gear.outer_cone_distance == pytest.approx(91.468, abs=0.003)


@pytest.mark.parametrize(
    ("make", "faces", "heights", "cone"),
    [
        # R_e1, b_1, R_e2, b_2; h_am1, h_am2, c; what the standard's stop leaves in cone distances
        (sample_f4, (76.755, 31.139, 95.168, 26.0), (5.840, 2.215, 1.007), 0.19),
        (sample_f5, (191.947, 66.0, 211.072, 60.0), (7.278, 4.852, 1.516), 0.0165),
    ],
)
def test_faces_and_heights_are_the_printed_ones(make, faces, heights, cone):
    blank = make().blank
    members = (blank.pinion, blank.gear)
    distances = [1e3 * m.outer_cone_distance for m in members]
    assert distances == pytest.approx([faces[0], faces[2]], abs=cone)
    # half a unit of the last digit and 0.0003 deg of the offset angle
    widths = [1e3 * m.face_width for m in members]
    assert widths == pytest.approx([faces[1], faces[3]], abs=2e-3)
    found = [1e3 * blank.pinion.addendum, 1e3 * blank.gear.addendum, 1e3 * blank.root_clearance]
    assert found == pytest.approx(heights, abs=1.01e-3)


def test_crown_of_the_large_sample_has_its_printed_diameters():
    blank = sample_f5().blank
    pinion, gear = MemberProfile.of_pinion(blank), MemberProfile.of_gear(blank)
    found = [2e3 * point[1] for point in (pinion.outer_tip, pinion.inner_tip, gear.outer_tip)]
    # the stop of method 3, 1e-4 R_m1 = 0.016 mm, twice in a diameter
    assert found == pytest.approx((133.730, 92.502, 403.102), abs=0.035)


def test_the_pair_of_the_papers_comes_from_round_numbers():
    """Karagiannis et al. 2012, Table 1; its blank is method 1, 165 mm, 46 deg, cutter 64 mm."""
    blank = designed(
        (64.0, 11),
        pinion_teeth=13,
        gear_teeth=36,
        offset_mm=24.0,
        face_width_mm=30.0,
        outer_pitch_diameter_mm=165.0,
        pinion_spiral_angle_deg=46.0,
    ).blank
    printed = HypoidGearFile.named("mohammadpour_2015").blank()
    for role in ("pinion", "gear"):
        one, other = getattr(blank, role), getattr(printed, role)
        # the print is converged to 0.011 deg, see test_iso_23509_shipped_pair.py
        assert one.outer_cone_distance == pytest.approx(other.outer_cone_distance, abs=8e-6)
        assert one.pitch_apex == pytest.approx(other.pitch_apex, abs=2e-5)
        # pinion: the axial offset angle in place of that in the root plane
        assert one.face_width == pytest.approx(other.face_width, abs=3.5e-5)
        # the chosen c_ham is 0.248, the pair has 0.25 of 6.77 mm
        assert one.addendum == pytest.approx(other.addendum, abs=1.8e-5)


def test_bevel_gears_without_offset_have_the_cones_of_their_teeth():
    """Teeth, size and cutter of the bevel sample F.2; tan(delta_2) = z_2/z_1 in closed form."""
    one = designed(
        (114.3, 0),
        pinion_teeth=14,
        gear_teeth=39,
        offset_mm=0.0,
        face_width_mm=25.4,
        outer_pitch_diameter_mm=176.893,
        gear_spiral_angle_deg=35.0,
    )
    outer = 0.5 * 176.893 * math.hypot(14, 39) / 39
    module = 176.893 / 39 * (outer - 12.7) / outer * math.cos(math.radians(35.0))
    assert 1e3 * one.normal_module == pytest.approx(module, rel=1e-12)
    for member, teeth, mate in ((one.blank.pinion, 14, 39), (one.blank.gear, 39, 14)):
        assert math.tan(member.pitch_angle) == pytest.approx(teeth / mate, rel=1e-12)
        assert 1e3 * member.outer_cone_distance == pytest.approx(outer, rel=1e-12)
        assert member.pitch_apex == pytest.approx(0.0, abs=1e-12)
        assert member.spiral_angle == pytest.approx(math.radians(35.0), rel=1e-12)
    assert one.cones.limit_pressure_angle == pytest.approx(0.0, abs=1e-12)
    assert check_blank(one) == []


def test_pinion_and_gear_thickness_fill_the_normal_pitch():
    one = sample_f3()
    total = one.pinion_thickness + one.gear_thickness
    assert total == pytest.approx(math.pi * one.normal_module, rel=1e-12)
