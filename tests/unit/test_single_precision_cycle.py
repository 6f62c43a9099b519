"""Parts of the multigrid cycle in single precision against dense matrices."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import solve_banded
from scipy.linalg.lapack import sgbtrf
from scipy.sparse import csr_matrix

from gearlube_core.ehl.point.newton import smoother
from gearlube_core.ehl.point.newton.galerkin import SparseOperator
from gearlube_core.ehl.point.newton.preconditioner import SingleOperator
from gearlube_core.ehl.point.newton.single_stencil import SingleStencil

SHAPE = (9, 12)
PERIOD = SHAPE[0] - 2  # rows 0 and 8 are copies
OWN = np.full(SHAPE[1], 0.5)  # deflection under unit pressure on a node's own cell


def stencil_matrix(period: int, reach: int = 2) -> csr_matrix:
    """Random derivatives of every own node by its neighbours, wrapped along y where they repeat."""
    rng = np.random.default_rng(4)
    ny, nx = SHAPE
    dense = np.zeros((ny * nx, ny * nx), dtype=complex)
    for j in range(1, ny - 1):
        for i in range(nx):
            for dj in range(-1, 2):
                for di in range(-reach, reach + 1):
                    jj, ii = j + dj, i + di
                    if period:
                        jj = 1 + (jj - 1) % period
                    if 1 <= jj < ny - 1 and 0 <= ii < nx:
                        dense[j * nx + i, jj * nx + ii] = complex(*rng.normal(size=2))
    return csr_matrix(dense)


@pytest.mark.parametrize("period", [0, PERIOD])
def test_stencils_multiply_as_their_matrix_does(period):
    matrix = stencil_matrix(period)
    pressure, film = np.random.default_rng(5).normal(size=(2, *SHAPE))
    right = np.ones(SHAPE)
    stencil = SingleStencil.of(matrix, SHAPE, period, OWN)
    expected = (matrix.real @ pressure.ravel() + matrix.imag @ film.ravel()).reshape(SHAPE)
    # at most fifteen neighbours of order one, rounded to 6e-8
    assert right - stencil.rest(right, pressure, film) == pytest.approx(expected, abs=1e-5)


def test_neighbours_of_little_weight_are_added_to_the_node_itself():
    matrix = stencil_matrix(PERIOD)
    rows, columns = matrix.nonzero()
    far = np.abs(rows % SHAPE[1] - columns % SHAPE[1]) == 2
    matrix.data[far] *= 1e-4
    stencil = SingleStencil.of(matrix, SHAPE, PERIOD, OWN)
    # without the far ones, three by three remain
    assert sorted(map(tuple, stencil.offsets)) == sorted(map(tuple, stencil.film_offsets))
    assert {abs(step) for _, step in stencil.offsets} == {0, 1}
    # under even changes nothing is lost: every entry counts as the matrix has it
    even = np.ones(SHAPE)
    expected = (matrix.real @ even.ravel() - 2.0 * matrix.imag @ even.ravel()).reshape(SHAPE)
    zero = np.zeros(SHAPE)
    assert -stencil.rest(zero, even, -2.0 * even) == pytest.approx(expected, abs=1e-5)


def test_oil_that_passes_ruptured_film_reaches_beyond_a_stencil():
    matrix = stencil_matrix(0, reach=3)
    assert SingleStencil.of(matrix, SHAPE, 0, OWN) is None
    sides = SimpleNamespace(period=lambda rows: 0)
    grid = SimpleNamespace(shape=SHAPE, sides=sides, own_deflection=np.full(SHAPE, 0.5))
    pressure = np.random.default_rng(6).normal(size=SHAPE)
    operator = SparseOperator(matrix, np.ones(SHAPE, dtype=bool), np.ones(SHAPE))
    right = np.ones(SHAPE)
    found = right - SingleOperator(grid, operator).rest(right, pressure, 0.5 * pressure, 2.0)
    expected = (matrix.real + 0.5 * matrix.imag) @ pressure.ravel() + 2.0
    assert found.ravel() == pytest.approx(expected, rel=1e-5, abs=1e-5)


def test_bands_are_solved_with_rows_exchanged():
    n, half = 60, smoother.REACH + 2
    rng = np.random.default_rng(7)
    matrix = np.zeros((2 * half + 1, n))
    for k in range(-half, half + 1):
        matrix[half - k, max(k, 0) : n + min(k, 0)] = rng.normal(size=n - abs(k))
    matrix[half, ::3] = 0.0  # diagonals of zero: rows must be exchanged
    band = np.zeros((3 * half + 1, n), dtype=np.float32)
    band[half:] = matrix
    factors, pivots, info = sgbtrf(band, half, half)
    assert info == 0
    assert (pivots != np.arange(n)).any()
    transposed = np.ascontiguousarray(factors.T)
    transposed[:, 2 * half] = 1.0 / transposed[:, 2 * half]
    free = np.ones(n, dtype=bool)
    free[5] = False
    right = rng.normal(size=n)
    found = right.astype(np.float32)
    smoother.solve_bands(transposed, pivots, free, np.float32(0.5), 0, found.size, found)
    expected = 0.5 * solve_banded((half, half), matrix, np.where(free, right, 0.0))
    # rounding, times a condition number of some hundreds
    assert found == pytest.approx(expected, abs=3e-4 * np.abs(expected).max())
