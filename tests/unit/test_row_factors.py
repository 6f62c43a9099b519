"""Rows of nodes that are factored side by side: against dense matrices, sound or not."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csr_matrix

from gearlube_core.ehl.point.newton import row_factors, smoother
from gearlube_core.ehl.point.newton.single_stencil import SingleStencil
from gearlube_core.ehl.point.newton.smoother import Equations
from gearlube_core.kernels.row_workers import ALONE, RowWorkers
from tests.helpers.source_of import interpret

NY, NX = 5, 23


def equations(own: float) -> Equations:
    """Neighbours along and across rows, a deflection over four nodes, every seventh node held."""
    rng = np.random.default_rng(4)
    dense = np.zeros((NY * NX, NY * NX), dtype=complex)
    for row in range(NY * NX):
        j, i = divmod(row, NX)
        for dj, di in ((0, 0), (0, -1), (0, 1), (0, -2), (-1, 0), (1, 0)):
            if 0 <= j + dj < NY and 0 <= i + di < NX:
                there = (j + dj) * NX + i + di
                dense[row, there] = complex(*rng.uniform(0.2, 1.0, 2))
        dense[row, row] = own + 0.3j
    free = np.arange(NY * NX).reshape(NY, NX) % 7 != 3
    apart = np.abs(np.subtract.outer(np.arange(NX), np.arange(NX)))
    matrix = csr_matrix(dense)
    across = 0.5 ** np.arange(5.0)
    return Equations(
        matrix.indptr, matrix.indices, matrix.data, free, 0.4 / (1.0 + apart), across, 0
    )


def solved(given: Equations, residual: np.ndarray) -> np.ndarray:
    """Every row's dense matrix, from the rule that a node's own row deflects under its pressure."""
    result = np.zeros((NY, NX))
    for j in range(NY):
        dense = np.zeros((NX, NX))
        for i in range(NX):
            for k in range(given.start[j * NX + i], given.start[j * NX + i + 1]):
                jj, ii = divmod(int(given.column[k]), NX)
                dense[i, ii] += given.entry[k].real * (jj == j)
                near = np.abs(np.arange(NX) - ii) <= smoother.REACH
                film = given.entry[k].imag * given.across[abs(jj - j)]
                dense[i] += film * np.where(near, given.local[ii], 0.0)
        free = np.flatnonzero(given.free[j])
        result[j, free] = np.linalg.solve(dense[np.ix_(free, free)], residual[j, free])
    return result


def rows_of(kind, given: Equations, workers: RowWorkers = ALONE):
    """Rows of either kind; what takes stencils gets those of the same entries."""
    if kind is smoother._ExchangedRows:
        return kind(given, workers)
    matrix = csr_matrix((given.entry, given.column, given.start), shape=(NY * NX, NY * NX))
    stencil = SingleStencil.of(matrix, (NY, NX), given.period, np.full(NX, 0.4))
    assert stencil is not None
    return kind(stencil, given, workers)


RESIDUAL = np.random.default_rng(5).normal(size=(NY, NX))


@pytest.mark.parametrize("kind", [smoother._SideBySide, smoother._ExchangedRows])
def test_rows_are_solved_as_dense_matrices_say(kind):
    given = equations(-6.0)
    rows = rows_of(kind, given)
    # factors of single precision
    expected = 0.7 * solved(given, RESIDUAL)
    assert rows.solve(RESIDUAL, np.float32(0.7)) == pytest.approx(expected, abs=1e-5)


def test_rows_side_by_side_do_not_depend_on_the_threads(monkeypatch):
    monkeypatch.setattr("gearlube_core.kernels.row_workers._FEW", 1)
    found = [
        rows_of(smoother._SideBySide, equations(-6.0), RowWorkers(threads)).solve(
            RESIDUAL, np.float32(1.0)
        )
        for threads in (1, 2, 3)
    ]
    assert (found[0] == found[1]).all()
    assert (found[0] == found[2]).all()


def test_interpreted_kernels_are_the_compiled_ones(monkeypatch):
    compiled = rows_of(smoother._SideBySide, equations(-6.0)).solve(RESIDUAL, np.float32(1.0))
    interpret(monkeypatch, row_factors, smoother)
    found = rows_of(smoother._SideBySide, equations(-6.0)).solve(RESIDUAL, np.float32(1.0))
    assert found == pytest.approx(compiled, abs=1e-6)


@pytest.mark.parametrize(("own", "sound"), [(-6.0, True), (-0.62, False), (np.nan, False)])
def test_equations_with_a_weak_own_node_are_not_sound(own, sound):
    assert rows_of(smoother._SideBySide, equations(own)).sound is sound
