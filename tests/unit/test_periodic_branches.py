"""Branches of periodic motions: arc length, multipliers and special points."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.periodic import newton as module
from gearlube_core.periodic.branch import crossings, locate
from gearlube_core.periodic.floquet import (
    doubling_test,
    exchange_test,
    floquet_multipliers,
    stability_margin,
    stable,
    torus_pair,
    torus_test,
)
from gearlube_core.periodic.newton import ArclengthCorrector, Node, hermite, turning_angle
from tests.helpers.each import each


def node_at(angle):
    place = np.array([math.cos(angle), math.sin(angle)])
    return Node(place, np.array([-place[1], place[0]]), np.zeros(1), 1.0)


def evaluation_at(place):
    return SimpleNamespace(
        place=np.asarray(place),
        jacobian=2.0 * np.asarray(place)[None],
        monodromy=np.diag([1.0, 0.3]),
    )


@pytest.fixture
def branch(monkeypatch):
    """A corrector whose Newton's method goes to the circle along the plane that it is given."""

    def correct(problem, place, normal, settings):
        along = np.array([-normal[1], normal[0]])
        # |place + s along| = 1, the root nearer by
        b, c = place @ along, place @ place - 1.0
        root = math.sqrt(b * b - c) if b * b > c else math.nan
        s = min(-b - root, -b + root, key=abs)
        return SimpleNamespace(
            evaluation=evaluation_at(place + s * along), evaluations=3, converged=root == root
        )

    monkeypatch.setattr(module, "correct", correct)
    return ArclengthCorrector(SimpleNamespace(trivial_multipliers=1), None)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_point_has_its_unit_tangent_on_the_side_of_the_reference(branch, side):
    point = evaluation_at([0.6, 0.8])
    found = branch.node(point, side * np.array([0.1, 1.0]))
    np.testing.assert_allclose(found.tangent, side * np.array([-0.8, 0.6]), rtol=1e-13)
    # det [[1.2, 1.6], t] = +-(0.72 + 1.28)
    assert found.determinant == pytest.approx(side * 2.0, rel=1e-13)
    np.testing.assert_allclose(found.multipliers, [0.3])
    assert branch.node(point, np.array([0.6, 0.8])) is None  # across the branch
    heading = branch.first(point, side * np.array([-1.0, 0.0]))
    np.testing.assert_allclose(heading.tangent, side * np.array([-0.8, 0.6]), rtol=1e-13)


@pytest.mark.parametrize("fraction", [0.0, 0.25, 0.5, 0.9, 1.0])
def test_cubic_between_two_points_is_close_to_the_arc_and_exact_at_its_ends(branch, fraction):
    a, b = node_at(0.3), node_at(0.7)
    place, direction = hermite(a, b, fraction)
    np.testing.assert_allclose(np.linalg.norm(direction), 1.0, rtol=1e-14)
    # a Hermite cubic of an arc: fourth order in the angle, 0.4^4/384; tangents of chord length
    # in place of arc length cost (0.4)^2/24 of the sagitta 0.02
    assert np.linalg.norm(place) == pytest.approx(1.0, abs=4e-4)
    angle = 0.3 + 0.4 * fraction
    assert math.atan2(place[1], place[0]) == pytest.approx(angle, abs=2e-3)
    np.testing.assert_allclose(direction, [-math.sin(angle), math.cos(angle)], atol=1e-2)
    if fraction in (0.0, 1.0):
        end = a if fraction == 0.0 else b
        np.testing.assert_allclose(place, end.place, rtol=1e-14)
        np.testing.assert_allclose(direction, end.tangent, rtol=1e-14)
    found = branch.between(a, b, fraction)
    np.testing.assert_allclose(np.linalg.norm(found.place), 1.0, rtol=1e-13)
    assert branch.evaluations == 3
    # the direction is the derivative of the place
    if 0.0 < fraction < 1.0:
        step = hermite(a, b, fraction + 1e-6)[0] - hermite(a, b, fraction - 1e-6)[0]
        np.testing.assert_allclose(direction, step / np.linalg.norm(step), atol=1e-8)


def test_point_at_a_parameter_is_the_one_between(branch):
    found = branch.at_parameter(node_at(0.3), node_at(0.7), 0.5)
    np.testing.assert_allclose(found.place, [math.sqrt(0.75), 0.5], rtol=1e-12)
    np.testing.assert_allclose(found.tangent, [-0.5, math.sqrt(0.75)], rtol=1e-12)


def test_point_that_is_not_found_or_far_away_is_none(branch, monkeypatch):
    far = SimpleNamespace(evaluation=evaluation_at([0.3, 0.5]), evaluations=1, converged=True)
    monkeypatch.setattr(module, "correct", lambda *_: far)
    assert branch.at_parameter(node_at(0.3), node_at(0.7), 0.5) is None
    far.evaluation, far.converged = evaluation_at([math.sqrt(0.75), 0.5]), False
    assert branch.at_parameter(node_at(0.3), node_at(0.7), 0.5) is None
    assert branch.between(node_at(0.3), node_at(0.7), 0.5) is None
    assert branch.evaluations == 3


@pytest.mark.parametrize("angle", [0.05, 0.4, 1.5])
def test_branch_turns_by_the_angle_of_the_arc(angle):
    assert turning_angle(node_at(0.2), node_at(0.2 + angle)) == pytest.approx(angle, rel=1e-9)
    # twice from the chord where the tangents say nothing
    a = Node(np.zeros(2), np.array([0.0, 1.0]), np.zeros(1), 1.0)
    b = a._replace(place=np.array([math.sin(angle), math.cos(angle)]))
    assert turning_angle(a, b) == pytest.approx(2.0 * angle, rel=1e-9)
    # and from the tangents where the chord says nothing
    tangent = np.array([math.sin(angle), math.cos(angle)])
    b = Node(np.array([0.0, 2.0]), tangent, np.zeros(1), 1.0)
    assert turning_angle(a, b) == pytest.approx(angle, rel=1e-9)
    assert turning_angle(a, b._replace(tangent=a.tangent)) == 0.0


def multipliers(*values):
    return np.array(values, dtype=complex)


def matrix_with(*values):
    """A matrix with these eigenvalues in a basis of its own."""
    blocks = np.zeros((len(values), len(values)))
    k = 0
    while k < len(values):
        mu = complex(values[k])
        blocks[k, k] = mu.real
        if mu.imag != 0.0:  # its conjugate stands next
            blocks[k : k + 2, k : k + 2] = [[mu.real, -mu.imag], [mu.imag, mu.real]]
            k += 1
        k += 1
    basis = np.random.default_rng(len(values)).standard_normal(blocks.shape) + 3.0 * np.eye(k)
    return basis @ blocks @ np.linalg.inv(basis)


def test_multipliers_are_sorted_by_modulus_and_pairs_by_their_imaginary_part():
    found = floquet_multipliers(matrix_with(0.2, 0.3 + 0.6j, 0.3 - 0.6j, -0.9))
    np.testing.assert_allclose(found, [-0.9, 0.3 + 0.6j, 0.3 - 0.6j, 0.2], atol=1e-12)


@pytest.mark.parametrize(
    ("trivial", "left"), [(0, [-1.2, 1.12, 1.0, 0.4]), (1, [-1.2, 1.12, 0.4]), (2, [-1.2, 0.4])]
)
def test_trivial_multipliers_are_those_closest_to_one(trivial, left):
    found = floquet_multipliers(matrix_with(1.0, 1.12, -1.2, 0.4), trivial=trivial)
    np.testing.assert_allclose(found, left, atol=1e-12)


def test_motion_that_ran_away_has_no_multipliers():
    found = floquet_multipliers(np.array([[1.0, np.inf], [0.0, 1.0]]), trivial=1)
    assert found.shape == (1,)
    assert np.isnan(found).all()


def test_what_has_no_multipliers_is_refused():
    with pytest.raises(ParameterError, match=r"square, got shape \(2, 3\)"):
        floquet_multipliers(np.zeros((2, 3)))
    with pytest.raises(ParameterError, match="at most the 2 states, got 3"):
        floquet_multipliers(np.eye(2), trivial=3)
    assert floquet_multipliers(np.eye(2), trivial=2).size == 0


@each(
    ("mu", "margin"),
    [
        (multipliers(0.5, -0.8), 0.2),
        (multipliers(1.25, -0.8), -0.25),
        (multipliers(-1.25, 1.1), -0.25),
        (multipliers(0.9 + 1.2j, 0.9 - 1.2j, 1.1), -0.5),
        (multipliers(), 1.0),
        (multipliers(1.0), 0.0),
    ],
)
def test_stability_is_lost_with_the_largest_multiplier(mu, margin):
    assert stability_margin(mu) == pytest.approx(margin, abs=1e-15)
    assert stable(mu) == (margin > 0.0)


def test_test_functions_are_their_products():
    mu = multipliers(0.5, -0.25, 0.3 + 0.4j, 0.3 - 0.4j)
    # |1 - mu|^2 = 0.7^2 + 0.4^2 and |1 + mu|^2 = 1.3^2 + 0.4^2 of the pair
    assert exchange_test(mu) == pytest.approx(0.5 * 1.25 * 0.65, rel=1e-14)
    assert doubling_test(mu) == pytest.approx(1.5 * 0.75 * 1.85, rel=1e-14)
    # pairs: -1/8 - 1, 0.25 - 1 and |0.5 mu - 1|^2 and |-0.25 mu - 1|^2
    pairs = -1.125 * -0.75 * (0.85**2 + 0.2**2) * (1.075**2 + 0.1**2)
    assert torus_test(mu) == pytest.approx(pairs, rel=1e-14)


@pytest.mark.parametrize(
    ("name", "before", "after"),
    [
        (exchange_test, (0.9, -0.5), (1.1, -0.5)),
        (doubling_test, (-0.9, 0.5), (-1.1, 0.5)),
        (torus_test, (0.6 + 0.7j, 0.6 - 0.7j), (0.6 + 0.9j, 0.6 - 0.9j)),
    ],
)
def test_each_changes_sign_at_its_bifurcation_alone(name, before, after):
    for test in (exchange_test, doubling_test, torus_test):
        product = test(multipliers(*before)) * test(multipliers(*after))
        assert (product < 0.0) == (test is name)


def test_torus_has_a_complex_pair_closest_to_the_unit_circle():
    assert torus_pair(multipliers(0.2, 0.6 + 0.79j, 0.6 - 0.79j))
    assert not torus_pair(multipliers(2.0, 0.51, 0.3 + 0.4j, 0.3 - 0.4j))
    assert not torus_pair(multipliers(0.9))


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
            multipliers=multipliers, tangent=lambda t, beside=beside: 0.3 + beside - t, count=3
        )
        assert len(near.listed()) == count
