"""Kernels and inputs of the unloaded contact."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.contact_point import (
    APART,
    TOUCHING,
    UNKNOWNS,
    find_contact,
    linearise_contacts,
    solve_in_place,
)
from gearlube_core.hypoid_contact.ease_off import contact_pattern, ease_off
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import (
    Misalignment,
    place_direction,
    place_point,
    placed_axis,
    placed_sample,
    tooth_position,
)
from gearlube_core.hypoid_contact.searched_transmission_error import (
    first_contact_point,
    searched_transmission_error,
)
from gearlube_core.hypoid_contact.unloaded_error import unloaded_error
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from tests.helpers.contact_cases import SIDES, shipped_file, shipped_pair


def test_elimination_agrees_with_lapack():
    random = np.random.default_rng(7)
    for _ in range(20):
        rows = random.normal(size=(7, 8))
        expected = np.linalg.solve(rows[:, :7], rows[:, 7])
        assert solve_in_place(rows, 7)
        # rounding, magnified by the condition of a random matrix of this size
        np.testing.assert_allclose(rows[:, 7], expected, rtol=1e-9)


def test_elimination_needs_its_pivots():
    rows = np.array([[0.0, 2.0, 4.0], [3.0, 0.0, 6.0]])
    assert solve_in_place(rows, 2)
    np.testing.assert_array_equal(rows[:, 2], [2.0, 2.0])


def test_elimination_tells_a_singular_matrix():
    assert not solve_in_place(np.array([[1.0, 2.0, 1.0], [2.0, 4.0, 1.0]]), 2)


def start_of_search(side):
    pair = shipped_pair(side)
    touch = first_contact_point(pair, 0.0)
    x = np.concatenate([touch.gear_parameters, touch.pinion_parameters, [touch.pinion_turn]])
    facing = -pair.gear.outward * pair.pinion.outward
    motions = pair.gear.motion, pair.pinion.motion
    return (*motions, pair.gear_placed(0.0), pair.pinion_base), facing, x


@pytest.mark.parametrize("side", SIDES)
def test_contact_search_gives_the_same_compiled_and_not(side):
    arguments, facing, x = start_of_search(side)
    y = x.copy()
    rows = np.empty((UNKNOWNS, UNKNOWNS + 1))
    assert find_contact(*arguments, facing, x, rows) == TOUCHING
    assert find_contact.py_func(*arguments, facing, y, rows) == TOUCHING
    # contraction of products and sums differs; Newton's last step is below 1e-10 of 0.1 rad
    np.testing.assert_allclose(x, y, rtol=0.0, atol=1e-12)


def test_linearised_equations_are_the_same_compiled_and_not():
    pair = shipped_pair("drive")
    _, _, x = start_of_search("drive")
    motions = pair.gear.motion, pair.pinion.motion, pair.gear_base, pair.pinion_base
    found = np.empty((2, 1, UNKNOWNS, UNKNOWNS + 1))
    for k, run in enumerate((linearise_contacts, linearise_contacts.py_func)):
        run(*motions, np.array([pair.gear_turn(0.0)]), x[None], found[k])
    # contraction of products and sums differs, in entries of order one
    np.testing.assert_allclose(found[0], found[1], rtol=1e-9, atol=1e-12)


def test_surfaces_whose_bodies_overlap_are_apart():
    arguments, facing, x = start_of_search("drive")
    rows = np.empty((UNKNOWNS, UNKNOWNS + 1))
    assert find_contact(*arguments, -facing, x, rows) == APART


def test_a_start_that_is_no_number_is_apart():
    arguments, facing, x = start_of_search("drive")
    x[3] = np.nan
    assert find_contact(*arguments, facing, x, np.empty((UNKNOWNS, UNKNOWNS + 1))) == APART


@pytest.mark.parametrize("member", ["gear", "pinion"])
def test_placed_samples_follow_the_placement_kernels(member):
    pair = shipped_pair("drive").misaligned(
        Misalignment(pinion_offset=2e-4, pinion_axial=-3e-4, gear_axial=1e-4, shaft_angle=0.01)
    )
    flank = getattr(pair, member)
    angles = np.array([-0.3, 0.2])
    base = getattr(pair, f"{member}_base")
    turns = getattr(pair, f"{member}_turn")(angles)
    parameters = flank.parameters(np.array([0.5, 0.6]), np.array([0.3, 0.7]))
    placed = placed_sample(flank, base, turns, parameters)
    own = flank.sample_parameters(parameters)
    for k, angle in enumerate(angles):
        placement = getattr(pair, f"{member}_placed")(angle)
        # two routes of the same rigid motion: rounding of 0.1 m
        np.testing.assert_allclose(
            placed.r[k], place_point(placement, Vector(*own.r[k])), rtol=0.0, atol=1e-15
        )
        np.testing.assert_allclose(
            placed.normal[k], place_direction(placement, Vector(*own.normal[k])), atol=1e-14
        )
    axis, point = placed_axis(flank, base)
    # a point of the axis stays where the rotation is
    np.testing.assert_allclose(point, place_point(placement, Vector(*flank.axis_point)), atol=1e-15)
    np.testing.assert_allclose(axis, place_direction(placement, Vector(*flank.axis)), atol=1e-15)


def test_tooth_position_inverts_the_flank_grid():
    flank = shipped_pair("drive").pinion
    s, t = np.meshgrid([0.4, 0.8], [0.2, 0.9], indexing="ij")
    found = tooth_position(flank, flank.sample(s, t).r)
    # the flank search ends at 1e-11 of its largest steps
    np.testing.assert_allclose(found, (s, t), rtol=0.0, atol=1e-9)


@pytest.mark.parametrize(("correction", "edge"), [(3.0, "s = 1.00"), (-3.0, "s = 0")])
def test_flanks_that_meet_at_an_edge_say_where_and_what_to_check(correction, edge):
    field = "pinion.cutter.concave_flank_angle_correction_deg"
    pair = FlankPair.from_file(shipped_file().varied({field: correction}), "drive")
    with pytest.raises(ParameterError, match=rf"at the edge, near .* {edge}.*flank angle"):
        contact_path(pair, np.array([0.0]))


def test_members_that_do_not_reach_each_other_say_so():
    pair = shipped_pair("drive").misaligned(Misalignment(gear_axial=5e-3))
    with pytest.raises(ParameterError, match="must touch in a point of both teeth"):
        contact_path(pair, np.array([0.0]))


def test_sawtooth_errors_name_the_route_that_finds_them():
    field = "pinion.cutter.concave_flank_angle_correction_deg"
    pair = FlankPair.from_file(shipped_file().varied({field: 0.0}), "drive")
    with pytest.raises(ParameterError, match=r"sawtooth \(searched_transmission_error"):
        unloaded_error(pair)


def test_a_pair_out_of_mesh_has_no_searched_transmission_error():
    pair = shipped_pair("drive")
    assert np.isnan(
        searched_transmission_error(pair, np.array([-3.0, 3.0]) * pair.gear_pitch).error
    ).all()


def test_contact_is_not_a_number_where_the_search_ends():
    pair = shipped_pair("drive")
    path = contact_path(pair, np.array([0.0, -3.0]))
    assert np.isfinite(path.transmission_error[0])
    assert np.isnan(path.transmission_error[1])
    assert not path.inside[1]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: ease_off(shipped_pair("drive"), s_count=2), "s_count must be within 3"),
        (lambda: ease_off(shipped_pair("drive"), t_count=10**6), "t_count must be within 3"),
        (lambda: unloaded_error(shipped_pair("drive"), 2), "count must be within 3"),
        (
            lambda: contact_pattern(
                ease_off(shipped_pair("drive"), s_count=3, t_count=3), thickness=1.0
            ),
            "thickness must be within 1e-07 to 0.0001 m",
        ),
    ],
)
def test_inputs_out_of_range_name_the_range(call, words):
    with pytest.raises(ParameterError, match=words):
        call()
