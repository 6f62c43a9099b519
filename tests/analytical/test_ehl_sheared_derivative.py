"""The linearised film of a shear-thinning oil is the derivative of its residual."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from gearlube_core.ehl.point.contact_domain import elliptical_contact, line_section
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.stencil import Grading
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.problem import expected_film
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solution import limited_faces
from gearlube_core.ehl.point.solver import nested_film
from gearlube_core.ehl.point.terms.differences import Differences
from gearlube_core.ehl.point.terms.elements import Elements
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.transient.level import FilmConditions, MovingLevel
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each

TAU0 = 4e6
NODES = 25
DIRECTIONS = [(1.0, 0.0), (0.0, 1.0), (0.8, 0.6)]


def contact(sliding=(1.0, 0.0), entrainment=(2.0, 0.0), nodes=NODES, **law):
    law = {"eyring_stress": TAU0} | law
    oil = film_oil(eta0=0.04, alpha=1.8e-8, **law)
    return elliptical_contact(
        R_x=0.012,
        R_y=0.02,
        entrainment=entrainment,
        sliding=sliding,
        load=120.0,
        contact_modulus=115e9,
        lubricant=oil,
        nodes=(nodes, nodes),
    )


def wavy(level: PointLevel, problem) -> tuple[np.ndarray, float]:
    """Return a rough Hertz pressure and an approach that leaves a rough film."""
    a_x, a_y, _ = problem.hertz_contact
    x, y = level.grid.x / a_x, level.grid.y / a_y
    pressure = np.sqrt(np.maximum(1.0 - x[:, None] ** 2 - y[None, :] ** 2, 0.0))
    pressure = level.scales.inward(pressure)
    pressure *= level.load / level.grid.integral(pressure)
    pressure *= 1.0 + 0.1 * np.random.default_rng(0).normal(size=pressure.shape)
    lowest = float(level.film(pressure, 0.0).min())
    return pressure, 1.3 * expected_film(problem) / level.scales.film - lowest


def galerkin(grid: PointGrid) -> Elements:
    """Return elements without upwinding, whose share the operator would hold."""
    return Elements(grid, compliance=0.0)


def error_of_the_operator(
    level: PointLevel, pressure: np.ndarray, approach: float, accept: Callable[[FilmState], bool]
) -> float:
    """Return the largest error along a change of pressure and approach, over the largest value."""
    state = level.state(pressure, approach)
    assert accept(state)
    linear = level.linearise(state)
    change = np.random.default_rng(1).normal(size=pressure.shape) * pressure
    rise, step = 0.1, 1e-5
    found = level.apply(linear, change, rise).copy()
    near, far = (
        level.state(pressure + n * step * change, approach + n * step * rise).residual
        - level.state(pressure - n * step * change, approach - n * step * rise).residual
        for n in (1, 2)
    )
    expected = np.where(linear.free, (8.0 * near - far) / (12.0 * step), 0.0)
    return float(np.abs(found - expected).max() / np.abs(expected).max())


def thinned(state: FilmState) -> bool:
    return bool(state.shear.xx.max() > 20.0)


@each("wedge", ["upwind-2", "quick", "central"])
@each("sliding", DIRECTIONS)
def test_operator_of_a_steady_sheared_film_is_the_derivative_of_its_residual(sliding, wedge):
    problem = contact(sliding, entrainment=(2.0, 0.8))
    level = PointLevel(problem, PointScales.of(problem), (NODES, NODES), wedge)
    # steps of 1e-5 with a truncation of their fourth power; mid-film stress is found to 1e-9
    assert error_of_the_operator(level, *wavy(level, problem), thinned) < 1e-6


@each("sliding", DIRECTIONS)
def test_operator_follows_a_limiting_stress_that_grows_with_pressure(sliding):
    problem = contact(sliding, limiting_shear=(1e4, 0.01))
    level = PointLevel(problem, PointScales.of(problem), (NODES, NODES), "upwind-2")
    pressure, approach = wavy(level, problem)
    free = PointLevel(contact(sliding), level.scales, level.shape, "upwind-2")
    sheared = free.state(pressure, approach).shear.xx

    def slips(state: FilmState) -> bool:
        return bool((state.shear.xx < 0.9 * sheared).sum() > 20)

    assert error_of_the_operator(level, pressure, approach, slips) < 1e-6


@each("sliding", DIRECTIONS)
@each(("limiting_shear", "largest"), [((0.0, 0.0), 5.0), ((1e4, 0.02), 1.5)])
def test_operator_follows_an_eyring_stress_that_grows_with_pressure(
    sliding, limiting_shear, largest
):
    law = {"eyring_stress": None, "eyring_slope": 0.03, "limiting_shear": limiting_shear}
    problem = contact(sliding, **law)
    level = PointLevel(problem, PointScales.of(problem), (NODES, NODES), "upwind-2")
    # warm in the middle: the local stress follows the temperature as well
    x, y = level.grid.x, level.grid.y
    warm = 0.05 * np.exp(-((x / 1e-4) ** 2) - (y[:, None] / 1e-4) ** 2)
    level.set_thermal_factors(1.0 - warm, np.ones(level.shape))

    def local(state: FilmState) -> bool:
        return bool(state.shear.xx.max() > largest)

    assert error_of_the_operator(level, *wavy(level, problem), local) < 1e-6


@each("limits", [(-np.inf, np.inf), (0.9, 1.1)])
@each("graded", [False, True])
@each("side", [0.0, 0.4])
@each("law", [{}, {"eyring_stress": None, "eyring_slope": 0.03, "limiting_shear": (0.0, 0.0)}])
def test_operator_of_a_film_in_motion_is_the_derivative_of_its_residual(limits, graded, side, law):
    """Storage, rows of other sliding or one across the motion, faces limited or not."""
    problem = contact(sliding=None, **law)
    grading = Grading((-1e-4, 1e-4), (2.0, 1.0)) if graded else None
    level = MovingLevel(problem, PointScales.of(problem), (NODES, NODES), "quick", grading)
    rows = np.linspace(1.9, 2.4, NODES) if side == 0.0 else np.full(NODES, 2.2)
    x, y = level.grid.x, level.grid.y
    level.set_conditions(
        FilmConditions(
            problem.gap(x[:, None], y[None, :]), 120.0, rows, rows - 0.9, side_sliding=side
        )
    )
    level.stencil = level.stencil._replace(least=limits[0], most=limits[1])
    pressure, approach = wavy(level, problem)
    level.set_storage(3.0, 2.5 * np.ones(level.shape))

    def limited(state: FilmState) -> bool:
        carried = level.terms.entrainment.carried(state.mass)
        count = limited_faces(level.stencil, state.pressure, carried)[0]
        sheared = state.shear.xx.max() > (5.0 if law else 20.0)
        return bool(sheared) and (count > 3 if np.isfinite(limits[0]) else count == 0)

    assert error_of_the_operator(level, pressure, approach, limited) < 1e-6


@each(
    ("sides", "across", "scheme"),
    [
        ("cyclic", 0.0, Differences),
        ("cyclic", 1.2, Differences),
        ("no_flow", 0.0, Differences),
        ("cyclic", 1.2, galerkin),
        ("no_flow", 0.0, galerkin),
    ],
)
def test_operator_of_a_film_between_closed_sides_is_the_derivative_of_its_residual(
    sides, across, scheme
):
    """Factors of the rows at a side follow the pressure of rows at the other, or of mirrored."""
    problem = line_section(
        R_x=0.012,
        length=2e-4,
        line_load=1e5,
        speed_1=2.4,
        speed_2=1.2,
        contact_modulus=115e9,
        lubricant=film_oil(eta0=0.04, alpha=1.8e-8, eyring_stress=TAU0),
        nodes=(NODES, 16),
        sides=sides,
    )
    problem = replace(problem, sliding=(1.2, across))
    wedge = "quick" if scheme is Differences else "central"
    level = PointLevel(problem, PointScales.of(problem), (16, NODES), wedge, scheme=scheme)
    rng = np.random.default_rng(2)
    x = level.grid.x / problem.hertz_contact[0]
    pressure = np.sqrt(np.maximum(1.0 - x**2, 0.0)) * (1.0 + 0.1 * rng.normal(size=(18, NODES)))
    pressure[:, [0, -1]] = 0.0
    pressure[[0, -1]] = 0.0
    pressure *= level.load / level.grid.integral(pressure)
    approach = 0.5 - float(level.film(pressure, 0.0)[1:-1].min())
    assert error_of_the_operator(level, pressure, approach, thinned) < 1e-6


@each("sliding", DIRECTIONS)
def test_operator_of_elements_is_the_derivative_of_their_residual(sliding):
    problem = contact(sliding)
    level = PointLevel(problem, PointScales.of(problem), (NODES, NODES), "central", scheme=galerkin)
    assert error_of_the_operator(level, *wavy(level, problem), thinned) < 1e-6


def test_newton_steps_of_a_sheared_film_end_quadratically():
    """Steps of a derivative that lacks a part shrink the residual by the share of that part."""
    problem = contact(sliding=(3.0, 0.0), nodes=65)
    settings = PointSolverSettings(tolerance=1e-10, load_tolerance=1e-10)
    _, _, record = nested_film(problem, settings)
    last = np.array(record.residuals[-3:])
    # linear solutions leave 1e-3 and more of a residual, and no more than 3e-2 of it
    assert np.all(last[1:] < 0.01 * last[:-1])
