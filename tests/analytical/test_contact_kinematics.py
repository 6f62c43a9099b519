"""Curvature and motion at the contact against gaps, conjugate surfaces and mechanics."""

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import contact_kinematics, path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.flank_intersection import HIT, intersect_line
from gearlube_core.hypoid_contact.placement import placed_sample, shape_operator
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from tests.helpers.conjugate_curvature import conjugate_relative_curvature
from tests.helpers.contact_cases import SIDES, angles_on_teeth, displaced, shipped_pair

PINION_AXIS, GEAR_AXIS = np.array([-1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
PINION_POINT = np.array([0.0, 0.024, 0.0])
RATIO = 36.0 / 13.0


def path_on_teeth(side, count=7):
    return contact_path(shipped_pair(side), angles_on_teeth(side, count))


def gap_at(path, k, normal, origin):
    """Gap along the normal at a place of the tangent plane, from both surfaces by ray."""
    pair, heights = path.pair, []
    for flank, placement, parameters in (
        (pair.gear, pair.gear_placed(path.gear_angle[k]), path.gear_parameters[k]),
        (pair.pinion, pair.pinion_placed(path.pinion_angle[k]), path.pinion_parameters[k]),
    ):
        x = np.array([*parameters, 0.0])
        assert intersect_line(flank.motion, placement, Vector(*origin), Vector(*normal), x) == HIT
        heights.append(x[3])
    return heights[0] - heights[1]


@pytest.mark.parametrize("side", SIDES)
def test_relative_curvature_is_the_second_difference_of_the_gap(side):
    path = path_on_teeth(side)
    k = path_kinematics(path)
    h = 1e-4  # m
    for i in range(1, path.gear_angle.size - 1):
        n = path.pair.touching_sign * k.normal[i]  # out of the pinion in either case
        for direction, R in (
            (k.minor_axis[i], k.R_x[i]),
            (k.major_axis[i], k.R_y[i]),
            (k.xi[i], k.R_sliding[i]),
        ):
            sides = gap_at(path, i, n, k.r[i] + h * direction) + gap_at(
                path, i, n, k.r[i] - h * direction
            )
            second = (sides - 2.0 * gap_at(path, i, n, k.r[i])) / h**2
            # rounding of positions 1e-17/h^2 = 1e-9; fourth order h^2/R^2 = 1e-4 near the root
            assert second == pytest.approx(1.0 / R, rel=1e-3, abs=1e-3)


@pytest.mark.parametrize("side", SIDES)
def test_curvature_across_is_that_of_conjugate_line_contact(side):
    """The mismatch is small against the curvature across, so conjugate flanks come close.

    The pair's curvature exceeds the conjugate one by part of the profile crown of the curved
    blades, 2/(0.762 m) = 2.6 1/m, against 37 to 117 1/m; more where lead crown adds to it.
    """
    path = path_on_teeth(side)
    pair, k = path.pair, path_kinematics(path)
    gear = placed_sample(
        pair.gear, pair.gear_base, pair.gear_turn(path.gear_angle), path.gear_parameters
    )
    operators = shape_operator(gear)
    for i in range(path.gear_angle.size):
        # normal into the gear body; the operator of the outward normal changes sign with it
        speed_g = k.R_p[i] / k.R_g[i]
        result = conjugate_relative_curvature(
            shape_operator=-operators[i],
            normal=path.normal[i],
            velocity_1=speed_g * np.cross(GEAR_AXIS, k.r[i]),
            velocity_2=np.cross(PINION_AXIS, k.r[i] - PINION_POINT),
            omega_1=speed_g * GEAR_AXIS,
            omega_2=PINION_AXIS,
        )
        # found 0.92 to 0.98, and 0.9 to 1.5 deg between the directions
        assert 0.90 < k.R_x[i] * result.curvature < 1.0
        assert abs(result.across @ k.minor_axis[i]) > math.cos(math.radians(2.0))


@pytest.mark.parametrize("side", SIDES)
def test_flanks_touch_like_a_bowl_of_ellipses(side):
    path = path_on_teeth(side, 31)
    k = path_kinematics(path)
    assert (k.R_y > k.R_x).all()
    assert (k.R_x > 0.0).all()
    axes = np.stack([k.minor_axis, k.major_axis, k.normal], axis=1)
    # orthonormal to rounding
    np.testing.assert_allclose(
        axes @ axes.transpose(0, 2, 1), np.broadcast_to(np.eye(3), axes.shape), atol=1e-12
    )
    assert np.all(np.einsum("ni,ni->n", k.minor_axis, k.entrainment) >= 0.0)


@pytest.mark.parametrize("side", SIDES)
def test_radii_are_the_arms_of_the_normal_force(side):
    """Moment about each axis of a unit force along n, by moments about the axes' own points."""
    k = path_kinematics(path_on_teeth(side))
    arm_p = np.cross(k.r - PINION_POINT, k.normal) @ PINION_AXIS
    arm_g = np.cross(k.r, k.normal) @ GEAR_AXIS
    # closed form, rounding
    np.testing.assert_allclose(k.R_p, arm_p, rtol=1e-12)
    np.testing.assert_allclose(k.R_g, arm_g, rtol=1e-12)
    assert (k.R_p > 0.0).all()
    assert (k.R_g > 0.0).all()


@pytest.mark.parametrize("side", SIDES)
def test_normal_points_into_the_gear_on_drive_and_out_of_it_on_coast_flanks(side):
    path = path_on_teeth(side)
    into_gear = path.normal  # out of the pinion tooth
    k = path_kinematics(path)
    sign = {"drive": 1.0, "coast": -1.0}[side]
    np.testing.assert_allclose(k.normal, sign * into_gear, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("side", SIDES)
def test_friction_arms_follow_karagiannis_equations_8_9_12_19(side):
    k = path_kinematics(path_on_teeth(side))
    arm_p = np.einsum("ni,ni->n", k.xi, np.cross(PINION_AXIS, k.r - PINION_POINT))
    arm_g = np.einsum("ni,ni->n", k.xi, np.cross(GEAR_AXIS, k.r))
    # closed form, rounding
    np.testing.assert_allclose(k.friction_arm_p, arm_p, rtol=1e-12)
    np.testing.assert_allclose(k.friction_arm_g, arm_g, rtol=1e-12)
    sliding = np.linalg.norm(k.sliding, axis=1)
    np.testing.assert_allclose(arm_p - arm_g / RATIO, sliding, rtol=1e-12)
    along = np.einsum("ni,ni->n", k.entrainment, k.xi)
    np.testing.assert_allclose(0.5 * (arm_p + arm_g / RATIO), along, rtol=1e-12)


@pytest.mark.parametrize("side", SIDES)
def test_friction_always_loses_power(side):
    """Friction -f xi on the pinion, +f xi on the gear: power -f (w_p r_p - w_g r_g) <= 0."""
    k = path_kinematics(path_on_teeth(side, 31))
    assert (k.friction_arm_p - k.friction_arm_g / RATIO > 0.0).all()


def test_entrainment_angle_is_measured_from_the_minor_axis():
    k = path_kinematics(path_on_teeth("drive"))
    arm = k.entrainment_arm
    along = np.abs(np.einsum("ni,ni->n", k.entrainment, k.minor_axis))
    # closed form, rounding
    np.testing.assert_allclose(arm * np.cos(k.psi), along, rtol=1e-12)
    assert ((k.psi >= 0.0) & (k.psi <= 0.5 * math.pi)).all()


@pytest.mark.parametrize("side", SIDES)
def test_opposite_points_near_the_contact_give_nearly_its_kinematics(side):
    """A centre of pressure 0.5 mm along the ellipse has its own point on either flank."""
    path = path_on_teeth(side, 3)
    pair, k = path.pair, path_kinematics(path)
    i = 1
    placed = pair.pinion_placed(path.pinion_angle[i])
    origin = k.r[i] + 5e-4 * k.major_axis[i]
    gear_x = np.array([*path.gear_parameters[i], 0.0])
    pinion_x = np.array([*path.pinion_parameters[i], 0.0])
    direction = Vector(*k.normal[i])
    gear_placed = pair.gear_placed(path.gear_angle[i])
    assert intersect_line(pair.gear.motion, gear_placed, Vector(*origin), direction, gear_x) == HIT
    assert intersect_line(pair.pinion.motion, placed, Vector(*origin), direction, pinion_x) == HIT
    near = contact_kinematics(
        pair, path.gear_angle[[i]], path.pinion_angle[[i]], gear_x[None, :3], pinion_x[None, :3]
    )
    # 0.5 mm of radii of 20 mm and more
    assert near.R_p[0] == pytest.approx(k.R_p[i], rel=0.03)
    assert near.R_x[0] == pytest.approx(k.R_x[i], rel=0.05)
    assert near.psi[0] == pytest.approx(k.psi[i], abs=0.05)
    assert np.linalg.norm(near.r[0] - origin) < 1e-5
    # both flanks lean apart by 0.5 mm / R_y there; the common normal halves it
    assert near.normal[0] @ k.normal[i] < 1.0 - 1e-10


def test_points_that_are_not_opposite_are_refused():
    path = path_on_teeth("drive", 3)
    moved = path.pinion_parameters.copy()
    moved[1, 0] += 2e-3
    with pytest.raises(
        ParameterError, match=r"points of both flanks must be opposite .*position 1"
    ):
        contact_kinematics(
            path.pair, path.gear_angle, path.pinion_angle, path.gear_parameters, moved
        )


def test_positions_without_contact_stay_without_numbers():
    path = contact_path(shipped_pair("drive"), np.array([0.0, -3.0]))
    k = path_kinematics(path)
    assert np.isfinite(k.R_x[0])
    assert np.isnan(k.R_x[1])
    assert np.isnan(k.normal[1]).all()


def test_a_tilted_pinion_axis_tilts_its_arms():
    pair = displaced("drive", shaft_angle=5e-4)
    path = contact_path(pair, np.array([0.05]))
    k = path_kinematics(path)
    axis = np.array([-math.cos(5e-4), 0.0, math.sin(5e-4)])
    arm = np.cross(axis, k.r[0] - PINION_POINT)
    # closed form, rounding
    assert k.R_p[0] == pytest.approx(k.normal[0] @ arm, rel=1e-12)
