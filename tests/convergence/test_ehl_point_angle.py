"""A round contact does not know the axes of its grid: Eyring film, entrained at an angle."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.ehl.point.contact_domain import ContactDomain, elliptical_contact
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.traction import point_traction
from gearlube_core.oil.film_oil_data import film_oil


def film_and_friction(nodes: int, angle: float) -> np.ndarray:
    """Return central film, smallest film and friction force at half the speed of sliding."""
    along = np.array([math.cos(angle), math.sin(angle)])
    problem = elliptical_contact(
        R_x=0.01,
        R_y=0.01,
        entrainment=(along[0], along[1]),
        sliding=(0.5 * along[0], 0.5 * along[1]),
        load=20.0,
        contact_modulus=1.15e11,
        lubricant=film_oil(eta0=0.04, alpha=2e-8, eyring_stress=5e6),
        nodes=(nodes, nodes),
        # a square whose corner does not flood the inlet better than its side does
        domain=ContactDomain(inlet=6.0, outlet=6.0, side=6.0),
    )
    solution = solve_point_contact(problem, PointSolverSettings(wedge="quick"))
    friction = point_traction(
        problem.x, problem.y, solution.pressure, solution.film, problem.sliding, problem.lubricant
    ).force
    return np.array([solution.central_film, solution.minimum_film, friction])


@pytest.mark.slow  # elements and differences meet at an angle in the default run
def test_film_and_friction_at_45_degrees_go_to_those_along_an_axis() -> None:
    off = [
        np.abs(film_and_friction(n, 0.25 * math.pi) / film_and_friction(n, 0.0) - 1.0)
        for n in (97, 193)
    ]
    # central film to second order: 0.26, 0.05 % on 97, 193 nodes
    assert off[0][0] < 5e-3
    assert off[1][0] < 0.35 * off[0][0]
    # the smallest film is that of a node, which lies elsewhere on a turned grid: 0.6, 0.3 %
    assert off[0][1] < 0.02
    assert off[1][1] < 0.01
    # 0.08, 0.01 %: the sliding stress hardly depends on the grid
    assert off[1][2] < 5e-4
