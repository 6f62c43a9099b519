"""Order and starts of the search for rotations to contact, with a stand-in for the intersection."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gearlube_core.hypoid_contact import contact_rotations, placement
from gearlube_core.hypoid_contact.flank_intersection import HIT, MISSED
from gearlube_core.hypoid_contact.placement import Placement
from gearlube_core.hypoid_geometry.flank import vectors
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from tests.helpers.source_of import interpret

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
