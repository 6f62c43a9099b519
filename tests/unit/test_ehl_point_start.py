"""Start of a point contact's film, and the measure of what flow is unbalanced, by hand."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.newton import flow_residual
from gearlube_core.ehl.point.problem import EllipticParaboloid, expected_film
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.solver import _hertz_start
from gearlube_core.ehl.point.start import zero_border
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import ALPHA, RADIUS, REDUCED_MODULUS, moes_contact, moes_film


def level_of(problem, nodes):
    scales = PointScales.of(problem)
    shape = nodes if scales.swap else nodes[::-1]
    return PointLevel(problem, scales, shape, "upwind-1")


def widened(problem):
    """Semi-axes of the dry ellipse, widened to where a rigid film of that height carries."""
    a_x, a_y, _ = problem.hertz_contact
    film = expected_film(problem)
    return math.sqrt(a_x**2 + RADIUS * film), math.sqrt(a_y**2 + 3.0 * RADIUS * film)


@each("nodes", [(33, 33), (9, 33), (33, 9)])
@each("load", [3.0, 300.0])
def test_start_is_an_ellipse_of_pressure_that_carries_the_load(load, nodes):
    """As wide as a rigid film asks for, and as the grid can show."""
    problem = moes_contact(load, 5.0, nodes=(33, 33), radius_ratio=3.0)
    level = level_of(problem, nodes)
    state = _hertz_start(problem, level)
    inner = zero_border(state.pressure)  # the border has the pressure of the oil beyond it
    assert level.grid.integral(inner) == pytest.approx(level.load, rel=1e-12)
    squares = np.zeros(nodes)
    for axis, (at, semi_axis) in enumerate(
        zip((level.grid.x, level.grid.y), widened(problem), strict=True)
    ):
        width = max(semi_axis, 2.5 * (at[1] - at[0]))
        assert (width > semi_axis) == (nodes[axis] == 9)
        squares += np.expand_dims(at / width, 1 - axis) ** 2
    ellipse = zero_border(np.sqrt(np.maximum(0.0, 1.0 - squares)))
    largest = level.scales.outward(inner).max() / ellipse.max()
    np.testing.assert_allclose(level.scales.outward(inner), largest * ellipse, atol=1e-9 * largest)


@pytest.mark.parametrize("load", [30.0, 300.0])
def test_start_leaves_the_film_that_is_expected(load):
    problem = moes_contact(load, 5.0, nodes=(33, 33), radius_ratio=3.0)
    level = level_of(problem, (33, 33))
    film = _hertz_start(problem, level).film.min() * level.scales.film
    # the pressure of the oil beyond the border adds a little where the load is small
    assert film == pytest.approx(expected_film(problem), rel=1e-3)


def test_flow_that_is_unbalanced_counts_where_the_oil_is_free_over_that_through_the_dry_width():
    pressure = np.array([[0.0, 1.0, 0.0], [0.2, 2.0, 1.7], [0.0, 1.4, 0.0]])
    state = SimpleNamespace(
        pressure=pressure,
        residual=np.array([[9.0, -0.2, 0.3], [0.1, 0.4, -0.1], [9.0, 0.2, 9.0]]),
        free=np.array([[False, True, True], [True, True, True], [False, True, False]]),
        film=np.array([[5.0, 2.0, 5.0], [2.0, 0.6, 0.8], [5.0, 1.5, 5.0]]),
        contact=SimpleNamespace(unbalanced=lambda residual, grid: 0.25),
    )
    grid = SimpleNamespace(integral=lambda values: 0.5 * values.sum())
    level = SimpleNamespace(grid=grid, half_width=0.4)
    # 0.5 x 1.3 and 0.25 of solids; nodes above 0.8 of the largest pressure have films 0.6 and 0.8
    assert flow_residual(level, state) == pytest.approx(0.9 / (0.8 * 0.7), rel=1e-14)
    state.film = -state.film
    assert flow_residual(level, state) == math.inf


def _expected_group(M, ratio):
    """H of an isoviscous contact after the formulas of rigid and of soft solids, lam = 1/ratio."""
    lam = 1.0 / ratio
    rigid = 2.0 * ratio * (6.0 * math.pi / ((3.0 + 2.0 * lam) * M)) ** 2
    c = 1.0 + 0.006 * math.log(lam) + 0.63 * lam ** (4.0 / 7.0)
    soft = 3.18 * c**-0.56 * lam ** (-1.0 / 15.0) * M ** (-2.0 / 15.0)
    return max(rigid, min(soft, 1.8 / lam))


@each("ratio", [1.0, 3.0])
@each("M", [1.0, 5.0, 20.0, 300.0])
def test_expected_film_of_a_constant_viscosity_is_that_of_rigid_or_soft_solids(M, ratio):
    # Kapitza; Nijenbanning, Venner and Moes
    problem = moes_contact(M, 0.0, nodes=(33, 33), radius_ratio=ratio)
    assert moes_film(problem, expected_film(problem)) == pytest.approx(
        _expected_group(M, ratio), rel=1e-12
    )


@each("angle", [0.0, 0.4, 0.5 * math.pi])
@each("turned", [False, True])
def test_expected_film_of_a_piezoviscous_oil_is_that_of_chittenden(angle, turned):
    problem = moes_contact(100.0, 12.0, nodes=(33, 33), radius_ratio=2.0, angle=angle)
    if turned:  # the same contact with its axes exchanged
        shape = EllipticParaboloid(2.0 * RADIUS, RADIUS)
        problem = replace(problem, gap=shape, hertz=shape, entrainment=problem.entrainment[::-1])
    cos, sin = math.cos(angle) ** 2, math.sin(angle) ** 2
    R_e, R_s = RADIUS / (cos + 0.5 * sin), RADIUS / (sin + 0.5 * cos)
    E, oil = REDUCED_MODULUS, problem.lubricant
    U = oil.eta0 * math.hypot(*problem.entrainment) / (E * R_e)
    side_flow = 1.0 - math.exp(-1.23 * (R_s / R_e) ** (2.0 / 3.0))
    film = 4.31 * R_e * U**0.68 * (ALPHA * E) ** 0.49 * (problem.load / (E * R_e**2)) ** -0.073
    assert expected_film(problem) == pytest.approx(film * side_flow, rel=1e-12)


@pytest.mark.parametrize(("M", "films"), [(1.0, 320.0), (20.0, None), (300.0, None)])
def test_flooded_domain_reaches_to_a_gap_of_20_films_and_of_320_under_thick_ones(M, films):
    problem = moes_contact(M, 0.0, nodes=(33, 33), oil_beyond=False)
    a, film = problem.hertz_contact[0], expected_film(problem)
    thickness = min(1.0, film * RADIUS / a**2)
    if films is None:
        assert thickness < 1.0
        films = 20.0 * (1.0 + 15.0 * thickness**4)
    else:
        assert thickness == 1.0
    flooded = a + math.sqrt(2.0 * RADIUS * films * film)
    side = max(2.0 * a, (0.6 + 0.4 * thickness) * flooded)
    assert problem.x_limits == pytest.approx((-max(2.5 * a, flooded), max(1.5 * a, 0.3 * flooded)))
    assert problem.y_limits == pytest.approx((-side, side))
    # oil beyond the border makes up for what a near border leaves out
    near = moes_contact(M, 0.0, nodes=(33, 33), oil_beyond=True)
    reach = max(2.5 * a, a + math.sqrt(2.0 * RADIUS * 20.0 * film))
    assert near.x_limits[0] == pytest.approx(-reach)
