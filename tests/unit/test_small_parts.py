"""Small parts of the film solvers against closed forms: stresses, units, storage, mixing."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair import supports
from gearlube_core.ehl.line import traction
from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.ehl.line.system import line_scales, row_coefficients
from gearlube_core.ehl.point.newton.galerkin import SparseOperator
from gearlube_core.ehl.point.newton.preconditioner import CoarseSolution
from gearlube_core.ehl.point.terms.differences import NoStorage, Storage
from gearlube_core.ehl.point.thermal.surfaces import AndersonMixing
from gearlube_core.helical_geometry.gear_body import SupportStiffness
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.row_operators import operator_of, some_entries
from tests.helpers.source_of import interpret, source_of

RNG = np.random.default_rng(17)


@pytest.mark.parametrize("sliding", [3.0, -3.0])
def test_stress_at_mid_film_is_newton_s_or_eyring_s_up_to_the_limit(monkeypatch, sliding: float):
    interpret(monkeypatch, traction)
    p = np.array([0.0, 2e8, 5e8, 9e8, 9e8])
    h = np.array([4e-7, 3e-7, 3e-7, 2e-7, 2e-7])
    slope = np.array([0.0, 3e12, -4e13, 1e12, 1e12])
    void = np.array([0.0, 0.25, 0.0, 0.0, 0.5])
    eta = np.array([0.04, 0.3, 5.0, 60.0, 60.0])
    newtonian, tau = eta * sliding / h, np.empty(5)
    traction.fill_mean_stress(p, slope, h, void, eta, sliding, film_oil(eta0=0.04, alpha=0.0), tau)
    assert tau == pytest.approx((1.0 - void) * newtonian)
    oil = film_oil(eta0=0.04, alpha=0.0, eyring_stress=5e6, limiting_shear=(2e6, 0.02))
    traction.fill_mean_stress(p, slope, h, void, eta, sliding, oil, tau)
    s = 0.5 * h * slope / 5e6
    thinned = np.where(s == 0.0, 1.0, s / np.sinh(np.where(s == 0.0, 1.0, s)))
    eyring = 5e6 * np.arcsinh(newtonian / 5e6 * thinned)
    limit = 2e6 + 0.02 * p
    expected = np.sign(sliding) * np.minimum(np.abs(eyring), limit) * (1.0 - void)
    assert tau == pytest.approx(expected, rel=1e-9)
    assert (np.abs(eyring) > limit).any()


def test_line_is_measured_in_its_dry_contact():
    oil = film_oil(eta0=0.05, alpha=2e-8, eyring_stress=4e6)
    problem = LineProblem(
        lubricant=oil, radius=0.012, line_load=3e5, reduced_modulus=2.2e11, speed_1=-1.0,
        speed_2=2.5,
    )  # fmt: skip
    scales = line_scales(problem)
    # b^2 = 8 w R/(pi E'), p_H = 2 w/(pi b)
    b = math.sqrt(8.0 * 3e5 * 0.012 / (math.pi * 2.2e11))
    assert scales.length == pytest.approx(b)
    assert scales.pressure == pytest.approx(2.0 * 3e5 / (math.pi * b))
    assert scales.film == pytest.approx(b * b / 0.012)
    assert scales.speed == 2.5
    assert scales.time == pytest.approx(b / 2.5)
    for conserving in (False, True):
        found = row_coefficients(problem, scales, 0.02, "upwind-1", conserving)
        assert found.step == 0.02
        assert found.speed == pytest.approx(0.75 / 2.5)
        # Poiseuille's flow h^3 p/(12 eta l) over the flow h u
        poiseuille = scales.film**3 * scales.pressure / (12.0 * 0.05 * b)
        assert found.mobility == pytest.approx(poiseuille / (scales.film * 2.5))
        assert found.pressure == scales.pressure
        # stress drop over half the film, and Newtonian stress of sliding, over tau0
        drop = 0.5 * scales.film * scales.pressure / b
        assert found.sigma == pytest.approx(drop / 4e6)
        assert found.shear == pytest.approx(0.05 * 3.5 / scales.film / 4e6)
        assert (found.weight, found.storage) == (1.0, 0.0)
        assert found.blend == (1e-3 if conserving else 0.0)
    newtonian = LineProblem(
        lubricant=film_oil(eta0=0.05, alpha=2e-8), radius=0.012, line_load=3e5,
        reduced_modulus=2.2e11, speed_1=-3.0, speed_2=2.5,
    )  # fmt: skip
    assert line_scales(newtonian).speed == 3.0
    found = row_coefficients(newtonian, scales, 0.02, "upwind-1", False)
    assert (found.sigma, found.shear) == (0.0, 0.0)


def test_storage_takes_its_rate_times_the_oil_of_inner_nodes():
    shape = (4, 5)
    mass, residual, rho, slope, film = RNG.random((5, *shape))
    state = SimpleNamespace(mass=mass, residual=residual.copy(), density=rho,
                            density_slope=slope, film=film)  # fmt: skip
    source = RNG.random(shape)
    storage = Storage.of(0.7, source, shape)
    inner = (slice(1, -1), slice(1, -1))
    assert storage.released(mass) == pytest.approx(source - 0.7 * mass)
    # what flows in is what is stored: rate mass - source more than what is left
    assert storage.inflow(state) == pytest.approx(residual + 0.7 * mass - source)
    free = np.ones(shape, dtype=bool)
    free[2, 2] = False
    by_pressure, by_film = np.zeros((2, *shape))
    storage.add_derivatives(state, free, by_pressure, by_film)
    counts = np.zeros(shape)
    counts[inner] = 0.7
    counts[2, 2] = 0.0
    # d(rho h) = rho' h dp + rho dh
    assert by_pressure == pytest.approx(-counts * slope * film)
    assert by_film == pytest.approx(-counts * rho)
    still = NoStorage(np.zeros(shape))
    assert not still.released(mass).any()
    assert still.inflow(state) is state.residual
    assert not still.rate.any()


def test_coarsest_grid_is_solved_as_its_dense_system():
    shape = (5, 6)
    free = RNG.random(shape) < 0.8
    operator = operator_of(some_entries(free), free)
    operator = SparseOperator(operator.matrix, free, RNG.random(shape))
    deflection = RNG.random((30, 30))
    cells = RNG.random(6)
    grid = SimpleNamespace(shape=shape, cells=cells, dense_deflection=lambda: deflection)
    residual = RNG.random(shape)
    pressure, approach = CoarseSolution(grid, operator, 2.5)(residual, 0.3)
    assert not pressure[~free].any()
    dense = operator.matrix.toarray()
    left = dense.real @ pressure.ravel() + dense.imag @ (deflection @ pressure.ravel())
    left += approach * operator.by_approach.ravel()
    # single precision, times a condition number of some hundreds
    assert left[free.ravel()] == pytest.approx(residual[free], rel=1e-4)
    assert (pressure * cells).sum() / 2.5 == pytest.approx(0.3, rel=1e-4)


def test_mixing_solves_a_linear_iteration_in_as_many_turns_as_it_has_modes():
    # x = A x + b with three eigenvalues, one of them above one
    basis = np.linalg.qr(RNG.normal(size=(9, 9)))[0]
    A = basis @ np.diag([0.9] * 4 + [-0.8] * 3 + [1.5] * 2) @ basis.T
    b = RNG.normal(size=9)
    goal = np.linalg.solve(np.eye(9) - A, b)
    mixing, x = AndersonMixing(5), np.zeros(9)
    for _ in range(4):
        x = mixing(x, A @ x + b)
    assert x == pytest.approx(goal, rel=1e-8)
    # the first turn is taken as it is; a shallow one forgets and needs more
    first = AndersonMixing(5)
    assert first(np.zeros(9), b) is b
    shallow, x = AndersonMixing(1), np.zeros(9)
    for _ in range(4):
        x = shallow(x, A @ x + b)
    assert np.abs(x - goal).max() > 1e-3 * np.abs(goal).max()


def test_depth_of_mixing_is_the_number_of_turns_besides_the_last():
    basis = np.linalg.qr(RNG.normal(size=(9, 9)))[0]
    A = basis @ np.diag(np.linspace(-0.9, 0.9, 9)) @ basis.T
    b = RNG.normal(size=9)
    deep, x, values = AndersonMixing(2), np.zeros(9), []
    for _ in range(5):
        after = A @ x + b
        values.append((x, after))
        x = deep(x, after)
    # of the last three: the combination with the smallest change
    before, later = (np.array(one[-3:]).T for one in zip(*values, strict=True))
    misses = later - before
    weights = np.linalg.lstsq(np.diff(misses), misses[:, -1], rcond=None)[0]
    assert x == pytest.approx(later[:, -1] - np.diff(later) @ weights, rel=1e-8)


def bearing(position: float) -> SupportStiffness:
    return SupportStiffness(position, *RNG.uniform(1.0, 2.0, 7))


def test_two_bearings_are_as_stiff_as_the_sum_of_their_energies(monkeypatch):
    interpret(monkeypatch, supports)
    bearings = bearing(0.3), bearing(-0.5)
    found = supports.member_stiffness(*bearings)
    q = RNG.normal(size=5)  # x, y, z, tilt about x and y
    x, y, z, a, b = q
    energy = 0.0
    for one in bearings:
        u, v = x + one.position * b, y - one.position * a
        energy += 0.5 * (one.K_xx * u**2 + one.K_yy * v**2 + one.K_zz * z**2)
        energy += 0.5 * (one.K_theta_x * a**2 + one.K_theta_y * b**2)
        energy += one.K_x_theta_y * u * b + one.K_y_theta_x * v * a
    whole = 0.5 * (found.K_xx * x**2 + found.K_yy * y**2 + found.K_zz * z**2)
    whole += 0.5 * (found.K_ax * a**2 + found.K_ay * b**2)
    whole += found.K_x_ay * x * b + found.K_y_ax * y * a
    assert whole == pytest.approx(energy, rel=1e-12)


def test_bearing_takes_what_is_given_in_the_place_of_its_own():
    own = bearing(0.3)
    replaced = source_of(supports.replaced_bearing)
    assert replaced(own, 1.0, 0.0, 0.0, 0.0) == own
    found = replaced(own, -1.0, 8.0, 6.0, 0.4)
    assert found == own._replace(position=-0.4, K_xx=4.0, K_yy=4.0, K_zz=3.0)
    assert source_of(supports.damping_constant)(4.0, 9.0, 0.05) == pytest.approx(0.6)
    # k x^2 + 2 c x t + K t^2 is nowhere negative up to c^2 = k K
    limit = source_of(supports.coupling_limit)(3.0, 5.0)
    for share, definite in ((0.999, True), (1.001, False)):
        matrix = np.array([[3.0, share * limit], [share * limit, 5.0]])
        assert (np.linalg.eigvalsh(matrix)[0] > 0.0) == definite
