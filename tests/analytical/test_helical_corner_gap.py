"""Where tip edges meet flanks: against tooth bodies turned about their axes."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.helical_contact.strips import edge, engagement, line_gap, roll_beside
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.pair import HelicalPair
from tests.helpers.each import each
from tests.helpers.helical_contact_cases import HE_2007, SPUR


def turned(vector, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


UNDERCUT = HelicalPair(
    name="24:24 of 14.5 deg",
    pinion_teeth=24,
    gear_teeth=24,
    normal_module=3e-3,
    normal_pressure_angle=math.radians(14.5),
    helix_angle=0.0,
    centre_distance=72e-3,
    pinion_tip_radius=39e-3,
    gear_tip_radius=39e-3,
    pinion_root_radius=32.25e-3,
    gear_root_radius=32.25e-3,
    face_width=20e-3,
)


def edge_against_flank(pair, beyond, end):
    """Turn the pinion's edge at roll length `end` past its place; measure it from the gear.

    Returns the distance along the gear's base tangent through the tip, and the arms of that
    tangent about both axes: built from the rotation of the bodies alone.
    """
    r_p, r_g = pair.pinion_base_radius, pair.gear_base_radius
    tip = turned((end, r_p), -beyond / r_p)
    from_gear = tip - np.array([pair.tangent_length, r_p + r_g])
    roll = math.sqrt(from_gear @ from_gear - r_g**2)
    place = math.atan2(from_gear[0], -from_gear[1])
    flank = (end + beyond - pair.tangent_length + roll) / r_g - math.atan(roll / r_g)
    along = turned((1.0, 0.0), place + math.atan(roll / r_g))
    arms = [abs(v[0] * along[1] - v[1] * along[0]) for v in (tip, from_gear)]
    return r_g * (flank - place), *arms


@each("beyond", [0.05e-3, 0.2e-3, 0.5e-3, 1.0e-3])
def test_corner_gap_is_the_tip_edges_distance_from_the_mating_involute(beyond):
    gap, pinion_arm, gear_arm = edge_against_flank(SPUR, beyond, SPUR.contact_end)
    found = line_gap(ModifiedPair(pair=SPUR), SPUR.contact_end + beyond)
    # the strip measures along the common normal of the line, turned by up to 0.05 from the base
    # tangent: half its square
    np.testing.assert_allclose(found.gap, gap, rtol=2e-3)
    assert gap > 1e-8
    met = engagement(np.array(SPUR.contact_end + beyond), SPUR)
    # the point on the edge is taken at the line's x, a gap (25 um at 1 mm) beside its true place
    assert float(met.pinion_arm) == pytest.approx(pinion_arm, rel=1e-4)
    assert float(met.gear_arm) == pytest.approx(gear_arm, rel=1e-9)


@each("before", [0.05e-3, 0.2e-3, 0.5e-3])
def test_an_undercut_begins_with_an_edge_like_that_of_a_tip(before):
    start = UNDERCUT.involute_starts[0].roll
    assert UNDERCUT.contact_start == start > UNDERCUT.tip_start
    gap, pinion_arm, gear_arm = edge_against_flank(UNDERCUT, -before, start)
    found = line_gap(ModifiedPair(pair=UNDERCUT), start - before)
    # tolerances as for tips; the pinion is six times as curved here, where x is 1.5 mm
    np.testing.assert_allclose(found.gap, gap, rtol=0.05)
    met = engagement(np.array(start - before), UNDERCUT)
    assert float(met.y) > 0.0
    assert float(met.pinion_arm) == pytest.approx(pinion_arm, rel=1e-3)
    assert float(met.gear_arm) == pytest.approx(gear_arm, rel=1e-6)


def test_before_mesh_the_members_change_places():
    swapped = replace(
        SPUR,
        pinion_teeth=SPUR.gear_teeth,
        gear_teeth=SPUR.pinion_teeth,
        pinion_tip_radius=SPUR.gear_tip_radius,
        gear_tip_radius=SPUR.pinion_tip_radius,
        pinion_root_radius=SPUR.gear_root_radius,
        gear_root_radius=SPUR.pinion_root_radius,
    )
    early = line_gap(ModifiedPair(pair=SPUR), SPUR.contact_start - 0.4e-3)
    late = line_gap(ModifiedPair(pair=swapped), swapped.contact_end + 0.4e-3)
    np.testing.assert_allclose(early.gap, late.gap, rtol=1e-9)


def test_teeth_touch_everywhere_inside_the_plane_of_contact():
    plane = HE_2007.plane
    x = np.linspace(plane.A, plane.D, 7)
    met = engagement(x, HE_2007)
    np.testing.assert_array_equal(met.y, 0.0)
    np.testing.assert_allclose(met.pinion_arm, plane.r_bp, rtol=1e-12)
    gap = line_gap(ModifiedPair(pair=HE_2007), plane.A + 10e-3)
    inside = (x := plane.A + 10e-3 - (0.5 * plane.W - gap.z) * plane.sin_b / plane.cos_b) > plane.A
    assert np.abs(gap.gap[inside]).max() < 1e-15
    assert gap.gap[~inside].max() > 1e-6
    assert x.min() < plane.A


def test_the_tip_edge_leaves_through_the_end_of_the_line_of_action():
    end = HE_2007.contact_end
    args = HE_2007.pinion_base_radius, HE_2007.tip_end
    assert abs(float(edge(end, *args))) < 1e-15
    x = end + np.array([-2e-4, 2e-4])
    # on the tip circle to the gap's own size, over radius: 1 um beside 43 mm
    radius = np.hypot(HE_2007.pinion_base_radius, roll_beside(x, edge(x, *args), args[0]))
    np.testing.assert_allclose(radius, HE_2007.pinion_tip_radius, atol=2e-6)
    assert edge(x, *args)[0] > 0.0 > edge(x, *args)[1]
