"""Deflection within a box: the same as that of the whole grid, wherever pressure is."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.ehl.point.equations.stencil import Grading
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.transient.rows import WindowedDeflection
from gearlube_core.oil.film_oil_data import film_oil

SHAPE = (97, 41)  # (ny, nx)


def level(grading: Grading | None = None) -> PointLevel:
    hertz = EllipticParaboloid(0.01, 0.4)
    problem = PointContactProblem(
        gap=hertz,
        entrainment=(1.0, 0.0),
        load=100.0,
        contact_modulus=1.1e11,
        lubricant=film_oil(eta0=0.05, alpha=15e-9),
        x_limits=(-1e-3, 1e-3),
        y_limits=(-5e-3, 5e-3),
        nodes=(SHAPE[1], SHAPE[0]),
        hertz=hertz,
    )
    return PointLevel(problem, PointScales.of(problem), SHAPE, "upwind-2", grading)


def patch(rows: slice, columns: slice) -> np.ndarray:
    free = np.zeros(SHAPE, dtype=bool)
    free[rows, columns] = True
    return free


@pytest.mark.parametrize("grading", [None, Grading((-1e-3, 0.0, 1e-3), (2.0, 1.0, 1.0))])
def test_box_follows_the_pressure(grading):
    grid, random = level(grading).grid, np.random.default_rng(3)
    window = WindowedDeflection(grid)
    # a line that grows, moves on and shrinks
    for rows in (slice(1, 9), slice(1, 60), slice(5, 62), slice(40, 96), slice(90, 96)):
        free = patch(rows, slice(7, 33))
        window.follow(free)
        pressure = np.where(free, random.random(SHAPE), 0.0)
        whole = grid.deflection(pressure)
        seen = patch(slice(max(rows.start - 2, 0), rows.stop + 2), slice(5, 35))
        # single precision: 6e-8 a number, some times that after transforms of 10^4 numbers
        assert window(pressure)[seen] == pytest.approx(whole[seen], rel=3e-6)


def test_box_of_a_part_leaves_the_rest_zero():
    grid = level().grid
    window = WindowedDeflection(grid)
    window.follow(patch(slice(10, 20), slice(10, 20)))
    film = window(np.where(patch(slice(10, 20), slice(10, 20)), 1.0, 0.0))
    assert film[15, 15] > 0.0
    assert not film[60:].any()


def test_box_of_nothing_is_there():
    window = WindowedDeflection(level().grid)
    window.follow(np.zeros(SHAPE, dtype=bool))
    assert not window(np.zeros(SHAPE)).any()
