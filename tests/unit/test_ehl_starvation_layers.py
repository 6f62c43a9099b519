"""Inlet layers on the way from the coarsest grid to the finest, with made-up films."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.point import start as module
from gearlube_core.ehl.point.start import Starvation, thin_layer

SETTINGS = SimpleNamespace(newton_steps=30, krylov_steps=40)


class Level:
    """What the continuation reads and sets of a grid."""

    def __init__(self, layer):
        self.layers = [layer]
        self.continuations = []

    @property
    def terms(self):
        return SimpleNamespace(cavitation=SimpleNamespace(inlet_layer=self.layers[-1]))

    def set_inlet_layer(self, layer):
        self.layers.append(layer)

    def set_continuation(self, *shares):
        self.continuations.append(shares)

    def state(self, pressure, approach):
        return SimpleNamespace(pressure=pressure, approach=approach, film=np.full((5, 5), 3.0))


def part(*levels):
    return SimpleNamespace(levels=list(levels))


def state_with(mass=1.0):
    pressure = np.array([[0.1, 1.0], [0.85, 0.3]])
    values = np.array([[9.0, 2.3], [1.7, 9.0]])  # of the two nodes that carry most: mean 2.0
    return SimpleNamespace(pressure=pressure, approach=-0.5, mass=mass * values)


@pytest.fixture
def calls(monkeypatch):
    made = []

    def solve_level(hierarchy, state, settings, tolerance, record, coarse):
        assert (tolerance, coarse) == (1e-3, True)
        made.append(("solve", hierarchy.levels[-1].layers[-1]))
        return state_with()

    def thinned(hierarchy, state, layer, settings, record):
        made.append(("thin", layer))
        return state

    monkeypatch.setattr(module, "solve_level", solve_level)
    monkeypatch.setattr(module, "thin_layer", thinned)
    return made


@pytest.mark.parametrize(("layer", "nested"), [(0.1, 1.0), (1.3, 1.3)])
def test_coarse_grids_keep_half_the_flooded_film_and_the_finest_gets_the_layer(
    calls, layer, nested
):
    levels = [Level(layer) for _ in range(3)]
    starved = Starvation(part(*levels), SETTINGS, None)
    assert all(level.layers[-1] == math.inf for level in levels)
    for k in range(3):
        found = starved.start(part(*levels[: k + 1]), state_with(), k == 2)
        assert found.approach == -0.5
        assert levels[k].layers[-1] == (layer if k == 2 else nested)
    expected = [("solve", math.inf), ("thin", nested), ("thin", nested)]
    if nested > layer:  # the finest grid's film with the coarse layer comes first
        expected.append(("solve", nested))
    assert calls == [*expected, ("thin", layer)]


def test_single_grid_is_flooded_first(calls):
    level = Level(0.1)
    Starvation(part(level), SETTINGS, None).start(part(level), state_with(), True)
    assert calls == [("solve", math.inf), ("thin", 0.1)]
    assert level.layers[-1] == 0.1


@pytest.mark.parametrize(
    ("least", "tried", "end"),
    [
        (0.0, [1.5, 0.75, 0.375, 0.3], 0.3),
        # below 1.2 no film is found with half the layer: smaller and smaller steps, then none
        (1.2, [1.5, 0.75, 1.5 * 0.5**0.5, 1.5 * 0.5**0.25], None),
    ],
)
def test_layer_is_halved_and_by_less_where_no_film_is_found(monkeypatch, least, tried, end):
    level, seen = Level(math.inf), []

    def newton(hierarchy, state, **limits):
        assert (limits["most"], limits["most_krylov"]) == (30, 40)
        assert limits["tolerance"] == limits["load_tolerance"] == 1e-3
        seen.append(level.layers[-1])
        report = SimpleNamespace(converged=seen[-1] >= least, residuals=[1.0], krylov=2)
        return SimpleNamespace(pressure=None, approach=seen[-1]), report

    monkeypatch.setattr(module, "newton", newton)
    record = SimpleNamespace(residuals=[], krylov=0)
    start = level.state(None, 9.0)
    found = thin_layer(part(level), start, 0.3, SETTINGS, record)
    assert seen[:4] == pytest.approx(tried[:4])
    assert record.residuals == [1.0] * len(seen)
    assert record.krylov == 2 * len(seen)
    assert level.continuations == [(1.0, 0.0), (1.0, 1.0)]
    good = min(layer for layer in seen if layer >= least)
    assert level.layers[-1] == found.approach == pytest.approx(end or good)
    if end is None:
        assert 1.2 <= good < 1.2 / 0.95  # steps of a twentieth are the last
