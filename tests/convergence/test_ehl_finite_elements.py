"""Reynolds equation in finite elements: order, Jacobian, balance, and the films they give."""

import math
from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve

from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.equations.reynolds import apply_derivatives
from gearlube_core.ehl.point.equations.stencil import (
    CarriedMass,
    FlowTensor,
    NodeSlopes,
    StencilParameters,
    TensorSlopes,
)
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.galerkin import sparse_operator
from gearlube_core.ehl.point.newton.newton import newton
from gearlube_core.ehl.point.newton.transfer import Hierarchy, Transfer, grid_shapes
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import AMBIENT, PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.terms.elements import (
    ELEMENT_OFFSETS,
    Elements,
    element_derivatives,
    element_residual,
    upwind_shares,
)
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.oil.film_oil_data import film_oil

CROSS = 0.4  # xy component of the flow factor tensor; xx 1, yy 0.7
U, V, SQUEEZE = 0.9, 0.4, 0.3
THICKENING, DENSENING = 1.5, 0.1  # eta = exp(1.5 p), rho = 1 + 0.1 p
QUICK = PointSolverSettings(wedge="quick", estimate_error=False)


def parameters(nx, ny, upwind=0.0):
    dx, dy = 1.0 / (nx - 1), 1.0 / (ny - 1)
    half = 0.5 * (1.0 - upwind)
    return StencilParameters(dx**-2, dy**-2, U / dx, V / dy, 1.0 - half, 0.0, half, SQUEEZE)


def exact_pressure(x, y):
    return np.sin(math.pi * x) * np.sin(math.pi * y) * (1.0 + 0.5 * x)


def exact_film(x, y):
    return 1.0 + 0.4 * x**2 - 0.2 * x * y + 0.3 * np.cos(2.0 * y)


def exact_source(x, y):
    """Return -R of the exact fields, by differences of sixth order on analytic functions."""
    step = 2e-3
    weights = {1: 0.75, 2: -0.15, 3: 1.0 / 60.0}

    def by(function, axis):
        def slope(x, y):
            total = 0.0
            for k, weight in weights.items():
                a, b = (k * step, 0.0) if axis == 0 else (0.0, k * step)
                total = total + weight * (function(x + a, y + b) - function(x - a, y - b))
            return total / step

        return slope

    def mass(x, y):
        return (1.0 + DENSENING * exact_pressure(x, y)) * exact_film(x, y)

    def mobility(x, y):
        return mass(x, y) * exact_film(x, y) ** 2 * np.exp(-THICKENING * exact_pressure(x, y))

    p_x, p_y = by(exact_pressure, 0), by(exact_pressure, 1)

    def flow_x(x, y):
        return mobility(x, y) * (p_x(x, y) + CROSS * p_y(x, y)) - U * mass(x, y)

    def flow_y(x, y):
        return mobility(x, y) * (0.7 * p_y(x, y) + CROSS * p_x(x, y)) - V * mass(x, y)

    return SQUEEZE * mass(x, y) - by(flow_x, 0)(x, y) - by(flow_y, 1)(x, y)


def fields(pressure, film):
    density = 1.0 + DENSENING * pressure
    cubic = density * film**3
    fluidity = np.exp(-THICKENING * pressure)
    return density, cubic, fluidity


def residual_of(grid, pressure, film, source, compliance):
    density, cubic, fluidity = fields(pressure, film)
    residual = np.empty(pressure.shape)
    element_residual(
        grid,
        pressure,
        density * film,
        FlowTensor(cubic, CROSS * cubic, 0.7 * cubic, fluidity),
        source,
        compliance,
        density,
        residual,
    )
    return residual


def derivatives_of(grid, pressure, film, compliance, free=None, rate=0.0):
    density, cubic, fluidity = fields(pressure, film)
    by_pressure, by_film = np.empty((2, 9, *pressure.shape))
    mobility, zero = cubic * fluidity, np.zeros(pressure.shape)
    # of rho h^3/eta: by p and by ln(h)
    even = NodeSlopes(mobility * (DENSENING / density - THICKENING), 3.0 * mobility, zero, zero)
    element_derivatives(
        grid,
        pressure,
        FlowTensor(cubic, CROSS * cubic, 0.7 * cubic, fluidity),
        CarriedMass(density, np.full(pressure.shape, DENSENING), film),
        TensorSlopes(
            even,
            NodeSlopes(*(CROSS * part for part in even)),
            NodeSlopes(*(0.7 * part for part in even)),
        ),
        compliance,
        np.full(pressure.shape, rate),
        np.ones(pressure.shape, dtype=bool) if free is None else free,
        by_pressure,
        by_film,
    )
    return by_pressure, by_film


def inner(shape):
    free = np.zeros(shape, dtype=bool)
    free[1:-1, 1:-1] = True
    return free


def matrix_of(by_pressure, by_film, free):
    linear = Linearisation(
        ELEMENT_OFFSETS,
        by_pressure,
        by_film,
        by_film.sum(axis=0),
        free,
        right=np.zeros(free.shape),
        result=np.empty(free.shape),
    )
    return sparse_operator(linear).matrix


def manufactured_error(n, compliance):
    """Return the largest error of pressure under a given film on n x (n + 4) nodes."""
    nx, ny = n, n + 4
    x, y = np.linspace(0.0, 1.0, nx)[None, :], np.linspace(0.0, 1.0, ny)[:, None]
    exact, film, source = exact_pressure(x, y), exact_film(x, y), exact_source(x, y)
    grid = parameters(nx, ny)
    free, pressure = inner(exact.shape), np.zeros_like(exact)
    for _ in range(8):
        residual = residual_of(grid, pressure, film, source, compliance)
        by_pressure, by_film = derivatives_of(grid, pressure, film, compliance, free)
        matrix = matrix_of(by_pressure, by_film, free).real[free.ravel()][:, free.ravel()].tocsc()
        pressure[free] -= spsolve(matrix, residual[free])
    assert np.abs(residual_of(grid, pressure, film, source, compliance)).max() < 1e-9
    return np.abs(pressure - exact).max()


@pytest.mark.slow
@pytest.mark.parametrize("compliance", [0.0, 1.0])
def test_manufactured_pressure_is_met_to_second_order(compliance):
    # compliance stands for K, which shrinks with the spacing as it does on a half-space
    errors = [manufactured_error(n, compliance / (n - 1)) for n in (17, 33, 65)]
    assert errors[2] < 1e-3
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.15)
    assert math.log2(errors[1] / errors[2]) == pytest.approx(2.0, abs=0.1)


def weak_form(grid, pressure, film, compliance):
    """Assemble the residual from its integrals, 4 x 4 Gauss points in each element."""
    density, cubic, fluidity = fields(pressure, film)
    mass, mobility = density * film, cubic * fluidity
    points, weights = np.polynomial.legendre.leggauss(4)
    px, py, pxy = (
        grid.poiseuille_x,
        grid.poiseuille_y,
        CROSS * math.sqrt(grid.poiseuille_x * grid.poiseuille_y),
    )
    ny, nx = pressure.shape
    total = np.zeros((ny, nx))
    for j, i in np.ndindex(ny - 1, nx - 1):
        cell = np.s_[j : j + 2, i : i + 2]
        carried = 0.5 * density[cell].mean() * compliance  # K rho/2
        Pe_x = grid.wedge_x * carried / (px * mobility[cell].mean())
        Pe_y = grid.wedge_y * carried / (py * 0.7 * mobility[cell].mean())
        back_x, back_y = (0.5 * (1.0 / math.tanh(Pe) - 1.0 / Pe) for Pe in (Pe_x, Pe_y))
        for (a, weight_a), (b, weight_b) in product(zip(points, weights, strict=True), repeat=2):
            x, y = 0.5 + 0.5 * a, 0.5 + 0.5 * b
            N = np.outer([1.0 - y, y], [1.0 - x, x])
            N_x, N_y = np.outer([1.0 - y, y], [-1.0, 1.0]), np.outer([-1.0, 1.0], [1.0 - x, x])
            p_x, p_y, s, m, m_x, m_y = (
                (shape * field[cell]).sum()
                for shape, field in (
                    (N_x, pressure),
                    (N_y, pressure),
                    (N, mobility),
                    (N, mass),
                    (N_x, mass),
                    (N_y, mass),
                )
            )
            # upwinding along x of what is carried and stored together
            flow_x = s * (px * p_x + pxy * p_y) - grid.wedge_x * m
            flow_x += back_x * (grid.wedge_x * m_x + grid.squeeze * m)
            flow_y = s * (0.7 * py * p_y + pxy * p_x) - grid.wedge_y * (m - back_y * m_y)
            weight = 0.25 * weight_a * weight_b
            total[cell] -= weight * (N_x * flow_x + N_y * flow_y + N * grid.squeeze * m)
    return total[1:-1, 1:-1]


@pytest.mark.parametrize("compliance", [3.0, 30.0])
def test_residual_is_that_of_the_weak_form(compliance):
    # Pe of 0.4 to 20: shares of upwinding between none and all, by the closed form of `coth`
    rng = np.random.default_rng(5)
    shape = (4, 5)
    pressure, film = rng.random(shape), 1.0 + rng.random(shape)
    grid = parameters(5, 4)
    residual = residual_of(grid, pressure, film, np.zeros(shape), compliance)
    # both are sums of products of polynomials: roundings alone part them
    assert residual[1:-1, 1:-1] == pytest.approx(
        weak_form(grid, pressure, film, compliance), rel=1e-12
    )


@pytest.mark.parametrize("upwind", [0.0, 0.6])
def test_derivatives_match_differences(upwind):
    # central differences of 1e-6: truncation 1e-12, rounding 1e-16/1e-6 of 1/dx^2 = 100
    rng = np.random.default_rng(2)
    shape = (9, 8)
    grid = parameters(shape[1], shape[0], upwind)
    pressure, film = rng.random(shape), 1.0 + rng.random(shape)
    rate = rng.random(shape)  # of storage, which a source less what is stored stands for
    by_pressure, by_film = derivatives_of(grid, pressure, film, 0.0, rate=rate)

    def residual(p, h):
        return residual_of(grid, p, h, -rate * fields(p, h)[0] * h, 0.0)

    for _ in range(5):
        dp, dh = rng.normal(size=(2, *shape))
        change = np.empty(shape)
        apply_derivatives(
            ELEMENT_OFFSETS, by_pressure, by_film, AMBIENT.reach(len(dp)), dp, dh, change
        )
        up, down = (residual(pressure + e * dp, film + e * dh) for e in (1e-6, -1e-6))
        assert change == pytest.approx((up - down) / 2e-6, abs=1e-6 * np.abs(change).max())


def test_residuals_of_inner_elements_add_to_the_flow_over_their_border():
    # shape functions sum to one: with pressure, film and source in the middle only, all flow stays
    rng = np.random.default_rng(3)
    shape = (12, 14)
    pressure, film = np.zeros(shape), np.zeros(shape)
    pressure[3:-3, 3:-3] = rng.random((6, 8))
    film[3:-3, 3:-3] = rng.random((6, 8))
    grid = parameters(14, 12)._replace(squeeze=0.0)
    residual = residual_of(grid, pressure, film, np.zeros(shape), 0.1)
    assert abs(residual.sum()) < 1e-13 * np.abs(residual).sum()
    gathering = residual_of(
        grid._replace(squeeze=SQUEEZE), pressure, film, np.zeros(shape), 0.1
    ).sum()
    mass = (1.0 + DENSENING * pressure) * film
    assert gathering == pytest.approx(-SQUEEZE * mass.sum(), rel=1e-12)


def test_matrix_rows_are_the_applied_derivatives():
    rng = np.random.default_rng(4)
    shape = (7, 8)
    pressure, film = rng.random(shape), 1.0 + rng.random(shape)
    free = inner(shape) & (rng.random(shape) > 0.2)
    by_pressure, by_film = derivatives_of(parameters(8, 7), pressure, film, 0.2, free)
    dp, dh = np.where(free, rng.normal(size=shape), 0.0), rng.normal(size=shape)
    applied = np.empty(shape)
    apply_derivatives(
        ELEMENT_OFFSETS, by_pressure, by_film, AMBIENT.reach(len(dp)), dp, dh, applied
    )
    matrix = matrix_of(by_pressure, by_film, free)
    product = matrix.real @ dp.ravel() + matrix.imag @ dh.ravel()
    assert product == pytest.approx(applied.ravel(), abs=1e-12 * np.abs(applied).max())
    assert np.all(applied[~free] == 0.0)


def test_upwinding_is_of_third_order_where_pressure_flows_and_whole_where_it_does_not():
    coarse, fine = (
        upwind_shares(parameters(n, n), 0.1 / (n - 1), (n - 1.0) ** 2, (n - 1.0) ** 2, 1.0)[0]
        for n in (65, 129)
    )
    assert coarse / fine == pytest.approx(4.0, rel=1e-3)  # times dx in the flow
    assert upwind_shares(parameters(65, 65), 0.1, 1e-12, 1e-12, 1.0) == pytest.approx((0.5, 0.5))
    assert upwind_shares(parameters(65, 65), 0.0, 1e-9, 1e-9, 1.0) == (0.0, 0.0)


def contact(nodes):
    """M 40, L 11: thick enough to be resolved by 65 nodes, thin enough to need upwinding."""
    return elliptical_contact(
        R_x=0.01,
        R_y=0.02,
        entrainment=(1.0, 0.3),
        load=20.0,
        contact_modulus=1.15e11,
        lubricant=film_oil(eta0=0.04, alpha=2e-8),
        nodes=nodes,
    )


def element_film(problem, start, compliance=None):
    """Return pressure and film in SI by finite elements from a solution by differences."""
    scales = PointScales.of(problem)
    assert not scales.swap
    shapes = grid_shapes(problem.nodes[::-1], (1.0, 1.0))
    levels = [
        PointLevel(
            problem, scales, shape, "central", scheme=lambda grid: Elements(grid, compliance)
        )
        for shape in shapes
    ]
    transfers = [Transfer(fine, coarse) for coarse, fine in pairwise(shapes)]
    state = levels[-1].state(
        scales.inward(start.pressure) / scales.pressure, start.approach / scales.film
    )
    state, record = newton(
        Hierarchy(levels, transfers),
        state,
        tolerance=1e-7,
        load_tolerance=1e-8,
        most=40,
        most_krylov=60,
    )
    assert record.converged
    return scales.outward(state.pressure) * scales.pressure, scales.outward(
        state.film
    ) * scales.film


@pytest.mark.slow
@pytest.mark.parametrize(
    ("radius_y", "load", "angle", "sliding"),
    [(0.01, 20.0, 0.0, None), (0.1, 100.0, 0.0, None), (0.01, 20.0, 0.5, (0.3, 0.3))],
    ids=["round", "ten to one", "Eyring at an angle"],
)
def test_films_of_elements_and_differences_meet_at_refinement(radius_y, load, angle, sliding):
    gaps = []
    for n in (65, 129):
        problem = elliptical_contact(
            R_x=0.01,
            R_y=radius_y,
            entrainment=(math.cos(angle), math.sin(angle)),
            sliding=sliding,
            load=load,
            contact_modulus=1.15e11,
            lubricant=film_oil(eta0=0.04, alpha=2e-8, eyring_stress=5e6),
            nodes=(n, n),
        )
        differences, elements = (
            solve_point_contact(problem, replace(QUICK, discretisation=one))
            for one in ("differences", "elements")
        )
        loaded = differences.pressure > 0.3 * differences.maximum_pressure
        off = np.abs(elements.pressure - differences.pressure)[loaded].mean()
        gaps.append(
            [
                off / differences.maximum_pressure,
                abs(elements.central_film / differences.central_film - 1.0),
                0.8 * abs(elements.minimum_film / differences.minimum_film - 1.0),
            ]
        )
    # the 2 % that pictures of Jamali 2015 sec. 3.11 can show, 2.5 % for the film of a single node,
    # and on a finer grid a quarter of it, where the edge counts less; the tip of the spike is
    # left out, no scheme resolves it here
    assert np.all(np.array(gaps[1]) < 0.02)
    assert np.all(np.array(gaps[1]) < 0.5 * np.array(gaps[0]))


@pytest.mark.slow
def test_upwinding_removes_pressure_that_alternates_from_node_to_node():
    problem = replace(contact((65, 65)), load=80.0)
    differences = solve_point_contact(problem, QUICK)
    pressure, _ = element_film(problem, differences)
    galerkin, _ = element_film(problem, differences, compliance=0.0)
    middle = np.abs(problem.x) < 0.5 * problem.hertz_contact[0]  # ahead of the spike

    def ripple(values):
        return np.abs(np.diff(values[middle, 32], 4)).max() / values.max() / 16.0

    assert ripple(galerkin) > 0.02
    assert ripple(pressure) < 0.002
