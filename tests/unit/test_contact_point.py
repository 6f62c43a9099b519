"""Contact points of a hypoid pair: search, rotations and arms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.hypoid_contact import contact_rotations, placement
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.contact_point import (
    APART,
    TOUCHING,
    UNKNOWNS,
    find_contact,
    linearise_contacts,
    solve_in_place,
)
from gearlube_core.hypoid_contact.ease_off import ease_off
from gearlube_core.hypoid_contact.flank_intersection import HIT, MISSED
from gearlube_core.hypoid_contact.gap_map import GapMap
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import (
    Misalignment,
    Placement,
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
from gearlube_core.hypoid_contact.strips import strip_frame
from gearlube_core.hypoid_contact.unloaded_error import unloaded_error
from gearlube_core.hypoid_geometry.flank import vectors
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from tests.helpers.contact_cases import SIDES, shipped_file, shipped_pair
from tests.helpers.source_of import interpret


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
    ],
)
def test_inputs_out_of_range_name_the_range(call, words):
    with pytest.raises(ParameterError, match=words):
        call()


RATIO, TURN = 2.75, 0.4  # rotations are far apart, so that a start has to move with the gear
AXIS = np.array([2.0, -1.0, 2.0]) / 3.0
POINT, SHIFT, TILT = np.array([0.02, 0.01, -0.03]), np.array([0.004, -0.003, 0.001]), 0.3
GEAR = Placement(
    Vector(*POINT), Vector(*AXIS), 1.0, 0.0, math.cos(TILT), math.sin(TILT), Vector(*SHIFT)
)
PINION = GEAR._replace(shift=Vector(9.0, 9.0, 9.0))
SHAPE = (4, 5)
CENTRE = (2, 2)  # of the grid, where the search begins
POINTS = np.random.default_rng(6).uniform(-0.05, 0.05, (*SHAPE, 3))
NEAR = 1.05  # neighbours in the grid and among the angles are one apart


def truth(k: int, i: int, j: int) -> np.ndarray:
    """Return what the search is to find; a step of any index changes it by one and the turn."""
    return np.array([float(i), float(j), float(k), 0.3 * i - RATIO * TURN * k])


class Flank:
    """Stand-in that hits from near the truth only, and not where there is no flank."""

    def __init__(self, turns: np.ndarray, without: set[tuple[int, int, int]]) -> None:
        self.calls: list[tuple[int, int, int]] = []
        self._without = without
        self._targets = {}
        for k, turn in enumerate(turns):
            own = (POINTS - POINT).reshape(-1, 3)
            placed = Rotation.from_rotvec(turn * AXIS).apply(own) + POINT
            placed = Rotation.from_rotvec([0.0, TILT, 0.0]).apply(placed) + SHIFT
            for index, one in zip(np.ndindex(SHAPE), placed, strict=True):
                self._targets[tuple(one.round(9))] = (k, *index)

    def __call__(self, motion, place, target, parameters) -> int:
        assert motion == "pinion"
        assert place is PINION
        here = self._targets[tuple(np.round(target, 9))]
        self.calls.append(here)
        off = np.abs(parameters - truth(*here))
        if here in self._without or off[:3].sum() > NEAR or off[3] > 0.31:
            parameters[:] = 77.0
            return MISSED
        parameters[:] = truth(*here)
        return HIT


def search(monkeypatch, count: int, middle: int, without=(), holes=()) -> tuple[Flank, np.ndarray]:
    turns = TURN * np.arange(count)
    flank = Flank(turns, set(without))
    interpret(monkeypatch, contact_rotations, placement, vectors)
    monkeypatch.setattr(contact_rotations, "intersect_rotation", flank)
    points = POINTS.copy()
    for hole in holes:
        points[hole] = math.nan
    found = np.full((count, *SHAPE, 4), math.nan)
    start = truth(middle, *CENTRE)
    contact_rotations.find_contact_rotations(
        "pinion", PINION, GEAR, points, turns, middle, RATIO, start, found
    )
    assert (start == truth(middle, *CENTRE)).all()
    return flank, found


def expected(count: int, without=(), holes=()) -> np.ndarray:
    whole = np.array([truth(*at) for at in np.ndindex(count, *SHAPE)]).reshape(count, *SHAPE, 4)
    for at in without:
        whole[at] = math.nan
    for hole in holes:
        whole[:, *hole] = math.nan
    return whole


@pytest.mark.parametrize(("count", "middle"), [(5, 2), (4, 1), (3, 0), (3, 2), (1, 0)])
def test_every_point_is_hit_from_the_first_start(monkeypatch, count: int, middle: int):
    flank, found = search(monkeypatch, count, middle)
    assert found == pytest.approx(expected(count))
    assert len(flank.calls) == count * SHAPE[0] * SHAPE[1]
    # from the middle angle up, then down; from the centre of the grid outwards
    angles = list(dict.fromkeys(k for k, _, _ in flank.calls))
    assert angles == [*range(middle, count), *range(middle - 1, -1, -1)]
    assert flank.calls[0] == (middle, *CENTRE)


def test_points_that_are_left_out_are_gone_around(monkeypatch):
    # what lies beyond along j is reached along i
    holes = [(0, 1), (3, 3)]
    flank, found = search(monkeypatch, 2, 0, holes=holes)
    assert found == pytest.approx(expected(2, holes=holes), nan_ok=True)
    assert len(flank.calls) == 2 * (SHAPE[0] * SHAPE[1] - 2)


def test_where_there_is_no_flank_a_neighbour_is_tried_and_nan_remains(monkeypatch):
    # an edge that the flank reaches at later angles only
    without = [(1, 3, 4), (2, 3, 4), (1, 0, 0), (1, 0, 1), (0, 1, 4)]
    _, found = search(monkeypatch, 4, 1, without)
    assert found == pytest.approx(expected(4, without), nan_ok=True)


def test_centre_that_is_missed_is_looked_for_from_the_start_at_the_next_angle(monkeypatch):
    # its neighbours are reached from the start itself, which is as near to them
    without = [(1, *CENTRE)]
    flank, found = search(monkeypatch, 3, 1, without)
    assert found == pytest.approx(expected(3, without), nan_ok=True)
    assert flank.calls.count((2, *CENTRE)) == 1
    assert flank.calls.count((0, *CENTRE)) == 1


def test_rotations_from_near_by_start_from_their_own_values(monkeypatch):
    turns = np.zeros(1)
    flank = Flank(turns, {(0, 1, 1)})
    interpret(monkeypatch, contact_rotations, placement, vectors)
    monkeypatch.setattr(contact_rotations, "intersect_rotation", flank)
    places = [(0, 1), (1, 1), (3, 4)]
    found = np.array([truth(0, *at) + 0.2 for at in places])
    points = np.array([POINTS[at] for at in places])
    contact_rotations.rotations_to_points("pinion", PINION, GEAR, points, np.zeros(3), found)
    whole = np.array([truth(0, *at) for at in places])
    whole[1] = math.nan  # where there is no flank
    np.testing.assert_array_equal(found, whole)


def gaps(gap: list[float], arm: list[float]) -> GapMap:
    points = np.zeros((1, len(gap), 3))
    return GapMap(np.array([gap]), points, points, points, points, np.array([arm]))


def test_gaps_with_an_arm_of_zero_or_less_close_at_no_rotation():
    """Two pitches away, flanks of 9 x 41 teeth move apart: inf over a negative arm was -inf."""
    found = gaps(
        [2e-6, math.inf, 1e-6, 3e-6, -1e-6], [0.02, -0.01, 0.0, math.nan, -0.02]
    ).touching_rotation
    np.testing.assert_array_equal(found, [[2e-6 / 0.02, *4 * [math.inf]]])


def test_a_strip_lies_on_the_contact_where_a_corner_of_the_gear_has_no_flank():
    """Points that the gear lacks are NaN; one of them was taken for the nearest to the contact."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, 5), np.linspace(-4.0, 4.0, 9), indexing="ij")
    point = 1e-3 * np.stack([x, y, 0.0 * x], axis=-1)
    normal = np.broadcast_to([0.0, 0.0, 1.0], point.shape).copy()
    gap = 1e-6 * (x**2 + 0.1 * y**2)
    for field in (point, normal):
        field[:2, 0] = math.nan
    gap[:2, 0] = math.inf
    frame = strip_frame(GapMap(gap, point, normal, point, point, np.full(gap.shape, 0.02)), 1.7e-6)
    np.testing.assert_allclose(np.abs(frame.along), [0.0, 1.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(frame.centre, 0.0, atol=1e-9)
    # all columns touch: 8 mm and three halves of the step of 1 mm at both ends
    assert frame.half_length == pytest.approx(5.5e-3, rel=1e-6)


def test_the_first_contact_is_not_where_flanks_part():
    near, far = gaps([1e-6], [0.02]), gaps([math.inf], [-0.01])
    position = MeshPosition(None, 0.0, (0.0, 1.0), (near, far))
    assert position.unloaded_rotation == pytest.approx(5e-5)


def test_teeth_that_meet_nowhere_are_said_to_do_so():
    nowhere = gaps([math.inf], [0.02])
    position = MeshPosition(None, 0.25, (0.25,), (nowhere,))
    with pytest.raises(ConvergenceError, match=r"The teeth must meet at mesh phase 0\.250"):
        position.load(50.0, None, LoadedSettings())
