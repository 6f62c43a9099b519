"""Steps of the eigenvalue kernel, one by one, against dense linear algebra."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.kernels import eigenvalues as module
from tests.helpers.source_of import interpret

RNG = np.random.default_rng(12)


@pytest.fixture(autouse=True)
def uncompiled(monkeypatch):
    interpret(monkeypatch, module)


def test_balancing_scales_by_powers_of_two_until_no_other_power_gains_a_twentieth():
    n = 6
    before = RNG.normal(size=(n, n)) * 2.0 ** RNG.integers(-20, 20, (n, 1))
    flat = before.ravel().copy()
    module._balance(flat, n)
    after = flat.reshape(n, n)
    assert np.diag(after) == pytest.approx(np.diag(before), rel=0.0)
    # D^-1 A D: ratios of entries are powers of 2 that multiply along a cycle to one
    ratio = np.log2(after / before)
    assert (ratio == np.round(ratio)).all()
    assert (ratio == ratio[:1] - ratio[0][:, None]).all()
    off = np.abs(after - np.diag(np.diag(after)))
    for column, row in zip(off.sum(axis=0), off.sum(axis=1), strict=True):
        for factor in (0.25, 0.5, 2.0, 4.0):
            assert column * factor + row / factor >= 0.95 * (column + row)


def test_balancing_leaves_what_gains_little_and_what_has_no_row():
    # norms of 1 and 2.2: a factor of 2 gives 2 + 1.1, a gain of 3 %
    little = np.array([[1.0, 2.2], [1.0, 1.0]])
    # 1 and 2.6: 2 + 1.3, a gain of 8 %
    more = np.array([[1.0, 2.6], [1.0, 1.0]])
    triangle = np.array([[1.0, 900.0], [0.0, 1.0]])
    for matrix, kept in ((little, True), (more, False), (triangle, True)):
        flat = matrix.ravel().copy()
        module._balance(flat, 2)
        assert (flat == matrix.ravel()).all() == kept


@pytest.mark.parametrize("n", [2, 3, 5, 8])
def test_reflections_keep_the_norm_and_the_eigenvalues_and_leave_one_diagonal_below(n: int):
    before = RNG.normal(size=(n, n))
    before[3:, 1] = 0.0  # nothing to do in a column
    flat = before.ravel().copy()
    module._to_hessenberg(flat, n, np.empty(n))
    after = flat.reshape(n, n)
    assert not np.tril(after, -2).any()
    assert np.linalg.norm(after) == pytest.approx(np.linalg.norm(before), rel=1e-14)
    # characteristic polynomials; the first column is turned alone
    assert np.poly(after) == pytest.approx(np.poly(before), rel=1e-10, abs=1e-10)
    assert after[0, 0] == before[0, 0]
    if n > 2:
        assert abs(after[1, 0]) == pytest.approx(np.linalg.norm(before[1:, 0]), rel=1e-14)


@pytest.mark.parametrize(
    "block",
    [
        [[3.0, 2.0], [0.5, -1.0]],
        [[-1.0, 2.0], [0.5, 3.0]],
        [[1.0, 2.0], [-3.0, 1.5]],
        [[2.0, 5.0], [0.0, 2.0]],
    ],
    ids=["real", "real, other order", "complex", "double"],
)
def test_a_block_of_two_rows_has_the_roots_of_its_polynomial(block):
    n, shift = 4, 0.7
    h = RNG.normal(size=(n, n))
    h[1:3, 1:3] = block
    real, imaginary = np.full(n, 9.0), np.full(n, 9.0)
    module._pair(h.ravel(), n, 2, shift, real, imaginary)
    trace, determinant = np.trace(block), np.linalg.det(block)
    root = np.sqrt(complex(0.25 * trace**2 - determinant))
    expected = shift + 0.5 * trace + np.array([root, -root])
    found = real[1:3] + 1j * imaginary[1:3]
    assert np.sort_complex(found) == pytest.approx(np.sort_complex(expected), abs=1e-14)
    assert imaginary[1] >= 0.0
    assert (real[[0, 3]] == 9.0).all()


def hessenberg(n: int) -> np.ndarray:
    return np.triu(RNG.normal(size=(n, n)), -1)


@pytest.mark.parametrize(("first", "last"), [(0, 5), (1, 5), (0, 2), (2, 4), (1, 4)])
def test_a_double_step_is_a_step_of_qr_with_both_shifts(first: int, last: int):
    n = 6
    h = hessenberg(n)
    if first:
        h[first, first - 1] = 0.0  # a block of its own
    if last < n - 1:
        h[last + 1, last] = 0.0
    x, y, w = 0.8, -0.3, -0.45  # a complex pair
    flat = h.ravel().copy()
    module._double_step(flat, n, first, last, x, y, w)
    # what stands farther below is not read again
    after = np.where(np.tri(n, n, -2, dtype=bool), h, flat.reshape(n, n))
    part = slice(first, last + 1)
    block = h[part, part]
    # (H - s1)(H - s2) = Q R, and the block becomes Q^T H Q but for signs of rows and columns
    product = block @ block - (x + y) * block + (x * y - w) * np.eye(last + 1 - first)
    turned = np.linalg.qr(product)[0]
    expected = turned.T @ block @ turned
    assert np.abs(after[part, part]) == pytest.approx(np.abs(expected), abs=1e-9)
    assert np.poly(after[part, part]) == pytest.approx(np.poly(block), abs=1e-11)
    outside = np.ones((n, n), dtype=bool)
    outside[part, part] = False
    assert (after[outside] == h[outside]).all()


def test_a_double_step_starts_where_two_small_numbers_allow_it():
    n = 7
    h = hessenberg(n)
    h[2, 1], h[3, 2] = 1e-9, 1e-10
    flat = h.ravel().copy()
    module._double_step(flat, n, 0, n - 1, 0.8, -0.3, -0.45)
    after = np.triu(flat.reshape(n, n), -1)
    # rows above are left alone
    assert (after[:2, :2] == h[:2, :2]).all()
    assert np.sort_complex(np.linalg.eigvals(after)) == pytest.approx(
        np.sort_complex(np.linalg.eigvals(h)), abs=1e-8
    )


def test_a_block_begins_below_what_vanishes_beside_its_neighbours():
    h = np.triu(np.ones((5, 5)), -1)
    assert module._first_row(h.ravel().copy(), 5, 4, 1.0) == 0
    h[3, 2] = 3e-17
    flat = h.ravel().copy()
    assert module._first_row(flat, 5, 4, 1.0) == 3
    assert flat[3 * 5 + 2] == 0.0
    assert module._first_row(h.ravel().copy(), 5, 2, 1.0) == 0
    h[3, 2] = 3e-16
    assert module._first_row(h.ravel().copy(), 5, 4, 1.0) == 0
    # beside zeros the norm of the matrix counts
    h[2, 2] = h[3, 3] = 0.0
    h[3, 2] = 1e-13
    assert module._first_row(h.ravel().copy(), 5, 4, 1e4) == 3
    assert module._first_row(h.ravel().copy(), 5, 4, 1.0) == 0


def test_shifts_need_few_steps(monkeypatch):
    steps = []
    step = module._double_step
    monkeypatch.setattr(module, "_double_step", lambda *a: steps.append(a[3]) or step(*a))
    n = 12
    for _ in range(5):
        a = RNG.normal(size=(n, n))
        real, imaginary = np.empty(n), np.empty(n)
        assert module.eigenvalues(a.ravel().copy(), n, real, imaginary) == module.OK
    # with the shifts of the last block two or three steps for each eigenvalue, usually
    assert len(steps) < 2.5 * 5 * n
    # a matrix whose steps change nothing is given up, after 60 of them
    steps.clear()
    monkeypatch.setattr(module, "_double_step", lambda *a: steps.append(a[3]))
    found = module.eigenvalues(hessenberg(4).ravel().copy(), 4, np.empty(4), np.empty(4))
    assert (found, len(steps)) == (module.NOT_CONVERGED, 60)
