"""Multigrid cycle with rows side by side, and inverses of rows."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.ehl.point.contact_domain import line_section
from gearlube_core.ehl.point.newton import column_multigrid, preconditioner
from gearlube_core.ehl.point.newton.column_multigrid import ColumnCycle, held_rows
from gearlube_core.ehl.point.newton.galerkin import coarse_operator, sparse_operator
from gearlube_core.ehl.point.newton.newton import flexible_gmres
from gearlube_core.ehl.point.newton.preconditioner import MultigridCycle
from gearlube_core.ehl.point.newton.transfer import build_hierarchy
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import Sides
from gearlube_core.ehl.transient import patches
from gearlube_core.kernels import row_workers
from gearlube_core.kernels.row_workers import RowWorkers
from gearlube_core.oil.film_oil_data import film_oil

ROWS, COLUMNS = 18, 65  # rows that are halved to 9 once
LENGTH = 0.1e-3  # rows and columns as far apart: both are halved


def grids(sides: str, length: float = LENGTH):
    problem = line_section(
        R_x=0.014,
        length=length,
        line_load=3.6e5,
        speed_1=7.9178,
        speed_2=5.5022,
        contact_modulus=0.5 * 227.5e9,
        lubricant=film_oil(eta0=0.00625, alpha=13.3e-9, eyring_stress=10e6),
        nodes=(COLUMNS, ROWS),
        sides=sides,
    )
    return build_hierarchy(problem, PointScales.of(problem), "quick")


def linearised(hierarchy):
    """Derivatives at an uneven pressure with holes, where pressure is known."""
    level = hierarchy.levels[-1]
    rng = np.random.default_rng(3)
    x = np.linspace(-2.5, 1.5, COLUMNS)
    wave = 1.0 + 0.2 * np.sin(2.0 * np.pi * np.arange(level.shape[0]) / ROWS)[:, None]
    pressure = np.sqrt(np.maximum(1.0 - x**2, 0.0)) * wave + 0.01 * (np.abs(x) < 1.4)
    pressure *= rng.uniform(0.9, 1.1, level.shape)
    pressure[4:6, 30:33] = 0.0
    pressure[[0, -1]] = 0.0
    bent = level.film(pressure, 0.0)
    return level.linearise(level.state(pressure, 0.3 - float(bent.min())))


@pytest.mark.parametrize("length", [LENGTH, 20.0 * LENGTH])
def test_cycle_is_that_of_sparse_matrices(length, monkeypatch):
    monkeypatch.setattr(column_multigrid, "_DAMPING", preconditioner._DAMPING)
    hierarchy = grids("cyclic", length)
    linear = linearised(hierarchy)
    own, other = ColumnCycle(hierarchy, linear), MultigridCycle(hierarchy, linear)
    residual = np.random.default_rng(8).normal(size=linear.free.shape)
    residual = np.where(linear.free, residual * np.abs(linear.by_pressure[0]), 0.0)
    for right, load in ((residual, 0.0), (linear.right, 0.2), (np.zeros_like(residual), 1.0)):
        (pressure, approach), (expected, expected_approach) = own(right, load), other(right, load)
        # both in single precision
        assert pressure == pytest.approx(expected, abs=1e-3 * np.abs(expected).max())
        assert approach == pytest.approx(expected_approach, rel=1e-3)
    # arrays are taken over: nothing of the cycle before is left
    again = ColumnCycle(hierarchy, linear, ColumnCycle(hierarchy, linear))
    assert np.array_equal(again(linear.right, 0.2)[0], own(linear.right, 0.2)[0])


@pytest.mark.parametrize("length", [LENGTH, 20.0 * LENGTH])
def test_cycle_serves_where_no_oil_passes_the_sides(length):
    # rows beside the sides are smoothed without what they feel of their own image: not the same
    hierarchy = grids("no_flow", length)
    linear, level = linearised(hierarchy), hierarchy.levels[-1]

    def operator(pressure, approach):
        rest = level.grid.integral(pressure) / level.load
        return level.apply(linear, pressure, approach).copy(), rest

    own, other = (
        flexible_gmres(operator, cycle, linear.right, 0.1, tolerance=1e-5, most=60, weight=1.0)
        for cycle in (ColumnCycle(hierarchy, linear), MultigridCycle(hierarchy, linear))
    )
    assert own[2] < 1e-5
    assert own[3] <= other[3] + 1


def parts_of(monkeypatch, module, name, place):
    """Return the parts, an argument at some place, with which a kernel will be called."""
    work, seen = getattr(module, name), set()

    def spied(*given):
        seen.add(given[place])
        return work(*given)

    monkeypatch.setattr(module, name, spied)
    return seen


@pytest.mark.parametrize("threads", [2, 3, 5])
@pytest.mark.parametrize("length", [LENGTH, 20.0 * LENGTH])
@pytest.mark.parametrize("sides", ["cyclic", "no_flow"])
def test_cycle_is_the_same_to_the_bit_for_any_number_of_threads(
    sides, length, threads, monkeypatch
):
    hierarchy = grids(sides, length)
    linear = linearised(hierarchy)
    pressure, approach = ColumnCycle(hierarchy, linear)(linear.right, 0.2)
    monkeypatch.setattr(row_workers, "_FEW", 1)
    parts = [
        parts_of(monkeypatch, *work)
        for work in (
            (column_multigrid, "pack_and_coarsen", -1),
            (column_multigrid, "factor_rows", -3),
            (column_multigrid, "turn_derivatives", -2),
            (column_multigrid, "solve_rows", -3),
            (column_multigrid, "descend", 1),
            (column_multigrid, "add_coarser", 1),
            (column_multigrid, "subtract_changes", 1),
            (column_multigrid, "finish", 1),
        )
    ]
    monkeypatch.setattr(column_multigrid, "TOGETHER", 4)
    for level in hierarchy.levels:
        level.set_workers(RowWorkers(threads))
    shared_pressure, shared_approach = ColumnCycle(hierarchy, linear)(linear.right, 0.2)
    assert np.array_equal(shared_pressure, pressure)
    assert shared_approach == approach
    # all of it was shared
    for seen in parts:
        assert len({first for first, _ in seen if first > 0}) >= threads - 1


@pytest.mark.parametrize("sides", ["cyclic", "no_flow"])
def test_coarse_derivatives_are_products_of_matrices(sides):
    hierarchy = grids(sides)
    linear = linearised(hierarchy)
    cycle = ColumnCycle(hierarchy, linear)
    operator = sparse_operator(linear)
    for transfer, whole, level in zip(
        hierarchy.transfers[::-1], cycle.grids.whole[-2::-1], hierarchy.levels[-2::-1], strict=True
    ):
        operator = coarse_operator(operator, transfer)
        found = whole.operator(Sides(sides))
        free = operator.free.ravel()
        assert np.array_equal(found.free, operator.free)
        assert found.by_approach == pytest.approx(
            operator.by_approach, abs=1e-6 * np.abs(operator.by_approach).max()
        )
        for part in (lambda matrix: matrix.real, lambda matrix: matrix.imag):
            dense, expected = (part(one.matrix.toarray()) for one in (found, operator))
            if part(1j) == 0.0:  # pressure of nodes where it is known does not change
                expected, dense = expected[:, free], dense[:, free]
            limit = 1e-6 * np.abs(expected).max()
            np.testing.assert_allclose(dense, expected, rtol=0.0, atol=limit)
        assert found.free.shape == level.shape


def test_a_node_that_hardly_feels_its_own_pressure_does_not_grow_in_the_lines(monkeypatch):
    hierarchy = grids("cyclic")
    linear = linearised(hierarchy)
    sound = ColumnCycle(hierarchy, linear)(linear.right, 0.1)[0]
    # the equation of one node loses its own pressure: to solve its row it would be exchanged
    own = linear.by_pressure[linear.centre], linear.by_film[linear.centre]
    for slopes in own:
        slopes[9, 32] *= 1e-6
    weak = ColumnCycle(hierarchy, linear)(linear.right, 0.1)[0]
    # an exact solution of that row would be as large as the inverse of what is left
    assert np.abs(weak).max() < 10.0 * np.abs(sound).max()


def test_rows_beyond_the_sides():
    assert list(held_rows(Sides("cyclic"), 4, 3)) == [1, 2, 3, 0, 1, 2, 3, 0, 1, 2]
    assert list(held_rows(Sides("no_flow"), 4, 5)) == [3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0]


def at(*nodes):
    """Flags of 18 rows and a copied one at both ends, set at row, column."""
    flags = np.zeros((ROWS + 2, COLUMNS), dtype=bool)
    flags[tuple(np.transpose(nodes))] = True
    return flags


@pytest.mark.parametrize("sides", ["cyclic", "no_flow"])
def test_patches_leave_nothing_of_their_equations(sides):
    hierarchy = grids(sides)
    linear, level = linearised(hierarchy), hierarchy.levels[-1]
    # at both ends of the rows, where the film repeats or is mirrored
    linear.touching = at((1, 30), (ROWS, 33))
    pressure = np.where(linear.free, np.random.default_rng(5).uniform(size=level.shape), 0.0)
    changed = pressure.copy()
    deflection = level.grid.deflection(pressure).copy()
    found = patches.TouchingPatches(level.grid, linear)
    found.correct(linear.right, deflection, 0.1, changed)
    inside = (changed != pressure) & linear.free
    # 5 x 7 around both, of which they share 4 x 4 where rows repeat; else 3 x 7 at either end
    assert inside.sum() == {"cyclic": 2 * 5 * 7 - 4 * 4, "no_flow": 2 * 3 * 7}[sides]
    before, rest = (
        np.abs(linear.right - level.apply(linear, one, 0.1))[inside] for one in (pressure, changed)
    )
    if sides == "cyclic":
        # factors have seven digits, of equations that range over three orders of magnitude
        assert rest.max() < 1e-3 * before.max()
    else:
        # patches apart: each feels what the other one adds
        assert rest.max() < 0.3 * before.max()


def test_patches_go_on_where_rows_repeat_and_are_cut_where_large(monkeypatch):
    free = np.ones((ROWS + 2, COLUMNS), dtype=bool)
    touching = at((1, 10), (ROWS, 12), (9, 40))
    assert patches.patch_numbers(touching, free, True).max() == 2
    number = patches.patch_numbers(touching, free, False)
    assert number.max() == 3
    assert (number[[0, -1]] == 0).all()
    # two rows to either side, three columns
    assert {*zip(*np.nonzero(number == number[9, 40]), strict=True)} == {
        (j, i) for j in range(7, 12) for i in range(37, 44)
    }
    free[8, 38:43] = False
    # the first two share 4 x 5 nodes
    whole = 3 * 5 * 7 - 4 * 5
    assert (patches.patch_numbers(touching, free, True) > 0).sum() == whole - 5
    monkeypatch.setattr(patches, "_LARGEST", 20)
    monkeypatch.setattr(patches, "_TILE", 4)
    cut = patches.patch_numbers(touching, np.ones_like(free), True)
    assert np.bincount(cut.ravel())[1:].max() <= 16
    assert (cut > 0).sum() == whole
