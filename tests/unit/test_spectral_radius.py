"""Largest modulus of eigenvalues from the kernel, against LAPACK and by hand."""

import numpy as np
import pytest

from gearlube_core.kernels.spectral_radius import spectral_radius
from tests.helpers.each import each


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
