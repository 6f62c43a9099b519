"""Search for special points between two points of a branch, on made-up branches."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.periodic.newton import Node
from gearlube_core.periodic.special_points import crossings, locate
from tests.helpers.each import each

TOLERANCE = 1e-7


def still(_: float) -> np.ndarray:
    return np.array([0.5 + 0.0j, 0.3])


class Branch:
    """A straight branch along t, whose test functions are given; counts the points asked for."""

    def __init__(
        self,
        determinant: Callable[[float], float] = lambda t: 1.0,
        tangent: Callable[[float], float] = lambda t: 1.0,
        multipliers: Callable[[float], np.ndarray] = still,
        count: int = 2,
        found: Callable[[float], bool] = lambda t: True,
    ) -> None:
        self.problem = SimpleNamespace(count=count)
        self.asked: list[float] = []
        self._parts = determinant, tangent, multipliers
        self._found = found

    def at(self, t: float) -> Node:
        determinant, tangent, multipliers = self._parts
        direction = np.array([1.0, tangent(t)])
        return Node(np.array([t, 0.2]), direction, multipliers(t), determinant(t))

    def between(self, a: Node, b: Node, fraction: float) -> Node | None:
        t = float(a.place[0] + fraction * (b.place[0] - a.place[0]))
        self.asked.append(t)
        return self.at(t) if self._found(t) else None

    def listed(self, first: float = 0.0, last: float = 1.0) -> list[tuple[str, float]]:
        found = crossings(self, self.at(first), self.at(last), TOLERANCE)
        return [(one.kind, float(one.node.place[0])) for one in found]


def determinant(node: Node) -> float:
    return node.determinant


def search(branch: Branch, first: float = 0.0, last: float = 1.0):
    return locate(branch, branch.at(first), branch.at(last), determinant, TOLERANCE)


@each("sign", [1.0, -1.0])
@each(
    ("function", "root", "most"),
    [
        (lambda t: t - 0.37, 0.37, 2),
        (lambda t: t**3 - 0.1, 0.1 ** (1.0 / 3.0), 12),
        (lambda t: math.expm1(20.0 * (t - 0.6)), 0.6, 26),
        (lambda t: (t - 0.3) ** 3, 0.3, 50),
    ],
)
def test_zero_is_found_in_few_trials(sign: float, function, root: float, most: int):
    branch = Branch(determinant=lambda t: sign * function(t))
    node, width, smooth = search(branch)
    # the width that is asked for holds the zero, or the zero was hit
    assert width <= TOLERANCE
    assert float(node.place[0]) == pytest.approx(root, abs=TOLERANCE)
    assert smooth
    assert len(branch.asked) <= most
    assert all(0.0 < t < 1.0 for t in branch.asked)


def test_jump_is_told_from_a_zero():
    branch = Branch(determinant=lambda t: 1.0 if t > 0.3 else -0.8)
    node, width, smooth = search(branch)
    assert not smooth
    assert float(node.place[0]) == pytest.approx(0.3, abs=TOLERANCE)
    assert width <= TOLERANCE
    # of the two ends the one with the smaller value
    assert node.determinant == -0.8
    # a jump over the twentieth part of the size is a zero, over more it is none
    for gone, expected in ((0.049, True), (0.051, False)):
        small = Branch(determinant=lambda t, gone=gone: gone if t > 0.3 else t - 1.3)
        small_from = small.at(0.3), small.at(1.0)
        assert small_from[0].determinant == -1.0
        assert search(small, 0.3, 1.0)[2] == expected
    # between points that lie closer than a hundred tolerances nothing is told
    near = 0.3 - 49.0 * TOLERANCE, 0.3 + 49.0 * TOLERANCE
    assert search(branch, *near)[2]
    far = 0.3 - 51.0 * TOLERANCE, 0.3 + 51.0 * TOLERANCE
    assert not search(branch, *far)[2]


def test_zero_at_the_end_needs_no_trial_and_one_that_is_hit_has_no_width():
    branch = Branch(determinant=lambda t: t - 1.0)
    node, width, smooth = search(branch)
    assert (float(node.place[0]), width, smooth, branch.asked) == (1.0, 1.0, True, [])
    branch = Branch(determinant=lambda t: t - 0.5)
    node, width, smooth = search(branch)
    assert (float(node.place[0]), width, smooth, len(branch.asked)) == (0.5, 0.0, True, 1)


def test_search_that_fails_returns_the_better_end_and_its_width():
    branch = Branch(determinant=lambda t: t**3 - 0.1, found=lambda t: t < 0.2)
    node, width, _ = search(branch)
    assert len(branch.asked) >= 2
    reached = max(t for t in branch.asked if t < 0.2)
    # |0.1^3 - 0.1| at 0.1 is less than 0.9 at 1
    assert float(node.place[0]) == reached
    assert width == pytest.approx(1.0 - reached)


def test_search_ends_after_eighty_trials():
    # false position comes slowly to a zero of ninth order
    branch = Branch(determinant=lambda t: (t - 0.3) ** 9)
    _, width, smooth = search(branch)
    assert len(branch.asked) == 80
    assert width > TOLERANCE
    assert smooth


def test_points_are_listed_in_the_order_they_are_met():
    def multipliers(t: float) -> np.ndarray:
        # one multiplier through -1 at 0.8, a pair through the unit circle at 0.4
        pair = (0.6 + t) * np.exp(1.3j)
        return np.array([-0.2 - t, pair, np.conj(pair)])

    branch = Branch(
        determinant=lambda t: 0.2 - t, tangent=lambda t: 0.6 - t, multipliers=multipliers
    )
    expected = [
        ("branch point", 0.2),
        ("Neimark-Sacker", 0.4),
        ("fold", 0.6),
        ("period doubling", 0.8),
    ]
    found = branch.listed()
    assert [kind for kind, _ in found] == [kind for kind, _ in expected]
    assert [t for _, t in found] == pytest.approx([t for _, t in expected], abs=TOLERANCE)
    # and backwards
    assert [kind for kind, _ in branch.listed(1.0, 0.0)] == [kind for kind, _ in expected[::-1]]


def test_first_point_is_left_out_and_the_last_is_not():
    branch = Branch(tangent=lambda t: 0.5 - t)
    assert branch.listed(0.5, 1.0) == []
    assert branch.listed(0.0, 0.5) == [("fold", 0.5)]
    assert branch.listed(0.0, 0.4) == []


def test_noise_and_numbers_that_are_not_finite_are_no_points():
    for size, kinds in ((0.9e-8, []), (2.2e-8, ["branch point"])):
        branch = Branch(determinant=lambda t, size=size: size * (t - 0.5) / 0.5)
        assert [kind for kind, _ in branch.listed()] == kinds
    assert Branch(determinant=lambda t: math.inf if t > 0.5 else -1.0).listed() == []


def test_extremum_of_the_parameter_at_a_branch_point_is_no_fold():
    for beside, kinds in ((0.0, 1), (900.0 * TOLERANCE, 1), (1100.0 * TOLERANCE, 2)):
        branch = Branch(
            determinant=lambda t: t - 0.3, tangent=lambda t, beside=beside: 0.3 + beside - t
        )
        assert len(branch.listed()) == kinds


def test_two_real_reciprocal_multipliers_are_no_torus():
    branch = Branch(multipliers=lambda t: np.array([2.0 + 0j, 0.25 + 0.5 * t]))
    assert branch.listed() == []


def test_exchange_is_looked_for_where_there_are_more_unknowns_than_multipliers():
    def multipliers(t: float) -> np.ndarray:
        return np.array([0.7 + t, 0.1 + 0j])

    assert Branch(multipliers=multipliers).listed() == []
    apart = Branch(multipliers=multipliers, count=3)
    assert apart.listed() == [("exchange", pytest.approx(0.3, abs=TOLERANCE))]
    # a fold brings the multiplier through one with it
    fold = Branch(multipliers=multipliers, tangent=lambda t: 0.3 - t, count=3)
    assert [kind for kind, _ in fold.listed()] == ["fold"]
    # as far as a thousandth of the test's size, or a thousand tolerances
    for beside, count in ((0.6e-3, 1), (0.9e-3, 2)):
        near = Branch(
            multipliers=multipliers,
            tangent=lambda t, beside=beside: 0.3 + beside - t,
            count=3,
        )
        assert len(near.listed()) == count
