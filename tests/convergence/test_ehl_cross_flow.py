"""Flow across the slope of pressure through faces: order on uniform and graded grids."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.ehl.point.equations.cross_flow import CrossFlow, add_cross_flow
from gearlube_core.ehl.point.equations.mesh import mesh_metric
from gearlube_core.ehl.point.equations.stencil import FilmFlow, StencilParameters

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
    cross = CrossFlow(t / f, t / g, t / f, t / g)
    flow = FilmFlow(cubic(X, Y), f, g, -np.log(f), -np.log(g))
    wedge = 1.0 if oblique else 0.0
    parameters = StencilParameters(dx**-2, dy**-2, 1.0, wedge, 1.5, -0.5, 0.0, 0.0)
    residual = np.zeros((nodes, nodes))
    add_cross_flow(parameters, mesh_metric(x, dx), pressure(X, Y), flow, cross, residual)
    inner = np.s_[2:-2, 2:-2]
    exact = expected(X, Y)[inner]
    return float(np.abs(residual[inner] - exact).mean() / np.abs(exact).mean())


@pytest.mark.parametrize("graded", [False, True], ids=["uniform", "graded"])
@pytest.mark.parametrize("oblique", [False, True], ids=["along x", "oblique"])
def test_cross_flow_through_faces_is_of_second_order(graded: bool, oblique: bool) -> None:
    errors = [error(nodes, graded, oblique) for nodes in (33, 65, 129)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx(2.0, abs=0.15)
    assert errors[-1] < 1e-3
