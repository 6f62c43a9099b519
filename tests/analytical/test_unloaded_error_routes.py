"""Unloaded transmission error: two routes, the contact radii, and small displacements."""

import numpy as np
import pytest

from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_migration, contact_path
from gearlube_core.hypoid_contact.ease_off import ease_off
from gearlube_core.hypoid_contact.placement import placed_sample
from gearlube_core.hypoid_contact.searched_transmission_error import searched_transmission_error
from gearlube_core.hypoid_contact.unloaded_error import (
    _edge_angle,
    _zero,
    path_ends,
    unloaded_error,
)
from tests.helpers.contact_cases import SIDES, angles_on_teeth, displaced, shipped_pair
from tests.helpers.each import each

RATIO = 36.0 / 13.0
MICRORADIAN = 1e-6


def path_on_teeth(side, count=13, **displacement):
    return contact_path(displaced(side, **displacement), angles_on_teeth(side, count))


@pytest.mark.parametrize("side", SIDES)
def test_flanks_touch_with_opposite_normals(side):
    """Checked from the two flanks apart, not from the equations of the solver."""
    path = path_on_teeth(side)
    pair = path.pair
    gear = placed_sample(
        pair.gear, pair.gear_base, pair.gear_turn(path.gear_angle), path.gear_parameters
    )
    pinion = placed_sample(
        pair.pinion, pair.pinion_base, pair.pinion_turn(path.pinion_angle), path.pinion_parameters
    )
    # Newton's last step is below 1e-13 m and 1e-11 rad; rounding of positions of 0.1 m
    np.testing.assert_allclose(pinion.r, gear.r, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(pinion.normal, -gear.normal, rtol=0.0, atol=1e-9)


@each(
    ("side", "displacement"),
    [
        ("drive", {}),
        ("coast", {}),
        ("drive", {"pinion_offset": 5e-5, "shaft_angle": -3e-4}),
        ("coast", {"gear_axial": -5e-5, "pinion_axial": 2e-5}),
    ],
)
def test_tangency_and_turning_to_touch_give_one_transmission_error(side, displacement):
    path = path_on_teeth(side, **displacement)
    inside = path.inside
    assert inside.sum() >= 10
    found = searched_transmission_error(path.pair, path.gear_angle[inside])
    # asked for: 1 urad; the stencils shrink to 1e-5 of the flank
    np.testing.assert_allclose(
        found.error, path.transmission_error[inside], rtol=0.0, atol=0.01 * MICRORADIAN
    )
    # the extreme is flat: its place is known to the root of its value
    np.testing.assert_allclose(found.s, path.gear_s[inside], rtol=0.0, atol=1e-3)
    np.testing.assert_allclose(found.t, path.gear_t[inside], rtol=0.0, atol=1e-3)


@pytest.mark.parametrize("side", SIDES)
def test_edges_touch_after_the_surfaces_beyond_them_would(side):
    """Off the teeth tangency belongs to surfaces that are not there; edges touch later."""
    pair = shipped_pair(side)
    angles = np.array([-1.2, 1.5]) * pair.gear_pitch
    path = contact_path(pair, angles)
    assert not path.inside.any()
    later = pair.touching_sign * (
        searched_transmission_error(pair, angles).error - path.transmission_error
    )
    assert (later > 1.0 * MICRORADIAN).all()


@pytest.mark.parametrize("side", SIDES)
def test_error_slope_is_the_mismatch_of_the_contact_radii(side):
    """R_p dphi_p = R_g dphi_g in contact, so de/dphi_g = R_g/R_p - 36/13 along the whole path."""
    path = path_on_teeth(side, 25)
    step = 1e-3 * path.pair.gear_pitch
    after = contact_path(path.pair, path.gear_angle + step).transmission_error
    before = contact_path(path.pair, path.gear_angle - step).transmission_error
    slope = (after - before) / (2.0 * step)
    k = path_kinematics(path)
    # difference quotient: step^2/6 e''' = 5e-9 * 1, rounding 1e-12/1e-4
    np.testing.assert_allclose(k.R_g / k.R_p, RATIO + slope, rtol=1e-7)
    # the same, as lengths: e counted in R_p against nominal pinion rotation
    np.testing.assert_allclose(
        k.R_p * slope / RATIO, k.R_g / RATIO - k.R_p, rtol=0.0, atol=1e-6 * k.R_p.max()
    )


@pytest.mark.parametrize("side", SIDES)
def test_radii_have_the_ratio_of_the_teeth_where_the_error_is_extreme(side):
    """Extreme found from errors alone: vertex of a parabola through exact contacts."""
    pair = shipped_pair(side)
    coarse = path_on_teeth(side, 41)
    centre = coarse.gear_angle[np.argmin(pair.touching_sign * coarse.transmission_error)]
    for step in (0.05, 0.01, 0.003):
        step *= pair.gear_pitch
        left, middle, right = contact_path(
            pair, centre + np.array([-step, 0.0, step])
        ).transmission_error
        centre += 0.5 * step * (left - right) / (left - 2.0 * middle + right)
    k = path_kinematics(contact_path(pair, np.array([centre])))
    # the third derivative moves the last vertex by 1e-6 pitch, the ratio by 1e-8
    assert k.R_g[0] / k.R_p[0] == pytest.approx(RATIO, rel=1e-6)
    found = unloaded_error(pair)
    assert found.extreme_angle == pytest.approx(centre, abs=1e-4 * pair.gear_pitch)


@each("side", SIDES)
@each("what", ["pinion_offset", "pinion_axial", "gear_axial", "shaft_angle", "all"])
def test_small_displacements_turn_the_pinion_by_virtual_work(side, what):
    """First order: R_p dphi_p = -n . (displacement of the pinion - that of the gear) at rest."""
    size = 1e-7  # m or rad
    names = ("pinion_offset", "pinion_axial", "gear_axial", "shaft_angle")
    moved = dict.fromkeys(names if what == "all" else (what,), size)
    base = path_on_teeth(side, 5)
    k = path_kinematics(base)
    # fixed frame: offset along +y, pinion body towards +x, gear body towards +z; the shaft angle
    # grows when the pinion axis +x turns towards -z, about +y
    E, P, G, sigma = (moved.get(name, 0.0) for name in names)
    shift = np.array([P, E, -G]) + sigma * np.cross([0.0, 1.0, 0.0], k.r)
    # n points from the pinion into the gear on drive flanks, the other way on coast flanks;
    # turning in the drive direction moves the pinion along n in both cases
    expected = -np.einsum("ni,ni->n", k.normal, shift) / k.R_p
    plus = path_on_teeth(side, 5, **moved).transmission_error
    minus = path_on_teeth(side, 5, **{key: -value for key, value in moved.items()})
    turned = 0.5 * (plus - minus.transmission_error)
    # rounding of the solutions, 1e-13 of 1e-6, and of third order terms
    np.testing.assert_allclose(turned, expected, rtol=1e-5, atol=1e-6 * np.abs(expected).max())


@pytest.mark.parametrize("side", SIDES)
def test_point_of_contact_migrates_with_the_surfaces_along_the_normal(side):
    """Both surfaces stay in contact there: n . v_contact = n . v_pinion = R_p."""
    path = path_on_teeth(side, 7)
    k = path_kinematics(path)
    along = np.einsum("ni,ni->n", contact_migration(path), k.normal)
    # difference quotient over 2e-3 pitch
    np.testing.assert_allclose(along, k.R_p, rtol=1e-5)


@pytest.mark.parametrize("side", SIDES)
def test_ease_off_is_zero_on_the_path_of_contact_at_the_error_extreme(side):
    """Where the single pair's error is extreme, the ease-off of the whole flank is least."""
    pair = shipped_pair(side)
    found = unloaded_error(pair)
    ease = ease_off(pair, s_count=21, t_count=41)
    conjugate = pair.touching_sign * ease.conjugate_error()
    k = np.unravel_index(np.nanargmin(conjugate), conjugate.shape)
    touch = contact_path(pair, np.array([found.extreme_angle]))
    # half a grid step in either direction
    assert ease.s[k[0]] == pytest.approx(touch.gear_s[0], abs=0.5 / 20 + 0.01)
    assert ease.t[k[1]] == pytest.approx(touch.gear_t[0], abs=2.0 / 40)
    # a grid cannot find less than the least; it misses R_x by half a step: (0.2 mm)^2/2R_x = 1 um
    excess = conjugate[k] - pair.touching_sign * found.extreme_error
    # over R_p = 20 mm
    assert -0.05 * MICRORADIAN < excess < 50.0 * MICRORADIAN
    gap = ease.normal_gap()
    assert np.nanmin(gap) == 0.0


def test_the_path_ends_where_a_search_of_its_own_finds_it_off_the_teeth():
    """Searched alone, a position near an edge may lie on another branch; then there is no root."""
    pair = shipped_pair("drive")
    leaving = path_ends(pair)[1]
    inside, beyond = leaving - 0.05 * pair.gear_pitch, leaving + 0.05 * pair.gear_pitch
    assert _edge_angle(pair, inside, beyond) == pytest.approx(leaving, abs=1e-9)
    assert _edge_angle(pair, beyond, beyond + 0.05 * pair.gear_pitch) == beyond


def test_a_path_that_is_lost_on_the_way_has_no_zero():
    assert _zero(lambda x: x - 0.3, (0.0, 1.0), 1e-14) == pytest.approx(0.3, abs=1e-13)
    assert _zero(lambda x: x + 0.3, (0.0, 1.0), 1e-14) is None
    assert _zero(lambda x: x - 0.3 if x in (0.0, 1.0) else np.nan, (0.0, 1.0), 1e-14) is None
