"""Front of the oil under pressure within a time step: the complementarity problem, and a march."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import gearlube_core.ehl.transient.newton as transient_front
import gearlube_core.ehl.transient.newton as transient_newton
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.newton import advance_front, mark_band, relax_band
from tests.helpers.jamali_2015 import jamali_2015_film

ROW = np.array([[0, 0], [0, -1], [0, 1]])


def test_band_reaches_ahead_and_keeps_off_the_border():
    opening, band = np.zeros((2, 9, 30), dtype=bool)
    opening[1, 3] = opening[6, 20] = True
    mark_band(opening, 4, 16, 2, band)
    assert band[1, 1]
    assert band[3, 19]
    assert not band[4, 13]
    assert not band[3, 20]
    assert band[8 - 1, 28]
    inner = np.zeros_like(band)
    inner[1:-1, 1:-1] = True
    assert not band[~inner].any()


def test_band_is_the_string_over_an_obstacle():
    # p'' = -1 for x < a and 1 beyond, where p > 0; p'(0) = 0; p and p' vanish at the front, 2 a:
    # p = a^2 - x^2/2, then (2 a - x)^2/2, then 0
    n, a = 201, 0.3
    x = np.linspace(0.0, 1.0, n)
    dx = x[1]
    by_pressure = np.zeros((3, 3, n))
    by_pressure[0, 1, 1:-1], by_pressure[1:, 1, 1:-1] = -2.0 / dx**2, 1.0 / dx**2
    by_pressure[0, 1, 1] = -1.0 / dx**2  # mirror between the nodes 0 and 1
    by_pressure[1, 1, 1] = 0.0
    load = np.where(x - 0.5 * dx < a, 1.0, -1.0)
    right, pressure, change = np.zeros((3, 3, n))
    right[1] = -load
    places = np.array([(1, i) for i in range(1, n - 1)])
    relax_band(ROW, by_pressure, by_pressure[0], places, pressure, right, 0, 20000, change)
    at = x - 0.5 * dx  # the mirror stands half a spacing off node 0
    exact = np.where(at < a, a**2 - at**2 / 2.0, np.maximum(2.0 * a - at, 0.0) ** 2 / 2.0)
    # the load's edge and the front lie between nodes: an error of the first order
    assert change[1, 1:-1] == pytest.approx(exact[1:-1], abs=1.5 * dx * a)
    assert np.flatnonzero(change[1] > 0.0)[-1] == pytest.approx(2.0 * a / dx, abs=3)


@pytest.mark.slow
def test_front_leaves_the_answer_and_saves_steps(monkeypatch):
    # towards the end of the cycle the edge of the pinion's relief runs along the line
    film = jamali_2015_film("a", nodes=(65, 129))
    start = 480 * film.time_step

    def march() -> tuple[np.ndarray, int]:
        solver = FilmMarch(film.moving_film(), film.time_step, start_time=start)
        solutions = [solver.step() for _ in range(3)]
        return solutions[-1].film, sum(s.newton_steps for s in solutions)

    moved, few = march()
    monkeypatch.setattr(transient_newton, "advance_front", lambda level, state, size: (state, size))
    plain, many = march()
    assert few < many
    # both stop at 1e-5 of unbalanced flow
    assert moved == pytest.approx(plain, rel=1e-4)


@pytest.mark.parametrize(
    ("before", "after", "share", "moves"),
    [
        (0.1, 0.5, 0.2, True),  # the film is found: the next linear solution does the rest
        (0.1, 0.7, 0.2, False),  # seven times as much
        (0.1, 0.05, 0.05, False),  # what lacks is not the front
        (1.0, 1.1, 0.5, False),  # the film is not found: less has to be left
        (1.0, 0.9, 0.5, True),
        (1.0, 0.9, 0.2, False),
    ],
)
def test_front_may_unbalance_the_film_only_near_the_answer(
    monkeypatch, before, after, share, moves
):
    shape = (5, 9)
    opening, residual, derivative = np.zeros((3, *shape))
    opening[2, 4], residual[2, 4], residual[2, 2] = 1.0, share, 1.0 - share
    derivative[1:-1, 1:-1] = -1.0
    state = SimpleNamespace(
        pressure=np.where(opening > 0.0, 0.0, 1.0),
        approach=0.0,
        residual=residual,
        free=np.ones(shape, dtype=np.bool_),
        contact=SimpleNamespace(apart=lambda nodes: nodes),
        boundary=SimpleNamespace(within=lambda nodes: nodes),
    )
    linear = SimpleNamespace(
        offsets=np.array([[0, 0]]),
        by_pressure=derivative[None],
        by_film=np.zeros((1, *shape)),
        centre=0,
        right=-residual,
    )
    level = SimpleNamespace(
        shape=shape,
        grid=SimpleNamespace(integral=np.sum, own_deflection=np.zeros(shape)),
        linearise=lambda state, rows: linear,
        state=lambda pressure, approach: SimpleNamespace(pressure=pressure),
    )
    monkeypatch.setattr(transient_front, "flow_residual", lambda level, state: after)
    found, size = advance_front(level, state, before)
    if moves:
        # its own equation alone: minus one times the pressure is minus the flow
        assert found.pressure[2, 4] == pytest.approx(share)
        assert size == after
    else:
        assert found is state
        assert size == before
