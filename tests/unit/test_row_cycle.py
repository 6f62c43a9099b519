"""Multigrid cycle by rows: factors, slopes and single precision."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import solve_banded
from scipy.linalg.lapack import sgbtrf
from scipy.sparse import csr_matrix

from gearlube_core.ehl.point.newton import row_factors, smoother
from gearlube_core.ehl.point.newton.galerkin import SparseOperator
from gearlube_core.ehl.point.newton.preconditioner import SingleOperator
from gearlube_core.ehl.point.newton.single_stencil import SingleStencil
from gearlube_core.ehl.point.newton.smoother import Equations
from gearlube_core.ehl.transient import rows as module
from gearlube_core.ehl.transient.rows import RowCycle
from gearlube_core.kernels.row_workers import ALONE, RowWorkers
from gearlube_core.oil import factor_slopes as slopes_module
from gearlube_core.oil.eyring_1936 import Eyring, eyring_flow_factor
from gearlube_core.oil.factor_slopes import factor_slopes
from gearlube_core.oil.shear_flow import shear_factors
from tests.helpers.each import each
from tests.helpers.row_operators import operator_of, some_entries
from tests.helpers.source_of import interpret

RNG = np.random.default_rng(19)
FINE, COARSE = (7, 12), (4, 12)


class Part:
    """Stand-in for the inverses of rows or a deflection: a factor, and what was followed."""

    def __init__(self, factor: float) -> None:
        self.factor, self.seen = factor, []

    def renew(self, operator) -> None:
        self.seen.append(operator)

    follow = renew

    def __call__(self, values: np.ndarray) -> np.ndarray:
        return self.factor * values


def parts(monkeypatch):
    """Return a hierarchy of two grids, its fine and coarse operator, and what makes a cycle."""
    interpret(monkeypatch, module)
    free = RNG.random(FINE) < 0.8
    fine = operator_of(some_entries(free), free)
    fine = type(fine)(fine.matrix, free, RNG.random(FINE))
    coarse = operator_of(some_entries(free[::2]), free[::2])
    transfer = SimpleNamespace(
        down=lambda values: values[::2], up=lambda values: np.repeat(values, 2, axis=0)[: FINE[0]]
    )
    levels = [SimpleNamespace(grid="coarse", load=1.5), SimpleNamespace(grid="fine", load=2.5)]
    grids = SimpleNamespace(levels=levels, transfers=[transfer])
    made = []

    def direct(grid, operator, load):
        made.append((grid, operator, load))
        return lambda residual, missing: (0.3 * residual + 1.0, 0.6 + missing)

    def of(kind, factor):
        def make(grid):
            made.append((kind, grid))
            return Part(factor)

        return make

    monkeypatch.setattr(module, "sparse_operator", lambda linear: fine)
    monkeypatch.setattr(module, "coarse_operator", lambda operator, given: coarse)
    monkeypatch.setattr(module, "CoarseSolution", direct)
    monkeypatch.setattr(module, "RowInverses", of("rows", 0.2))
    monkeypatch.setattr(module, "WindowedDeflection", of("deflection", 0.7))
    return grids, fine, coarse, made


def test_cycle_solves_the_coarse_grid_and_then_the_rows_of_what_is_left(monkeypatch):
    grids, fine, coarse, made = parts(monkeypatch)
    cycle = RowCycle(grids, "linear")
    assert made == [("rows", "fine"), ("deflection", "coarse"), ("coarse", coarse, 1.5)]
    assert cycle._rows[0].seen == [fine]
    assert cycle._deflections[0].seen == [coarse.free]
    residual = RNG.random(FINE)
    pressure, approach = cycle(residual, 0.05)

    assert approach == pytest.approx(0.65)
    below = 0.3 * residual[::2] + 1.0
    up = np.repeat(below, 2, axis=0)[: FINE[0]]
    before, film = np.where(fine.free, up, 0.0), 0.7 * up
    dense = fine.matrix.toarray()
    left = residual.ravel() - dense.real @ before.ravel() - dense.imag @ film.ravel()
    left -= 0.65 * fine.by_approach.ravel()
    expected = before + np.where(fine.free, 0.2 * left.reshape(FINE), 0.0)
    # entries in single precision
    assert pressure == pytest.approx(expected, abs=1e-5 * np.abs(expected).max())


def test_rows_and_deflections_of_the_cycle_before_serve_again(monkeypatch):
    grids, fine, coarse, made = parts(monkeypatch)
    before = RowCycle(grids, "linear")
    count = len(made)
    after = RowCycle(grids, "linear", before)
    assert made[count:] == [("coarse", coarse, 1.5)]
    assert after._rows[0] is before._rows[0]
    assert after._rows[0].seen == [fine, fine]
    assert len(after._deflections[0].seen) == 2


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


LAW = Eyring(1.0)
POINTS = [
    (0.3, 0.2, 0.5, math.inf),
    (-1.4, 0.8, 30.0, math.inf),
    (0.02, -3.0, 4e3, math.inf),
    (4.0, 1.5, -60.0, math.inf),
    (0.7, 0.4, 50.0, 2.5),  # slips
    (-2.0, 1.0, -50.0, 1.2),
    (30.0, -20.0, 1e5, math.inf),
    (90.0, 60.0, 1e8, math.inf),  # beyond |Sigma| = 100
]


@each("point", POINTS)
def test_slopes_are_those_of_differences(point):
    found = factor_slopes(LAW, *point)
    assert (found.along, found.across) == shear_factors(LAW, *point)
    slopes = np.array([found[1:5], found[6:10]])
    for k, value in enumerate(point):
        if not math.isfinite(value):
            assert not slopes[:, k].any()
            continue

        def factors(at: float, k: int = k) -> np.ndarray:
            return np.array(shear_factors(LAW, *point[:k], at, *point[k + 1 :]))

        # fourth order: e^30 over a step of 3e-4 of 30 has a truncation of 1e-9
        step = 3e-4 * abs(value)
        near, far = (factors(value + n * step) - factors(value - n * step) for n in (1, 2))
        expected = (8.0 * near - far) / (12.0 * step)
        # the stress is found to 1e-9, and no better are differences over 3e-4 of a value
        scale = np.array([found.along, found.across]) / abs(value)
        assert slopes[:, k] == pytest.approx(expected, rel=1e-6, abs=3e-6 * scale.min())


@pytest.mark.parametrize(("sigma", "a"), [(0.4, 2.0), (-3.0, 100.0), (12.0, 1e4)])
def test_slopes_along_sliding_are_those_of_the_closed_form(sigma, a):
    found = factor_slopes(LAW, sigma, 0.0, a, math.inf)
    S, by_sigma, by_a = eyring_flow_factor(sigma, a)
    assert found.along == pytest.approx(S, rel=1e-9)
    assert found.along_s == pytest.approx(by_sigma, rel=1e-8)
    assert found.along_a == pytest.approx(by_a, rel=1e-8, abs=0.0)
    assert found.along_r == found.across_r == 0.0


def test_slopes_vanish_with_the_stress_they_belong_to():
    # both factors are even in either Sigma: slopes grow in proportion to it
    small, large = (factor_slopes(LAW, s, 0.7, 5.0, math.inf) for s in (3e-6, 2e-3))
    for name in ("along_s", "across_s"):
        expected = getattr(large, name) * 3e-6 / 2e-3
        assert getattr(small, name) == pytest.approx(expected, rel=1e-3, abs=0.0)
    assert factor_slopes(LAW, 0.0, 0.7, 5.0, math.inf).along_s == 0.0


def test_factors_are_held_along_the_direction_of_a_stress_beyond_the_largest():
    found = factor_slopes(LAW, 120.0, 90.0, 1e4, math.inf)
    # what is left are roundings of slopes as large as the factors
    assert abs(120.0 * found.along_s + 90.0 * found.along_r) < 1e-12 * found.along
    assert abs(120.0 * found.across_s + 90.0 * found.across_r) < 1e-12 * found.across


@pytest.mark.parametrize("point", POINTS[:5])
def test_compiled_slopes_are_those_of_the_source(monkeypatch, point):
    compiled = factor_slopes(LAW, *point)
    interpret(monkeypatch, slopes_module)
    assert slopes_module.factor_slopes(LAW, *point) == pytest.approx(compiled, rel=1e-12)


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
