"""Starts of a line film: nested grids, dry pressure, states on another grid."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.line import newton
from gearlube_core.ehl.line.solver import grid_nest, hertz_start, interpolate
from gearlube_core.ehl.line.system import LineState
from tests.helpers.each import each


@each(
    ("nodes", "coarsest", "expected"),
    [
        (257, 33, [33, 65, 129, 257]),
        (257, 34, [65, 129, 257]),
        (100, 25, [25, 50, 100]),
        (100, 26, [50, 100]),
        (30, 26, [30]),
    ],
)
def test_grids_have_about_half_the_nodes_down_to_the_coarsest(nodes, coarsest, expected):
    assert grid_nest(SimpleNamespace(nodes=nodes, coarsest=coarsest)) == expected


def system(speed: float, load: float = 0.5 * np.pi) -> SimpleNamespace:
    X = np.linspace(-3.0, 2.0, 201)
    return SimpleNamespace(
        X=X, x=X, step=X[1] - X[0], load=load, gap=0.5 * X**2 + 0.3,
        scales=SimpleNamespace(film=1e-7), coefficients=SimpleNamespace(speed=speed),
        deflection=lambda P: 0.2 * P,
    )  # fmt: skip


@each("speed", [1.0, -1.0])
@each(
    ("load", "film", "width"),
    [
        (0.5 * np.pi, 1e-8, 1.0),
        (0.5 * np.pi * 1.44, 1e-8, 1.2),  # of Hertz, with the root of the load
        (0.5 * np.pi, 4.5e-7, 1.5),  # root of half the film
    ],
)
def test_dry_pressure_carries_the_load_and_the_inlet_is_seeded(speed, load, film, width):
    given = system(speed, load)
    start = hertz_start(given, film)
    X, inner = given.X, np.abs(given.X) < width - 1e-9
    shape = np.sqrt(np.maximum(1.0 - (X / width) ** 2, 0.0))
    # a half ellipse with the load as its sum
    largest = load / (given.step * shape.sum())
    assert largest == pytest.approx(load / (0.5 * np.pi * width), rel=1e-2)
    assert start.P[inner] == pytest.approx(largest * shape[inner])
    upstream = ~inner & (X * speed < 0.0)
    upstream[[0, -1]] = False
    assert (start.P[upstream] == 1e-6).all()
    assert not start.P[~inner & ~upstream].any()
    assert not start.void.any()
    # film at the middle, under its pressure
    assert start.H0 + 0.3 + 0.2 * largest == pytest.approx(film / 1e-7, rel=1e-12)


def test_state_on_another_grid_is_cubic_within_the_pressure_and_broken_beside_it():
    x = np.linspace(-3.0, 2.0, 41)
    P = np.maximum(0.0, 1.0 - x**2)
    found = interpolate(LineState(P, 0.1 * (x + 3.0), -0.4), x, system(1.0))
    new = system(1.0).X
    inside = np.abs(new) < 0.7
    assert found.P[inside] == pytest.approx(1.0 - new[inside] ** 2, abs=2e-3)
    assert not found.P[np.abs(new) >= 1.0].any()
    assert found.void == pytest.approx(0.1 * (new + 3.0))
    assert found.H0 == -0.4
    filled = interpolate(LineState(np.ones(41), np.zeros(41), 0.0), x, system(1.0))
    assert (filled.P[1:-1] > 0.99).all()
    assert (filled.P[[0, -1]] == 0.0).all()


def test_a_factored_matrix_serves_on_while_every_step_leaves_a_quarter():
    nodes = np.arange(350)
    factors = SimpleNamespace(nodes=nodes, voids=nodes[:3], touching=nodes[:2])

    def good(residuals, loads, nodes=nodes, voids=nodes[:3], touching=nodes[:2]):
        return newton._still_good(factors, nodes, voids, touching, residuals, loads)

    assert good([1.0, 0.1], [1.0, 0.39])
    assert not good([1.0, 0.1], [1.0, 0.41])
    assert good([9.0, 1.0, 0.39], [9.0, 1.0, 0.1])
    assert not good([1.0], [1.0])
    assert not good([1.0, 0.1], [1.0, 0.1], voids=nodes[:4])
    assert not good([1.0, 0.1], [1.0, 0.1], touching=nodes[:4])
    assert not good([1.0, 0.1], [1.0, 0.1], nodes=nodes[::-1])
    small = SimpleNamespace(nodes=nodes[1:], voids=nodes[:3], touching=nodes[:2])
    assert not newton._still_good(small, nodes[1:], nodes[:3], nodes[:2], [1.0, 0.1], [1.0, 0.1])


def test_an_iteration_stagnates_where_its_last_twelve_steps_do_not_halve_what_was_left():
    falling = [8.0, 4.0] + [2.1] * 11
    loads = [0.0] * 13
    assert newton._stagnant([*falling[1:], 2.1], loads)
    assert not newton._stagnant([*falling[1:], 1.9], loads)
    # loads count, and what came before the twelve does once only
    assert newton._stagnant([4.0] + [1.0] * 12, [0.0] + [1.1] * 12)
    assert not newton._stagnant([4.0, 1.0] + [3.0] * 11, loads)
