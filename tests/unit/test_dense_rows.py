"""Products of dense matrices as kernels, against numpy."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.kernels.dense_rows import add_times, add_times_both, semidefinite_root

RANDOM = np.random.default_rng(5)


@pytest.mark.parametrize("shape", [(80, 80), (24, 41), (3, 8), (1, 1)])
@pytest.mark.parametrize("kind", [np.float64, np.float32])
def test_products_are_those_of_numpy_for_all_counts_of_columns(shape, kind):
    matrix, x = RANDOM.standard_normal(shape).astype(kind), RANDOM.standard_normal(shape[0])
    out = np.ones(shape[1])
    add_times(matrix.ravel(), x.astype(kind), out)
    # each product and each sum is rounded once
    bound = 2.0 * shape[0] * np.finfo(kind).eps * (1.0 + abs(x) @ abs(matrix))
    assert (abs(out - 1.0 - x @ matrix) < bound).all()


def test_two_products_at_once_are_each_of_them():
    matrix, (x, y) = RANDOM.standard_normal((33, 27)), RANDOM.standard_normal((2, 33))
    of_x, of_y = np.zeros((2, 27))
    add_times_both(matrix.ravel(), x, y, of_x, of_y)
    np.testing.assert_allclose(of_x, x @ matrix, atol=1e-13)
    np.testing.assert_allclose(of_y, y @ matrix, atol=1e-13)


def test_a_root_has_as_many_columns_as_the_rank():
    factor = RANDOM.standard_normal((20, 7))
    root = (factor @ factor.T).ravel()
    whole = root.reshape(20, 20).copy()
    assert semidefinite_root(root, 20, np.empty(400)) == 7
    found = root[:140].reshape(20, 7)
    np.testing.assert_allclose(found @ found.T, whole, atol=1e-10)
