"""Cycle of a long contact's grids: parts of it with operators and transfers of two grids."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.transient import rows as module
from gearlube_core.ehl.transient.rows import RowCycle
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
        down=lambda values: values[::2],
        up=lambda values: np.repeat(values, 2, axis=0)[: FINE[0]],
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
