"""What the unloaded contact of any pair obeys: periods, envelopes, order, displacements."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.ease_off import MARKING_COMPOUND, closest_approach, ease_off
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Misalignment
from gearlube_core.hypoid_contact.searched_transmission_error import searched_transmission_error
from gearlube_core.hypoid_contact.unloaded_error import contact_ratio, path_ends, unloaded_error
from tests.helpers.contact_cases import (
    SIDES,
    angles_on_teeth,
    displaced,
    shipped_file,
    shipped_pair,
)
from tests.helpers.each import each


@cache
def shipped_error(side):
    return unloaded_error(shipped_pair(side))


@cache
def shipped_ease_off(side):
    return ease_off(shipped_pair(side), s_count=16, t_count=31)


@pytest.mark.parametrize("side", SIDES)
def test_error_repeats_every_tooth(side):
    pair = shipped_pair(side)
    found = shipped_error(side)
    # both pairs touch at a handover: same rotations, one pitch apart; bracketed to 1e-13 rad
    assert found.angular[0] == pytest.approx(found.angular[-1], abs=1e-11)
    assert np.ptp(found.pinion_angle) == pytest.approx(pair.pinion_pitch, abs=1e-11)
    assert np.ptp(found.gear_angle) == pytest.approx(pair.gear_pitch, abs=1e-12)


@pytest.mark.parametrize("side", SIDES)
def test_no_neighbour_touches_before_the_ruling_pair(side):
    pair = shipped_pair(side)
    found = unloaded_error(pair, 33)
    for pitches in (-2, -1, 1, 2):
        other = contact_path(pair, found.gear_angle + pitches * pair.gear_pitch)
        later = pair.touching_sign * (other.transmission_error - found.path.transmission_error)
        # equal at the handovers
        assert (later[other.inside] > -1e-11).all()


@pytest.mark.parametrize("side", SIDES)
def test_gear_lags_on_drive_flanks_and_leads_on_coast_flanks(side):
    found = shipped_error(side)
    sign = {"drive": 1.0, "coast": -1.0}[side]
    assert (sign * found.angular >= -1e-12).all()
    inner = slice(8, -8)
    # one extreme over the period, convex on either side
    assert (sign * np.diff(found.angular, 2)[inner] > 0.0).all()
    assert sign * found.mean > 0.0


@pytest.mark.parametrize("side", SIDES)
def test_order_of_the_angles_asked_for_does_not_matter(side):
    pair = shipped_pair(side)
    angles = angles_on_teeth(side, 9)
    shuffled = np.random.default_rng(3).permutation(9)
    direct = contact_path(pair, angles).transmission_error
    mixed = contact_path(pair, angles[shuffled]).transmission_error
    # Newton's last step
    np.testing.assert_allclose(mixed, direct[shuffled], rtol=0.0, atol=1e-11)


@pytest.mark.parametrize("side", SIDES)
def test_no_displacement_is_alignment(side):
    angles = angles_on_teeth(side, 5)
    np.testing.assert_array_equal(
        contact_path(displaced(side), angles).r, contact_path(shipped_pair(side), angles).r
    )


# direction in which the contact at the error extreme moves on the gear: towards the tip (s) and
# towards the heel (t)
MOVES = {
    ("drive", "pinion_offset"): (+1, -1),
    ("coast", "pinion_offset"): (+1, +1),
    ("drive", "gear_axial"): (+1, +1),
    ("coast", "gear_axial"): (+1, -1),
    ("drive", "shaft_angle"): (+1, +1),
    ("coast", "shaft_angle"): (+1, -1),
}


@pytest.mark.slow
@each(("side", "what"), MOVES)
def test_contact_moves_steadily_with_displacement(side, what):
    """Towards the tip on both flanks, towards opposite ends of the face on drive and coast."""
    places = []
    for size in (-1e-4, -5e-5, 0.0, 5e-5, 1e-4):
        pair = displaced(side, **{what: size})
        at = contact_path(pair, np.array([unloaded_error(pair, 3).extreme_angle]))
        places.append((at.gear_s[0], at.gear_t[0]))
    for direction, steps in zip(MOVES[side, what], np.diff(places, axis=0).T, strict=True):
        assert (direction * steps > 0.0).all()


def test_pinion_position_moves_the_contact_over_the_profile():
    """0.02 mm of pinion cone correction shifts the drive contact further than of any other."""
    shifts = {}
    for what in ("pinion_axial", "pinion_offset", "gear_axial"):
        ends = []
        for size in (-2e-5, 2e-5):
            pair = displaced("drive", **{what: size})
            at = contact_path(pair, np.array([unloaded_error(pair, 3).extreme_angle]))
            ends.append(at.gear_s[0])
        shifts[what] = abs(ends[1] - ends[0])
    assert shifts["pinion_axial"] > 2.0 * max(shifts["pinion_offset"], shifts["gear_axial"])


@settings(max_examples=12)
@given(
    offset=st.floats(-5e-5, 5e-5),
    axial=st.floats(-5e-5, 5e-5),
    shaft=st.floats(-3e-4, 3e-4),
    place=st.floats(0.1, 0.9),
)
def test_displaced_flanks_keep_mechanics(offset, axial, shaft, place):
    """Positive radii, a bowl-shaped gap and R_g/R_p = dphi_p/dphi_g, whatever the displacement."""
    pair = shipped_pair("drive").misaligned(
        Misalignment(pinion_offset=offset, gear_axial=axial, shaft_angle=shaft)
    )
    entry, leaving = path_ends(pair)
    angle = entry + place * (leaving - entry)
    step = 1e-4
    path = contact_path(pair, angle + np.array([-step, 0.0, step]))
    k = path_kinematics(path)
    rate = (path.pinion_angle[2] - path.pinion_angle[0]) / (2.0 * step)
    # difference quotient over 1e-4 rad
    assert k.R_g[1] / k.R_p[1] == pytest.approx(rate, rel=1e-7)
    assert k.R_y[1] > k.R_x[1] > 0.0
    assert path.inside.all()


@pytest.mark.parametrize("side", SIDES)
def test_contact_ratio_counts_the_pitches_on_both_teeth(side):
    pair = shipped_pair(side)
    entry, leaving = path_ends(pair)
    just = 1e-7
    ends = np.array([entry - just, entry + just, leaving - just, leaving + just])
    assert contact_path(pair, ends).inside.tolist() == [False, True, True, False]
    pitches = (leaving - entry) * 36 / (2 * np.pi)
    assert contact_ratio(pair) == pytest.approx(pitches, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("side", SIDES)
def test_pattern_shrinks_with_neighbours(side):
    ease = shipped_ease_off(side)
    touch = searched_transmission_error(ease.pair, ease.gear_angle).error
    alone = ease.pair.touching_sign * (ease.error - touch[:, None, None]) * ease.R_p
    # points that a pair alone never reaches are far apart
    one = np.where(np.isnan(alone), 1.0, alone).min(axis=0)
    every = closest_approach(ease)
    known = np.isfinite(every)
    # neighbours can only hold a pair apart; rounding of the touch, 1e-12 rad of 20 mm
    assert (every[known] >= one[known] - 1e-12).all()
    marked, of_one = every <= MARKING_COMPOUND, one <= MARKING_COMPOUND
    assert (of_one | ~marked).all()
    assert 0.1 < marked.mean() < of_one.mean() < 0.5
    # the teeth never overlap: touch is found to a few nm where it lies on an edge
    assert one.min() > -10e-9
    assert 0.4 < ease.s[np.nonzero(marked)[0]].mean() < 0.8


@pytest.mark.slow
@pytest.mark.parametrize("side", SIDES)
def test_path_of_contact_runs_inside_the_pattern(side):
    pair = shipped_pair(side)
    closest = closest_approach(shipped_ease_off(side))
    path = unloaded_error(pair, 17).path
    i = np.rint(path.gear_s * 15).astype(int)
    j = np.rint(path.gear_t * 30).astype(int)
    assert (closest[i, j] <= MARKING_COMPOUND).all()


def test_straight_blades_leave_no_profile_crown():
    """A larger edge radius brings the pair nearer to conjugate: less transmission error."""
    errors = []
    for radius in (600.0, 762.0, 1200.0):
        file = shipped_file().varied(
            {
                "pinion.cutter.blade_edge_radius_mm": radius,
                "gear.cutter.blade_edge_radius_mm": radius,
            }
        )
        errors.append(unloaded_error(FlankPair.from_file(file, "drive"), 17).mean)
    assert errors[0] > errors[1] > errors[2] > 0.0
