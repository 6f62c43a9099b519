"""Mass-conserving rupture of point contacts: closed forms, balances and limits."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.point.contact_domain import ContactDomain
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import PointSolution
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.film_oil import density, viscosity
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.ehl_point_cases import ALPHA, ETA0, REDUCED_MODULUS, moes_contact, radius_ratio

QUICK = PointSolverSettings(estimate_error=False)
RUPTURED = replace(QUICK, cavitation="mass_conserving")
CONSERVING = replace(RUPTURED, tolerance=1e-10, load_tolerance=1e-10)
WAVE, HEIGHT, VISCOSITY, SPEED = 1e-3, 4e-6, 0.02, 1.0  # m, m, Pa s, m/s


def _mass(solution: PointSolution) -> np.ndarray:
    oil = solution.problem.lubricant
    rho = np.vectorize(lambda q: density(oil, q))(solution.pressure)
    return np.asarray(rho * solution.film * solution.fill)


def _whole_balance(solution: PointSolution) -> float:
    """Return what leaves the whole domain over what enters, less one; entrainment along x."""
    problem = solution.problem
    p, mass = solution.pressure, _mass(solution)
    oil, u = problem.lubricant, problem.entrainment[0]
    dx, dy = problem.x[1] - problem.x[0], problem.y[1] - problem.y[0]
    rho = np.vectorize(lambda q: density(oil, q))(p)
    eta = np.vectorize(lambda q: viscosity(oil, q))(p)
    cubic = rho * solution.film**3

    def pumped(a: tuple, b: tuple, step: float, steep: bool) -> np.ndarray:
        f, g = 1.0 / eta[a], 1.0 / eta[b]
        fluidity = 0.5 * (f + g)
        if steep:
            ratio = np.log(np.where(g == f, 2.0 * f, g) / f)
            fluidity = np.where((p[b] > p[a]) & (g != f), (g - f) / ratio, fluidity)
        return np.sqrt(cubic[a] * cubic[b]) * fluidity / 12.0 * (p[a] - p[b]) / step

    rows, columns = slice(1, -1), slice(1, -1)
    entering = u * (mass[0, rows] if problem.inlet_layer else 0.5 * (mass[0] + mass[1])[rows])
    entering = entering + pumped((0, rows), (1, rows), dx, True)
    leaving = u * mass[-2, rows] + pumped((-2, rows), (-1, rows), dx, True)
    aside = pumped((columns, 1), (columns, 0), dy, False)
    aside = aside + pumped((columns, -2), (columns, -1), dy, False)
    return float((leaving.sum() * dy + aside.sum() * dx) / (entering.sum() * dy) - 1.0)


@pytest.mark.slow
@pytest.mark.parametrize("layer", [None, pytest.param(1.5, marks=pytest.mark.slow), 0.3])
def test_what_enters_the_domain_leaves_it(layer: float | None) -> None:
    problem = moes_contact(50.0, 5.0, nodes=(65, 65))
    flooded = solve_point_contact(problem, CONSERVING)
    solution = flooded
    if layer is not None:
        thin = replace(problem, oil_beyond=False, inlet_layer=layer * flooded.central_film)
        solution = solve_point_contact(thin, CONSERVING)
    # the outlet is ruptured right across: this is the balance with what broken film carries
    assert (solution.fill[-2, 1:-1] < 1.0).all()
    assert (solution.pressure[solution.fill < 1.0] == 0.0).all()
    # the bar of the issue; flows are balanced to 1e-10 of that through the dry width
    assert abs(_whole_balance(solution)) < 1e-8


@pytest.mark.slow
def test_a_flooded_contact_has_the_film_of_reynolds_cavitation() -> None:
    differences = []
    for nodes in (49, 97):
        problem = moes_contact(100.0, 10.0, nodes=(nodes, nodes))
        reynolds, conserving = (solve_point_contact(problem, one) for one in (QUICK, RUPTURED))
        assert conserving.central_film == pytest.approx(reynolds.central_film, rel=1e-4)
        differences.append(abs(conserving.minimum_film / reynolds.minimum_film - 1.0))
    # the wedge falls to first order in the last node or two before the exit alone
    assert differences[0] < 3e-3
    assert differences[1] < 0.7 * differences[0]


def _sommerfeld(phase: float, eccentricity: float) -> tuple[float, float]:
    """Return int dphi/h^2 and int dphi/h^3 from 0 for h = 1 + e cos(phi).

    With 1 + e cos(phi) = (1 - e^2)/(1 - e cos(g)): [g - e sin g]/(1 - e^2)^(3/2) and
    [g (1 + e^2/2) - 2 e sin g + e^2/4 sin 2 g]/(1 - e^2)^(5/2).
    """
    e = eccentricity
    turns = round(phase / (2.0 * math.pi))
    rest = phase - 2.0 * math.pi * turns
    g = 2.0 * math.atan(math.sqrt((1.0 - e) / (1.0 + e)) * math.tan(0.5 * rest))
    g += 2.0 * math.pi * turns
    second = (g - e * math.sin(g)) / (1.0 - e * e) ** 1.5
    third = g * (1.0 + 0.5 * e * e) - 2.0 * e * math.sin(g) + 0.25 * e * e * math.sin(2.0 * g)
    return second, third / (1.0 - e * e) ** 2.5


def _wavy_contact(nodes: int) -> PointContactProblem:
    shape = EllipticParaboloid(WAVE**2 / (4.0 * math.pi**2 * HEIGHT), 1.0)
    return PointContactProblem(
        gap=lambda x, y: HEIGHT * (1.0 - np.cos(2.0 * math.pi * x / WAVE)) + 0.0 * y,
        entrainment=(SPEED, 0.0),
        load=5.0,
        contact_modulus=1e13,
        lubricant=film_oil(eta0=VISCOSITY, alpha=0.0, density_law="incompressible"),
        x_limits=(-0.3 * WAVE, 1.6 * WAVE),
        y_limits=(-5.0 * WAVE, 5.0 * WAVE),
        nodes=(nodes, 17),
        hertz=shape,
    )


@pytest.mark.slow
def test_film_of_a_wavy_wall_breaks_and_forms_again_where_the_closed_form_says() -> None:
    errors = []
    for nodes in (115, 229):
        problem = _wavy_contact(nodes)
        solution = solve_point_contact(problem, replace(RUPTURED, tolerance=1e-8))
        x, p = problem.x, solution.pressure[:, 8]
        # 10 by 2 waves: the ends of the walls are exp(-8) away from the middle row; solids of
        # 1e13 Pa bend by 1e-4 of the film
        mean = solution.film[:, 8].min() + HEIGHT
        e = HEIGHT / mean
        start = 2.0 * math.pi * 0.2

        def rise(phase: float, first: float, flow: float, e: float = e) -> float:
            a, b = _sommerfeld(phase, e), _sommerfeld(first, e)
            return a[0] - b[0] - flow * (a[1] - b[1])

        # pressure and its slope vanish: flow q = u h there
        rupture = brentq(
            lambda f, e=e, start=start: rise(f, start, 1.0 + e * math.cos(f)),  # type: ignore[misc]
            math.pi + 1e-6,
            2.0 * math.pi - start,
        )
        flow = 1.0 + e * math.cos(rupture)
        # the same flow fills the gap again where the pressure that follows ends with it
        end = rupture + 2.0 * math.pi
        reform = brentq(lambda f, end=end, q=flow: rise(end, f, q), rupture + 1e-3, 3.0 * math.pi)  # type: ignore[misc]
        assert reform == pytest.approx(start + 2.0 * math.pi, abs=1e-6)  # a whole wave on
        unit = 12.0 * VISCOSITY * SPEED * WAVE / (2.0 * math.pi) / mean**2
        phase = 2.0 * math.pi * x / WAVE + math.pi
        full = (phase <= rupture) | ((phase >= reform) & (phase <= end))
        first = np.where(phase < reform, start, reform)
        expected = np.array(
            [
                unit * rise(f, a, flow) if ok else 0.0
                for f, a, ok in zip(phase, first, full, strict=True)
            ]
        )
        fill = np.where(full, 1.0, flow / (1.0 + e * np.cos(phase)))
        errors.append(np.abs(p - expected).max() / expected.max())
        away = np.abs((phase - reform + math.pi) % (2.0 * math.pi) - math.pi) > 0.15
        inner = (x > x[1]) & away
        # what is left at the border, the bend of the walls and the node of the rupture
        assert np.abs(solution.fill[:, 8] - fill)[inner].max() < 0.02
        broken = solution.fill[:, 8] < 1.0
        formed = x[:-1][broken[:-1] & ~broken[1:]][0]
        assert formed == pytest.approx(
            (reform / (2.0 * math.pi) - 0.5) * WAVE, abs=2.5 * (x[1] - x[0])
        )
    # the place of reformation is known to a node
    assert errors[0] < 0.05
    assert errors[1] < 0.7 * errors[0]


@pytest.mark.slow
def test_starvation_lowers_the_film_to_the_layer_that_comes() -> None:
    problem = moes_contact(200.0, 10.0, nodes=(49, 49), oil_beyond=False)
    flooded = solve_point_contact(problem, RUPTURED)
    squeezed = density(problem.lubricant, flooded.maximum_pressure) / problem.lubricant.rho0
    layers = np.array([20.0, 1.5, 0.7, 0.05])
    shares = []
    for layer in layers:
        thin = replace(problem, inlet_layer=layer * flooded.central_film * squeezed)
        solution = solve_point_contact(thin, RUPTURED)
        assert solution.outcome.wedge == "upwind-2"
        shares.append(solution.central_film / flooded.central_film)
    found = np.array(shares)
    # more oil than needed changes nothing; with less the film falls, to the layer itself at the
    # density of the middle: none of a thin layer finds time to flow aside
    assert found[0] == pytest.approx(1.0, abs=1e-3)
    assert (np.diff(found) < 0.0).all()
    assert found[-1] == pytest.approx(layers[-1], rel=5e-3)
    assert (found < np.minimum(1.0, layers) * 1.003).all()
    # the form of Chevalier et al. 1998, r/(1 + r^g)^(1/g): sharper the larger g
    for layer, share in zip(layers[1:3], found[1:3], strict=True):
        bounds = [layer / (1.0 + layer**g) ** (1.0 / g) for g in (2.0, 5.0)]
        assert bounds[0] - 0.01 < share < bounds[1] + 0.01


def test_the_middle_of_a_long_contact_is_a_line_contact() -> None:
    problem = moes_contact(
        200.0,
        5.0,
        nodes=(129, 65),
        radius_ratio=radius_ratio(20.0),
        domain=ContactDomain(inlet=4.0, outlet=2.0),
    )
    a_x, _, largest = problem.hertz_contact
    load = 0.5 * math.pi * a_x * largest
    line = LineProblem(
        lubricant=film_oil(eta0=ETA0, alpha=ALPHA),
        radius=math.pi * REDUCED_MODULUS * a_x**2 / (8.0 * load),
        line_load=load,
        reduced_modulus=REDUCED_MODULUS,
        speed_1=problem.entrainment[0],
        speed_2=problem.entrainment[0],
        domain=problem.x_limits,
    )
    expected = solve_line(line, LineSettings(nodes=513, cavitation="mass_conserving"))
    solution = solve_point_contact(problem, CONSERVING)
    # the ends are 20 half widths away and 129 nodes are a quarter of the line's: 2 %
    assert solution.central_film == pytest.approx(expected.central_film, rel=0.02)
    left = solution.film[-2, 32] * solution.fill[-2, 32]
    of_line = expected.film[-2] * (1.0 - expected.void[-2])
    assert left == pytest.approx(of_line, rel=0.02)
