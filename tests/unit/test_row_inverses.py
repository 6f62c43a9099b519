"""Inverses of whole rows, which are kept while rows change little."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.galerkin import sparse_operator
from gearlube_core.ehl.point.newton.wave import uniform_wave_deflection
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.transient import rows
from gearlube_core.ehl.transient.rows import RowInverses, row_shapes, subtract_rows
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.row_operators import dense_row, operator_of, some_entries
from tests.helpers.source_of import interpret, source_of

SHAPE = (49, 65)  # (ny, nx)


def line() -> PointLevel:
    hertz = EllipticParaboloid(0.01, 2.0)
    problem = PointContactProblem(
        gap=hertz,
        entrainment=(1.0, 0.0),
        load=100.0,
        contact_modulus=1.1e11,
        lubricant=film_oil(eta0=0.05, alpha=15e-9),
        x_limits=(-4e-4, 2e-4),
        y_limits=(-5e-3, 5e-3),
        nodes=(SHAPE[1], SHAPE[0]),
        hertz=hertz,
    )
    return PointLevel(problem, PointScales.of(problem), SHAPE, "quick")


def test_node_that_came_is_solved_though_its_row_is_not_inverted_again():
    level = line()
    x = np.linspace(-1.0, 1.0, SHAPE[1])
    pressure = np.broadcast_to(0.05 * np.sqrt(np.maximum(0.0, 1.0 - x**2)), SHAPE).copy()
    pressure[[0, -1]] = 0.0
    state = level.state(pressure, 1.0)
    later = np.zeros(SHAPE, dtype=bool)
    later[1:-1, 5:50] = True
    before = later.copy()
    before[1:-1, 49] = False
    inverses = RowInverses(level.grid)
    assert inverses.renew(sparse_operator(level.linearise(state, rows=before))) == SHAPE[0]
    operator = sparse_operator(level.linearise(state, rows=later))
    # one node in 45 is too little of a change to invert a row for
    assert inverses.renew(operator) == 0
    residual = np.zeros(SHAPE)
    residual[24, 49] = 1.0
    change = inverses(residual)
    rest = residual - operator.apply(change, level.grid.deflection(change), 0.0)
    # damping leaves a tenth, and what it pushes to its neighbours is theirs
    assert abs(rest[24, 49]) < 0.2


SMALL = (6, 40)
WAVE = 0.12 * np.pi  # a row, of the wave across the motion
GRID = SimpleNamespace(shape=SMALL, dx=0.05, dy=0.3, modulus=0.02, graded=False)
LOCAL = uniform_wave_deflection(SMALL[1], GRID.dx, GRID.modulus, WAVE / GRID.dy)
WEIGHT = LOCAL[0, 0]


def test_rows_are_inverted_with_the_deflection_of_a_wave_across_them(monkeypatch):
    interpret(monkeypatch, rows)
    free = np.zeros(SMALL, dtype=bool)
    free[:, 9:31] = np.random.default_rng(2).random((6, 22)) < 0.9
    entries = some_entries(free)
    inverses = RowInverses(GRID)
    assert inverses.renew(operator_of(entries, free)) == SMALL[0]
    residual = np.random.default_rng(3).normal(size=SMALL)
    across = np.cos(WAVE * np.arange(5))
    expected = np.array(
        [
            0.9 * np.linalg.solve(dense_row(entries, free, LOCAL, across, j), row * free[j])
            for j, row in enumerate(residual)
        ]
    )
    # single precision
    found = inverses(residual)
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-5 * np.abs(expected).max())


def diagonal(free: np.ndarray, entry: np.ndarray | complex):
    every = np.broadcast_to(entry, free.shape)
    return operator_of({(j, i, j, i): every[j, i] for j, i in np.argwhere(free)}, free)


@pytest.mark.parametrize(
    ("entry", "change"),
    [
        (2.0, 1.0),
        (-2.0j, 1.0),
        # of which a change by film alone is half
        (complex(5.0 * WEIGHT, 5.0), 2.0j),
        (complex(5.0 * WEIGHT, -5.0), 2.0),
    ],
)
def test_rows_that_have_changed_by_a_twentieth_are_inverted_anew(monkeypatch, entry, change):
    interpret(monkeypatch, rows)
    free = np.zeros(SMALL, dtype=bool)
    free[:, 5:35] = True
    by = complex(change)

    def changed(share: float) -> complex:
        # the change over the mean of before and after
        ratio = (2.0 + share) / (2.0 - share)
        if abs(by) == 1.0:
            return entry * ratio
        if by.imag:
            return complex(entry.real, entry.imag * (1.0 + 2.0 * share))
        return complex(entry.real * (1.0 + 2.0 * share), entry.imag)

    # a part that changes alone grows, and with it the mean, by half of the change
    for share, count in ((0.047, 0), (0.054, 2)):
        inverses = RowInverses(GRID)
        inverses.renew(diagonal(free, entry))
        entries = np.full(SMALL, entry, dtype=complex)
        entries[[1, 4]] = changed(share)
        assert inverses.renew(diagonal(free, entries)) == count
        residual = np.ones(SMALL)
        slope = changed(share) if count else entry
        expected = 0.9 / (slope.real + slope.imag * WEIGHT) if count else None
        if expected is not None and entry.imag == 0.0:
            assert inverses(residual)[[1, 4], 5:35] == pytest.approx(expected, rel=1e-5)


def test_nodes_that_come_or_go_count_as_changed():
    free = np.zeros(SMALL, dtype=bool)
    free[:, 5:30] = True
    for row in (0, 3):
        free[row, 18:30] = False
    later = free.copy()
    later[0, 17] = False  # one of 12: enough
    later[1, 29] = False  # one of 24: too little
    later[3, 18] = True  # one of 14
    later[5, 30] = True  # one of 26
    inverses = RowInverses(GRID)
    inverses.renew(diagonal(free, 2.0))
    assert inverses.renew(diagonal(later, 2.0)) == 2
    found = inverses(np.ones(SMALL))
    # the node that came is solved on its own; a node that goes without its row stays
    expected = 0.45 * (free | later)
    expected[0, 17] = 0.0
    assert found == pytest.approx(expected, rel=1e-6)
    assert inverses.renew(diagonal(later, 4.0)) == SMALL[0]
    assert inverses(np.ones(SMALL)) == pytest.approx(0.225 * later, rel=1e-6)


@pytest.mark.parametrize(("column", "count"), [(6, 1), (5, 6), (23, 1), (24, 6)])
def test_four_columns_are_spared_for_nodes_that_come(column: int, count: int):
    free = np.zeros(SMALL, dtype=bool)
    free[:, 10:20] = True
    inverses = RowInverses(GRID)
    inverses.renew(diagonal(free, 2.0))
    free[2, column] = True
    assert inverses.renew(diagonal(free, 2.0)) == count
    assert inverses(np.ones(SMALL)) == pytest.approx(0.45 * free, rel=1e-6)


def test_columns_at_the_borders_and_none_at_all_are_held():
    free = np.zeros(SMALL, dtype=bool)
    inverses = RowInverses(GRID)
    assert inverses.renew(diagonal(free, 2.0)) == SMALL[0]
    assert not inverses(np.ones(SMALL)).any()
    free[:] = True
    assert inverses.renew(diagonal(free, 2.0)) == SMALL[0]
    assert inverses(np.ones(SMALL)) == pytest.approx(0.45, rel=1e-6)


@each(
    ("shape", "coarser"),
    [
        ((17, 100), []),  # 1700 nodes are solved directly
        ((9, 189), [(5, 189)]),  # 1701 are not
        ((7, 1000), []),  # seven rows are not halved
        ((8, 1000), [(4, 1000)]),
        ((40, 200), [(5, 200), (10, 200), (20, 200)]),
    ],
)
def test_coarser_grids_have_fewer_rows(shape, coarser):
    assert row_shapes(shape) == [*coarser, shape]


def test_what_an_operator_leaves_of_a_residual_is_that_of_dense_matrices():
    free = np.random.default_rng(2).random((5, 7)) < 0.8
    matrix = operator_of(some_entries(free), free).matrix
    right, pressure, film = np.random.default_rng(3).normal(size=(3, 35))
    rest = np.empty(35)
    strided = np.asfortranarray(film.reshape(5, 7))
    pointers = matrix.indptr, matrix.indices, matrix.data
    source_of(subtract_rows)(*pointers, pressure, strided, right, rest)
    dense = matrix.toarray()
    assert rest == pytest.approx(right - dense.real @ pressure - dense.imag @ film)
