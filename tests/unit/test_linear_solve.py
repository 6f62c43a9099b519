"""LU factors against numpy and against systems solved by hand."""

import numpy as np
import pytest

from gearlube_core.kernels.linear_solve import factorise, solve_factorised
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
