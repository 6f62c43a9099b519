"""Point contacts that are hard to solve, and the cost of ending the domain."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.solution import limited_faces
from gearlube_core.ehl.point.solver import solve_point_contact
from tests.helpers.ehl_point_cases import moes_contact, moes_film, radius_ratio, sliding_along

NODES = (65, 65)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ellipticity", "M", "L", "slide_roll"),
    [
        # thin lobes beside a contact long in the direction of motion
        pytest.param(0.2, 500.0, 0.0, 0.0, marks=pytest.mark.slow),
        (0.2, 500.0, 10.0, 0.0),
        # linear systems of high contrast
        pytest.param(0.2, 200.0, 25.0, 0.0, marks=pytest.mark.slow),
        pytest.param(0.5, 1000.0, 0.0, 0.0, marks=pytest.mark.slow),
        (100.0, 5000.0, 25.0, 0.0),
        (100.0, 50.0, 0.0, 0.0),  # far thicker than the solids flatten
        # thin lobes of a film that shear thins
        pytest.param(0.2, 1000.0, 10.0, 1.0, marks=pytest.mark.slow),
        (0.5, 1000.0, 20.0, 1.0),  # shear thins
    ],
)
def test_extreme_contacts_converge_in_the_stencil_that_is_asked_for(
    ellipticity: float, M: float, L: float, slide_roll: float
) -> None:
    problem = moes_contact(M, L, nodes=NODES, radius_ratio=radius_ratio(ellipticity))
    if slide_roll > 0.0:
        problem = sliding_along(problem, slide_roll)
    solution = solve_point_contact(problem, throw=False)
    outcome = solution.outcome
    # residual, load, film and complementarity together
    assert outcome.converged, outcome.sentence
    assert outcome.wedge == "upwind-2"
    # a film that collapsed on the grid is thinner by orders of magnitude
    assert moes_film(problem, solution.minimum_film) > 1e-3
    # the unresolved inlet and lobes are lines of nodes: a few of the 33 or so across the contact
    assert outcome.limited < 0.05
    assert solution.load == pytest.approx(problem.load, rel=1e-6)


@pytest.mark.slow
def test_limited_faces_vanish_on_a_grid_that_resolves_the_inlet() -> None:
    problem = moes_contact(1000.0, 0.0, nodes=NODES)
    coarse = solve_point_contact(problem).outcome
    fine = solve_point_contact(problem.with_nodes(193, 193)).outcome
    assert coarse.limited > 0.0
    assert fine.limited == 0.0


@pytest.mark.slow
def test_a_sheared_inlet_is_right_on_a_grid_where_viscosity_multiplies_from_node_to_node() -> None:
    problem = sliding_along(
        moes_contact(200.0, 20.0, nodes=NODES, radius_ratio=radius_ratio(0.5)), 1.0
    )
    coarse, fine = (
        solve_point_contact(p).central_film for p in (problem, problem.with_nodes(97, 97))
    )
    # 9 %; 23 % if the means of viscosity and flow factor were taken apart
    assert coarse == pytest.approx(fine, rel=0.12)


def test_limits_act_where_the_film_halves_in_a_cell_and_nowhere_else() -> None:
    problem = moes_contact(20.0, 5.0, nodes=(23, 19))
    level = PointLevel(problem, PointScales.of(problem), (19, 23), "upwind-2")
    pressure = np.ones((19, 23))
    mass = np.ones((19, 23))
    limited, faces = limited_faces(level.stencil, pressure, mass)
    # one face upstream of each inner node; the entrainment is along x
    assert (limited, faces) == (0, 17 * 21)
    mass[:, 10:] = 0.51
    assert limited_faces(level.stencil, pressure, mass)[0] == 0
    mass[:, 10:] = 0.49
    # 1.5 0.49 - 0.5 < 0.5 0.49 on the face behind column 10, in 17 rows
    assert limited_faces(level.stencil, pressure, mass)[0] == 17
    # at the border too: 1.5 - 0.5 3 < 0.5 on the face behind the second column, and row
    crossed = level.stencil._replace(wedge_y=1.0)
    for axis, count in ((1, 17), (0, 21)):
        mass = np.ones((19, 23))
        mass[(0, slice(None))[:: 1 - 2 * axis]] = 3.0
        assert limited_faces(crossed, pressure, mass)[0] == count


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ellipticity", "M", "L", "allowed"),
    [
        (0.5, 20.0, 5.0, 0.01),
        pytest.param(1.0, 20.0, 5.0, 0.01, marks=pytest.mark.slow),
        pytest.param(1.0, 200.0, 10.0, 0.01, marks=pytest.mark.slow),
        pytest.param(5.0, 200.0, 10.0, 0.01, marks=pytest.mark.slow),
        (5.0, 5.0, 5.0, 0.01),  # rigid: oil goes on beyond the border
    ],
)
def test_a_larger_domain_leaves_the_film(
    ellipticity: float, M: float, L: float, allowed: float
) -> None:
    problem = moes_contact(M, L, nodes=NODES, radius_ratio=radius_ratio(ellipticity))
    x, y = ((1.5 * low, 1.5 * high) for low, high in (problem.x_limits, problem.y_limits))
    # the same spacing: what differs is the end of the domain alone, and nodes by half a cell
    larger = replace(problem, x_limits=x, y_limits=y, nodes=(97, 97))
    film, other = (solve_point_contact(p).central_film for p in (problem, larger))
    assert other == pytest.approx(film, rel=allowed)


@pytest.mark.slow
@pytest.mark.parametrize(("ellipticity", "degrees"), [(2.0, 30.0), (2.0, 60.0), (3.0, 60.0)])
def test_contacts_entrained_askew_keep_their_stencil_on_fine_grids(
    ellipticity: float, degrees: float
) -> None:
    # lines of nodes along x alone do not smooth what is carried along y: the linear solutions
    # stalled and only the film of upwind-1 was found
    problem = moes_contact(
        200.0,
        10.0,
        nodes=(257, 257),
        radius_ratio=radius_ratio(ellipticity),
        angle=math.radians(degrees),
    )
    outcome = solve_point_contact(problem).outcome
    assert outcome.wedge == "upwind-2"
    assert outcome.limited < 0.01
