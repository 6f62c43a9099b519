"""Dang Van's number and smallest balls against closed forms."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scipy.optimize import minimize

from gearlube_core.contact.dang_van import (
    QUENCHED_42CRMO4,
    FatigueLimits,
    dang_van_number,
    followed_history,
    passage_history,
    smallest_ball,
)
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

STEEL = FatigueLimits(bending=400e6, torsion=250e6)  # alpha = 0.375
TURN = np.linspace(0.0, 2.0 * np.pi, 49)


def number(limits: FatigueLimits = STEEL, residual=None, **components: np.ndarray) -> float:
    history = np.zeros((TURN.size, 6))
    for name, values in components.items():
        history[:, ("xx", "yy", "zz", "xy", "yz", "xz").index(name)] = values
    return float(dang_van_number(history, limits, residual, tolerance=1e-6))


def test_both_fatigue_limits_come_back():
    # alpha and the denominator are made so
    assert number(xx=400e6 * np.cos(TURN)) == pytest.approx(1.0, rel=1e-5)
    assert number(yz=250e6 * np.cos(TURN)) == pytest.approx(1.0, rel=1e-5)
    assert number(yy=100e6 * np.sin(TURN)) == pytest.approx(0.25, rel=1e-5)
    of = number(QUENCHED_42CRMO4, zz=398e6 * np.cos(TURN))
    assert of == pytest.approx(1.0, rel=1e-5)


def test_pulsating_tension_has_a_quarter_as_shear_and_a_third_as_pressure():
    # deviator: a straight path, its middle is taken off; at the top s/4 + alpha s/3
    pulse = 0.5 * 300e6 * (1.0 + np.cos(TURN))
    expected = (300e6 / 4.0 + 0.375 * 300e6 / 3.0) / 250e6
    assert number(xx=pulse) == pytest.approx(expected, rel=1e-5)
    # and pulsating pressure is worst where it is gone: s/4
    assert number(xx=-pulse) == pytest.approx(300e6 / 4.0 / 250e6, rel=1e-5)


def test_constant_shear_does_nothing_and_constant_pressure_shifts():
    swing = 100e6 * np.cos(TURN)
    assert number(xy=swing + 70e6) == pytest.approx(0.4, rel=1e-5)
    shifted = number(xy=swing, xx=-80e6 + 0.0 * TURN, yy=-80e6 + 0.0 * TURN, zz=-80e6 + 0.0 * TURN)
    assert shifted == pytest.approx(0.4 - 0.375 * 80.0 / 250.0, rel=1e-5)
    residual = np.array([-240e6, 0.0, 0.0, 50e6, 0.0, 0.0])
    assert number(xy=swing, residual=residual) == pytest.approx(shifted, rel=1e-5)


def test_shear_that_turns_is_as_strong_at_each_time():
    # a circle in the space of deviators: its middle is its centre
    turning = number(xz=120e6 * np.cos(TURN) + 30e6, yz=120e6 * np.sin(TURN) - 10e6)
    assert turning == pytest.approx(120.0 / 250.0, rel=1e-4)


def test_places_are_independent():
    random = np.random.default_rng(1)
    history = 1e8 * random.standard_normal((20, 6, 2, 3))
    found = dang_van_number(history, STEEL)
    assert found.shape == (2, 3)
    for i, j in itertools.product(range(2), range(3)):
        assert found[i, j] == pytest.approx(float(dang_van_number(history[:, :, i, j], STEEL)))


def ball(points: np.ndarray, tolerance: float = 1e-7) -> tuple[float, np.ndarray, int]:
    centre = np.zeros(5)
    radius, steps = smallest_ball(points, tolerance, 20_000, np.zeros(len(points)), centre)
    return radius, centre, steps


def test_smallest_balls_of_simple_points():
    one = np.ones((3, 5))
    assert ball(one)[0] == 0.0
    two = np.array([[0.0] * 5, [2.0, 0.0, 0.0, 0.0, 0.0], [1.0, 0.9, 0.0, 0.0, 0.0]])
    radius, centre, _ = ball(two)
    assert radius == pytest.approx(1.0)
    assert centre == pytest.approx([1.0, 0.0, 0.0, 0.0, 0.0])
    # a regular simplex of five corners, edges sqrt(2): radius sqrt(1 - 1/5) about (1/5, ...)
    radius, centre, _ = ball(np.eye(5))
    assert radius == pytest.approx(0.8**0.5, rel=1e-6)
    assert centre == pytest.approx(np.full(5, 0.2), abs=1e-4)


def test_smallest_balls_of_many_points_are_those_of_another_method():
    random = np.random.default_rng(11)
    for _ in range(5):
        points = random.standard_normal((40, 5)) * np.array([3.0, 1.0, 1.0, 0.3, 0.01])
        radius, centre, _ = ball(points)
        # least r with |x - c|^2 <= r^2 by sequential quadratic programming
        found = minimize(
            lambda v: v[5],
            np.append(points.mean(axis=0), 100.0),
            constraints={
                "type": "ineq",
                "fun": lambda v, x=points: v[5] - ((x - v[:5]) ** 2).sum(axis=1),
            },
            method="SLSQP",
            options={"ftol": 1e-14, "maxiter": 500},
        )
        assert radius == pytest.approx(found.x[5] ** 0.5, rel=1e-5)
        # all points lie inside
        assert np.linalg.norm(points - centre, axis=1).max() <= radius * (1.0 + 1e-12)


def test_ball_kernel_equals_its_source():
    points = np.random.default_rng(3).standard_normal((15, 5))
    found = []
    for kernel in (smallest_ball, smallest_ball.py_func):
        weights, centre = np.zeros(15), np.zeros(5)
        found.append((*kernel(points, 1e-5, 5000, weights, centre), *centre, *weights))
    assert found[0] == pytest.approx(found[1], rel=1e-10, abs=1e-12)


def test_material_follows_its_surface():
    x = np.linspace(0.0, 1.0, 11)
    # stress that is straight in x and in time
    time = np.arange(4.0)
    stress = np.zeros((4, 6, 11, 2))
    stress[:, 2] = (2.0 * x + 3.0)[None, :, None] + 10.0 * time[:, None, None]
    places, travel = np.array([0.05, 0.2]), 0.13 * time
    found = followed_history(stress, x, travel, places)
    expected = 2.0 * (places + travel[:, None]) + 3.0 + 10.0 * time[:, None]
    assert found.shape == (4, 6, 2, 2)
    assert found[:, 2, :, 1] == pytest.approx(expected, rel=1e-12)
    assert followed_history(stress, x, travel + 5.0, places)[0, 2, 0, 0] == pytest.approx(5.0)
    assert passage_history(stress[0]).shape == (11, 6, 2)
    assert passage_history(stress[0])[3, 2, 1] == stress[0, 2, 3, 1]


@each(
    ("wrong", "words"),
    [
        (lambda: dang_van_number(np.zeros((1, 6)), STEEL), r"got \(1, 6\)"),
        (lambda: dang_van_number(np.zeros((4, 5)), STEEL), r"\(steps, 6, ...\)"),
        (lambda: dang_van_number(np.full((4, 6), np.inf), STEEL), "must be finite"),
        (
            lambda: dang_van_number(np.zeros((4, 6, 3)), STEEL, np.zeros(6)),
            r"residual must have the shape \(6, 3\)",
        ),
        (lambda: FatigueLimits(bending=400e6, torsion=100e6), "torsion over bending"),
        (
            lambda: followed_history(np.zeros((3, 6, 4)), np.zeros(4), np.zeros(2), np.zeros(1)),
            r"must have the shape \(2, 6, 4, ...\)",
        ),
    ],
)
def test_histories_that_cannot_be_are_refused(wrong, words: str):
    with pytest.raises(ParameterError, match=words):
        wrong()
