"""Corrections of hypoid flanks: their laws, the gap they open, the curvature they add."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.hypoid_contact.contact_kinematics import contact_kinematics, path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.ease_off import ease_off
from gearlube_core.hypoid_contact.gap_map import gap_map
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_geometry.flank.correction import (
    EdgeRelief,
    FlankCorrection,
    rounding,
)
from gearlube_core.hypoid_geometry.flank.flank import Flank
from tests.helpers.contact_cases import shipped_pair
from tests.helpers.each import each
from tests.helpers.loaded_cases import FILE, stiffness

HEIGHT, WIDTH = 7e-3, 30e-3
ALL = FlankCorrection(
    reliefs=(
        EdgeRelief(edge="tip", amount=20e-6, extent=3e-3),
        EdgeRelief(edge="root", amount=15e-6, extent=3e-3),
        EdgeRelief(edge="toe", amount=30e-6, extent=16e-3),
        EdgeRelief(edge="heel", amount=25e-6, extent=12e-3),
    ),
    profile_crown=4e-6,
    lead_crown=-7e-6,
    twist=9e-6,
)
EVERYTHING = {
    "tip_relief_um": 20.0, "tip_relief_depth_mm": 3.0, "heel_relief_um": 25.0,
    "heel_relief_length_mm": 12.0, "lead_crown_um": 7.0, "profile_crown_um": 4.0, "twist_um": 9.0,
}  # fmt: skip


def removed(s, t, correction=ALL):
    return correction.bends(np.array(s), np.array(t), HEIGHT, WIDTH).value


def with_relief(**members):
    return FILE.varied({f"{role}.drive_flank": fields for role, fields in members.items()})


@each(
    ("place", "expected"),
    [
        # crowns 4 - 7 um in the corners; twist +9 at heel tip and toe root, -9 at the others
        ((1.0, 1.0), 20e-6 + 25e-6 + 4e-6 - 7e-6 + 9e-6),
        ((0.0, 0.0), 15e-6 + 30e-6 + 4e-6 - 7e-6 + 9e-6),
        ((1.0, 0.0), 20e-6 + 30e-6 + 4e-6 - 7e-6 - 9e-6),
        ((0.5, 0.57), 0.0),  # beyond all reliefs; crown -7e-6 x 0.14^2 is left
    ],
)
def test_what_is_removed_at_corners_and_in_the_middle(place, expected):
    expected += -7e-6 * 0.14**2 if place == (0.5, 0.57) else 0.0
    assert removed(*place) == pytest.approx(expected, rel=1e-12, abs=0.0)


def test_a_rounding_begins_as_its_circle():
    radius, distance = 0.3e-3, 0.27e-3
    circle = radius - np.sqrt(radius**2 - (radius - distance) ** 2)
    found = rounding("tip", radius).at(np.array(distance))[0]
    # the parabola and the circle differ by a quarter of (x/r)^2 of the depth, x/r = 0.1
    assert found == pytest.approx(circle, rel=0.004)


def test_derivatives_are_those_of_the_removal():
    s, t = np.array([0.2, 0.7, 0.93, 0.55]), np.array([0.1, 0.3, 0.8, 0.95])
    d = 1e-3

    def at(i, j):
        return removed(s + i * d, t + j * d)

    found = ALL.bends(s, t, HEIGHT, WIDTH)
    h, w = d * HEIGHT, d * WIDTH
    # a law of second degree has these differences exactly, to roundings of 1e-16/1e-3^2
    expected = {
        "by_h": (at(1, 0) - at(-1, 0)) / (2 * h),
        "by_l": (at(0, 1) - at(0, -1)) / (2 * w),
        "by_hh": (at(1, 0) - 2 * at(0, 0) + at(-1, 0)) / h**2,
        "by_hl": (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h * w),
        "by_ll": (at(0, 1) - 2 * at(0, 0) + at(0, -1)) / w**2,
    }
    for name, value in expected.items():
        np.testing.assert_allclose(getattr(found, name), value, rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize("role", ["pinion", "gear"])
def test_the_bend_is_that_of_the_removal_over_the_surface(role):
    """Second differences over points of the cut surface itself, found again in s and t."""
    flank = Flank.from_file(with_relief(**{role: EVERYTHING}), role, "drive")
    s, t, d = 0.8, 0.75, 0.02
    grid = flank.grid(s + d * np.array([-1.0, 0.0, 1.0]), t + d * np.array([-1.0, 0.0, 1.0]))
    middle = flank.sample(np.array(s), np.array(t))
    local = (grid.r - middle.r).reshape(9, 3) @ np.stack([middle.tangent_1, middle.tangent_2]).T
    x, y = local.T
    terms = np.stack([np.ones(9), x, y, 0.5 * x * x, x * y, 0.5 * y * y], axis=1)
    fit = np.linalg.lstsq(terms, flank.removal(grid.r).ravel(), rcond=None)[0]
    bend = flank.removal_bend(middle)
    # the surface bends away from its tangent plane by 3 % over the stencil's 1 mm
    np.testing.assert_allclose(bend[[0, 0, 1], [0, 1, 1]], fit[3:], rtol=0.03, atol=0.02)


def test_relief_opens_the_gap_by_what_it_takes_away_and_none_leaves_it_bit_for_bit():
    plain = gap_map(FlankPair.from_file(FILE, "drive"), 0.0, 0.0)
    none = gap_map(FlankPair.from_file(with_relief(gear={}, pinion={}), "drive"), 0.0, 0.0)
    np.testing.assert_array_equal(none.gap, plain.gap)
    fields = {"tip_relief_um": 20.0, "tip_relief_depth_mm": 3.0}
    relieved = gap_map(FlankPair.from_file(with_relief(gear=fields), "drive"), 0.0, 0.0)
    with np.errstate(invalid="ignore"):
        opened = relieved.gap - plain.gap
    # rows of the map run from s = 0.02 to the tip; 3 mm of 7.615 mm are relieved
    height = FILE.blank().whole_depth
    depth = (1.0 - np.linspace(0.02, 1.0, 25)) * height
    expected = 20e-6 * np.maximum(1.0 - depth / 3e-3, 0.0) ** 2
    some = np.isfinite(opened)
    np.testing.assert_allclose(
        opened[some], np.broadcast_to(expected[:, None], opened.shape)[some], atol=1e-12
    )


def test_a_crown_of_the_gear_is_added_to_the_ease_off():
    angles = np.arange(-18, 19) / 9.0 * shipped_pair("drive").gear_pitch
    grid = {"s_count": 5, "t_count": 9, "gear_angles": angles}
    plain = ease_off(FlankPair.from_file(FILE, "drive"), **grid)
    crowned = ease_off(
        FlankPair.from_file(with_relief(gear={"lead_crown_um": 20.0}), "drive"), **grid
    )
    change = crowned.normal_gap() - plain.normal_gap()
    expected = np.broadcast_to(20e-6 * (2.0 * crowned.t - 1.0) ** 2, change.shape)
    some = np.isfinite(change)
    # the tightest place moves, which shifts all by one rotation: equal but for arms that differ
    # by 10 % over the flank
    difference = (change - expected)[some]
    assert np.ptp(difference) < 0.1 * 20e-6


@pytest.fixture(scope="module")
def middle():
    """Contacts of the plain pair about the middle of its path."""
    pair = shipped_pair("drive")
    return contact_path(pair, np.array([-0.1, 0.1, 0.3]) * pair.gear_pitch)


def test_a_crown_bends_the_gap_along_the_face_by_its_own_curvature(middle):
    crown, width = 20e-6, FILE.gear.face_width_mm * 1e-3
    pair = replace(middle.pair, gear=replace(
        middle.pair.gear, correction=FlankCorrection(lead_crown=crown)
    ))  # fmt: skip
    plain, crowned = (
        contact_kinematics(
            one, middle.gear_angle, middle.pinion_angle, middle.gear_parameters,
            middle.pinion_parameters,
        )
        for one in (middle.pair, pair)
    )  # fmt: skip
    # along the gear's pitch cone, away from the axis and its apex
    radial = plain.r * [1.0, 1.0, 0.0]
    radial /= np.linalg.norm(radial, axis=1)[:, None]
    angle = np.radians(FILE.gear.pitch_angle_deg)
    along = np.sin(angle) * radial + np.cos(angle) * np.array([0.0, 0.0, 1.0])
    tangent = along - np.einsum("ni,ni->n", along, plain.normal)[:, None] * plain.normal
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    change = np.einsum(
        "ni,nij,nj->n", tangent, crowned.relative_curvature - plain.relative_curvature, tangent
    )
    expected = 8.0 * crown / width**2 * np.einsum("ni,ni->n", along, tangent) ** 2
    # contact is up to a tenth of the face off its middle: the slope of the crown there, times the
    # curvature of the flank, adds some per cent
    assert change == pytest.approx(expected, rel=0.08)


def test_the_error_of_a_crowned_pair_changes_as_the_ratio_of_its_radii_says(middle):
    """Gearing: the pinion gains nothing on the gear where R_g / R_p is the ratio of the teeth."""
    crown = FlankCorrection(lead_crown=20e-6)
    pair = replace(middle.pair, gear=replace(middle.pair.gear, correction=crown))
    angles = np.linspace(-0.2, 0.5, 7) * pair.gear_pitch
    path = contact_path(pair, angles)
    k = path_kinematics(path)
    rate = np.polyder(np.polyfit(angles, path.transmission_error, 4))
    expected = np.polyval(rate, angles[1:-1])
    # de/d(gear angle) = R_g/R_p - ratio; a parabola of the fourth degree through seven points
    np.testing.assert_allclose(
        (k.R_g / k.R_p - pair.ratio)[1:-1], expected, atol=0.02 * np.ptp(expected)
    )


def test_the_path_of_corrected_flanks_is_that_of_tangency_where_nothing_is_taken_off(middle):
    hair = FlankCorrection(profile_crown=1e-15)  # m; makes the search take the place of equations
    pair = replace(middle.pair, pinion=replace(middle.pair.pinion, correction=hair))
    found = contact_path(pair, middle.gear_angle)
    for name in ("gear_s", "gear_t", "pinion_s", "pinion_t", "pinion_angle"):
        # the search ends with parabolas over 1e-5 of the flank, exact to third order
        assert getattr(found, name) == pytest.approx(getattr(middle, name), abs=1e-7), name


def test_relief_of_tips_and_ends_makes_every_pressure_independent_of_the_cells():
    """Phase 0.5 at 200 N.m: with sharp ends the pinion's toe presses into the gear."""
    tip = {"tip_relief_um": 20.0, "tip_relief_depth_mm": 1.9}
    ends = {
        "toe_relief_um": 10.0, "toe_relief_length_mm": 4.0, "heel_relief_um": 10.0,
        "heel_relief_length_mm": 4.0,
    }  # fmt: skip
    growth = {}
    for name, fields in (("tip", tip), ("all", tip | ends)):
        pair = FlankPair.from_file(with_relief(pinion=fields, gear=fields), "drive")
        position = MeshPosition.at(pair, 0.5)
        highest = []
        for across in (24, 48):
            cells = StripSettings(cells_across=across, cells_along=3 * across // 2)
            state = position.load(200.0, stiffness(), LoadedSettings(strips=cells))
            highest.append(np.array([one.pressure.max() for one in state.pairs]))
        growth[name] = (highest[1] / highest[0])[highest[0] > 1e8]
    # a sharp edge rises as the square root of the cells, 1.41, more slowly where it just touches
    assert growth["tip"].max() > 1.15
    np.testing.assert_allclose(growth["all"], 1.0, atol=0.03)
