"""Second order of the point contact in its grid."""

from __future__ import annotations

import math

import pytest

from gearlube_core.ehl.point.contact_domain import ContactDomain
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from tests.helpers.ehl_point_cases import moes_contact

# at L = 5 the spike is small enough for 49 nodes to lie in the range of the order
FIXED = ContactDomain(inlet=4.0, outlet=2.0, side=3.0)


def _films(problem: PointContactProblem, wedge: str) -> tuple[float, float]:
    settings = PointSolverSettings(wedge=wedge, tolerance=1e-9, estimate_error=False)
    solution = solve_point_contact(problem, settings)
    middle = solution.pressure[solution.pressure.shape[0] * 2 // 3, problem.nodes[1] // 2]
    return solution.central_film, float(middle)


@pytest.mark.parametrize(("wedge", "lowest"), [("upwind-2", 1.6), ("central", 1.6)])
def test_film_and_pressure_converge_at_second_order(wedge: str, lowest: float) -> None:
    problem = moes_contact(20.0, 5.0, nodes=(49, 49), domain=FIXED)
    films, pressures = zip(
        *(_films(problem.with_nodes(n, n), wedge) for n in (49, 97, 193)), strict=True
    )
    order = math.log2((films[0] - films[1]) / (films[1] - films[2]))
    # 2 in the limit; the free boundary and the spike move by fractions of a cell
    assert lowest < order < 3.2
    # what is left on the finest grid, a third of the last change, is below 0.5 %
    assert abs(films[2] - films[1]) / 3.0 < 5e-3 * films[2]
    assert abs(pressures[2] - pressures[1]) < abs(pressures[1] - pressures[0])
