"""Order in time of the point contact's march: second with either scheme, first where it starts."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.problem import EllipticParaboloid
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.oil.film_oil_data import film_oil

R, LOAD, SPEED, MODULUS = 0.0125, 15.0, 0.5, 55e9
SHAPE = EllipticParaboloid(R, R)
A = (0.75 * LOAD * R / MODULUS) ** (1.0 / 3.0)  # Hertz radius [m]
CYCLE = 3.0 * A / SPEED  # one pulse of load, in which the film is renewed one and a half times
STEPS = 16  # of the coarse march
# of the linear solutions: far below the errors of time, 6e-4 of the film and more
STRICT = PointSolverSettings(wedge="quick", tolerance=1e-7, load_tolerance=1e-7)


def _pulse(time: float) -> float:
    """Return a load that starts without a kink, so that only the steps set the order."""
    return LOAD * (1.0 + 0.1 * float(np.sin(np.pi * time / CYCLE)) ** 2)


def _ramp(time: float) -> float:
    """Return a load that rises from the first moment on."""
    return LOAD * (1.0 + 0.1 * time * SPEED / A)


def _film(load: object) -> MovingFilm:
    def conditions(x: Array, y: Array, time: float) -> FilmConditions:
        speed = np.full(y.size, SPEED)
        return FilmConditions(SHAPE(x[:, None], y[None, :]), load(time), speed, speed)

    return MovingFilm(
        conditions=conditions,
        lubricant=film_oil(eta0=0.05, alpha=15e-9),
        contact_modulus=MODULUS,
        x_limits=(-2.5 * A, 1.5 * A),
        y_limits=(-2.0 * A, 2.0 * A),
        nodes=(25, 25),
        hertz=SHAPE,
        load=LOAD,
        speed=SPEED,
    )


def _end(scheme: str, load: object, duration: float, steps: int) -> FilmSolution:
    march = FilmMarch(_film(load), duration / steps, scheme=scheme, settings=STRICT)
    for _ in range(steps):
        end = march.step()
    return end


@cache
def _reference() -> FilmSolution:
    return _end("crank_nicolson", _pulse, CYCLE, 8 * STEPS)


def _distance(film: FilmSolution, other: FilmSolution) -> float:
    """Return the mean difference of two films where the reference carries load [m]."""
    inside = other.pressure > 0.1 * other.maximum_pressure
    return float(np.sqrt(np.mean((film.film - other.film)[inside] ** 2)))


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["bdf2", "crank_nicolson"])
def test_half_the_time_step_leaves_a_quarter_of_the_error(scheme: str) -> None:
    """Both schemes against one march of eight times as many steps, of the trapezoidal rule."""
    errors = [_distance(_end(scheme, _pulse, CYCLE, n), _reference()) for n in (STEPS, 2 * STEPS)]
    # 2; the next terms of the error, and of the reference's, are a sixth of the finer one.
    # Backward Euler throughout has 1
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.25)


@pytest.mark.parametrize(("scheme", "order"), [("bdf2", 1.0), ("crank_nicolson", 2.0)])
def test_the_first_step_is_of_the_order_of_its_own_rule(scheme: str, order: float) -> None:
    """A single step from rest against eight in the same time, under a load that rises at once.

    The local error is of the order of the rule, not of one above: most of the film answers much
    faster than a step.
    """
    errors = []
    for duration in (0.2 * A / SPEED, 0.1 * A / SPEED):
        eight = _end(scheme, _ramp, duration, 8)
        errors.append(_distance(_end(scheme, _ramp, duration, 1), eight))
    # backward Euler first, by design, also where differences of second order follow
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.25)
