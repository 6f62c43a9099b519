"""Grids of a point contact from coarse to fine, and its rows and columns solved one by one."""

from __future__ import annotations

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.point.newton import smoother, transfer
from gearlube_core.ehl.point.newton.single_stencil import SingleStencil
from gearlube_core.ehl.point.newton.smoother import ColumnSmoother, RowSmoother
from gearlube_core.ehl.point.newton.transfer import Hierarchy, grid_shapes
from gearlube_core.ehl.point.newton.wave import uniform_wave_deflection
from gearlube_core.ehl.point.settings import AMBIENT
from gearlube_core.ehl.point.terms.differences import Differences
from gearlube_core.ehl.point.terms.elements import Elements
from gearlube_core.kernels.row_workers import ALONE
from tests.helpers.each import each
from tests.helpers.row_operators import dense_row, operator_of, some_entries
from tests.helpers.source_of import interpret


@each(
    ("nodes", "steps", "coarser"),
    [
        # up to 1300 nodes are solved directly
        ((26, 50), (1.0, 1.0), []),
        ((27, 49), (1.0, 1.0), [(14, 25)]),
        ((1, 1301), (1.0, 1.0), [(1, 651)]),
        # spacings within a ratio of 1.5 are halved together, else the smaller one first
        ((65, 65), (1.45, 1.0), [(33, 33)]),
        ((65, 65), (1.0, 1.45), [(33, 33)]),
        ((65, 65), (1.55, 1.0), [(33, 17), (65, 33)]),
        ((65, 65), (1.0, 1.55), [(17, 33), (33, 65)]),
        # 129 steps become 64 and their ratio 1.493; 128 become 64 and the ratio 1.505
        ((40, 130), (3.01, 1.0), [(20, 33), (40, 65)]),
        ((40, 129), (3.01, 1.0), [(20, 17), (40, 33), (40, 65)]),
        # sides of 12 nodes are not halved, also where theirs is the smaller spacing
        ((13, 401), (1.0, 0.9), [(7, 101), (7, 201)]),
        ((12, 401), (1.0, 0.9), [(12, 101), (12, 201)]),
        ((401, 12), (0.9, 1.0), [(101, 12), (201, 12)]),
        ((12, 200), (0.5, 1.0), [(12, 100)]),
        ((200, 12), (1.0, 0.5), [(100, 12)]),
    ],
)
def test_sides_are_halved_until_the_grid_is_solved_directly(nodes, steps, coarser):
    assert grid_shapes(nodes, steps) == [*coarser, nodes]


@pytest.mark.parametrize("swap", [False, True])
@pytest.mark.parametrize(
    ("ratio", "shapes"),
    [
        # dy/dx of 64 and 59 steps; with a node more or less on either side it is beyond 1.5
        (1.505, [(30, 17), (60, 33), (60, 65)]),
        (1.495, [(30, 33), (60, 65)]),
    ],
)
def test_grids_of_a_problem_are_those_of_its_limits(monkeypatch, swap: bool, ratio, shapes):
    made = []
    monkeypatch.setattr(transfer, "PointLevel", lambda *given, **more: made.append((given, more)))
    monkeypatch.setattr(transfer, "Transfer", lambda fine, coarse, sides: (fine, coarse))
    # 64 steps along x over 64 m, 59 along y over 59 ratio m
    problem = SimpleNamespace(nodes=(65, 60), spacing=(1.0, ratio), sides="ambient")
    scales = SimpleNamespace(swap=swap)
    grids = transfer.build_hierarchy(problem, scales, "quick", "elements", "jfo")
    if swap:
        shapes = [shape[::-1] for shape in shapes]
    assert [given for given, _ in made] == [(problem, scales, shape, "quick") for shape in shapes]
    assert made[0][1] == {"scheme": Elements, "cavitation": "jfo"}
    assert grids.transfers == [(fine, coarse) for coarse, fine in pairwise(shapes)]
    transfer.build_hierarchy(problem, scales, "quick")
    assert made[-1][1] == {"scheme": Differences, "cavitation": "reynolds"}


def test_grids_below_keep_the_transfers_between_them():
    levels, transfers = list("abcd"), ["a-b", "b-c", "c-d"]
    below = Hierarchy(levels, transfers).below(3)
    assert (below.levels, below.transfers) == (["a", "b", "c"], ["a-b", "b-c"])
    assert Hierarchy(levels, transfers).below(1).transfers == []


SHAPE = (7, 16)
GRID = SimpleNamespace(
    shape=SHAPE,
    modulus=0.02,
    graded=False,
    sides=AMBIENT,
    workers=ALONE,
    own_deflection=np.ones(SHAPE),
)


def solved(entries, free, residual, halved, spacing) -> np.ndarray:
    """Solve rows one by one, at 0.55 of the shortest wave across them and 0.35 of that along."""
    dy, dx = spacing
    wave = max(halved[0] * 0.55 * np.pi / dy, halved[1] * 0.35 * np.pi / dx)
    local = uniform_wave_deflection(free.shape[1], dx, GRID.modulus, wave)
    across = np.cos(np.arange(5) * min(wave * dy, 0.55 * np.pi))
    return np.array(
        [
            np.linalg.solve(
                dense_row(entries, free, local, across, j, 2, smoother.REACH), row * free[j]
            )
            for j, row in enumerate(residual)
        ]
    )


@pytest.mark.parametrize("halved", [(True, False), (False, True), (True, True)])
@pytest.mark.parametrize("spacing", [(0.02, 0.05), (0.05, 0.02)])
def test_rows_and_columns_are_solved_as_dense_matrices_say(monkeypatch, halved, spacing):
    interpret(monkeypatch, smoother)
    free = np.random.default_rng(9).random(SHAPE) < 0.85
    entries = some_entries(free)
    operator = operator_of(entries, free)
    dy, dx = spacing
    grid = SimpleNamespace(**vars(GRID) | {"dx": dx, "dy": dy})
    residual = np.random.default_rng(1).normal(size=SHAPE)
    stencil = SingleStencil.of(operator.matrix, SHAPE, 0, grid.own_deflection[0])
    found = RowSmoother(grid, operator, stencil, halved, 0.7)(residual)
    expected = 0.7 * solved(entries, free, residual, halved, spacing)
    # factors of single precision
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-4 * np.abs(expected).max())

    found = ColumnSmoother(grid, operator, halved, 0.7)(residual)
    turned = {(i, j, ii, jj): entry for (j, i, jj, ii), entry in entries.items()}
    expected = 0.7 * solved(turned, free.T, residual.T, halved[::-1], spacing[::-1]).T
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-4 * np.abs(expected).max())
