"""Points of a branch that is a circle: place (y, parameter) with y^2 + parameter^2 = 1."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.periodic import newton as module
from gearlube_core.periodic.newton import ArclengthCorrector, Node, hermite, turning_angle


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
