"""Unilateral contact: balance, complementarity, and the answer of an independent solver."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.unilateral import solve_rotation, solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem
from gearlube_core.tooth_contact.coupled_strips import StripCompliance
from tests.helpers.each import each

E_STAR, DX, DY, NX, NY = 115.4e9, 3e-5, 5e-4, 9, 8
STRIP = HalfSpaceConvolution(love_coefficients(DX, DY, NX, NY, E_STAR, "mean"))


def random_problem(seed: int, coupling: float) -> tuple[UnilateralProblem, np.ndarray]:
    """Return two rough strips with an indefinite smooth part, and the dense compliance."""
    random = np.random.default_rng(seed)
    n = 2 * NX * NY
    modes = np.linspace(0.0, 1.0, 4)
    hats = np.maximum(0.0, 1.0 - 3.0 * np.abs(np.linspace(0.0, 1.0, NY)[:, None] - modes))
    shapes = np.kron(np.eye(2), np.tile(hats, (NX, 1)))
    root = random.standard_normal((8, 8))
    K = coupling * root @ root.T / 8.0 - 1e-10 * np.eye(8)
    compliance = StripCompliance([STRIP, STRIP], shapes, K)
    dense = np.column_stack([compliance(column).copy() for column in np.eye(n)])
    x, y = np.arange(NX) - 4.0, np.arange(NY) - 3.5
    smooth = (x[:, None] * DX) ** 2 / 0.02 + (y * DY) ** 2 / 2.0
    gap = np.tile(smooth.ravel(), 2) + 1e-6 * random.random(n)
    gap[random.random(n) < 0.1] = np.inf
    arm = 0.022 * (1.0 + 0.2 * random.random(n))
    return UnilateralProblem(
        compliance=compliance, gap=gap, arm=arm, cell_area=np.full(n, DX * DY)
    ), dense


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 10_000),
    coupling=st.sampled_from([0.0, 1e-9, 3e-8, 1e-6]),
    torque=st.floats(0.05, 500.0),
)
def test_forces_balance_and_complement_gaps(seed: int, coupling: float, torque: float) -> None:
    problem, dense = random_problem(seed, coupling)
    solution = solve_torque(problem, torque, tolerance=1e-8)
    forces = solution.forces
    assert (forces >= 0.0).all()
    assert problem.arm @ forces == pytest.approx(torque, rel=1e-10)
    # from the dense compliance, not from what the solver carried along
    displacement = dense @ forces
    separation = problem.gap + displacement - problem.arm * solution.rotation
    closed = solution.touching
    scale = float(forces @ displacement) / float(forces.sum())
    # forces that are off by 1e-8 of their mean leave the softest mode of the cells open by this
    error = 1e-8 * float(forces.sum()) / np.sqrt(problem.usable.sum())
    softest = np.linalg.eigvalsh(dense[np.ix_(closed, closed)])[-1]
    assert np.linalg.norm(separation[closed]) <= softest * error
    assert separation[~closed].min(initial=0.0) >= -softest * error
    np.testing.assert_allclose(solution.displacement, displacement, atol=1e-9 * scale, rtol=1e-9)


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 10_000),
    coupling=st.sampled_from([0.0, 1e-9, 3e-8, 1e-6]),
    closing=st.floats(1e-7, 3e-5),
)
def test_given_rotation_agrees_with_non_negative_least_squares(
    seed: int, coupling: float, closing: float
) -> None:
    """min f.A f/2 - c.f over f >= 0 is min |L^T f - L^-1 c| with A = L L^T: Lawson and Hanson."""
    problem, dense = random_problem(seed, coupling)
    rotation = (float(problem.gap.min()) + closing) / 0.022
    solution = solve_rotation(problem, rotation, tolerance=1e-10)
    usable = problem.usable
    c = (problem.arm * rotation - problem.gap)[usable]
    L = np.linalg.cholesky(dense[np.ix_(usable, usable)])
    scale = np.sqrt(dense[0, 0])
    forces, _ = nnls(L.T / scale, np.linalg.solve(L, c) / scale, maxiter=10_000)
    # gaps within 1e-10; forces follow with the condition of the compliance, up to 1e5 here
    np.testing.assert_allclose(
        solution.forces[usable], forces, atol=1e-5 * max(float(forces.max()), 1e-12), rtol=0
    )


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 10_000), torque=st.floats(0.1, 100.0), factor=st.floats(1.05, 5.0))
def test_more_torque_means_more_rotation_and_energy(
    seed: int, torque: float, factor: float
) -> None:
    problem, _ = random_problem(seed, 3e-9)
    less, more = solve_torque(problem, torque), solve_torque(problem, factor * torque)
    assert more.rotation > less.rotation
    # convex: work lies between the two rectangles
    work = more.strain_energy - less.strain_energy
    turned = more.rotation - less.rotation
    assert torque * turned < work < factor * torque * turned


@pytest.mark.slow
@each("seed", range(6))
def test_energy_never_rises_from_one_iteration_to_the_next(seed: int) -> None:
    """Runs cut after n iterations are prefixes of each other: equal input gives equal bits."""
    problem, dense = random_problem(seed, 1e-6)
    gap = np.where(problem.usable, problem.gap, 0.0)
    start = np.random.default_rng(seed).random(gap.size) ** 8
    energy = []
    for n in range(1, 60):
        forces = solve_torque(problem, 5.0, max_iterations=n, start=start, throw=False).forces
        energy.append(float(0.5 * forces @ dense @ forces + gap @ forces))
    # the torque is fixed, so its work is not part of the balance; 1e-12 is rounding
    assert np.diff(energy).max() <= 1e-12 * energy[0]


def test_two_spur_lines_with_equal_cells_let_go_of_many_cells_at_once() -> None:
    """1400 of 2976 cells carry load; letting go one at a time took over 1000 iterations.

    Teeth of 1e-7 m/N beside half-spaces under 1.2e-9 m/N: cells cannot be solved on their own.
    """
    n_x, n_y, width, torque, arm = 31, 48, 0.02, 5.0, 0.035
    half = 1.7 * np.sqrt(4.0 * torque / arm / 2.0 / width * 8e-3 / (np.pi * E_STAR))
    cell = (2.0 * half / n_x, width / n_y)
    line = HalfSpaceConvolution(love_coefficients(*cell, n_x, n_y, E_STAR))
    modes, t = np.linspace(0.0, 1.0, 7), (np.arange(n_y) + 0.5) / n_y
    hats = np.maximum(0.0, 1.0 - 6.0 * np.abs(t[:, None] - modes))
    bending = 1e-7 * np.exp(-0.5 * np.abs(modes[:, None] - modes))
    x = (np.arange(n_x) - n_x // 2) * cell[0]
    problem = UnilateralProblem(
        compliance=StripCompliance(
            [line, line], np.kron(np.eye(2), np.tile(hats, (n_x, 1))), np.kron(np.eye(2), bending)
        ),
        gap=np.concatenate([np.repeat(x**2 / (2.0 * R), n_y) for R in (8e-3, 6e-3)]),
        arm=np.full(2 * n_x * n_y, arm),
        cell_area=np.full(2 * n_x * n_y, cell[0] * cell[1]),
    )
    solution = solve_torque(problem, torque, tolerance=1e-5)
    assert solution.outcome.iterations < 300
    separation = problem.gap + problem.compliance(solution.forces) - arm * solution.rotation
    scale = 2.0 * solution.strain_energy / solution.forces.sum()
    assert np.abs(separation[solution.touching]).max() < 1e-3 * scale
    assert separation[~solution.touching].min() > -1.1e-5 * scale
