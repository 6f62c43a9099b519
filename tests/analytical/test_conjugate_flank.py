"""The conjugate pinion flank of a gear, and the gap to it, against other routes."""

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.ease_off import ease_off
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.conjugate_flank import PinionGap, conjugate_flank
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.hypoid_design.flank_target import MeanContact, measured_contact
from gearlube_core.hypoid_design.start_settings import image_pair, start_pair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each

SIDES = ("drive", "coast")
SAMPLE = BlankFile.named("hypoid_13_42")
SHIPPED = HypoidGearFile.named("mohammadpour_2015")
BEVEL = {
    "pair.offset_mm": 0.0,
    "pair.pinion_spiral_angle_deg": None,
    "pair.gear_spiral_angle_deg": 35.0,
    "cutter.radius_mm": 76.0,
}


def image(changes):
    return image_pair(DesignedBlank.from_file(SAMPLE.varied(changes)))


def places():
    s, t = np.meshgrid(np.linspace(0.2, 0.95, 5), np.linspace(0.05, 0.95, 7), indexing="ij")
    return s.ravel(), t.ravel()


def gap(file, side):
    pair = FlankPair.from_file(file, side)
    flank = conjugate_flank(pair, *places())
    return flank, PinionGap.from_pair(pair, flank).of(pair)


@each("side", SIDES)
@each(
    ("changes", "micrometres"),
    [
        # face milling: the cutters of both members are one surface, so only rounding is left
        ({}, 1e-4),
        # the bevel gear's cutter meets the mean point at 55 deg, a node of the search for it
        (BEVEL, 1e-4),
        # face hobbing: the blades of both flanks stand at different offset angles
        ({"cutter.blade_groups": 5}, 0.5),
    ],
)
def test_the_image_of_a_form_cut_gear_is_conjugate_to_it(changes, micrometres, side):
    flank, found = gap(image(changes), side)
    closed = found - found.mean() / flank.arm.mean() * flank.arm
    assert 1e6 * np.abs(closed).max() < micrometres


@pytest.mark.parametrize("side", SIDES)
def test_bevel_gears_generated_by_one_crown_gear_are_conjugate(side):
    """Each is conjugate to the crown gear, in the same line at the same time."""
    blank = SAMPLE.varied(BEVEL | {"machine.gear": "generated"})
    flank, found = gap(start_pair(DesignedBlank.from_file(blank)), side)
    closed = found - found.mean() / flank.arm.mean() * flank.arm
    assert 1e6 * np.abs(closed).max() < 1e-4


@pytest.mark.parametrize("side", SIDES)
def test_the_gap_to_the_conjugate_flank_is_the_ease_off_found_by_rotation(side):
    """The other route turns the pinion to each gear point at every gear angle."""
    pair = FlankPair.from_file(SHIPPED, side)
    other = ease_off(pair, s_count=9, t_count=13)
    i, j = np.meshgrid(np.arange(2, 9), np.arange(1, 12), indexing="ij")
    s, t = other.s[i].ravel(), other.t[j].ravel()
    flank = conjugate_flank(pair, s, t)
    found = PinionGap.from_pair(pair, flank).of(pair)
    by_turning = other.normal_gap()[i, j].ravel()
    seen = np.isfinite(by_turning)
    assert seen.mean() > 0.8
    # both gaps measured from one pinion angle; the map by rotation takes the arm of the pinion
    first = int(np.argmin(np.where(seen, by_turning, np.inf)))
    shifted = found - found[first] / flank.arm[first] * flank.arm
    difference = (shifted - by_turning)[seen]
    # that arm and the cubic between angles: 1 % of the range
    assert np.abs(difference).max() < 0.012 * np.ptp(by_turning[seen])


@pytest.mark.parametrize("side", SIDES)
def test_a_conjugate_place_is_in_contact_when_the_contact_analysis_says_so(side):
    """On the path of contact of a pair with little error both give one gear angle."""
    from gearlube_core.hypoid_contact.contact_path import contact_path

    pair = FlankPair.from_file(SHIPPED, side)
    angles = np.array([-0.3, 0.0, 0.3]) * pair.gear_pitch
    path = contact_path(pair, angles)
    flank = conjugate_flank(pair, path.gear_s, path.gear_t)
    # at a place off the extreme the error's slope, 2 urad/mrad, leans the pinion's normal: the
    # contact is off the conjugate by the slope of the gap over that of the gear angle
    assert flank.gear_angle == pytest.approx(angles, abs=0.01 * pair.gear_pitch)


@pytest.mark.parametrize("side", SIDES)
def test_path_direction_and_turn_from_across_the_lines_belong_together(side):
    pair = FlankPair.from_file(SHIPPED, side)
    mean = MeanContact.at(pair, 0.57, 0.5)
    for angle in (0.3, 1.0, 1.5, 2.0):
        if abs(angle - mean.line_angle) < 0.5:
            continue
        assert mean.path_angle(mean.turn(angle)) == pytest.approx(angle, rel=1e-9)
    with pytest.raises(ParameterError, match="away from the lines of contact"):
        mean.turn(mean.line_angle + 0.1)


def test_error_ellipse_and_path_of_the_shipped_pair_follow_from_its_gap():
    """Second derivatives of the gap at the extreme against the landed contact analysis."""
    side = "drive"
    found = measured_contact(SHIPPED, side)
    pair = FlankPair.from_file(SHIPPED, side)
    mean = MeanContact.at(pair, found.s, found.t)
    h = 0.02
    near = np.array([(i * h, j * h) for i in range(-2, 3) for j in range(-2, 3)])
    flank = conjugate_flank(pair, found.s + near[:, 0], found.t + near[:, 1])
    gaps = PinionGap.from_pair(pair, flank).of(pair)
    middle = len(near) // 2
    gaps = gaps - gaps[middle] / flank.arm[middle] * flank.arm
    x = (flank.gear_angle - mean.gear_angle) / mean.slope
    y = (flank.r - mean.r) @ mean.e2
    # full cubic, so that the quadratic terms are those at the point
    powers = [(i, k - i) for k in range(4) for i in range(k + 1)]
    terms = np.stack([x**a * y**b for a, b in powers], axis=1)
    scale = np.abs(terms).max(axis=0)
    factors = np.linalg.lstsq(terms / scale, gaps, rcond=None)[0] / scale
    fitted = dict(zip(powers, factors, strict=True))
    h11, h12, h22 = 2.0 * fitted[2, 0], fitted[1, 1], 2.0 * fitted[0, 2]
    length = 2.0 * math.sqrt(2.0 * 6.35e-6 / h22)
    assert length == pytest.approx(found.length, rel=0.02)
    path = mean.path_angle(-h12 / h22)
    assert math.degrees(path) == pytest.approx(math.degrees(found.path_angle), abs=1.0)
    bend = (h11 - h12**2 / h22) / (mean.arm * mean.slope**2)
    parabola = 0.5 * bend * (math.pi / 36) ** 2
    # peak to peak has the third order as well: 4 % here
    assert parabola == pytest.approx(found.error, rel=0.06)
