"""Jamali 2015, sec. 4.1, 4.2 and 7.3: what the thesis prints of its two gear pairs."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from gearlube_core.helical_geometry.contact_line import clip_line, line_kinematics, segment_length
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.load_sharing import (
    relief_on_path,
)
from gearlube_core.helical_geometry.meshing_steps import line_at_position
from tests.helpers.each import each

FILES = {design: HelicalGearFile.named(f"jamali_2015_{design}") for design in "ab"}
PAIRS = {design: file.helical_pair() for design, file in FILES.items()}
SPEED, TORQUE = 235.62, 1060.0  # rad/s, N.m


def limits(pair):
    return pair.contact_start - pair.pitch_point, pair.contact_end - pair.pitch_point


@pytest.mark.parametrize(("design", "first", "last"), [("a", -10.8, 10.8), ("b", -11.8, 10.8)])
def test_path_of_contact_runs_between_the_printed_limits(design, first, last):
    """Printed in tenths of a millimetre."""
    low, high = limits(PAIRS[design])
    assert (1e3 * low, 1e3 * high) == pytest.approx((first, last), abs=0.05)


def test_path_of_design_b_is_4_4_percent_longer():
    """Printed in tenths of a percent."""
    path = {d: np.subtract(*limits(pair)[::-1]) for d, pair in PAIRS.items()}
    assert path["b"] / path["a"] == pytest.approx(1.044, abs=1e-3)


@each("relation", ["below", "equal", "above"])
def test_line_length_follows_the_three_cases_of_section_2_2_1(relation):
    """F tan(b) below, at and above the path AB; the printed branches, one routine."""
    pair = PAIRS["a"]
    low, high = limits(pair)
    path, b = high - low, pair.base_helix_angle
    width = {"below": 0.7, "equal": 1.0, "above": 1.6}[relation] * path / math.tan(b)
    pair = FILES["a"].varied({"pair.face_width_mm": 1e3 * width}).helical_pair()
    reach = width * math.tan(b)

    def printed(s):
        rising = width / math.cos(b) - (low - s) / math.sin(b)
        falling = (high - s) / math.sin(b)
        if relation == "below":
            if s <= low:
                return rising
            return width / math.cos(b) if s <= high - reach else falling
        if relation == "equal":
            return rising if s <= low else falling
        if s <= high - reach:
            return rising
        return path / math.sin(b) if s <= low else falling

    plane = pair.plane
    for s in np.linspace(low - reach, high, 501)[1:-1]:
        got = segment_length(clip_line(float(line_at_position(s, pair)), plane), plane)
        assert got == pytest.approx(printed(s), rel=1e-9, abs=1e-11)


@each(
    ("design", "member", "exact"),
    [("a", "pinion", 4.456), ("a", "gear", 4.477), ("b", "pinion", 4.456), ("b", "gear", 5.084)],
)
def test_relief_takes_its_exact_length_off_the_path(design, member, exact):
    """(2.14), (2.15) against the integral of r dr/sqrt(r^2 - r_b^2).

    Fig. 4.6 prints z_p = 4.3 and z_w = 4.4 mm "for the gears of Table 4.1". Not reproduced:
    4.46 and 4.48 for design A, 0.16 and 0.08 mm off, and 5.08 for the wheel of design B. No
    radius, angle or depth of the table gives the printed pair.
    """
    pair = PAIRS[design]
    tip = getattr(pair, f"{member}_tip_radius")
    base = getattr(pair, f"{member}_base_radius")
    got = relief_on_path(tip, base, 2e-3)
    integral, _ = quad(lambda r: r / math.sqrt(r * r - base * base), tip - 2e-3, tip)
    assert got == pytest.approx(integral, rel=1e-9)
    assert 1e3 * got == pytest.approx(exact, abs=1e-3)
    printed = {"pinion": 4.3, "gear": 4.4}[member]
    assert (abs(1e3 * got - printed) < 0.2) == ((design, member) != ("b", "gear"))


def test_table_7_1_follows_from_the_reference_pressure_angle_at_5_25_mm():
    """Slide-roll 0.3632, R 14.0 mm transverse, 6.71 m/s: digits as printed.

    The text says s = 5.75 mm, where the ratio would be 0.398; and the working angle shifts it too.
    """
    pair = PAIRS["a"]
    tan_t = math.tan(pair.transverse_pressure_angle)
    r_1, r_2 = pair.pinion_base_radius, pair.gear_base_radius
    plane = pair.plane._replace(x_g=(r_1 + r_2) * tan_t, P=r_1 * tan_t)
    got = line_kinematics(plane.P + 5.25e-3, SPEED, plane)
    assert got.slide_roll == pytest.approx(0.3632, abs=5e-5)
    assert 1e3 * got.R * plane.cos_b == pytest.approx(14.0, abs=0.05)
    assert got.entrainment == pytest.approx(6.71, abs=5e-3)
    assert line_kinematics(plane.P + 5.75e-3, SPEED, plane).slide_roll > 0.39
