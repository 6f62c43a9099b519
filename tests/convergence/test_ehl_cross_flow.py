"""Flow across the slope of pressure through faces: order on all grids, derivatives."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.ehl.point.equations.cross_flow import (
    CrossFlow,
    add_cross_derivatives,
    add_cross_flow,
)
from gearlube_core.ehl.point.equations.reynolds import apply_derivatives
from gearlube_core.ehl.point.equations.shear_factors import ObliqueFactors
from gearlube_core.ehl.point.equations.stencil import (
    OFFSETS,
    FilmFlow,
    FlowSlopes,
    NodeSlopes,
    StencilParameters,
    TensorSlopes,
    mesh_metric,
)
from gearlube_core.ehl.point.settings import AMBIENT
from tests.helpers.each import each

STEP = 1e-4  # of the differences that stand for derivatives of the smooth fields


def cubic(x, y):
    return np.exp(0.6 * np.sin(2.0 * x) - 0.4 * y)


def pressure(x, y):
    return np.cos(1.3 * x + 0.4) * np.sin(0.8 * y + 0.3) + x * y


def fluidity_x(x, y):
    return np.exp(np.cos(x - y))


def fluidity_y(x, y):
    return np.exp(np.cos(x - y) - 0.5 * np.sin(x + y))


def fluidity_xy(x, y):
    return np.cos(0.7 * x) * np.exp(0.3 * y)


def expected(x, y):
    """Return d/dx(F dp/dy) + d/dy(F dp/dx), F = rho h^3 times the fluidity xy."""

    def along_x(x, y):
        rise = pressure(x, y + STEP) - pressure(x, y - STEP)
        return cubic(x, y) * fluidity_xy(x, y) * rise / (2.0 * STEP)

    def along_y(x, y):
        rise = pressure(x + STEP, y) - pressure(x - STEP, y)
        return cubic(x, y) * fluidity_xy(x, y) * rise / (2.0 * STEP)

    return (along_x(x + STEP, y) - along_x(x - STEP, y)) / (2.0 * STEP) + (
        along_y(x, y + STEP) - along_y(x, y - STEP)
    ) / (2.0 * STEP)


def error(nodes: int, graded: bool, oblique: bool) -> float:
    """Return the mean error at inner nodes over the mean of the flow's divergence."""
    s = np.linspace(0.0, 1.0, nodes)
    x = s + 0.12 * np.sin(2.0 * math.pi * s) if graded else s
    y = np.linspace(0.0, 1.2, nodes)
    dx, dy = float(np.diff(x).min()), y[1] - y[0]
    X, Y = x[None, :], y[:, None]
    f, g, t = (part(X, Y) for part in (fluidity_x, fluidity_y, fluidity_xy))
    cross = CrossFlow(t / f, t / g)
    flow = FilmFlow(cubic(X, Y), f, g, -np.log(f), -np.log(g))
    wedge = 1.0 if oblique else 0.0
    parameters = StencilParameters(dx**-2, dy**-2, 1.0, wedge, 1.5, -0.5, 0.0, 0.0)
    residual = np.zeros((nodes, nodes))
    add_cross_flow(parameters, mesh_metric(x, dx), pressure(X, Y), flow, cross, residual)
    inner = np.s_[2:-2, 2:-2]
    exact = expected(X, Y)[inner]
    return float(np.abs(residual[inner] - exact).mean() / np.abs(exact).mean())


@each("graded", [False, True])
@each("oblique", [False, True])
def test_cross_flow_through_faces_is_of_second_order(graded: bool, oblique: bool) -> None:
    errors = [error(nodes, graded, oblique) for nodes in (33, 65, 129)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx(2.0, abs=0.15)
    assert errors[-1] < 1e-3


@pytest.mark.parametrize("oblique", [False, True], ids=["along x", "oblique"])
def test_derivatives_of_the_cross_flow_match_differences(oblique: bool) -> None:
    rng = np.random.default_rng(6)
    shape = _, nx = 8, 9
    x = np.linspace(0.0, 1.0, nx) + 0.05 * rng.random(nx)
    metric = mesh_metric(x, float(np.diff(x).min()))
    wedge = 1.0 if oblique else 0.0
    parameters = StencilParameters(40.0, 70.0, 1.0, wedge, 1.5, -0.5, 0.0, 0.0)
    along, aside, ratio_x, ratio_y = 0.5 + rng.random((4, *shape))
    # laws with exact slopes: rho ~ exp(0.3 p), fluidity ~ exp(-0.9 p) h^-0.4, and both the
    # fluidity and the ratio rise with pressure across their node, inside the border
    dense, thinner, thin = 0.3, -0.9, -0.4
    of_fluidity, of_ratio = (0.5, -0.2), (0.3, 0.6)
    inside = np.zeros(shape)
    inside[1:-1, 1:-1] = 1.0

    def across(p: np.ndarray, weights: tuple[float, float]) -> np.ndarray:
        rises = np.zeros(shape)
        rises[1:-1, 1:-1] = weights[0] * (p[1:-1, 2:] - p[1:-1, :-2])
        rises[1:-1, 1:-1] += weights[1] * (p[2:, 1:-1] - p[:-2, 1:-1])
        return rises

    def film_flow(p: np.ndarray, h: np.ndarray) -> FilmFlow:
        fluidity = np.exp(thinner * p + across(p, of_fluidity)) * h**thin
        f, g = along * fluidity, aside * fluidity
        return FilmFlow(np.exp(dense * p) * h**3, f, g, -np.log(f), -np.log(g))

    def cross_of(p: np.ndarray, h: np.ndarray) -> CrossFlow:
        change = 0.2 * p + 0.1 * np.log(h) + across(p, of_ratio)
        return CrossFlow(ratio_x + change, ratio_y + change)

    def cross_flow(p: np.ndarray, h: np.ndarray) -> np.ndarray:
        residual = np.zeros(shape)
        add_cross_flow(parameters, metric, p, film_flow(p, h), cross_of(p, h), residual)
        return residual

    p, h = rng.random(shape), 1.0 + rng.random(shape)
    full = np.ones(shape)
    through = NodeSlopes(thinner * full, thin * full, *(w * inside for w in of_fluidity))
    turned = NodeSlopes(0.2 * full, 0.1 * full, *(w * inside for w in of_ratio))
    slopes = FlowSlopes(dense * full, through, through, turned, turned)
    by_pressure, by_film = np.zeros((2, len(OFFSETS), *shape))
    add_cross_derivatives(
        parameters,
        metric,
        p,
        film_flow(p, h),
        cross_of(p, h),
        h,
        slopes,
        np.ones(shape, dtype=bool),
        by_pressure,
        by_film,
    )
    for _ in range(3):
        dp, dh = rng.normal(size=(2, *shape))
        change = np.empty(shape)
        apply_derivatives(OFFSETS, by_pressure, by_film, AMBIENT.reach(len(dp)), dp, dh, change)
        up, down = (cross_flow(p + e * dp, h + e * dh) for e in (1e-5, -1e-5))
        # differences of 1e-5: truncation 1e-10, roundings 1e-16/1e-5
        inner = np.s_[1:-1, 1:-1]
        numerical = ((up - down) / 2e-5)[inner]
        assert change[inner] == pytest.approx(numerical, abs=1e-7 * np.abs(numerical).max())


def test_both_flows_across_the_slope_answer_to_a_change_of_pressure_by_one_factor() -> None:
    """Even film, pressure 1 + x y: d/dx(F_xy dp/dy) + d/dy(F_xy dp/dx) = 2 F_xy."""
    shape = (6, 7)
    xx, yy, xy = (np.full(shape, value) for value in (0.8, 1.3, 0.2))
    zero, metric = np.zeros(shape), mesh_metric(np.arange(7.0), 1.0)
    none = NodeSlopes(*(zero,) * 4)
    factors = ObliqueFactors(xx, yy, lambda *_: TensorSlopes(none, none, none), xy)
    cubic, fluidity = np.full(shape, 0.7), np.full(shape, 0.4)
    flow = factors.flow(cubic * factors.xx, fluidity, -np.log(fluidity))
    parameters = StencilParameters(9.0, 4.0, 1.0, 0.0, 1.5, -0.5, 0.0, 0.0)
    y, x = np.indices(shape, dtype=float)

    by_pressure, by_film = np.zeros((2, len(OFFSETS), *shape))
    add_cross_derivatives(
        parameters,
        metric,
        zero,
        flow,
        factors.cross,
        zero + 1.0,
        factors.slopes(zero, zero),
        zero == 0.0,
        by_pressure,
        by_film,
    )
    change, residual = np.empty(shape), np.zeros(shape)
    apply_derivatives(
        OFFSETS, by_pressure, by_film, AMBIENT.reach(len(zero)), 1.0 + x * y, zero, change
    )
    add_cross_flow(parameters, metric, 1.0 + x * y, flow, factors.cross, residual)
    inner, mobility = np.s_[1:-1, 1:-1], 2.0 * 0.7 * 0.4 * math.sqrt(9.0 * 4.0)
    for found in (residual, change):
        assert found[inner] == pytest.approx(np.full((4, 5), mobility * 0.2), rel=1e-12)
