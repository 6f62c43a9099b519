"""He, Gunda and Singh 2007: the plane of contact of their example, fig. 3 and eq. (23), (24)."""

import math

import numpy as np
import pytest

from gearlube_core.helical_geometry.contact_line import (
    clip_line,
    line_count,
    line_kinematics,
    line_position,
    pitch_crossing,
    segment_length,
)
from gearlube_core.helical_geometry.load_sharing import positions_at, shared_load
from gearlube_core.helical_geometry.modification import ModifiedPair
from tests.helpers.each import each
from tests.helpers.named_pairs import named_pair

PAIR = named_pair("he_2007")
PLANE = PAIR.plane
INCH = 0.0254


def drawn_landmarks():
    """Fig. 3 drawn from sec. 3's inches: circles and a tangent, no formula of the package."""
    turn = math.radians(25.0)  # transverse pressure angle; the centres stand at its pitch circles
    r_p, centre = 0.5 * 3.125 * INCH, 3.5 * INCH
    pitch_point = np.array([0.0, r_p])  # pinion centre at the origin, gear centre above
    along = np.array([math.cos(turn), math.sin(turn)])  # the line of action
    foot = pitch_point @ along  # from the foot of the perpendicular to the pitch point

    def cuts(middle, radius):
        """Distances from the pitch point to where the line of action cuts a circle."""
        offset = pitch_point - np.asarray(middle)
        half, rest = offset @ along, offset @ offset - radius**2
        return sorted(np.roots([1.0, 2.0 * half, rest]).real)

    a = foot + cuts((0.0, centre), 0.5 * 4.13 * INCH)[0]
    d = foot + cuts((0.0, 0.0), 0.5 * 3.38 * INCH)[1]
    # Lead of the pinion; the base cylinder's helix has the same.
    base = r_p * math.cos(turn)
    lead = 2.0 * math.pi * r_p / math.tan(math.radians(21.5))
    skew = 1.25 * INCH * 2.0 * math.pi * base / lead
    pitch = 2.0 * math.pi * base / 25
    return {
        "A": a, "P": foot, "C": a + pitch, "Q": a + skew, "D": d, "E": a + 2.0 * pitch,
        "H": foot + skew, "G": d + skew, "R": a + 3.0 * pitch,
    }  # fmt: skip


MARKS = drawn_landmarks()
SKEW = MARKS["Q"] - MARKS["A"]


def test_landmarks_of_fig_3_follow_from_the_drawn_circles():
    """To rounding: the centre distance is the sum of the pitch radii, so both angles are one."""
    tan_b = PLANE.sin_b / PLANE.cos_b
    skew = PLANE.W * tan_b
    got = {
        "A": PLANE.A, "P": PLANE.P, "C": PLANE.A + PLANE.pitch, "Q": PLANE.A + skew,
        "D": PLANE.D, "E": PLANE.A + 2.0 * PLANE.pitch, "H": PLANE.P + skew,
        "G": PLANE.D + skew, "R": PLANE.A + 3.0 * PLANE.pitch,
    }  # fmt: skip
    assert got == pytest.approx(MARKS, rel=1e-9)
    order = ["A", "P", "C", "Q", "D", "E", "H", "G", "R"]
    assert sorted(MARKS, key=MARKS.get) == order


def test_zone_6_is_only_57_micrometres_long():
    """What makes the order of fig. 3 special to this pair; printed nowhere, so to 1 um."""
    assert MARKS["H"] - MARKS["E"] == pytest.approx(57.4e-6, abs=1e-6)


def zone_limits(number, x):
    """x_m, x_f, z_m, z_f, z_p of eq. (24), z_p None where no pitch point lies on the line.

    (24f) prints x_1 for x_2 in z_p; corrected here.
    """
    m, half, tan_b = MARKS, 0.5 * 1.25 * INCH, SKEW / (1.25 * INCH)
    if number == 0:
        below = half - (x - m["A"]) / tan_b
        if x < m["P"]:  # zone 1
            return m["A"], x, below, half, None
        return m["A"], x, below, half, half - (x - m["P"]) / tan_b  # zone 2
    if number == 1:
        crossing = half - (x - m["P"]) / tan_b
        if x < m["Q"]:  # zone 3
            return m["A"], x, half - (x - m["A"]) / tan_b, half, crossing
        if x < m["D"]:  # zone 4
            return x - SKEW, x, -half, half, crossing
        return x - SKEW, m["D"], -half, half - (x - m["D"]) / tan_b, crossing  # zone 5
    above = half - (x - m["D"]) / tan_b
    if x < m["H"]:  # zone 6
        return x - SKEW, m["D"], -half, above, half - (x - m["P"]) / tan_b
    if x < m["G"]:  # zone 7
        return x - SKEW, m["D"], -half, above, None
    return None  # zone 8


@pytest.mark.slow
@each("number", [0, 1, 2])
def test_clipping_gives_the_eight_zones_of_eq_24(number):
    """Phases are dense enough to meet zone 6, a two-hundredth of the mesh."""
    met = set()
    for phase in np.linspace(0.0, 0.9999, 4001):
        X = line_position(phase, number, PLANE)
        assert MARKS["A"] + (phase + number) * PLANE.pitch == pytest.approx(X, rel=1e-9)  # (23)
        segment, zone = clip_line(X, PLANE), zone_limits(number, X)
        if zone is None:
            assert segment_length(segment, PLANE) == 0.0
            met.add("none")
            continue
        x_m, x_f, z_m, z_f, z_p = zone
        expected = (z_m, z_f, x_m, x_f)
        assert tuple(segment) == pytest.approx(expected, rel=1e-9, abs=1e-11)
        if z_p is None:  # all before the pitch line in zone 1, all past it in zone 7
            z_p = z_f if number == 0 else z_m
        assert pitch_crossing(X, segment, PLANE) == pytest.approx(z_p, abs=1e-11)
        met.add(zone[-1] is not None)
    assert met == [{False, True}, {True}, {True, False, "none"}][number]


def test_two_or_three_pairs_are_in_contact_at_a_contact_ratio_of_2_7():
    assert PAIR.total_contact_ratio == pytest.approx(2.7426, abs=1e-4)
    span = MARKS["G"] - MARKS["A"]
    assert PAIR.total_contact_ratio == pytest.approx(span / PLANE.pitch, rel=1e-12)
    assert line_count(PLANE) == 3
    X = positions_at(np.linspace(0.0, 1.0, 500, endpoint=False), PAIR)
    length = np.array([[segment_length(clip_line(x, PLANE), PLANE) for x in row] for row in X])
    touching = (length > 0.0).sum(axis=1)
    assert set(touching) == {2, 3}
    # Three while pair 2 is between E and G.
    assert (touching == 3).mean() == pytest.approx(
        (MARKS["G"] - MARKS["E"]) / PLANE.pitch, abs=2e-3
    )


def test_length_of_a_line_is_a_trapezoid_between_its_landmarks():
    corners = [MARKS[name] for name in ("A", "Q", "D", "G")]
    full = 1.25 * INCH * math.hypot(1.0, SKEW / (1.25 * INCH))
    X = np.linspace(0.8 * corners[0], 1.1 * corners[-1], 3001)
    got = [segment_length(clip_line(x, PLANE), PLANE) for x in X]
    np.testing.assert_allclose(got, np.interp(X, corners, [0.0, full, full, 0.0]), atol=1e-12)


def test_total_contact_length_varies_by_13_6_percent_about_its_mean():
    """13.6: the ripple of fig. 2 under constant density, to its digits."""
    X = positions_at(np.arange(4000) / 4000, PAIR)
    total = shared_load(X, ModifiedPair(pair=PAIR), 100.0).total_length[:, 0]
    ratio = (MARKS["D"] - MARKS["A"]) / PLANE.pitch
    mean = ratio * 1.25 * INCH * math.hypot(1.0, SKEW / (1.25 * INCH))
    # Piecewise linear: the sampled mean is off by the square of the step.
    assert total.mean() == pytest.approx(mean, rel=1e-6)
    assert PAIR.mean_contact_length == pytest.approx(mean, rel=1e-12)
    assert np.ptp(total) / mean == pytest.approx(0.136, abs=5e-4)


def test_sliding_reverses_at_the_pitch_line():
    """Eq. (6), with the pinion ahead of the line before the pitch point: v_s > 0 there."""
    speed = 1000.0 * math.pi / 30.0
    length = 3.5 * INCH * math.sin(math.radians(25.0))  # between the tangent points
    for x in np.linspace(MARKS["A"], MARKS["D"], 41):
        v_s = -x * speed + (length - x) * speed * 25 / 31
        got = line_kinematics(x, speed, PLANE)
        assert got.sliding == pytest.approx(-v_s, rel=1e-9, abs=1e-12)
        assert np.sign(v_s) == np.sign(MARKS["P"] - x) or abs(x - MARKS["P"]) < 1e-9
    # Cancellation of 6 m/s leaves rounding only.
    assert line_kinematics(MARKS["P"], speed, PLANE).sliding == pytest.approx(0.0, abs=1e-12)
