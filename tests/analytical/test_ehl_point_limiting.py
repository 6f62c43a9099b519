"""Limiting shear stress in the flow and the traction of a point contact."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.equations.film_shear import FilmShear
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.traction import point_traction
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.film_oil_data import film_oil

TAU0 = 5e6
OIL = film_oil(eta0=0.02, alpha=18e-9, eyring_stress=TAU0)


def shear(limit: tuple[float, float], sliding: float = 2.0) -> FilmShear:
    oil = OIL._replace(tau_limit=limit[0], limit_slope=limit[1])
    return FilmShear.of(oil, (sliding, 0.0), (1e-5, 1e-5), 3)


def state(slope: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    pressure = 4e8 + slope * 1e-5 * np.arange(-1.0, 2.0) * np.ones((3, 1))
    return pressure, np.full((3, 3), 3e-7), np.full((3, 3), 1.0 / 50.0)


@pytest.mark.parametrize("slope", [1e12, 3e13])
def test_slipping_film_flows_as_one_sheared_up_to_the_limit(slope):
    p, h, fluidity = state(slope)
    limit = 0.05 * p[1, 1] + 1e6
    factors = shear((1e6, 0.05)).factors(p, h, fluidity)
    s = 0.5 * h[1, 1] * slope / TAU0
    # 3 (s cosh s - sinh s)/s^3 [1 + (a s/sinh s)^2]^(1/2) where a s/sinh s = sinh(limit/tau0)
    pumped = 3.0 * (s * math.cosh(s) - math.sinh(s)) / s**3
    assert factors.xx[1, 1] == pytest.approx(pumped * math.cosh(limit / TAU0), rel=1e-6)
    # slip leaves the flow with the viscosity of the Newtonian share alone
    thickening = np.full((3, 3), 2e-8)
    rates, without = factors.rates(thickening).xx, factors.rates(0.0 * thickening).xx
    assert np.array_equal(rates.by_pressure, without.by_pressure)
    step = 1e-4
    up = shear((1e6, 0.05)).factors(*_steeper(p, step), h, fluidity).xx[1, 1]
    down = shear((1e6, 0.05)).factors(*_steeper(p, -step), h, fluidity).xx[1, 1]
    slope_found = (math.log(up) - math.log(down)) / (2.0 * step)
    steeper = rates.by_rise_x[1, 1] * 2.0 * slope * 1e-5 / factors.xx[1, 1]
    assert steeper == pytest.approx(slope_found, rel=1e-4)
    # and the limit follows the pressure: S goes as cosh(limit/tau0)
    harder = 0.05 / TAU0 * math.tanh(limit / TAU0)
    assert rates.by_pressure[1, 1] / factors.xx[1, 1] == pytest.approx(harder, rel=1e-9, abs=0.0)


def _steeper(p: np.ndarray, share: float) -> tuple[np.ndarray]:
    return (p[1, 1] + (1.0 + share) * (p - p[1, 1]),)


def test_a_limit_that_is_not_met_changes_no_bit():
    p, h, fluidity = state(3e12)
    far = shear((1e6, 0.9)).factors(p, h, fluidity)
    without = shear((0.0, 0.0)).factors(p, h, fluidity)
    assert np.array_equal(far.xx, without.xx)
    thickening = np.full((3, 3), 2e-8)
    one, other = far.rates(thickening), without.rates(thickening)
    assert np.array_equal(one.xx.by_film, other.xx.by_film)


def _solved(oil: FilmOil) -> tuple[float, float, float]:
    problem = elliptical_contact(
        R_x=0.012,
        R_y=0.02,
        entrainment=(3.0, 1.0),
        load=150.0,
        contact_modulus=115e9,
        lubricant=oil,
        nodes=(65, 65),
        sliding=(1.5, 0.5),
    )
    solution = solve_point_contact(problem, PointSolverSettings(estimate_error=False))
    traction = point_traction(
        problem.x, problem.y, solution.pressure, solution.film, (1.5, 0.5), oil
    )
    return traction.force / problem.load, solution.minimum_film, solution.central_film


@pytest.mark.slow
def test_limited_film_lies_between_the_eyring_and_the_slipping_one():
    free = _solved(OIL)
    limited = _solved(OIL._replace(tau_limit=1e4, limit_slope=0.02))
    slipping = _solved(OIL._replace(tau_limit=1e4, limit_slope=0.0))
    newtonian = _solved(OIL.newtonian())
    # where the whole contact slips friction is the slope, less the rim that does not
    assert limited[0] == pytest.approx(0.02, rel=0.05)
    assert free[0] > limited[0] > slipping[0]
    # a film without shear flows like a Newtonian one, but for Eyring's flow by pressure
    assert slipping[1] == pytest.approx(newtonian[1], rel=3e-3)
    # the film forms in the inlet, where little slips
    assert limited[2] == pytest.approx(free[2], rel=3e-3)
