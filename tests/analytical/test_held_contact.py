"""Contact on held cells, solved by an active set: against closed forms and another solver."""

import numpy as np
import pytest

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import UnilateralProblem
from gearlube_core.errors import ConvergenceError
from gearlube_core.tooth_contact.coupled_strips import StripCompliance
from gearlube_core.tooth_contact.held_contact import frozen_compliance, solve_held

CELL, SHAPE, MODULUS = (0.04e-3, 0.3e-3), (13, 17), 1.15e11
TORQUE = 40.0


@pytest.fixture(scope="module")
def strip():
    """Return a crowned cylinder: compliance, gap and arm of all cells."""
    row, column = (a.ravel() for a in np.indices(SHAPE))
    none = np.zeros((row.size, 1))
    compliance = frozen_compliance(row, column, CELL, none, np.zeros((1, 1)), MODULUS)
    x, y = (row - 6) * CELL[0], (column - 8) * CELL[1]
    gap = x**2 / (2.0 * 0.02) + y**2 / (2.0 * 1.5)
    arm = 0.04 + 0.2 * y
    return compliance, gap, arm


def held(strip, gap=None):
    compliance, plain, arm = strip
    gap = plain if gap is None else gap
    return solve_held([compliance], [gap], [arm], TORQUE, [gap < 1e-6])


def test_springs_of_known_gaps_close_one_by_one():
    stiffness, arm = 1e8, 0.05
    gaps = np.array([0.0, 1e-6, 2e-6, 8e-6])
    soft = np.eye(4) / stiffness
    # two closed: k R (2 theta R - 1 um) = T
    torque = 20.0
    theta = (torque / (stiffness * arm) + 3e-6) / (3.0 * arm)
    assert 2e-6 < theta * arm < 8e-6  # three carry
    found = solve_held([soft], [gaps], [np.full(4, arm)], torque, [np.ones(4, bool)])
    assert found.active[0].tolist() == [True, True, True, False]
    assert found.rotation == pytest.approx(theta, rel=1e-12)


def test_it_finds_what_conjugate_gradients_find(strip):
    _, gap, arm = strip
    love = HalfSpaceConvolution(love_coefficients(*CELL, *SHAPE, MODULUS))
    problem = UnilateralProblem(
        compliance=StripCompliance([love], None, None),
        gap=gap,
        arm=arm,
        cell_area=np.full(gap.size, CELL[0] * CELL[1]),
    )
    expected = solve_torque(problem, TORQUE, tolerance=1e-10)
    found = held(strip)
    forces = np.zeros(gap.size)
    forces[found.active[0]] = found.equilibrium.forces[0]
    assert found.rotation == pytest.approx(expected.rotation, rel=1e-7)
    assert np.abs(forces - expected.forces).max() < 1e-5 * forces.max()
    assert arm @ forces == pytest.approx(TORQUE, rel=1e-10)


def test_rates_are_those_of_a_contact_solved_anew(strip):
    compliance, gap, arm = strip
    found = held(strip)
    shape = np.linspace(-1.0, 1.0, gap.size) ** 2
    turn, moves = found.rates([shape[None, :]])
    step = 1e-12  # m: no cell opens or closes
    ends = [
        solve_held([compliance], [gap + sign * step * shape], [arm], TORQUE, found.active)
        for sign in (-1.0, 1.0)
    ]
    assert all((one.active[0] == found.active[0]).all() for one in ends)
    expected = (ends[1].rotation - ends[0].rotation) / (2.0 * step)
    # rounding of rotations of 1e-4 rad over steps of 1e-12 m times 25 rad/m
    assert turn[0] == pytest.approx(expected, rel=1e-4)
    forces = (ends[1].equilibrium.forces[0] - ends[0].equilibrium.forces[0]) / (2.0 * step)
    assert np.abs(moves[0][0] - forces).max() < 1e-3 * np.abs(forces).max()


def test_cells_that_never_settle_are_refused():
    # not positive definite: a cell that carries opens, one that opens carries
    wrong = np.array([[1.0, 3.0], [3.0, 10.0]]) * 1e-9
    with pytest.raises((ConvergenceError, np.linalg.LinAlgError)):
        solve_held([-wrong], [np.zeros(2)], [np.ones(2)], 1.0, [np.array([True, False])])
