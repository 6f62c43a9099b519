"""Oil beyond the domain of a point contact: closed forms; films do not depend on domains."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import dblquad

from gearlube_core.ehl.point.contact_domain import ContactDomain, elliptical_contact
from gearlube_core.ehl.point.far_field import FarField
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import moes_contact

ISOVISCOUS = film_oil(eta0=0.02, alpha=0.0, density_law="incompressible")
LIMITS = ((-3e-3, 2e-3), (-4e-3, 5e-3))
QUICK = PointSolverSettings(estimate_error=False)


def _far_field(R_x: float, R_y: float, velocity: tuple[float, float]) -> FarField:
    return FarField(
        R_x=R_x,
        R_y=R_y,
        entrainment=velocity,
        load=1.0,
        contact_modulus=1e15,
        lubricant=ISOVISCOUS,
        x_limits=LIMITS[0],
        y_limits=LIMITS[1],
    )


@each("angle", [0.0, 0.6, 2.5])
def test_pressure_towards_the_inlet_is_that_of_kapitza(angle: float) -> None:
    R_x, R_y, speed, film = 0.01, 0.023, 1.3, 2e-6
    u, v = speed * math.cos(angle), speed * math.sin(angle)
    upstream = angle + math.pi + np.linspace(-0.5, 0.5, 5)
    x, y = 2e-3 * np.cos(upstream), 2e-3 * np.sin(upstream)
    h = film + 0.5 * (x * x / R_x + y * y / R_y)
    kapitza = (
        -12.0 * 0.02 * (u * x / (3.0 + 2.0 * R_x / R_y) + v * y / (3.0 + 2.0 * R_y / R_x)) / h**2
    )
    # the break of the film, more than a right angle away, reaches here as exp(-3 angle)
    found, slope = _far_field(R_x, R_y, (u, v)).pressure(x, y, film)
    assert found == pytest.approx(kapitza, rel=0.03)
    assert slope == pytest.approx(-2.0 * found / h, rel=1e-7)  # a point force lifts too


def test_the_film_of_a_sphere_breaks_where_pressure_and_its_slope_vanish() -> None:
    # p r^3 = cos(a) + c cosh(3 a), a from upstream; both vanish at a: tan(a) = -3 tanh(3 a)
    theta = np.linspace(-math.pi, math.pi, 2000)
    found, _ = _far_field(0.01, 0.01, (1.0, 0.0)).pressure(np.cos(theta), np.sin(theta), 0.0)
    from_upstream = math.pi - abs(theta)
    end = math.pi - math.atan(3.0)
    share = -math.cos(end) / math.cosh(3.0 * end)
    shape = np.cos(from_upstream) + share * np.cosh(3.0 * from_upstream)
    expected = np.where(from_upstream < end, shape, 0.0) * 12.0 * 0.02 / 5.0 / 50.0**2
    # angles 1.5 degrees apart, second order; linear between them
    assert found == pytest.approx(expected, abs=2e-3 * expected.max())


@pytest.mark.slow
def test_load_beyond_is_the_integral_of_the_pressure() -> None:
    far = _far_field(0.01, 0.04, (1.0, 0.4))
    (x0, x1), (y0, y1) = LIMITS

    def ring(s: float, theta: float) -> float:
        c, d = math.cos(theta), math.sin(theta)
        reach = min((x1 if c > 0 else x0) / c, (y1 if d > 0 else y0) / d)
        r = reach / s
        p, _ = far.pressure(np.array([r * c]), np.array([r * d]), 1e-6)
        return float(p[0]) * r * reach / s**2

    expected, _ = dblquad(ring, 1e-3, math.pi + 1e-3, 0.0, 1.0, epsrel=1e-3)
    rest, _ = dblquad(ring, math.pi + 1e-3, 2.0 * math.pi, 0.0, 1.0, epsrel=1e-3)
    load, slope = far.load(1e-6)
    # 16 points along a side, a kink where the film breaks
    assert load == pytest.approx(expected + rest, rel=5e-3)
    near = [far.load(1e-6 + step)[0] for step in (-1e-9, 1e-9)]
    assert slope == pytest.approx((near[1] - near[0]) / 2e-9, rel=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [1.0, 4.0])
def test_rigid_solids_have_the_film_of_brewe_hamrock_and_taylor(ratio: float) -> None:
    R, load, speed = 0.01, 1.0, 1.0
    problem = elliptical_contact(
        R_x=R,
        R_y=ratio * R,
        entrainment=(speed, 0.0),
        load=load,
        contact_modulus=1e13,
        lubricant=ISOVISCOUS,
        nodes=(81, 81),
    )
    solution = solve_point_contact(problem, QUICK)
    # H = 128 a [0.131 atan(a/2) + 1.683]^2 phi^2 (U/W)^2, phi = 1/(1 + 2/(3 a)), a = R_y/R_x
    lift = (0.131 * math.atan(0.5 * ratio) + 1.683) / (1.0 + 2.0 / (3.0 * ratio))
    brewe = 128.0 * ratio * (lift * 0.02 * speed * R / load) ** 2 * R
    # a fit to films on grids with ambient pressure on their border, which thins them
    assert solution.minimum_film == pytest.approx(brewe, rel=0.04)
    assert solution.load == pytest.approx(load, rel=1e-5)
    assert 0.2 < solution.outcome.beyond < 0.3
    assert "Oil beyond the domain carries" in solution.outcome.sentence


def _widened(problem: PointContactProblem, factor: float) -> PointContactProblem:
    (x0, x1), (y0, y1) = problem.x_limits, problem.y_limits
    nx, ny = (round(factor * (count - 1)) + 1 for count in problem.nodes)
    return replace(
        problem,
        x_limits=(factor * x0, factor * x1),
        y_limits=(factor * y0, factor * y1),
        nodes=(nx, ny),
        oil_beyond=True,
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("M", "L", "ratio", "angle"),
    [
        (3.0, 5.0, 1.0, 0.0),  # rigid, oil that thickens
        (10.0, 10.0, 6.3, 0.5),  # rigid, wide, at an angle
        (5.0, 0.0, 1.0, 0.0),  # isoviscous, neither rigid nor soft
        pytest.param(30.0, 0.0, 1.0, 0.8, marks=pytest.mark.slow),
        pytest.param(100.0, 10.0, 1.0, 0.0, marks=pytest.mark.slow),  # elastic
    ],
)
def test_central_film_does_not_hang_on_the_default_domain(
    M: float, L: float, ratio: float, angle: float
) -> None:
    problem = moes_contact(M, L, nodes=(65, 65), radius_ratio=ratio, angle=angle)
    assert problem.oil_beyond
    film = solve_point_contact(problem, QUICK).central_film
    wide = solve_point_contact(_widened(problem, 2.0), QUICK)
    # nodes of the two grids differ: 1 % on 65 nodes, of which the domain is a tenth
    assert film == pytest.approx(wide.central_film, rel=0.01)
    assert "cuts" not in wide.outcome.sentence


@pytest.mark.slow
def test_a_flattened_contact_tells_what_its_domain_costs_and_the_default_costs_little() -> None:
    problem = moes_contact(100.0, 10.0, nodes=(33, 33))
    default = solve_point_contact(problem)
    # 0.03 to 0.1 % in trials, of films that ambient pressure on the border thins by 0.5 to 1 %
    assert default.error.domain.central_film < 2e-3
    assert "Thin-film" not in default.outcome.sentence
    cut = solve_point_contact(replace(problem, oil_beyond=False))
    thinned = 1.0 - cut.central_film / default.central_film
    assert 3e-3 < thinned < cut.error.domain.central_film
    assert "twice as wide: central film" in cut.outcome.sentence


def test_a_ball_that_floats_far_above_its_plane_says_that_the_theory_has_ended() -> None:
    # 10 mm, 0.01 N, 1 m/s, 0.1 Pa.s: a film of 14 mm solves the equations
    ball = elliptical_contact(
        R_x=0.01, R_y=0.01, entrainment=(1.0, 0.0), load=0.01, contact_modulus=1.15e11,
        lubricant=film_oil(eta0=0.1, alpha=2e-8), nodes=(33, 33),
    )  # fmt: skip
    film = solve_point_contact(ball, QUICK)
    assert film.central_film > 0.01
    assert "Thin-film theory has ended: the smallest film is 1.4 of the radius" in (
        film.outcome.sentence
    )


def test_oil_goes_on_beyond_elements_as_well() -> None:
    problem = moes_contact(3.0, 5.0, nodes=(65, 65))
    volumes = solve_point_contact(problem, QUICK)
    elements = solve_point_contact(problem, replace(QUICK, discretisation="elements"))
    # both of second order on the same nodes: 1.3, 0.6 and 0.3 % apart on 65, 97 and 129
    assert elements.central_film == pytest.approx(volumes.central_film, rel=0.02)
    assert elements.outcome.beyond == pytest.approx(volumes.outcome.beyond, rel=0.02)


@pytest.mark.slow
def test_border_through_the_contact_says_so_with_oil_beyond() -> None:
    problem = moes_contact(3.0, 5.0, nodes=(49, 49))
    assert "cuts" not in solve_point_contact(problem, QUICK).outcome.sentence
    low, high = problem.x_limits
    cut = solve_point_contact(replace(problem, x_limits=(0.2 * low, high)), QUICK, throw=False)
    assert "at small x off that of the oil beyond by" in cut.outcome.sentence


def test_oil_goes_on_beyond_a_given_domain_only_if_asked() -> None:
    domain = ContactDomain(inlet=20.0)
    given = moes_contact(3.0, 5.0, nodes=(33, 33), domain=domain)
    assert not given.oil_beyond
    assert moes_contact(3.0, 5.0, nodes=(33, 33), domain=domain, oil_beyond=True).oil_beyond
    assert not moes_contact(3.0, 5.0, nodes=(33, 33), oil_beyond=False).oil_beyond
    assert moes_contact(50.0, 5.0, nodes=(33, 33)).oil_beyond
    with pytest.raises(ParameterError, match="both sides of 0 m"):
        replace(given, oil_beyond=True, x_limits=(1e-4, 2e-4))
