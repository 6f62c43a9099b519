"""Derivatives of the film's equation at nodes whose laws are given, against differences."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.ehl.point.equations import reynolds, stencil
from gearlube_core.ehl.point.equations.stencil import (
    OFFSETS,
    FilmFlow,
    FlowSlopes,
    MeshMetric,
    NodeSlopes,
    StencilParameters,
)
from gearlube_core.ehl.point.settings import AMBIENT
from tests.helpers.source_of import interpret

SHAPE = (6, 8)
DENSER, THINNER, POWER = 0.3, 2.1, -0.8  # d ln rho/dp, -d ln f/dp, d ln f/d ln h
# d ln f/d(rise of pressure across the node) along x and y, of the fluidity along x and along y
RISES = ((0.7, -0.3), (0.2, 0.9))
RNG = np.random.default_rng(15)
METRIC = MeshMetric(1.0 + 0.2 * RNG.random(SHAPE[1]), 1.0 + 0.2 * RNG.random(SHAPE[1]))


def flow_of(p: np.ndarray, h: np.ndarray, sheared: bool) -> tuple[np.ndarray, FilmFlow]:
    """Return rho and the flow of a film whose fluidity falls with pressure and with its height.

    Where it is sheared, fluidity inside the border rises with the pressure across its node too.
    """
    rho = np.exp(DENSER * p)
    log = np.tile(-THINNER * p + POWER * np.log(h), (2, 1, 1))
    if sheared:
        for part, (x, y) in zip(log, RISES, strict=True):
            part[1:-1, 1:-1] += x * (p[1:-1, 2:] - p[1:-1, :-2]) + y * (p[2:, 1:-1] - p[:-2, 1:-1])
    log[1] += np.log(1.3)
    return rho, FilmFlow(rho * h**3, *np.exp(log), *-log)


def residual_of(
    parameters: StencilParameters, p: np.ndarray, h: np.ndarray, sheared: bool
) -> np.ndarray:
    rho, flow = flow_of(p, h, sheared)
    found = np.empty(SHAPE)
    reynolds.reynolds_residual(parameters, METRIC, p, rho * h, flow, 0.2 * np.ones(SHAPE), found)
    return found


def slopes_of(sheared: bool) -> FlowSlopes:
    inner, full = np.zeros(SHAPE), np.ones(SHAPE)
    inner[1:-1, 1:-1] = float(sheared)
    x, y = (
        NodeSlopes(-THINNER * full, POWER * full, along * inner, across * inner)
        for along, across in RISES
    )
    return FlowSlopes(DENSER * full, x, y, x, y)  # cross flow is not asked for


@pytest.mark.parametrize("along_y", [0.0, 0.6])
@pytest.mark.parametrize("weights", [(1.5, -0.5, 0.0), (0.5, 0.0, 0.5)])
@pytest.mark.parametrize("sheared", [False, True])
def test_derivatives_are_those_of_differences(monkeypatch, along_y: float, weights, sheared: bool):
    interpret(monkeypatch, reynolds, stencil)
    here, upstream, downstream = weights
    parameters = StencilParameters(
        poiseuille_x=0.9, poiseuille_y=0.5, wedge_x=0.8, wedge_y=along_y, squeeze=0.3, here=here,
        upstream=upstream, downstream=downstream, least=0.85, most=1.15,
    )  # fmt: skip
    p = 0.2 + 0.6 * RNG.random(SHAPE)
    h = 0.5 + 0.5 * RNG.random(SHAPE)
    rho, flow = flow_of(p, h, sheared)
    free = np.ones(SHAPE, dtype=bool)
    free[2, 3] = False
    by_pressure, by_film = np.full((2, 13 if sheared else 7, *SHAPE), np.nan)
    reynolds.reynolds_derivatives(
        parameters, METRIC, p, flow, rho, DENSER * rho, h, slopes_of(sheared), free,
        (0, SHAPE[0]), by_pressure, by_film,
    )  # fmt: skip
    assert not by_pressure[:, 2, 3].any()
    assert not by_film[:, 2, 3].any()
    step = 1e-6
    for dp, dh in ((1.0, 0.0), (0.0, 1.0)):
        change_p, change_h = dp * RNG.normal(size=SHAPE), dh * RNG.normal(size=SHAPE)
        above = residual_of(parameters, p + step * change_p, h + step * change_h, sheared)
        below = residual_of(parameters, p - step * change_p, h - step * change_h, sheared)
        numerical = np.where(free, (above - below) / (2.0 * step), 0.0)
        found = np.empty(SHAPE)
        reynolds.apply_derivatives(
            OFFSETS, by_pressure, by_film, AMBIENT.reach(SHAPE[0]), change_p, change_h, found
        )
        # truncation of 1e-12 and rounding of 1e-10
        assert found == pytest.approx(numerical, abs=1e-7 * np.abs(numerical).max())


@pytest.mark.parametrize("rise", [0.0, 2e-4, 9e-4, 1.1e-3, -0.4, 3.0])
def test_steep_means_are_logarithmic_and_their_slopes_those_of_differences(monkeypatch, rise):
    interpret(monkeypatch, stencil)
    here = 0.7
    mean = stencil.mean_fluidity

    def value(up: float, down: float, steep: bool) -> float:
        a, b = here * np.exp(up), here * np.exp(rise + down)
        return mean(a, b, np.log(b / a), steep)[0]

    # integral of exp(t) from here to there over the rise
    t, w = np.polynomial.legendre.leggauss(12)
    expected = here * float((0.5 * w * np.exp(0.5 * rise * (1.0 + t))).sum())
    assert value(0.0, 0.0, True) == pytest.approx(expected, rel=1e-9)
    assert value(0.0, 0.0, False) == pytest.approx(0.5 * here * (1.0 + np.exp(rise)))
    for steep in (True, False):
        found = mean(here, here * np.exp(rise), rise, steep)
        step = 1e-4
        for k, slope in ((0, found[1]), (1, found[2])):
            up, down = (step, 0.0) if k == 0 else (0.0, step)
            difference = (value(up, down, steep) - value(-up, -down, steep)) / (2.0 * step)
            # differences divide roundings of the mean's own small difference by the step
            assert slope == pytest.approx(difference, rel=1e-5)
