"""The printed table of the hypoid pair against itself: one blank gives the other's numbers.

Mohammadpour et al. 2015, Table A1; Karagiannis et al. 2012, Table 1. Expected numbers are taken
from the printed tables, in mm and degrees; only the gear's blank enters the mean point.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each

BLANK = HypoidGearFile.named("mohammadpour_2015").blank()
PINION_CONE = math.radians(29.056)
PINION_SPIRAL, GEAR_SPIRAL = math.radians(45.989), math.radians(27.601)
OFFSET = 24.0
PINION_AXIS = np.array([1.0, 0.0, 0.0])  # from the apex into the pinion


def radius_from_pinion_axis(point):
    """Distance [mm] and unit vector from the pinion axis to `point` [mm]."""
    arm = np.array([0.0, point[1] - OFFSET, point[2]])
    return np.linalg.norm(arm), arm / np.linalg.norm(arm)


def pinion_generator(point):
    return (
        math.cos(PINION_CONE) * PINION_AXIS
        + math.sin(PINION_CONE) * (radius_from_pinion_axis(point)[1])
    )


def arm(axis, point, normal):
    return abs(normal @ np.cross(axis, point))


def test_gear_mean_point_lies_at_the_pinions_printed_mid_face_radius():
    printed = (83.084 - 0.5 * 33.851) * math.sin(PINION_CONE)
    found, _ = radius_from_pinion_axis(1e3 * BLANK.mean_point())
    # the table's last digits: 1 um of cone distances, 1e-3 deg of angles at 66 mm (1.2 um each)
    assert found == pytest.approx(printed, abs=0.01)


def test_gear_mean_point_lies_on_the_pinion_cone_of_the_printed_apex():
    point = 1e3 * BLANK.mean_point()
    radius, _ = radius_from_pinion_axis(point)
    # printed -9.085 beyond the crossing point, so at x = +9.085 in the frame of the package
    assert point[0] - radius / math.tan(PINION_CONE) == pytest.approx(9.085, abs=0.01)
    assert 1e3 * BLANK.pinion_apex[0] == pytest.approx(9.085, rel=1e-12)


def test_pitch_cones_share_their_normal_at_the_mean_point():
    _, outward = radius_from_pinion_axis(1e3 * BLANK.mean_point())
    normal = math.cos(PINION_CONE) * outward - math.sin(PINION_CONE) * PINION_AXIS
    angle = math.degrees(math.acos(min(1.0, abs(normal @ BLANK.pitch_normal()))))
    # the printed pitch angles and apexes hold the normal to a few 1e-2 deg
    assert angle < 0.05


def test_pitch_plane_of_the_gear_passes_the_pinion_apex():
    normal = BLANK.pitch_normal()
    distance = 1e3 * abs(normal @ (BLANK.pinion_apex - BLANK.mean_point()))
    # 0.05 deg of the common normal over the pinion's cone distance of 66.16 mm
    assert distance < math.radians(0.05) * 66.16


@each(
    ("length", "printed"),
    [
        (BLANK.gear.addendum, (10.948 - 8.987) * math.sin(math.radians(59.653))),
        (BLANK.pinion.addendum, (1.368 + 9.085) * math.sin(PINION_CONE)),
        (BLANK.gear.addendum, 1.692),
        (BLANK.pinion.addendum, 5.077),
        (BLANK.working_depth, 6.769),
    ],
)
def test_apex_distances_give_the_addenda(length, printed):
    # half a unit of the last of three decimals
    assert 1e3 * length == pytest.approx(printed, abs=5e-4)


def test_cutter_reference_plane_lies_at_mid_working_depth():
    """The root apex 7.026 mm before the crossing point is a gear addendum inside the pitch cone."""
    half = (8.987 - 7.026) * math.sin(math.radians(59.653))
    # half a unit of the last of three decimals, in both apex distances
    assert half == pytest.approx(1e3 * BLANK.gear.addendum, abs=1e-3)


PRESSURE_ANGLE = math.radians(0.5 * (15.815 + 22.436))  # mean of the gear's blade angles


def drive_flank_normal(blank):
    """Normal of the drive flanks at the mean point: mean blade angle, printed spiral angle."""
    generator, pitch = blank.gear_generator(), blank.pitch_normal()
    psi = blank.gear.spiral_angle
    trace = math.cos(psi) * generator - math.sin(psi) * np.cross(pitch, generator)
    across = np.cross(pitch, trace)
    across *= np.sign(across @ np.cross(blank.gear_axis, blank.mean_point()))
    return math.cos(PRESSURE_ANGLE) * across - math.sin(PRESSURE_ANGLE) * pitch


def test_pinion_pressure_arm_is_twenty_one_millimetres():
    point = BLANK.mean_point() - BLANK.pinion_apex
    # mean pitch radius 32.13 mm x cos(45.76..45.99 deg) x cos(19.13 deg) = 21.09 to 21.18 mm
    assert 21.05e-3 < arm(BLANK.pinion_axis, point, drive_flank_normal(BLANK)) < 21.2e-3


def test_printed_spiral_angles_give_the_teeth_ratio_of_the_arms():
    """R_g / R_p = r_g cos psi_g / (r_p cos psi_p) whatever the pressure angle."""
    point = 1e3 * BLANK.mean_point()
    r_p, _ = radius_from_pinion_axis(point)
    r_g = np.hypot(point[0], point[1])
    ratio = r_g * math.cos(GEAR_SPIRAL) / (r_p * math.cos(PINION_SPIRAL))
    # spiral angles are printed for the calculation point, 0.97 mm toe-ward of mid-face
    assert ratio == pytest.approx(36 / 13, rel=4e-3)


def test_arms_of_one_common_normal_differ_by_the_angle_of_the_generators():
    point, normal = BLANK.mean_point(), drive_flank_normal(BLANK)
    ratio = arm(BLANK.gear_axis, point, normal) / arm(
        BLANK.pinion_axis, point - BLANK.pinion_apex, normal
    )
    # 0.31 % as above, and 0.23 deg of pinion spiral angle: tan(46 deg) 0.23 pi/180 = 0.42 %
    assert ratio == pytest.approx(36 / 13, rel=7.5e-3)


def test_angle_between_the_generators_is_the_difference_of_the_spiral_angles():
    angle = math.acos(pinion_generator(1e3 * BLANK.mean_point()) @ BLANK.gear_generator())
    # 0.97 mm from the calculation point turns the generators by 0.24 deg
    assert math.degrees(angle) == pytest.approx(45.989 - 27.601, abs=0.25)


def test_at_the_calculation_point_spiral_angles_and_ratio_close():
    """At a gear cone distance of 79.63 mm all of the above hold a hundred times better."""
    shifted = replace(BLANK.gear, outer_cone_distance=79.63e-3 + 0.5 * BLANK.gear.face_width)
    blank = replace(BLANK, gear=shifted)
    point, normal = blank.mean_point(), drive_flank_normal(blank)
    line = point - blank.pinion_apex
    angle = math.acos(line @ blank.gear_generator() / np.linalg.norm(line))
    # 0.03 deg is the misfit of the two printed cones there
    assert math.degrees(angle) == pytest.approx(45.989 - 27.601, abs=0.03)
    ratio = arm(blank.gear_axis, point, normal) / arm(blank.pinion_axis, line, normal)
    # tan(46 deg) x 0.03 deg = 0.05 %
    assert ratio == pytest.approx(36 / 13, rel=5e-4)


def test_teeth_ratio_is_the_final_drive_ratio():
    assert pytest.approx(36 / 13, rel=1e-15) == BLANK.ratio


def test_pinion_machine_is_the_image_of_the_gear():
    """The cradle stands in for the gear: its axis, its offset and its speed are nearly the gear's.

    Karagiannis et al. 2012, Table 1: ratio of roll 2.762, blank offset 23.908 mm, machine root
    angle 0.202 deg, tilt 31.736 deg. What is left is the lengthwise and profile crowning.
    """
    # crowning took 0.26 % of the roll and 0.4 % of the offset
    assert pytest.approx(2.762, rel=3e-3) == BLANK.ratio
    assert 1e3 * BLANK.offset == pytest.approx(23.908, rel=4e-3)
    # the cradle axis at right angles to the pinion's, as the gear axis is
    assert math.sin(math.radians(0.202)) < 4e-3
    # the tilted cutter's plane along the gear's pitch cone, within 1.4 deg of crowning
    assert math.degrees(0.5 * math.pi - BLANK.gear.pitch_angle) == pytest.approx(31.736, abs=1.4)
