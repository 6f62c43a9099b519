"""Roots from the Newton kernel, against SciPy and against roots known beforehand."""

import math

import numpy as np
import pytest
from scipy.optimize import root

from gearlube_core.kernels import damped_newton as module
from gearlube_core.kernels.damped_newton import (
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    damped_newton,
    newton_work_size,
)
from gearlube_core.kernels.linear_solve import factorise, solve_factorised
from tests.helpers.each import each
from tests.helpers.source_of import interpret


@pytest.fixture(autouse=True)
def interpreted(monkeypatch):
    """Compiled for a function it is at the start of every axle, see test_compiled_entries.py."""
    interpret(monkeypatch, module)
    monkeypatch.setattr(module, "kernel", lambda function: function)


def solved(residual, start, scale, problem, jacobian=None):
    """Return the root, the status and the last step."""
    u = np.array(start, dtype=float)
    work = np.zeros(newton_work_size(u.size))
    scales = np.broadcast_to(np.asarray(scale, dtype=float), u.shape).copy()
    status, step = damped_newton.__wrapped__(residual, jacobian)(u, scales, problem, work)
    return u, status, step


def cubic_springs(u, problem, out):
    stiffness, load = problem
    n = u.size
    for i in range(n):
        out[i] = -load[i] + 0.1 * u[i] ** 3
        for j in range(n):
            out[i] += stiffness[i * n + j] * u[j]


def cubic_stiffness(u, problem, matrix):
    n = u.size
    for i in range(n * n):
        matrix[i] = problem[0][i]
    for i in range(n):
        matrix[i * n + i] += 0.3 * u[i] ** 2


def scaled_springs(u, problem, out):
    springs, columns, rows, scratch = problem
    for j in range(u.size):
        scratch[j] = u[j] / columns[j]
    cubic_springs(scratch, springs, out)
    for i in range(u.size):
        out[i] *= rows[i]


def springs(n, seed):
    rng = np.random.default_rng(seed)
    half = rng.normal(size=(n, n))
    return (half @ half.T + np.eye(n)).ravel(), 10.0 * rng.normal(size=n)


@each("jacobian", [None, cubic_stiffness])
@each("n", [1, 6, 11])
def test_hardening_springs_settle_where_scipy_finds_them(n, jacobian):
    problem = springs(n, n)

    def with_scipy(u):
        out = np.zeros(n)
        cubic_springs(u, problem, out)
        return out

    expected = root(with_scipy, np.zeros(n), options={"xtol": 1e-13}).x
    found, status, step = solved(cubic_springs, np.zeros(n), 1.0, problem, jacobian)
    assert status == OK
    assert step < 1e-8
    # both stop at rounding: residuals of 1e-14 over a stiffness of at least 1
    assert found == pytest.approx(expected, rel=1e-11, abs=1e-12)


def test_units_of_unknowns_and_residuals_do_not_change_the_root():
    # radians beside metres, newtons beside newton metres: 12 orders of magnitude
    n = 6
    problem = springs(n, 3)
    columns, rows = 10.0 ** np.arange(-6.0, 6.0, 2.0), 10.0 ** np.arange(6.0, -6.0, -2.0)
    plain, _, _ = solved(cubic_springs, np.zeros(n), 1.0, problem)
    scaled, status, _ = solved(
        scaled_springs, np.zeros(n), columns, (problem, columns, rows, np.zeros(n))
    )
    assert status == OK
    assert scaled / columns == pytest.approx(plain, rel=1e-11)


def two_stops(u, problem, out):
    """A body between two stops with gaps, on a weak spring, under a load."""
    load, gap, weak = problem
    right = max(u[0] - gap, 0.0)
    left = max(-gap - u[0], 0.0)
    out[0] = weak * u[0] + right - left + 0.5 * u[1] - load
    out[1] = 1e3 * (u[1] + 0.5 * u[0])


@each("load", [-7.0, -0.5, 0.0, 0.3, 40.0, 4e4])
@each("weak", [0.3, 1.0])
def test_one_sided_stops_are_found_across_their_kinks(load, weak):
    # with u1 = -u0/2 the effective weak spring is weak - 1/4
    gap, spring = 5.0, weak - 0.25
    free = load / spring
    expected = free
    if abs(free) > gap:
        expected = (load + math.copysign(gap, load)) / (spring + 1.0)
    found, status, _ = solved(two_stops, [0.0, 0.0], 1.0, (load, gap, weak))
    assert status == OK
    assert found == pytest.approx([expected, -0.5 * expected], rel=1e-12, abs=1e-14)


def rollers(u, problem, out):
    """A ring of one-sided rollers with q = k d^(10/9), which has no stiffness without contact."""
    load_x, load_y, clearance = problem
    out[0] = load_x
    out[1] = load_y
    for k in range(12):
        angle = 2.0 * math.pi * k / 12.0
        depth = u[0] * math.cos(angle) + u[1] * math.sin(angle) - clearance
        if depth > 0.0:
            q = 300.0 * depth ** (10.0 / 9.0)
            out[0] -= q * math.cos(angle)
            out[1] -= q * math.sin(angle)


@pytest.mark.parametrize("clearance", [-8.0, 0.0, 3.0])
def test_a_shaft_among_rollers_settles_under_the_load_also_from_within_the_clearance(clearance):
    problem = (4000.0, -2500.0, clearance)
    found, status, _ = solved(rollers, [0.0, 0.0], 1.0, problem)
    assert status == OK
    out = np.ones(2)
    rollers(found, problem, out)
    assert np.abs(out).max() < 1e-9 * 4000.0  # stiffness 1e3 N/um, steps of 1e-12 um
    assert found @ np.array([4000.0, -2500.0]) > 0.0


def one_unknown(u, problem, out):
    kind, a = problem
    if kind == 0.0:
        out[0] = math.atan(u[0]) - a
    elif kind == 1.0:
        out[0] = u[0] * u[0] + a
    else:
        out[0] = math.nan


def test_where_plain_newton_diverges_damping_converges():
    found, status, _ = solved(one_unknown, [20.0], 1.0, (0.0, 0.5))
    assert status == OK
    assert found[0] == pytest.approx(math.tan(0.5), rel=1e-13)


def test_no_root_and_no_number_are_told():
    assert solved(one_unknown, [3.0], 1.0, (1.0, 1.0))[1] == NOT_CONVERGED
    assert solved(one_unknown, [3.0], 1.0, (2.0, 0.0))[1] == NOT_FINITE


def test_factors_solve_what_needs_pivoting():
    rng = np.random.default_rng(5)
    for n in (1, 2, 7, 11):
        matrix, right = rng.normal(size=(n, n)), rng.normal(size=n)
        matrix[0, 0] = 0.0 if n > 1 else 2.0
        factors, order, x = matrix.ravel().copy(), np.zeros(n), np.zeros(n)
        assert factorise(factors, n, order) == 0.0
        solve_factorised(factors, n, order, right, x)
        assert x == pytest.approx(np.linalg.solve(matrix, right), rel=1e-11)


def test_a_singular_matrix_is_counted_and_gives_finite_numbers():
    factors, order, x = np.array([1.0, 2.0, 2.0, 4.0]), np.zeros(2), np.zeros(2)
    assert factorise(factors, 2, order) == 1.0
    solve_factorised(factors, 2, order, np.array([1.0, 1.0]), x)
    assert np.all(np.isfinite(x))
