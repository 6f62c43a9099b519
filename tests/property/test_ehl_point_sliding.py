"""Eyring films that slide in any direction: derivatives, symmetry, balance, and Newton's limit."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from gearlube_core.ehl.point.equations.shear_factors import ObliqueFactors
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.oil.eyring_1936 import Eyring
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.ehl_point_cases import ALPHA, ETA0, moes_contact

OIL = film_oil(eta0=ETA0, alpha=ALPHA, eyring_stress=5e6)
TIGHT = PointSolverSettings(tolerance=1e-9, load_tolerance=1e-9)


def sliding_contact(ratio: float, turn: float, nodes=(49, 41), **more) -> PointContactProblem:
    """Return a contact that slides at `ratio` of its entrainment, turned from it by an angle."""
    problem = moes_contact(30.0, 5.0, nodes=nodes, lubricant=OIL, **more)
    u, v = problem.entrainment
    c, s = ratio * math.cos(turn), ratio * math.sin(turn)
    return dataclasses.replace(problem, sliding=(c * u - s * v, s * u + c * v))


def level_of(problem: PointContactProblem) -> tuple[PointLevel, PointScales]:
    scales = PointScales.of(problem)
    nx, ny = problem.nodes
    return PointLevel(problem, scales, (nx, ny) if scales.swap else (ny, nx), "upwind-2"), scales


def test_derivatives_follow_factors_viscosity_and_film() -> None:
    # with oil beyond, the approach also moves the pressure on the border
    problem = sliding_contact(0.5, 0.7, oil_beyond=False)
    solution = solve_point_contact(problem)
    level, scales = level_of(problem)
    pressure = scales.inward(solution.pressure) / scales.pressure
    approach = solution.approach / scales.film
    linear = level.linearise(level.state(pressure, approach))
    y, x = np.meshgrid(np.linspace(0.0, 3.0, 41), np.linspace(0.0, 2.0, 49), indexing="ij")
    for change, rise in ((pressure * np.sin(x) * np.cos(y), 0.0), (0.0 * x, 1.0)):
        step = 1e-5
        above = level.state(pressure + step * change, approach + step * rise).residual
        below = level.state(pressure - step * change, approach - step * rise).residual
        numerical = np.where(linear.free, (above - below) / (2.0 * step), 0.0)
        error = np.abs(level.apply(linear, change, rise) - numerical).sum()
        # what is left out: how factors across sliding and slopes at neighbours answer
        assert error < 0.03 * np.abs(numerical).sum()


def test_mass_is_balanced_over_any_set_of_nodes() -> None:
    level, _ = level_of(sliding_contact(0.5, 0.7, angle=0.4))
    rng = np.random.default_rng(5)
    ny, nx = level.shape
    pressure = np.zeros(level.shape)
    pressure[4:-4, 4:-4] = rng.random((ny - 8, nx - 8))
    state = level.state(pressure, 2.0 - float(level.film(pressure, 0.0).min()))
    assert isinstance(state.shear, ObliqueFactors)
    # what pressure changes within the border stays within: the wedge of ambient oil taken off
    pumped = state.residual - level.state(0.0 * pressure, state.approach, state.film).residual
    assert abs(pumped.sum()) < 1e-12 * np.abs(pumped).sum()


@pytest.mark.slow
@pytest.mark.parametrize("turn", [0.0, 0.6, pytest.param(0.5 * math.pi, marks=pytest.mark.slow)])
def test_the_film_turns_with_its_motion(turn: float) -> None:
    forward = sliding_contact(0.4, turn, (33, 29), radius_ratio=2.0, angle=0.6)
    (u, v), (a, b) = forward.entrainment, forward.sliding
    shape = EllipticParaboloid(forward.hertz.R_y, forward.hertz.R_x)
    turned = dataclasses.replace(
        forward,
        gap=shape,
        hertz=shape,
        entrainment=(-v, u),
        sliding=(-b, a),
        x_limits=(-forward.y_limits[1], -forward.y_limits[0]),
        y_limits=forward.x_limits,
        nodes=(29, 33),
    )
    first, second = solve_point_contact(forward, TIGHT), solve_point_contact(turned, TIGHT)
    # the same discrete problem; what differs is the end of two iterations at 1e-9
    assert np.abs(second.film / first.film.T[::-1] - 1.0).max() < 1e-6


@pytest.mark.slow
def test_the_film_is_mirrored_with_its_motion() -> None:
    forward = sliding_contact(0.4, 0.7, nodes=(33, 33))
    (u, v), (a, b) = forward.entrainment, forward.sliding
    mirrored = dataclasses.replace(forward, entrainment=(u, -v), sliding=(a, -b))
    opposite = dataclasses.replace(forward, sliding=(-a, -b))
    first = solve_point_contact(forward, TIGHT)
    second, third = solve_point_contact(mirrored, TIGHT), solve_point_contact(opposite, TIGHT)
    assert np.abs(second.film[:, ::-1] / first.film - 1.0).max() < 1e-6
    # flow knows the amount of shear, not its sign
    assert np.abs(third.film / first.film - 1.0).max() < 1e-6
    # sliding aside leaves a film that is not symmetric: a hundred times the above
    assert np.abs(first.film[:, ::-1] / first.film - 1.0).max() > 1e-4


def test_a_large_eyring_stress_gives_the_newtonian_film() -> None:
    problem = sliding_contact(0.4, 0.7, (33, 29))
    stiff = dataclasses.replace(problem, lubricant=OIL._replace(shear=Eyring(1e12)))
    plain = dataclasses.replace(problem, sliding=None)
    first, second = solve_point_contact(stiff, TIGHT), solve_point_contact(plain, TIGHT)
    # tau/tau0 below 1e-2: factors differ from 1 by its square
    assert np.abs(first.film / second.film - 1.0).max() < 1e-5
