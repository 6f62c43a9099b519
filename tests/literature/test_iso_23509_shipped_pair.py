"""The shipped pair as a design by method 1 of ISO 23509:2016.

Karagiannis et al. 2012, Table 1 prints blank and cutter, not the design data. Method 1 with round
design data reproduces the blank; the number of blade groups, which the table omits, follows.
Numbers in mm and degrees.
"""

import math
from dataclasses import replace

import pytest

from gearlube_core.hypoid_geometry.blank.iso_23509 import HypoidDesign, curvature_misfit, method_1
from gearlube_core.hypoid_geometry.blank.pitch_cones import CutterHead, PitchCones
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each

BLANK = HypoidGearFile.named("mohammadpour_2015").blank()
RAD = math.radians
CALCULATION_POINT = 79.63  # cone distance at which the printed spiral angles belong together
PRINTED_POINT_RADIUS = 64.185
NOMINAL_RADIUS = 64.0


def design(groups, radius=NOMINAL_RADIUS):
    return HypoidDesign(
        pinion_teeth=13,
        gear_teeth=36,
        offset=0.024,
        shaft_angle=0.5 * math.pi,
        gear_face_width=0.030,
        cutter=CutterHead(radius=radius * 1e-3, blade_groups=groups),
    )


def designed(groups):
    return method_1(design(groups), outer_pitch_diameter=0.165, pinion_spiral_angle=RAD(46.0))


def from_printed_gear_cone():
    return PitchCones.touching(
        pinion_teeth=13,
        gear_teeth=36,
        offset=0.024,
        shaft_angle=0.5 * math.pi,
        gear_pitch_angle=RAD(59.653),
        gear_pitch_radius=CALCULATION_POINT * 1e-3 * math.sin(RAD(59.653)),
        gear_spiral_angle=RAD(27.601),
    )


def test_outer_pitch_diameter_of_the_gear_is_165_millimetres():
    diameter = 2.0 * BLANK.gear.outer_cone_distance * math.sin(BLANK.gear.pitch_angle)
    # half a unit of the last digits: 0.0009 mm of cone distance, 0.0008 mm of angle
    assert 1e3 * diameter == pytest.approx(165.0, abs=2e-3)


def test_the_printed_gear_cone_and_spiral_angle_fix_the_printed_pinion():
    """Touching cones at the calculation point: nothing of the pinion goes in but its teeth."""
    cones = from_printed_gear_cone()
    # The two printed cones leave 0.03 deg of their normals open (see the blank identities); the
    # calculation point is known to 0.03 mm, over which beta_m1 turns by 0.2 deg/mm.
    assert math.degrees(cones.pinion_spiral_angle) == pytest.approx(45.989, abs=0.006)
    assert math.degrees(cones.pinion_pitch_angle) == pytest.approx(29.056, abs=0.003)
    # the same 0.006 deg over 80 mm
    assert 1e3 * cones.pinion_apex == pytest.approx(-9.085, abs=0.01)
    assert 1e3 * cones.gear_apex == pytest.approx(8.987, abs=0.01)


def test_working_depth_is_two_normal_modules_a_quarter_of_it_gear_addendum():
    """k_d = 2 and c_ham = 0.25 of ISO 23509:2016, annex C."""
    depth = BLANK.working_depth
    # 0.5 um of two apex distances in 1.7 mm
    assert BLANK.gear.addendum / depth == pytest.approx(0.25, abs=2e-4)
    # 0.03 mm of the calculation point is 4e-4 of the module
    assert depth / from_printed_gear_cone().normal_module == pytest.approx(2.0, rel=6e-4)


def test_method_1_with_round_design_data_gives_the_printed_blank():
    """d_e2 165 mm, b_2 30 mm, beta_Delta1 46 deg, cutter 64 mm with 11 blade groups."""
    cones = designed(11)
    # The printed spiral angles stand 0.011 deg below 46 deg, so the print is converged no further.
    # The standard stops at 1 % of curvature, 0.17 deg of the cones and 0.4 mm of the apexes; the
    # tolerances are a twentieth of that and a thirtieth of what one blade group makes.
    assert math.degrees(cones.pinion_pitch_angle) == pytest.approx(29.056, abs=0.009)
    assert math.degrees(cones.gear_pitch_angle) == pytest.approx(59.653, abs=0.009)
    assert math.degrees(cones.pinion_spiral_angle) == pytest.approx(45.989, abs=0.012)
    assert math.degrees(cones.gear_spiral_angle) == pytest.approx(27.601, abs=0.012)
    assert 1e3 * cones.pinion_apex == pytest.approx(-9.085, abs=0.02)
    assert 1e3 * cones.gear_apex == pytest.approx(8.987, abs=0.02)


def test_method_1_puts_the_calculation_point_where_the_spiral_angles_belong():
    """Its first estimate of the gear's pitch angle sets the mean point toe-ward of mid-face."""
    cone_distance = 1e3 * designed(11).gear_mean_cone_distance
    # 79.63 is where both printed spiral angles fit best, good to 0.03 mm
    assert cone_distance == pytest.approx(CALCULATION_POINT, abs=0.03)
    assert 1e3 * BLANK.gear.mean_cone_distance - cone_distance == pytest.approx(0.95, abs=0.03)


@each("groups", [9, 10, 12, 13])
def test_no_other_number_of_blade_groups_gives_the_printed_apexes(groups):
    cones = designed(groups)
    # fifty times the print's last digit and ten times what is left with 11
    assert abs(1e3 * cones.pinion_apex + 9.085) > 0.5
    assert abs(1e3 * cones.gear_apex - 8.987) > 0.4


@each("radius", [NOMINAL_RADIUS, PRINTED_POINT_RADIUS])
@each("groups", [9, 10, 11, 12, 13])
def test_only_eleven_blade_groups_close_the_limit_curvature_of_the_printed_cones(groups, radius):
    """The standard's stop is 1 %; neighbours of 11 miss by 1.4 to 1.9 %."""
    cones = PitchCones(
        pinion_teeth=13,
        gear_teeth=36,
        offset=0.024,
        shaft_angle=0.5 * math.pi,
        pinion_pitch_angle=BLANK.pinion.pitch_angle,
        gear_pitch_angle=BLANK.gear.pitch_angle,
        # the pinion's mean point from the gear's, at the printed pinion cone
        pinion_mean_cone_distance=1e-3 * 65.18,
        gear_mean_cone_distance=1e-3 * CALCULATION_POINT,
        pinion_spiral_angle=BLANK.pinion.spiral_angle,
        gear_spiral_angle=BLANK.gear.spiral_angle,
    )
    misfit = abs(curvature_misfit(design(groups, radius), cones))
    assert (misfit < 0.01) == (groups == 11)
    if groups == 11:
        # 0.02 % with the nominal radius, 0.22 % with the printed point radius
        assert misfit < 0.003


@each(("groups", "spiral"), [(10, 26.50), (11, 27.87), (12, 29.21)])
def test_lead_angle_at_the_gear_machine_gives_the_spiral_angle(groups, spiral):
    """Settings 66.650, 62.642 and 7.026 mm: the triangle of machine centre, cutter and point.

    The machine centre stands (8.987 - 7.026) cos(59.653 deg) = 0.991 mm up the cone from the apex.
    Only 11 groups come within a degree of the printed 27.601 deg; the 0.27 deg left are between
    the reference plane of the cutter at mid depth and the pitch cone.
    """
    cone = CALCULATION_POINT - (8.987 - 7.026) * math.cos(RAD(59.653))
    distance = math.hypot(66.650, 62.642)
    sine = (cone**2 + PRINTED_POINT_RADIUS**2 - distance**2) / (2.0 * cone * PRINTED_POINT_RADIUS)
    cutter = CutterHead(radius=PRINTED_POINT_RADIUS * 1e-3, blade_groups=groups)
    module = from_printed_gear_cone().normal_module
    for _ in range(20):
        beta = math.asin(sine) + cutter.lead_angle(module)
        module = 2e-3 * CALCULATION_POINT * math.sin(RAD(59.653)) * math.cos(beta) / 36
    # two digits are given
    assert math.degrees(beta) == pytest.approx(spiral, abs=0.006)
    assert (abs(math.degrees(beta) - 27.601) < 0.3) == (groups == 11)


def test_completed_clearance_is_an_eighth_of_the_working_depth():
    # 6.769 / 8, completed: no table prints it
    assert 1e3 * BLANK.root_clearance == pytest.approx(0.846, abs=5e-4)
    assert 1e3 * replace(BLANK, clearance=0.9e-3).whole_depth == pytest.approx(7.669, abs=1e-3)
