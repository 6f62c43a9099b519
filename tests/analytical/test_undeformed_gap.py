"""The undeformed gap against involute helicoids built point by point, and against its limits."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.involute import facet_bounds, involute_flank, parabola_distance
from gearlube_core.helical_geometry.modification import Crown, FlankModification, ModifiedPair
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap, contact_line_gap
from tests.helpers.each import each
from tests.helpers.jamali_2015 import jamali_2015
from tests.helpers.named_pairs import PAIRS, named_pair


def full_line(pair):
    """X of the line that meets the pitch line at mid-face."""
    return pair.pitch_point + 0.5 * pair.face_width * math.tan(pair.base_helix_angle)


def half_length(pair):
    return 0.5 * pair.face_width / math.cos(pair.base_helix_angle)


def helicoid_point(pair, member, roll, z):
    """Point of the flank at a roll length and z, in the frame of the plane of contact.

    The string of the involute leaves the base circle at an angle d from the tangent point.
    """
    tan_b = math.tan(pair.base_helix_angle)
    on_line = full_line(pair) - (0.5 * pair.face_width - z) * tan_b
    if member == "pinion":
        r_b, centre, side = pair.pinion_base_radius, np.array([0.0, 0.0]), 1.0
        d = (roll - on_line) / r_b
    else:
        r_b, side = pair.gear_base_radius, -1.0
        centre = np.array([pair.tangent_length, pair.pinion_base_radius + r_b])
        d = (roll - (pair.tangent_length - on_line)) / r_b
    radial = np.array([-math.sin(d), math.cos(d)])
    along = np.array([math.cos(d), math.sin(d)])
    plane_point = centre + side * (r_b * radial + roll * along)
    return np.array([*plane_point, z])


@each("name", PAIRS)
@each("member", ["pinion", "gear"])
def test_gap_is_that_of_an_involute_helicoid_built_in_space(name, member):
    pair = named_pair(name)
    b = pair.base_helix_angle
    gap = UndeformedGap(modified=ModifiedPair(pair=pair))
    origin = np.array([pair.pitch_point, pair.pinion_base_radius, 0.0])
    across, along = np.array([0.0, -1.0, 0.0]), np.array([math.sin(b), 0.0, math.cos(b)])
    into = np.array([-math.cos(b), 0.0, math.sin(b)]) * (1.0 if member == "pinion" else -1.0)
    rng = np.random.default_rng(5)
    for _ in range(40):
        z = rng.uniform(-0.3, 0.3) * pair.face_width
        on_line = pair.pitch_point + z * math.tan(b)
        roll = on_line if member == "pinion" else pair.tangent_length - on_line
        point = helicoid_point(pair, member, roll + rng.uniform(-1.5e-3, 1.5e-3), z) - origin
        x, y, depth = point @ across, point @ along, point @ into
        found = float(gap.tooth_heights(member, x, y, full_line(pair)))
        # the section's fixed point leaves 1e-11 m at most at the edge of a wide grid
        assert found == pytest.approx(depth, rel=1e-6, abs=1e-12)
        assert depth >= 0.0


@each("name", PAIRS)
@each("form", ["involute", "parabola"])
def test_curvature_of_the_gap_is_the_relative_normal_curvature(name, form):
    pair = named_pair(name)
    plane, X, e = pair.plane, full_line(pair), 3e-6
    gap = UndeformedGap(modified=ModifiedPair(pair=pair), form=form)
    for y in np.linspace(-0.6, 0.6, 7) * half_length(pair):
        h = gap.heights(np.array([-e, e]), y, X)
        R = line_kinematics(pair.pitch_point + y * plane.sin_b, 100.0, plane).R
        # fourth-order terms of the involute: (e/R)^2 times the squared radius ratio
        assert h.sum() / e**2 * R == pytest.approx(1.0, rel=1e-6)


def test_spur_gap_is_that_of_two_cylinders():
    pair = replace(named_pair("he_2007"), helix_angle=0.0, normal_module=25.4e-3 / 8.0)
    pair = replace(pair, normal_pressure_angle=math.radians(25.0))
    gap = UndeformedGap(modified=ModifiedPair(pair=pair))
    X = pair.pitch_point + 1e-3
    R1, R2 = X, pair.tangent_length - X
    x, y = np.linspace(-2e-4, 2e-4, 41)[:, None], np.linspace(-0.5, 0.5, 5) * pair.face_width
    h = gap.heights(x, y, X)
    assert np.ptp(h, axis=1).max() == 0.0
    cylinders = R1 - np.sqrt(R1**2 - x**2) + R2 - np.sqrt(R2**2 - x**2)
    even = 0.5 * (h + h[::-1])[:, 0]
    # an involute's radius grows linearly: odd in x to first order, (x/R)^2 in the even part
    assert even == pytest.approx(cylinders[:, 0], rel=3e-4)
    printed = replace(gap, form="parabola").heights(x, 0.0, X)
    assert printed == pytest.approx(0.5 * x**2 * (1 / R1 + 1 / R2), rel=1e-12)


def test_parabola_misses_the_involute_by_its_third_order_term():
    pair = named_pair("jamali_2015_a")
    X, x = full_line(pair) + 3e-3, np.array([-2e-4, -1e-4, 1e-4, 2e-4])
    exact = UndeformedGap(modified=ModifiedPair(pair=pair)).tooth_heights("pinion", x, 0.0, X)
    plain = UndeformedGap(modified=ModifiedPair(pair=pair), form="parabola")
    error = plain.tooth_heights("pinion", x, 0.0, X) - exact
    # involute: g = t^2/(2 R) - r_b t^3/(6 R^3) + ..., t = -x towards the tip, R' = r_b/R
    R, r_b = pair.pitch_point + 3e-3, pair.pinion_base_radius
    odd = 0.5 * (error[0] - error[3])
    expected = r_b * 2e-4**3 / (6 * R**3) * math.cos(pair.base_helix_angle)
    # the helix adds terms of sin(b)^2 at the same order, below a tenth of it times tan(b)^2
    assert odd == pytest.approx(expected, rel=0.02)
    assert odd / (0.5 * (error[1] - error[2])) == pytest.approx(8.0, rel=0.01)


@pytest.mark.parametrize("member", ["pinion", "gear"])
def test_relief_widens_the_gap_on_the_side_of_the_tip(member):
    # the tangent plane's x runs to the pinion's root and the gear's tip
    modified = jamali_2015("a", k=0.5)
    pair = modified.pair
    on_line = modified.contact_end if member == "pinion" else modified.contact_start
    X = on_line + full_line(pair) - pair.pitch_point
    x = np.array([-3e-4, 3e-4])
    removed = {}
    for form in ("involute", "parabola"):
        gap = UndeformedGap(modified=modified, form=form)
        plain = UndeformedGap(modified=ModifiedPair(pair=pair), form=form)
        removed[form] = gap.tooth_heights(member, x, 0.0, X) - plain.tooth_heights(
            member, x, 0.0, X
        )
    tip, root = (0, 1) if member == "pinion" else (1, 0)
    # the gap of 1 um shifts the section off mid-face, where 8 um of crown begin: (1e-5)^2 of them
    assert removed["involute"][root] == pytest.approx(0.0, abs=1e-14)
    # radius at the tip side: r^2 = r_b^2 + roll^2 grows by 2 r_b t
    if member == "pinion":
        tip_radius, r_b = pair.pinion_tip_radius, pair.pinion_base_radius
    else:
        tip_radius, r_b = pair.gear_tip_radius, pair.gear_base_radius
    r = math.sqrt((tip_radius - 2e-3) ** 2 + 2.0 * r_b * 3e-4)
    depth = (r - tip_radius + 2e-3) / 1e-3  # of the parabola, half the extent
    expected = depth**2 * 70e-6 / 3.0 * math.cos(pair.base_helix_angle)
    # terms of t^3 in r, 1e-4 of t, and the section's shift by the gap
    assert removed["involute"][tip] == pytest.approx(expected, rel=5e-3)
    assert removed["parabola"][tip] == pytest.approx(removed["involute"][tip], rel=1e-3)


def test_relief_of_a_spur_pair_starts_nowhere_along_a_line():
    pair = replace(named_pair("jamali_2015_a"), helix_angle=0.0, normal_module=4.5e-3 / 0.94206)
    line = contact_line_gap(ModifiedPair(pair=pair), pair.pitch_point, np.array([0.0, 0.01]))
    assert math.isnan(line.pinion_relief_start)
    assert math.isnan(line.gear_relief_start)
    assert np.all(line.gap == 0.0)


@pytest.mark.parametrize("form", ["involute", "parabola"])
def test_gap_on_the_line_is_the_normal_removal(form):
    modified = jamali_2015("b", k=0.4, crown_start=5e-3, facets=40 if form == "involute" else 0)
    pair = modified.pair
    X = full_line(pair) + 4e-3
    y = np.linspace(-1.0, 1.0, 201) * half_length(pair)
    x = X - 0.5 * pair.face_width * math.tan(pair.base_helix_angle)
    x = x + y * math.sin(pair.base_helix_angle)
    h = UndeformedGap(modified=modified, form=form).heights(0.0, y, X)
    cosine = math.cos(pair.base_helix_angle)
    expected = modified.removal(x, y * cosine) * cosine
    # removal of 0.1 mm shifts the section by 0.03 mm, along which a crown or relief changes by 2 %
    assert h == pytest.approx(expected, rel=2e-2, abs=1e-12)
    shallow = expected < 1e-6
    assert h[shallow] == pytest.approx(expected[shallow], abs=2e-9)


def test_crown_of_both_teeth_gives_the_gap_its_curvature_along_the_line():
    pair = named_pair("jamali_2015_a")
    crown = Crown(amount=8e-6, start=0.0)
    flank = FlankModification(crown=crown)
    h = {}
    for name, gear in (("one", FlankModification()), ("both", flank)):
        gap = UndeformedGap(modified=ModifiedPair(pair=pair, pinion=flank, gear=gear))
        h[name] = gap.heights(0.0, np.array([-1e-3, 1e-3]), full_line(pair)).sum() / 1e-3**2
    R_y = crown.curvature_radius(pair.face_width, pair.base_helix_angle)
    # 35.392 m from (F/2)^2/(2 c_r cos^3 b), printed to five digits
    assert R_y == pytest.approx(35.392, abs=5e-4)
    assert 1.0 / h["one"] == pytest.approx(R_y, rel=1e-6)
    assert 1.0 / h["both"] == pytest.approx(0.5 * R_y, rel=1e-6)


def test_faceted_flank_is_the_chord_of_two_helicoid_points():
    modified = jamali_2015("a", facets=20)
    pair = modified.pair
    plain = FlankModification(facets=20)
    gap = UndeformedGap(modified=ModifiedPair(pair=pair, pinion=plain, gear=plain))
    X, b = full_line(pair), pair.base_helix_angle
    flank = modified.pinion_flank
    arc = (flank.roll_high - flank.roll_low) / 20
    origin = np.array([pair.pitch_point, pair.pinion_base_radius, 0.0])
    z = 2e-3
    for k in (9, 10, 11):
        ends = [
            helicoid_point(pair, "pinion", flank.roll_low + j * arc, z) - origin for j in (k, k + 1)
        ]
        for share in (0.0, 0.3, 0.5, 0.9):
            x, y, depth = (
                ((1 - share) * ends[0] + share * ends[1]) @ direction
                for direction in (
                    np.array([0.0, -1.0, 0.0]),
                    np.array([math.sin(b), 0.0, math.cos(b)]),
                    np.array([-math.cos(b), 0.0, math.sin(b)]),
                )
            )
            # the section's fixed point
            found = float(gap.tooth_heights("pinion", x, y, X))
            assert found == pytest.approx(depth, rel=1e-5, abs=1e-12)


def test_facet_ends_on_the_parabola_lie_at_their_radius():
    roll, r_b = 0.0284, 0.0735
    other = roll + np.array([-1e-2, -2e-3, 0.0, 2e-3, 8e-3])
    t = parabola_distance(roll, other, r_b)
    radius = np.hypot(r_b + t, roll - 0.5 * t**2 / roll)
    # the fixed point gains (t/R)^3 a step
    assert radius == pytest.approx(np.hypot(r_b, other), rel=1e-9)
    assert np.abs(t).max() > 2e-3


def test_facets_end_at_the_base_circle():
    flank = involute_flank(named_pair("jamali_2015_a"), "pinion")
    first, second = facet_bounds([1e-3, flank.roll_low, flank.roll_high - 1e-6], flank, 2)
    arc = 0.5 * (flank.roll_high - flank.roll_low)
    assert first == pytest.approx([0.0, flank.roll_low, flank.roll_low + arc], rel=1e-12)
    assert second[0] == pytest.approx(flank.roll_low - arc, rel=1e-12)
    assert second[1:] == pytest.approx(first[1:] + arc, rel=1e-12)


def test_line_tells_the_crowns_of_both_teeth_and_where_their_reliefs_begin():
    pair = named_pair("jamali_2015_a")
    crowns = Crown(amount=8e-6, start=1e-3), Crown(amount=3e-6, start=2e-3)
    flanks = [FlankModification(crown=one) for one in crowns]
    modified = ModifiedPair(pair=pair, pinion=flanks[0], gear=flanks[1])
    y = np.linspace(-0.9, 0.9, 7) * half_length(pair)
    X = full_line(pair) + 1e-3
    line = contact_line_gap(modified, X, y)
    cos_b = math.cos(pair.base_helix_angle)
    expected = sum(
        one.amount
        * (np.maximum(np.abs(y * cos_b) - one.start, 0.0) / (0.5 * pair.face_width - one.start))
        ** 2
        for one in crowns
    )
    assert line.crown == pytest.approx(expected * cos_b)
    # removal of 10 um shifts the section by a few um, along which the crowns change by 0.1 %
    assert line.gap == pytest.approx(expected * cos_b, rel=1e-2, abs=1e-12)
    for one in (flanks[0], FlankModification()):
        alone = ModifiedPair(pair=pair, pinion=FlankModification(), gear=one)
        crown = contact_line_gap(alone, X, y).crown
        assert (crown.max() > 0.0) == (one is flanks[0])
    # where the line, mid-face at X less half the face's advance, crosses the starts
    advance = 0.5 * pair.face_width * math.tan(pair.base_helix_angle)
    for start, contact in (
        (line.pinion_relief_start, modified.contact_end),
        (line.gear_relief_start, modified.contact_start),
    ):
        assert X - advance + start * math.sin(pair.base_helix_angle) == pytest.approx(contact)
