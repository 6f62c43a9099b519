"""Point contact film against closed forms: rigid isoviscous solids and dry elastic contact."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.ehl.point.contact_domain import ContactDomain, elliptical_contact
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import moes_contact

ISOVISCOUS = film_oil(eta0=0.02, alpha=0.0, density_law="incompressible")
QUICK = PointSolverSettings(estimate_error=False)


def _kapitza_residual(nodes: int, wedge: str, angle: float) -> float:
    """Return the mean residual of Kapitza's solution on a grid, relative to the wedge term.

    p = -12 eta [u x/(3 + 2 R_x/R_y) + v y/(3 + 2 R_y/R_x)]/h^2, negative pressures kept.
    """
    R_x, R_y, speed, film = 0.01, 0.023, 1.3, 2e-6
    u, v = speed * math.cos(angle), speed * math.sin(angle)
    problem = elliptical_contact(
        R_x=R_x,
        R_y=R_y,
        entrainment=(u, v),
        load=5.0,
        contact_modulus=1e11,
        lubricant=ISOVISCOUS,
        nodes=(nodes, nodes),
        domain=ContactDomain(inlet=4.0, outlet=4.0, side=4.0),
    )
    scales = PointScales.of(problem)
    level = PointLevel(problem, scales, (nodes, nodes), wedge)
    x, y = problem.x[:, None], problem.y[None, :]
    h = film + problem.gap(x, y)
    p = -12.0 * 0.02 * (u * x / (3.0 + 2.0 * R_x / R_y) + v * y / (3.0 + 2.0 * R_y / R_x)) / h**2
    state = level.state(scales.inward(p / scales.pressure), 0.0, scales.inward(h / scales.film))
    inner = (slice(3, -3), slice(3, -3))
    wedge_size = np.abs(np.gradient(state.film, level.grid.dx, axis=1)).mean()
    return float(np.abs(state.residual[inner]).mean() / wedge_size)


@each("angle", [0.0, 0.5, 2.3])
@each(("wedge", "order"), [("upwind-1", 1), ("upwind-2", 2), ("central", 2), ("quick", 2)])
def test_kapitzas_rigid_film_solves_the_equation_to_the_order_of_the_stencil(
    wedge: str, order: int, angle: float
) -> None:
    coarse = _kapitza_residual(129, wedge, angle)
    fine = _kapitza_residual(257, wedge, angle)
    # the mean of |residual| falls by 2^order once 2 um films are resolved; 0.3 for the rest
    assert math.log2(coarse / fine) > order - 0.3


def test_a_stiff_contact_floats_on_the_rigid_isoviscous_film() -> None:
    R, speed, load = 0.01, 1.0, 1.0
    problem = elliptical_contact(
        R_x=R,
        R_y=R,
        entrainment=(speed, 0.0),
        load=load,
        contact_modulus=1e13,
        lubricant=ISOVISCOUS,
        nodes=(65, 65),
        domain=ContactDomain(inlet=50.0, outlet=15.0, side=50.0),
    )
    solution = solve_point_contact(problem, QUICK)
    # half of Kapitza's antisymmetric pressure: W = 12 pi eta u R/5 sqrt(2 R/h)
    half = 2.0 * R * (12.0 * math.pi * 0.02 * speed * R / (5.0 * load)) ** 2
    # the smooth exit carries a few percent more than half of the antisymmetric pressure, the
    # border of the domain, 50 to 90 films up, takes as much away
    assert 0.9 < solution.minimum_film / half < 1.15
    assert solution.outcome.converged


def test_under_a_thin_film_the_pressure_is_that_of_the_dry_contact() -> None:
    problem = moes_contact(1000.0, 5.0, nodes=(65, 65), radius_ratio=2.0)
    solution = solve_point_contact(problem, QUICK)
    a_x, a_y, largest = problem.hertz_contact
    x, y = problem.x[:, None] / a_x, problem.y[None, :] / a_y
    dry = np.sqrt(np.maximum(0.0, 1.0 - x * x - y * y))
    inside = x * x + y * y < 0.8
    difference = np.abs(solution.pressure / largest - dry)[inside]
    # the film is 1/30 of the approach and its inlet and side lobes are steeper: 0.05 and 0.01
    assert difference.max() < 0.05
    assert np.mean(difference) < 0.01
