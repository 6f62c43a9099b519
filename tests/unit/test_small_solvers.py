"""Small solvers in kernels: linear systems, brackets and spectral radius."""

import math

import numpy as np
import pytest

from gearlube_core.friction.thermal_eyring_flank import bracketed_secant_step
from gearlube_core.kernels.least_squares import least_squares, least_squares_work
from gearlube_core.kernels.linear_solve import factorise, solve_factorised
from gearlube_core.kernels.spectral_radius import spectral_radius
from tests.helpers.each import each
from tests.helpers.source_of import source_of


def solved(matrix, right):
    """Solution, raised pivots, factors and order of rows."""
    n = len(right)
    factors, order, x = np.array(matrix, dtype=float).ravel(), np.full(n, -1.0), np.full(n, np.nan)
    raised = source_of(factorise)(factors, n, order)
    source_of(solve_factorised)(factors, n, order, np.array(right, dtype=float), x)
    return x, raised, factors.reshape(n, n), order


@each("n", [1, 2, 3, 6, 10])
@each("seed", range(4))
def test_any_system_is_solved_with_its_factors(n, seed):
    rng = np.random.default_rng(10 * n + seed)
    matrix, right = rng.standard_normal((n, n)), rng.standard_normal(n)
    x, raised, factors, order = solved(matrix, right)
    # rounding times the condition, below 1e3 for these
    np.testing.assert_allclose(x, np.linalg.solve(matrix, right), rtol=1e-9)
    assert raised == 0.0
    lower, upper = np.tril(factors, -1) + np.eye(n), np.triu(factors)
    np.testing.assert_allclose(lower @ upper, matrix[order.astype(int)], atol=1e-13)
    # partial pivoting: no factor above one
    assert np.abs(np.tril(factors, -1)).max() <= 1.0


def test_rows_change_places_where_the_first_pivot_is_zero():
    x, _, _, order = solved([[0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [4.0, 1.0, 3.0]], [7.0, 1.0, 15.0])
    np.testing.assert_allclose(x, [1.0, 2.0, 3.0], rtol=1e-14)
    assert list(order) == [2.0, 0.0, 1.0]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_singular_matrix_has_a_long_solution_along_what_it_does_not_determine(sign):
    x, raised, factors, _ = solved([[4.0, 2.0], [2.0, 1.0]], [0.0, sign])
    assert raised == 1.0
    # the second pivot is zero: raised to 1e-14 of the largest number
    assert factors[1, 1] == pytest.approx(4e-14, rel=1e-12)
    np.testing.assert_allclose(x, sign * np.array([-1.25e13, 2.5e13]), rtol=1e-12)
    nearly, raised, factors, _ = solved([[4.0, 2.0], [2.0, 1.0 - 1e-15]], [0.0, 1.0])
    assert raised == 1.0
    assert factors[1, 1] == pytest.approx(-4e-14, rel=1e-12)  # keeps its sign
    assert nearly[1] == pytest.approx(-2.5e13, rel=1e-12)


def test_matrix_of_zeros_counts_every_pivot():
    x, raised, _, order = solved(np.zeros((3, 3)), [1.0, 2.0, 3.0])
    assert raised == 3.0
    np.testing.assert_array_equal(x, [1.0, 2.0, 3.0])  # pivots of one
    assert list(order) == [0.0, 1.0, 2.0]


@pytest.mark.parametrize("slope", [2.0, -0.3])
def test_secant_meets_the_root_of_a_line_inside_the_bracket(slope):
    step = source_of(bracketed_secant_step)
    root = 14.5
    for x, old in ((12.0, 19.0), (17.0, 16.0)):
        found = step(x, slope * (x - root), old, slope * (old - root), 10.0, 20.0)
        assert found == pytest.approx(root, rel=1e-14)
    # a root on the border still lies inside
    assert step(12.0, 2.0 * slope, 13.0, 3.0 * slope, 10.0, 20.0) == pytest.approx(10.0)


@pytest.mark.parametrize(
    ("g", "g_old"),
    [(1.0, 1.0), (1.0, 1.1), (1.0, 0.9), (math.nan, 1.0)],
    ids=["level", "below", "above", "not a number"],
)
def test_bracket_is_halved_where_the_secant_leaves_it(g, g_old):
    assert source_of(bracketed_secant_step)(12.0, g, 13.0, g_old, 10.0, 20.0) == 15.0
    assert source_of(bracketed_secant_step)(2.0, g, 3.0, g_old, 1.5, 3.5) == 2.5


def from_kernel(matrix, function=spectral_radius):
    n = len(matrix)
    return function(np.array(matrix, dtype=float).ravel(), n, np.zeros(n * n))


@each("n", [1, 2, 3, 8, 12, 24])
def test_random_matrices_have_the_radius_that_lapack_finds(n):
    rng = np.random.default_rng(n)
    for _ in range(20):
        matrix = rng.normal(size=(n, n)) * 10.0 ** rng.integers(-9, 9)
        values, vectors = np.linalg.eig(matrix)
        # rounding of either is that of the norm times the condition of the eigenvectors
        rounding = 1e-14 * np.linalg.norm(matrix, 2) * np.linalg.cond(vectors)
        assert from_kernel(matrix) == pytest.approx(np.abs(values).max(), abs=rounding)


def test_units_of_rotation_and_displacement_do_not_change_it():
    # D S D^-1 is similar to the symmetric S; norms of such matrices differ by 1e12
    rng = np.random.default_rng(1)
    for _ in range(20):
        half = rng.normal(size=(8, 8))
        symmetric = half @ half.T
        grading = 10.0 ** rng.integers(-3, 4, 8)
        found = from_kernel(grading[:, None] * symmetric / grading)
        assert found == pytest.approx(np.linalg.norm(symmetric, 2), rel=1e-10)


def test_complex_repeated_and_defective_eigenvalues():
    rotation = 2.0 * np.array([[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]])
    assert from_kernel(rotation) == pytest.approx(2.0, rel=1e-12)
    assert from_kernel(np.roll(np.eye(8), 1, axis=0)) == pytest.approx(1.0, rel=1e-12)
    # powers of a block of two rows grow by the power itself: (2^50)^(2^-50) = 1 + 3e-14
    assert from_kernel([[-3.0, 1.0], [0.0, -3.0]]) == pytest.approx(3.0, rel=1e-12)


def test_no_motion_has_no_radius_and_numbers_that_are_not_finite_are_told():
    assert from_kernel(np.zeros((4, 4))) == 0.0
    assert from_kernel([[0.0, 1.0], [0.0, 0.0]]) == 0.0
    for bad in (np.nan, np.inf):
        assert not np.isfinite(from_kernel([[1.0, bad], [0.0, 1.0]]))


def test_the_compiled_kernel_is_its_source():
    matrix = np.random.default_rng(4).normal(size=(8, 8))
    assert from_kernel(matrix) == pytest.approx(
        from_kernel(matrix, spectral_radius.py_func), rel=1e-13
    )


@pytest.mark.parametrize(
    ("rows", "columns", "rank"),
    [(4, 4, 4), (7, 3, 3), (3, 7, 3), (6, 5, 2), (5, 6, 4), (3, 3, 0), (2, 0, 0), (0, 3, 0)],
)
def test_least_squares_of_any_rank_are_the_shortest(rows, columns, rank):
    rng = np.random.default_rng(10 * rows + columns)
    for _ in range(5):
        left, right = rng.normal(size=(rows, rank)), rng.normal(size=(rank, columns))
        wanted, matrix = rng.normal(size=rows), left @ right
        found, work = np.full(columns, np.nan), np.empty(least_squares_work(columns))
        free = least_squares(matrix.flatten(), rows, columns, wanted, found, work)
        assert free == columns - rank
        expected = np.linalg.pinv(matrix, rcond=1e-10) @ wanted
        # rounding times the condition, at worst 1e5 for such matrices
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)
