"""Eigenvalues of general matrices from the kernel, against LAPACK."""

import numpy as np
import pytest

from gearlube_core.kernels.eigenvalues import NOT_FINITE, OK, eigenvalues

EPS = np.finfo(float).eps


def from_kernel(matrix):
    n = len(matrix)
    real, imaginary = np.zeros(n), np.zeros(n)
    assert eigenvalues(np.array(matrix, dtype=float).ravel(), n, real, imaginary) == OK
    return real + 1j * imaginary


def distance(found, expected):
    """Return the largest distance of a found eigenvalue from its own expected one."""
    left = list(expected)
    worst = 0.0
    for value in found:
        nearest = min(left, key=lambda one: abs(one - value))
        left.remove(nearest)
        worst = max(worst, abs(nearest - value))
    return worst


def tolerance(matrix):
    """Return 100 roundings of the norm, times the condition of the eigenvectors."""
    _, vectors = np.linalg.eig(matrix)
    return 100.0 * EPS * np.linalg.norm(matrix, 2) * np.linalg.cond(vectors)


@pytest.mark.parametrize("n", [1, 2, 3, 5, 8, 12, 24])
def test_random_matrices_have_the_eigenvalues_that_lapack_finds(n):
    rng = np.random.default_rng(n)
    for _ in range(50):
        matrix = rng.normal(size=(n, n))
        expected = np.linalg.eigvals(matrix)
        assert distance(from_kernel(matrix), expected) < tolerance(matrix)


def test_graded_stiffness_over_mass_keeps_relative_accuracy_after_balancing():
    # M^-1 K with units of rotation and displacement mixed: D S D^-1 with powers of 2 in D is
    # similar to the symmetric S without any rounding, whose eigenvalues are well conditioned
    rng = np.random.default_rng(1)
    for _ in range(50):
        half = rng.normal(size=(8, 8))
        symmetric = half + half.T
        grading = 2.0 ** rng.integers(-30, 30, 8)
        graded = grading[:, None] * symmetric / grading
        expected = np.linalg.eigvalsh(symmetric)
        # balancing gives back numbers that compare: some hundred roundings of the norm
        assert distance(from_kernel(graded), expected) < 1e-12 * np.abs(expected).max()


def test_complex_pairs_come_with_the_positive_imaginary_part_first():
    angle = 0.3
    rotation = 2.0 * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    found = from_kernel(rotation)
    expected = 2.0 * np.exp(1j * angle)
    assert found == pytest.approx([expected, np.conj(expected)], rel=1e-15)


def test_a_defective_matrix_is_as_near_as_its_block_allows():
    # an m-fold eigenvalue in one Jordan block moves by (rounding)^(1/m)
    rng = np.random.default_rng(2)
    basis = np.linalg.qr(rng.normal(size=(6, 6)))[0]
    jordan = np.diag([3.0, 3.0, 3.0, -1.0, -1.0, 5.0])
    jordan[0, 1] = jordan[1, 2] = jordan[3, 4] = 1.0
    found = from_kernel(basis @ jordan @ basis.T)
    assert distance(found, np.diag(jordan)) < (100.0 * EPS) ** (1.0 / 3.0)
    assert found.sum() == pytest.approx(np.trace(jordan), abs=1e-13)


def test_a_cyclic_permutation_does_not_stall_the_shifts():
    # the textbook case that plain double shifts leave unchanged: the roots of unity
    for n in (3, 4, 8):
        cyclic = np.roll(np.eye(n), 1, axis=0)
        expected = np.exp(2j * np.pi * np.arange(n) / n)
        assert distance(from_kernel(cyclic), expected) < 1e-13


def test_zeros_triangles_and_blocks_split():
    assert np.all(from_kernel(np.zeros((4, 4))) == 0.0)
    triangle = np.triu(np.arange(1.0, 17.0).reshape(4, 4))
    assert sorted(from_kernel(triangle).real) == pytest.approx([1.0, 6.0, 11.0, 16.0], rel=1e-14)
    blocks = np.kron(np.eye(2), np.array([[0.0, 1.0], [-4.0, 0.0]]))
    assert distance(from_kernel(blocks), [2j, -2j, 2j, -2j]) < 1e-14


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_refused(bad):
    matrix = np.eye(3)
    matrix[0, 2] = bad
    assert eigenvalues(matrix.ravel(), 3, np.zeros(3), np.zeros(3)) == NOT_FINITE


def test_the_compiled_kernel_is_its_source():
    matrix = np.random.default_rng(4).normal(size=(8, 8)).ravel()
    results = []
    for function in (eigenvalues, eigenvalues.py_func):
        real, imaginary = np.zeros(8), np.zeros(8)
        assert function(matrix.copy(), 8, real, imaginary) == OK
        results.append((real, imaginary))
    # the callees are the same; the order of operations here too
    np.testing.assert_allclose(results[0], results[1], rtol=1e-13, atol=1e-14)
