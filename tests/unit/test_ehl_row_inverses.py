"""Rows of a kept preconditioner: nodes that came since they were inverted are not forgotten."""

from __future__ import annotations

import numpy as np

from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.galerkin import sparse_operator
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.transient.rows import RowInverses
from gearlube_core.oil.film_oil_data import film_oil

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
    rest = residual - operator.apply(level.grid, inverses(residual), 0.0)
    # damping leaves a tenth, and what it pushes to its neighbours is theirs
    assert abs(rest[24, 49]) < 0.2
